//! Ripples: light that comes and goes with the place of the target, whatever the time: by a motor's pole, or a slat before the emitter. Columns of the position are too coarse for
//! more than a few periods. Errors of the phase are left to the encoder, whose they are as a rule.

use super::levels::{LIGHT, MODES};
use super::swings::{LEAST_SETS, usual};
use crate::diagnose::statistics::evidence::Greatest;
use crate::diagnose::statistics::periodogram::{ANY, FINENESS, Scan, Sum, greatest, power};
use crate::physics::cos_sin;
use nalgebra::{Matrix2, Vector2};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Modes that may be a ripple, of [`MODES`]: an offset, a gain, the camera's own light.
const RIPPLING: [usize; 3] = [0, 1, LIGHT];
/// Fewer cycles over all places are what harmonics and walls do.
const LEAST_CYCLES: f64 = 3.0;
/// Cosine and sine.
const NUMBERS: usize = 2;
/// The median of chi squared of two degrees, 2 ln 2.
const MEDIAN: f64 = 2.0 * std::f64::consts::LN_2;
/// Places that are as near as this, m, are one.
const ONE_PLACE_M: f64 = 1e-3;
/// Cycles a metre at most.
const MOST_CYCLES_M: f64 = 250.0;

/// With a phase of their own recordings explain more; of what goes with the place it is nearly as much with one.
const IN_PHASE: f64 = 0.7;
/// Nor is most of it one recording's, in which the place goes with the time.
const OF_ONE: f64 = 0.9;
/// Products of frequencies and frames that are looked at, at most.
const MOST_PRODUCTS: f64 = 2e8;

/// Where the target is: at the frame, and at the beginning of its set, which the carriage's control may have gone by.
type Places = [f64; CLOCKS];
const CLOCKS: usize = 2;

/// What frames say of each mode, recording by recording: where the target was, m, and the sum.
#[derive(Debug, Clone, Default)]
pub struct Ripples {
    modes: [Takes; RIPPLING.len()],
}

type Takes = BTreeMap<usize, Vec<(Places, Sum)>>;

/// The strongest ripple of a mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ripple {
    /// Its mode.
    pub mode: &'static str,
    /// Its period, m.
    pub period_m: f64,
    /// What it says among all periods.
    pub found: Greatest,
}

impl Ripples {
    /// With what one more frame says of a mode, with the target at `places_m`: at the frame, and at the beginning of its set.
    pub fn add(&mut self, mode: usize, take: usize, places_m: Places, sum: Sum) {
        if let Some(number) = RIPPLING.iter().position(|rippling| *rippling == mode).filter(|_| sum.1 > 0.0) {
            self.modes[number].entry(take).or_default().push((places_m, sum));
        }
    }

    /// Those of both.
    pub fn and(mut self, other: Self) -> Self {
        for (mine, others) in self.modes.iter_mut().zip(other.modes) {
            others.into_iter().for_each(|(take, frames)| mine.entry(take).or_default().extend(frames));
        }
        self
    }

    /// The strongest ripple of each mode, with one phase in all recordings.
    pub fn strongest(&self) -> Vec<Ripple> {
        let of = |(takes, mode): (&Takes, usize)| {
            let by = |clock: usize| {
                let at =
                    |frames: &Vec<(Places, Sum)>| frames.iter().map(|(at, sum)| (at[clock], *sum)).collect();
                ripple(&takes.values().map(at).collect::<Vec<_>>(), MODES[mode])
            };
            (0..CLOCKS).filter_map(by).max_by(|a, b| a.found.ln_bayes.total_cmp(&b.found.ln_bayes))
        };
        self.modes.iter().zip(RIPPLING).filter_map(of).collect()
    }
}

fn ripple(takes: &[Vec<(f64, Sum)>], mode: &'static str) -> Option<Ripple> {
    let steps = |frames: &[(f64, Sum)]| -> Vec<f64> {
        let steps_m = frames.windows(2).map(|pair| (pair[1].0 - pair[0].0).abs());
        steps_m.filter(|step_m| *step_m > ONE_PLACE_M).collect()
    };
    let takes: Vec<&Vec<(f64, Sum)>> =
        takes.iter().filter(|frames| steps(frames).len() >= LEAST_SETS).collect();
    let usual_m = usual(takes.iter().flat_map(|frames| steps(frames)).collect())?;
    // Of one recording alone the place goes with the time.
    let takes: Vec<Vec<(f64, Sum)>> = takes.into_iter().map(|frames| beside_mean(frames)).collect();
    let mut all = takes.concat();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let span_m = all.last()?.0 - all.first()?.0;
    let most = MOST_PRODUCTS / (all.len() as f64 * FINENESS * span_m);
    let ends = (LEAST_CYCLES / span_m, (0.5 / usual_m).min(MOST_CYCLES_M).min(most));
    if ends.0.is_nan() || ends.0 >= ends.1 {
        return None;
    }
    let scan = Scan::of(std::slice::from_ref(&all), ends, ANY)?;
    let best = greatest(&scan.powers);
    let (frequency, chi2) = (scan.low + best as f64 * scan.step, *scan.powers.get(best)?);
    let own: Vec<f64> = takes.iter().map(|take| power(take, frequency)).collect();
    let (sum, most) = (own.iter().sum::<f64>(), own.iter().copied().fold(0.0, f64::max));
    let is_one = chi2 > IN_PHASE * sum && most < OF_ONE * sum;
    // What frames and sets scatter besides raises all periods alike: the median, without the line itself, which uneven places spread over many.
    let mut powers = Scan::of(&[without(&all, frequency)?], ends, ANY)?.powers;
    let middle = powers.len() / 2;
    let usual = *powers.select_nth_unstable_by(middle, f64::total_cmp).1 / MEDIAN;
    let looked = (CLOCKS * RIPPLING.len() * scan.powers.len()) as f64;
    let found = Greatest::of(chi2 / usual.max(1.0), NUMBERS, looked);
    is_one.then_some(Ripple { mode, period_m: frequency.recip(), found })
}

/// Frames without the line of this frequency, cycles a metre.
fn without(frames: &[(f64, Sum)], frequency: f64) -> Option<Vec<(f64, Sum)>> {
    let angle = |place_m: f64| {
        let (cosine, sine) = cos_sin(TAU * (place_m * frequency).fract());
        Vector2::new(cosine, sine)
    };
    let (mut matrix, mut vector) = (Matrix2::zeros(), Vector2::zeros());
    for &(place_m, (score, information)) in frames {
        let line = angle(place_m);
        matrix += information * line * line.transpose();
        vector += score * line;
    }
    let parts = matrix.try_inverse()? * vector;
    let beside = |&(place_m, (score, information)): &(f64, Sum)| {
        (place_m, (score - information * parts.dot(&angle(place_m)), information))
    };
    Some(frames.iter().map(beside).collect())
}

/// Frames, without what they share.
pub fn beside_mean(frames: &[(f64, Sum)]) -> Vec<(f64, Sum)> {
    let (score, information) = frames.iter().fold((0.0, 0.0), |sum, (_, of)| (sum.0 + of.0, sum.1 + of.1));
    let mean = score / information;
    frames.iter().map(|(place_m, sum)| (*place_m, (sum.0 - mean * sum.1, sum.1))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    /// Two recordings of 60 places 5 cm apart, and one that stays, with so many frames at each, and noise of so much that they share, which see what there is `at` a place, in a recording.
    fn seen(frames: usize, noise: f64, at: &dyn Fn(usize, f64) -> f64) -> Option<Ripple> {
        let mut ripples = Ripples::default();
        for take in 0..3_usize {
            for (number, draw) in Draws::of(5, take as u64).normal(60).into_iter().enumerate() {
                let place_m = if take == 2 { 2.0 } else { 1.0 + 0.05 * number as f64 + 0.01 * take as f64 };
                // Five frames of a set share their error.
                let seen = (noise * draw + at(take, place_m), 1.0);
                (0..frames).for_each(|_| ripples.add(1, take, [place_m; 2], seen));
            }
        }
        ripples.strongest().into_iter().find(|ripple| ripple.mode == "gain")
    }

    fn found(noise: f64, at: impl Fn(usize, f64) -> f64) -> Option<Ripple> {
        seen(1, noise, &at)
    }

    /// Frames of a set that are off alike say no more than one of them.
    #[test]
    fn errors_of_sets_are_no_ripple() {
        for noise in [1.0, 5.0] {
            let ripple = seen(16, noise, &|_, _| 0.0);
            assert!(ripple.is_none_or(|ripple| ripple.found.ln_bayes < 1.0), "{noise}: {ripple:?}");
        }
    }

    #[test]
    fn a_ripple_has_one_phase_in_all_recordings() {
        let wave = |place_m: f64| 2.0 * (TAU * place_m / 0.31 + 0.4).cos();
        let ripple = found(1.0, |_, place_m| wave(place_m)).unwrap();
        assert!((ripple.period_m - 0.31).abs() < 0.003, "{ripple:?}");
        assert!(ripple.found.ln_bayes > 50.0, "{ripple:?}");
        // Of recordings in which it is turned about, as of what goes with the time, or that one recording sees alone, it is none.
        let turned = found(1.0, |take, place_m| if take == 0 { wave(place_m) } else { -wave(place_m) });
        let alone = found(1.0, |take, place_m| if take == 0 { wave(place_m) } else { 0.0 });
        for none in [turned, alone] {
            assert!(none.is_none_or(|ripple| ripple.found.ln_bayes == 0.0), "{none:?}");
        }
        // Frames that scatter more say less.
        let scattered = found(4.0, |_, place_m| wave(place_m)).unwrap();
        assert!(scattered.found.ln_bayes < 12.0, "{scattered:?}");
        assert!(found(1.0, |_, _| 0.0).is_none_or(|ripple| ripple.found.ln_bayes == 0.0));
    }
}
