//! Whether errors of frames have a mean, or go with the velocity: what does is no jitter. A shutter, or an encoder, that is always late by as much looks
//! like a random time of moving frames to one who sees only how great the errors are.

use super::jitters::{Frame, Jitters};
use std::collections::BTreeMap;

/// Standard deviations of the mean from which on errors are steady.
const STEADY: f64 = 5.0;
/// Fewer sets do not tell how much a mean scatters.
const LEAST_SETS: usize = 20;
/// A frame's error counts as so many standard deviations at most.
const MOST: f64 = 4.0;

/// What frames may be off by: the kinds of [`Jitters`], each with what its errors must not go with.
struct Kind {
    /// Score and information of a frame.
    of: fn(&Frame) -> (f64, f64),
    /// Functions of the velocity. The mean of the phase is the pixels' own.
    with: &'static [fn(f64) -> f64],
}

const KINDS: [Kind; 2] = [
    Kind { of: |frame| frame.phase, with: &[|velocity| velocity] },
    Kind { of: |frame| frame.time, with: &[|_| 1.0, |velocity| velocity] },
];

/// A set's mean error, its weight, and its velocity.
#[derive(Clone, Copy)]
struct Set {
    mean: f64,
    weight: f64,
    velocity_m_s: f64,
}

/// Whether the errors of a `kind` (0: the phase, 1: the time), which scatter by `sigma`, are not random but have a mean, or go with the velocity.
///
/// Frames of a set may share the error of its reading, so that a mean scatters as those of sets do.
pub fn is_steady(jitters: &Jitters, kind: usize, sigma: f64) -> bool {
    let kind = &KINDS[kind];
    let mut sets = BTreeMap::<usize, (f64, f64, f64)>::new();
    for frame in jitters.frames() {
        let (score, information) = (kind.of)(frame);
        if information > 0.0 {
            let weight = (sigma * sigma + information.recip()).recip();
            let most = MOST / weight.sqrt();
            let set = sets.entry(frame.set).or_default();
            set.0 += weight * (score / information).clamp(-most, most);
            set.1 += weight;
            set.2 = frame.velocity_m_s;
        }
    }
    let set = |(sum, weight, velocity_m_s): (f64, f64, f64)| Set { mean: sum / weight, weight, velocity_m_s };
    let sets: Vec<Set> = sets.into_values().map(set).collect();
    kind.with.iter().any(|with| deviations(&sets, *with) > STEADY)
}

/// By how many standard deviations the errors of `sets` go with a function of the velocity.
fn deviations(sets: &[Set], with: fn(f64) -> f64) -> f64 {
    let sum = |of: &dyn Fn(&Set, f64) -> f64| -> f64 {
        sets.iter().map(|set| of(set, with(set.velocity_m_s))).sum()
    };
    let seen = sets.iter().filter(|set| with(set.velocity_m_s) != 0.0).count();
    if seen < LEAST_SETS {
        return 0.0;
    }
    let information = sum(&|set, x| set.weight * x * x);
    let slope = sum(&|set, x| set.weight * x * set.mean) / information;
    let scatter = sum(&|set, x| (set.weight * x * (set.mean - slope * x)).powi(2)).sqrt();
    if scatter > 0.0 { (slope * information / scatter).abs() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    const FRAMES: usize = 4;
    const SIGMA: f64 = 2e-3;

    /// Times of the frames of a hundred sets, which go to and fro: random ones, and those of `steady`, by the velocity.
    fn times(seed: u64, steady: impl Fn(f64) -> f64, reading: f64) -> Jitters {
        let mut jitters = Jitters::default();
        for set in 0..100 {
            let draws = Draws::of(seed, set as u64).normal(FRAMES + 1);
            let velocity_m_s = if set % 2 == 0 { 1.0 } else { -1.0 };
            for draw in &draws[..FRAMES] {
                let error = steady(velocity_m_s) + SIGMA * draw + reading * draws[FRAMES];
                let information = 1e8;
                let nothing = (0.0, 0.0);
                let time = (information * error, information);
                jitters.add(Frame { phase: nothing, time, shared: 0.0, set, velocity_m_s });
            }
        }
        jitters
    }

    #[test]
    fn what_is_always_late_is_no_jitter() {
        for seed in 0..40 {
            assert!(is_steady(&times(seed, |_| SIGMA, 0.0), 1, SIGMA), "{seed}");
            assert!(is_steady(&times(seed, |velocity| SIGMA * velocity, 0.0), 1, SIGMA), "{seed}");
            assert!(!is_steady(&times(seed, |_| 0.0, 0.0), 1, SIGMA), "{seed}");
            // Nor is a jitter steady where sets share the error of a reading.
            assert!(!is_steady(&times(seed, |_| 0.0, 3.0 * SIGMA), 1, SIGMA), "{seed}");
            // Of the phase nothing was seen.
            assert!(!is_steady(&times(seed, |_| SIGMA, 0.0), 0, SIGMA), "{seed}");
        }
    }
}
