//! A phase shifter that has only so many settings: how many is looked for by what frames say of their phase, as the period of a line is.

use crate::diagnose::periodic::lines::Series;
use crate::diagnose::reading::data::{Data, SAME_PHASE_RAD};
use crate::diagnose::reading::included::included_of;
use crate::diagnose::statistics::periodogram::Sum;
use crate::diagnose::tangents::pieces::{Piece, Variant};
use crate::physics::Effect;
use crate::physics::effects::phase_step_errors::{A_TURN, DOWN, EFFECT, MOST_A_TURN, ROUNDING, rounded_by};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// The effect whose phases may be rounded.
pub const OF_SHIFTER: &str = EFFECT.name;
/// Settings a turn that are looked for.
pub const SETTINGS: (f64, f64) = (8.0, MOST_A_TURN / 2.0);
/// Phases that are commanded range over so many turns at most: nobody knows whether a shifter goes on counting beyond that.
const MOST_TURNS: f64 = 4.0;
/// A settings' number is so many times finer than the inverse of the turns that commanded phases range over; and, twice, so many times finer still.
const FINENESS: f64 = 8.0;
/// See [`FINENESS`].
pub const FINER: i32 = 16;
/// So many phases are looked at for all numbers, and for so many of these, which then say most, all phases.
pub const MOST_PHASES: usize = 400;
const BEST: usize = 32;
/// At no more phases the pixels' own numbers take a part of what they are off by, which nobody knows here.
const FEW: usize = 8;

/// What a rounding to so many settings would explain.
#[derive(Debug, Clone, Copy)]
struct Rounding {
    settings: f64,
    rounds_down: bool,
    chi2: f64,
}

/// What all frames of a recording say that were taken at the same phase.
#[derive(Debug, Clone, Copy)]
pub struct Commanded {
    take: usize,
    /// Turns.
    pub turns: f64,
    /// What they say of an error of the light's phase.
    pub phase: Sum,
}

/// The phases of a recording, with what they say beside a constant error and one in proportion to the phase, which are no rounding.
pub struct Phases {
    /// Each of them.
    pub all: Vec<Commanded>,
    /// Information of all, the mean of the phases, and their spread.
    pub information: f64,
    mean: f64,
    spread: f64,
    /// Score of a constant error, and of one in proportion to the phase beside it.
    score: (f64, f64),
}

impl Phases {
    fn of(all: Vec<Commanded>) -> Self {
        let sum = |of: &dyn Fn(&Commanded) -> f64| all.iter().map(of).sum::<f64>();
        let information = sum(&|of| of.phase.1);
        let mean = if information > 0.0 { sum(&|of| of.phase.1 * of.turns) / information } else { 0.0 };
        let spread = sum(&|of| of.phase.1 * (of.turns - mean).powi(2));
        let score = (sum(&|of| of.phase.0), sum(&|of| of.phase.0 * (of.turns - mean)));
        Self { all, information, mean, spread, score }
    }

    /// Of each recording of `all`, every so many.
    pub fn thinned(all: &[Commanded], every: usize) -> Vec<Self> {
        let takes = all.chunk_by(|a, b| a.take == b.take);
        takes.map(|take| Self::of(take.iter().step_by(every).copied().collect())).collect()
    }

    /// By how much chi squared is less with a rounding than without. At many phases nothing scales it, so that of the numbers of settings that round phases alike but
    /// for a factor the one is found that has them; at few it may be less than it is.
    fn explained(&self, settings: f64, rounds_down: bool) -> f64 {
        let (mut with, mut sum, mut along, mut square) = (0.0, 0.0, 0.0, 0.0);
        for Commanded { turns, phase, .. } in &self.all {
            let by_rad = TAU * rounded_by(*turns, settings, rounds_down);
            // A gate that comes later is light that comes earlier.
            with -= phase.0 * by_rad;
            sum += phase.1 * by_rad;
            along += phase.1 * by_rad * (turns - self.mean);
            square += phase.1 * by_rad * by_rad;
        }
        if self.information <= 0.0 {
            return 0.0;
        }
        let (mean, slope) =
            (sum / self.information, if self.spread > 0.0 { along / self.spread } else { 0.0 });
        let score = with + mean * self.score.0 + slope * self.score.1;
        let information = square - mean * sum - slope * along;
        let share = if self.all.len() <= FEW { (score / information).clamp(0.0, 1.0) } else { 1.0 };
        if information > 0.0 { share * (2.0 * score - share * information) } else { 0.0 }
    }
}

impl Series {
    /// What frames say of their phase, by recording and commanded phase.
    pub fn commanded(&self) -> Vec<Commanded> {
        let lit = self.frames.iter().filter(|frame| frame.phase.1 > 0.0);
        let mut all: Vec<Commanded> =
            lit.map(|frame| Commanded { take: frame.take, turns: frame.turns, phase: frame.phase }).collect();
        all.sort_by(|a, b| a.take.cmp(&b.take).then(a.turns.total_cmp(&b.turns)));
        let is_same =
            |a: &Commanded, b: &Commanded| a.take == b.take && TAU * (b.turns - a.turns) < SAME_PHASE_RAD;
        let sum = |of: &[Commanded]| {
            let add = |sum: Sum, of: &Commanded| (sum.0 + of.phase.0, sum.1 + of.phase.1);
            Commanded { phase: of.iter().fold((0.0, 0.0), add), ..of[0] }
        };
        all.chunk_by(is_same).map(sum).collect()
    }

    /// The rounding that explains most, among how many.
    fn rounding(&self) -> Option<(Rounding, f64)> {
        let all = self.commanded();
        let steps = steps(&all)?;
        let every = all.len().div_ceil(MOST_PHASES);
        let [few, all] = [every, 1].map(|every| Phases::thinned(&all, every));
        let of = |takes: &[Phases], settings: f64, rounds_down: bool| {
            let chi2 = takes.iter().map(|take| take.explained(settings, rounds_down)).sum();
            Rounding { settings, rounds_down, chi2 }
        };
        let most = |a: &Rounding, b: &Rounding| a.chi2.total_cmp(&b.chi2);
        let count = numbers(steps);
        let both = |n: usize| [false, true].map(|down| of(&few, SETTINGS.0 + n as f64 / steps, down));
        let mut tried: Vec<Rounding> = (0..count).into_par_iter().flat_map_iter(both).collect();
        tried.sort_by(|a, b| most(b, a));
        tried.truncate(BEST);
        let finest = |best: Rounding, step: f64| {
            let near = (-FINER..=FINER).map(|n| best.settings + f64::from(n) * step / f64::from(FINER));
            let near = near.filter(|settings| *settings >= 1.0);
            near.map(|settings| of(&all, settings, best.rounds_down)).max_by(most).unwrap_or(best)
        };
        let best = tried.into_par_iter().map(|best| finest(best, steps.recip())).max_by(most)?;
        let best = finest(best, steps.recip() / f64::from(FINER));
        (best.chi2 > 0.0).then_some((best, 2.0 * count as f64))
    }
}

/// In how many steps each number of settings is looked at, if phases are several.
pub fn steps(all: &[Commanded]) -> Option<f64> {
    let (low, high) = all
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), of| (low.min(of.turns), high.max(of.turns)));
    Some((FINENESS * (high - low)).ceil()).filter(|steps| (1.0..=FINENESS * MOST_TURNS).contains(steps))
}

/// So many numbers of settings are looked at in as many `steps` each.
pub fn numbers(steps: f64) -> usize {
    (steps * (SETTINGS.1 - SETTINGS.0)) as usize + 1
}

/// The settings a turn to which a `piece` rounds, and whether it rounds down; nothing where it does something else.
pub fn settings_of(piece: &Piece) -> Option<(f64, bool)> {
    let is_rounding = piece.effect.name == OF_SHIFTER && piece.free == [ROUNDING];
    is_rounding.then(|| (piece.values[A_TURN], piece.values[DOWN] > 0.5))
}

/// What the sentence about the effect called `name` says besides of `pieces` that round.
pub fn says_of_settings(pieces: &[Piece], name: &str) -> String {
    let of = pieces.iter().filter(|piece| piece.effect.name == name);
    let rounding = of.filter_map(settings_of).map(|(settings, rounds_down)| {
        let settings = (10.0 * settings).round() / 10.0;
        let down = if rounds_down { ", and takes the last one before a phase" } else { "" };
        format!(" The shifter has {settings} settings a turn, {:.2} degrees apart{down}.", 360.0 / settings)
    });
    rounding.collect()
}

/// The way in which `effect`, if it is of the phase shifter, rounds to settings, if frames say that it may.
pub fn rounded(effect: &'static Effect, data: &Data, series: &Series) -> Option<Variant> {
    if effect.name != OF_SHIFTER {
        return None;
    }
    // What does not pay for having been looked for is no way in which anything else may be said, either.
    let (found, looked) = series.rounding().filter(|(found, looked)| found.chi2 > 2.0 * looked.ln())?;
    let mut values = effect.off();
    (values[A_TURN], values[DOWN]) = (found.settings, f64::from(u8::from(found.rounds_down)));
    let takes: Vec<usize> = (0..data.takes.len()).collect();
    let included = included_of(data, effect, &takes);
    let piece = Piece { effect, values, free: vec![ROUNDING], takes, finite: false, included };
    Some(Variant { pieces: vec![piece], rarity: looked })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::periodic::lines::FrameSeen;
    use crate::physics::Draws;

    /// Frames of 4 and 5 steps at so many offsets of a turn, whose phases are off `by` turns and noise, and known to so many radians each.
    fn series(offsets: usize, seed: u64, sigma_rad: f64, by: &dyn Fn(f64) -> f64) -> Series {
        let noise = Draws::of(seed, 3).normal(9 * offsets);
        let information = sigma_rad.powi(-2);
        let mut frames = Vec::new();
        for (take, steps) in [(0, 4), (1, 5)] {
            for n in 0..offsets * steps {
                let step = if steps == 4 { 0.25 } else { 1.0 / 3.0 };
                let turns = (n / steps) as f64 / offsets as f64 + (n % steps) as f64 * step;
                let error_rad = -TAU * by(turns) + sigma_rad * noise[n + 4 * offsets * take];
                let phase = (information * error_rad, information);
                frames.push(FrameSeen { take, turns, phase, ..FrameSeen::default() });
            }
        }
        Series { frames, ..Series::default() }
    }

    /// Whole numbers or not, few phases or more than are looked at for all numbers.
    #[test]
    fn the_number_of_settings_is_found() {
        for (settings, rounds_down, offsets) in
            [(100.0, false, 53), (240.0, true, 53), (595.3, false, 53), (32.0, true, 53), (777.0, false, 211)]
        {
            let seen = series(offsets, 7, 1e-3, &|turns| rounded_by(turns, settings, rounds_down));
            let (found, looked) = seen.rounding().unwrap();
            assert!((found.settings - settings).abs() < 0.2, "{settings}: {found:?} of {looked}");
            assert_eq!(found.rounds_down, rounds_down, "{settings}: {found:?}");
            assert!(found.chi2 > 10.0 * looked.ln());
        }
    }

    /// Phases that are exact, all off by the same, or in proportion to themselves, have no settings, however little is known of them.
    #[test]
    fn noise_is_no_number_of_settings() {
        let mut most = 0.0_f64;
        for seed in 0..6 {
            for (constant, slope) in [(0.0, 0.0), (0.01, 0.0), (0.0, 0.002)] {
                let found = series(53, seed, 5e-3, &|turns| constant + slope * turns).rounding();
                let Some((found, looked)) = found else { continue };
                assert!(found.chi2 < 2.0 * looked.ln(), "{seed} {constant} {slope}: {found:?} of {looked}");
                most = most.max(found.chi2);
            }
        }
        // It was looked for.
        assert!(most > 2.0, "{most}");
        assert!(Series::default().rounding().is_none());
    }

    /// At few phases what is seen of a rounding may be less than it is, and none of it is nothing.
    #[test]
    fn of_few_phases_a_part_of_a_rounding_counts() {
        let at = |part: f64| {
            let of = |n: usize| {
                let turns = n as f64 / 3.0;
                let phase = (-1e6 * part * TAU * rounded_by(turns, 100.0, false), 1e6);
                Commanded { take: 0, turns, phase }
            };
            Phases::of((0..5).map(of).collect()).explained(100.0, false)
        };
        let whole = at(1.0);
        assert!(whole > 10.0 && at(0.0) == 0.0 && at(-0.5) == 0.0);
        assert!(
            (at(0.5) - 0.25 * whole).abs() < 1e-9 * whole && (at(2.0) - 3.0 * whole).abs() < 1e-9 * whole
        );
    }
}
