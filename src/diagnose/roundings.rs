//! A phase shifter that has only so many settings: how many is looked for by what frames say of their phase, as the period of a line is.

use super::data::Data;
use super::fit::{Fit, fit};
use super::included::included_of;
use super::lines::{FrameSeen, Series};
use super::noise::Noise;
use super::pass::THRESHOLD;
use super::periodogram::Sum;
use super::pieces::{Piece, Variant};
use crate::physics::effects::phase_step_errors::{
    A_TURN, DOWN, EFFECT, MOST_A_TURN, MOST_SETTINGS, ROUNDING, rounded_by,
};
use crate::physics::{Effect, Moment};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Settings a turn that are looked for: of fewer each one may have an error of its own.
const SETTINGS: (f64, f64) = (MOST_SETTINGS, MOST_A_TURN / 2.0);
/// A settings' number is so many times finer than the inverse of the turns that commanded phases range over; and then so many times finer still.
const FINENESS: f64 = 8.0;
const FINER: i32 = 16;
/// So many roundings are tried at most.
const MOST_ROUNDED: f64 = 3e7;
/// At no more phases the pixels' own numbers take a part of what they are off by, which nobody knows here.
const FEW: usize = 8;
/// Phases closer than this, in turns, are one: files round them.
const ALIKE: f64 = 1e-8;
/// Two roundings may be the same but for their size where, between the steps of the scan, they are so much alike, and are where they are so.
const NEARLY: f64 = 0.8;
const ALIKE_BUT_FOR_SIZE: f64 = 0.995;

/// What a rounding to so many settings would explain.
#[derive(Debug, Clone, Copy)]
struct Rounding {
    settings: f64,
    rounds_down: bool,
    chi2: f64,
}

/// What all frames of a recording say that were taken at the same phase.
#[derive(Debug, Clone, Copy)]
struct Commanded {
    take: usize,
    turns: f64,
    phase: Sum,
}

impl Series {
    /// What frames say of their phase, by recording and commanded phase.
    fn commanded(&self) -> Vec<Commanded> {
        let of = |frame: &FrameSeen| Commanded { take: frame.take, turns: frame.turns, phase: frame.phase };
        let mut all: Vec<Commanded> = self.frames.iter().map(of).collect();
        all.sort_by(|a, b| a.take.cmp(&b.take).then(a.turns.total_cmp(&b.turns)));
        let is_same = |a: &Commanded, b: &Commanded| a.take == b.take && b.turns - a.turns < ALIKE;
        let sum = |of: &[Commanded]| {
            let add = |sum: Sum, of: &Commanded| (sum.0 + of.phase.0, sum.1 + of.phase.1);
            Commanded { phase: of.iter().fold((0.0, 0.0), add), ..of[0] }
        };
        all.chunk_by(is_same).map(sum).collect()
    }

    /// The rounding that explains most, among how many.
    fn rounding(&self) -> Option<(Rounding, f64)> {
        let all = self.commanded();
        let takes: Vec<&[Commanded]> = all.chunk_by(|a, b| a.take == b.take).collect();
        let a_setting = a_setting(&all)?;
        let most = SETTINGS.1.min(SETTINGS.0 + MOST_ROUNDED / (2.0 * a_setting * all.len() as f64));
        let count = (a_setting * (most - SETTINGS.0)) as usize + 1;
        let of = |(settings, rounds_down): (f64, bool)| {
            let chi2 = takes.iter().map(|take| explained(take, settings, rounds_down)).sum();
            Rounding { settings, rounds_down, chi2 }
        };
        let both = |settings: f64| [(settings, false), (settings, true)];
        let tried = (0..count).into_par_iter().flat_map_iter(|n| both(SETTINGS.0 + n as f64 / a_setting));
        let most = |a: &Rounding, b: &Rounding| a.chi2.total_cmp(&b.chi2);
        let best = tried.map(of).max_by(most)?;
        let finer = |n: i32| best.settings + f64::from(n) / (a_setting * f64::from(FINER));
        let near = (-FINER..=FINER).map(|n| of((finer(n), best.rounds_down)));
        let best = std::iter::once(best).chain(near).max_by(most).filter(|best| best.chi2 > 0.0)?;
        Some((best, 2.0 * count as f64))
    }
}

/// In how many steps a number of settings is looked at, if phases are several.
fn a_setting(all: &[Commanded]) -> Option<f64> {
    let (low, high) = all
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), of| (low.min(of.turns), high.max(of.turns)));
    Some((FINENESS * (high - low)).ceil()).filter(|steps| *steps >= 1.0)
}

/// By how much chi squared is less with a rounding than without, beside a constant error of the phase. At many phases nothing scales it, so that of the
/// numbers of settings that round phases alike but for a factor the one is found that has them.
fn explained(take: &[Commanded], settings: f64, rounds_down: bool) -> f64 {
    let (mut score, mut information, mut with, mut square) = (0.0, 0.0, (0.0, 0.0), 0.0);
    for Commanded { turns, phase, .. } in take {
        let by_rad = TAU * rounded_by(*turns, settings, rounds_down);
        score += phase.0;
        information += phase.1;
        // A gate that comes later is light that comes earlier.
        with.0 -= phase.0 * by_rad;
        with.1 += phase.1 * by_rad;
        square += phase.1 * by_rad * by_rad;
    }
    if information <= 0.0 {
        return 0.0;
    }
    let mean = with.1 / information;
    let (score, information) = (with.0 + mean * score, square - mean * with.1);
    let is_scaled = take.len() <= FEW && (0.0..information).contains(&score);
    if is_scaled { score * score / information } else { 2.0 * score - information }
}

/// The phases that the recordings' frames were commanded, each as often as it was.
fn commanded(data: &Data) -> Vec<Commanded> {
    let frame = |(take, of): (usize, &Moment)| FrameSeen {
        take,
        turns: (of.step_rad + of.offset_rad) / TAU,
        phase: (0.0, 1.0),
        ..FrameSeen::default()
    };
    let takes = data.takes.iter().enumerate();
    let frames = takes.flat_map(|(take, of)| of.moments.iter().map(move |of| frame((take, of)))).collect();
    Series { frames, ..Series::default() }.commanded()
}

/// Of two roundings, how alike their patterns are, from -1 to 1, and by which factor of the other one is most of the one.
fn alike(takes: &[&[Commanded]], one: (f64, bool), other: (f64, bool)) -> (f64, f64) {
    let (mut squares, mut product) = ((0.0, 0.0), 0.0);
    for take in takes {
        let mut sums = [0.0; 6];
        for Commanded { turns, phase: (_, often), .. } in *take {
            let (a, b) = (rounded_by(*turns, one.0, one.1), rounded_by(*turns, other.0, other.1));
            let values = [1.0, a, b, a * a, b * b, a * b];
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += often * value);
        }
        let [all, a, b, aa, bb, ab] = sums;
        squares.0 += aa - a * a / all;
        squares.1 += bb - b * b / all;
        product += ab - a * b / all;
    }
    (product / (squares.0 * squares.1).sqrt(), product / squares.1)
}

/// What is `fitted` with another number of settings, which rounds these phases alike but for a factor, where that factor is nearer to a whole rounding.
pub fn whole(data: &Data, fitted: Fit, noise: Noise) -> Fit {
    let is_rounding =
        |piece: &&Piece| std::ptr::eq(piece.effect, &raw const EFFECT) && piece.free == [ROUNDING];
    let Some(piece) = fitted.pieces.iter().find(is_rounding) else { return fitted };
    let (strength, settings, down) = (piece.values[ROUNDING], piece.values[A_TURN], piece.values[DOWN] > 0.5);
    let all = commanded(data);
    let takes: Vec<&[Commanded]> = all.chunk_by(|a, b| a.take == b.take).collect();
    let Some(a_setting) = a_setting(&all) else { return fitted };
    let of = |other: f64| (other, alike(&takes, (settings, down), (other, down)));
    let finest = |near: f64| {
        let finer = (-FINER..=FINER).map(|n| of(near + f64::from(n) / (a_setting * f64::from(FINER))));
        finer.max_by(|a, b| a.1.0.total_cmp(&b.1.0))
    };
    let off = |factor: f64| (strength * factor - 1.0).abs();
    let numbers = 0..(a_setting * (SETTINGS.1 - SETTINGS.0)) as usize;
    let others = numbers.into_par_iter().map(|n| of(SETTINGS.0 + n as f64 / a_setting));
    let others = others.filter(|(_, (alike, factor))| *alike > NEARLY && off(*factor) < off(1.0));
    let others =
        others.filter_map(|(near, _)| finest(near)).filter(|(_, (alike, _))| *alike > ALIKE_BUT_FOR_SIZE);
    let Some((other, (_, factor))) = others.min_by(|a, b| off(a.1.1).total_cmp(&off(b.1.1))) else {
        return fitted;
    };
    let with = |piece: &Piece| {
        let mut piece = piece.clone();
        if is_rounding(&&piece) {
            (piece.values[ROUNDING], piece.values[A_TURN]) = (strength * factor, other);
        }
        piece
    };
    let anew = fit(data, Some(&fitted), fitted.pieces.iter().map(with).collect(), noise, &|_| true);
    if off(factor) < off(1.0) && anew.cost() < fitted.cost() + THRESHOLD { anew } else { fitted }
}

/// What a sentence says besides of `pieces` that round.
pub fn says(pieces: &[Piece], name: &str) -> String {
    let of = pieces.iter().filter(|piece| piece.effect.name == name && name == EFFECT.name);
    let rounding = of.filter(|piece| piece.free == [ROUNDING]).map(|piece| {
        let settings = piece.values[A_TURN];
        let down = if piece.values[DOWN] > 0.5 { ", and takes the last one before a phase" } else { "" };
        format!(" It has {settings:.0} a turn, {:.2} degrees apart{down}.", 360.0 / settings)
    });
    rounding.collect()
}

/// The way in which `effect`, if it is of the phase shifter, rounds to settings, if frames say that it may.
pub fn rounded(effect: &'static Effect, data: &Data, series: &Series) -> Option<Variant> {
    if !std::ptr::eq(effect, &raw const EFFECT) {
        return None;
    }
    let (found, looked) = series.rounding()?;
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
    use crate::physics::Draws;

    /// Frames of 4 and 5 steps at so many offsets of a turn, whose phases are rounded, known to a milliradian each.
    fn series(offsets: usize, by: &dyn Fn(f64) -> f64) -> Series {
        let noise = Draws::of(7, 3).normal(9 * offsets);
        let mut frames = Vec::new();
        for (take, steps) in [(0, 4), (1, 5)] {
            for n in 0..offsets * steps {
                let step = if steps == 4 { 0.25 } else { 1.0 / 3.0 };
                let turns = (n / steps) as f64 / offsets as f64 + (n % steps) as f64 * step;
                let error_rad = -TAU * by(turns) + 1e-3 * noise[n + 4 * offsets * take];
                frames.push(FrameSeen { take, turns, phase: (1e6 * error_rad, 1e6), ..FrameSeen::default() });
            }
        }
        Series { frames, ..Series::default() }
    }

    #[test]
    fn the_number_of_settings_is_found() {
        for (settings, rounds_down) in [(100.0, false), (240.0, true), (595.3, false), (72.0, true)] {
            let seen = series(53, &|turns| rounded_by(turns, settings, rounds_down));
            let (found, looked) = seen.rounding().unwrap();
            assert!((found.settings - settings).abs() < 0.2, "{settings}: {found:?} of {looked}");
            assert_eq!(found.rounds_down, rounds_down, "{settings}: {found:?}");
            assert!(found.chi2 > 10.0 * looked.ln());
        }
    }

    /// Phases that are exact, or all off by the same, have no settings.
    #[test]
    fn noise_is_no_number_of_settings() {
        for error in [0.0, 0.01] {
            let found = series(53, &|_| error).rounding();
            assert!(found.is_none_or(|(found, looked)| found.chi2 < 4.0 * looked.ln()), "{found:?}");
        }
        assert!(Series::default().rounding().is_none());
    }
}
