//! Whether errors of frames have a mean, or go with the velocity: what does is no jitter. A shutter, or an encoder, that is always late by as much, or in the same
//! frame of every set, looks like a random time of moving frames to one who sees only how great the errors are.

use super::again::comes_again;
use super::jitters::{Frame, Jitters};
use std::collections::BTreeMap;

/// Standard deviations of the mean from which on errors are steady.
const STEADY: f64 = 5.0;
/// Of the errors' variance they have at least this share: a jitter of many frames may have a little of a mean, too.
const SHARE: f64 = 0.1;
/// Fewer sets do not tell how much a mean scatters.
const LEAST_SETS: usize = 20;
/// A frame's error counts as so many standard deviations at most.
const MOST: f64 = 4.0;

/// What frames may be off by: the kinds of [`Jitters`], each with what its errors must not go with.
struct Kind {
    /// Score and information of a frame.
    of: fn(&Frame) -> (f64, f64),
    /// Functions of the velocity. The mean of the phase is the pixels' own, and that of one frame of each set the columns of the frames say.
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

/// Whether the errors of a `kind` (0: the phase, 1: the time), which scatter by `sigma`, are not random but have a mean, go with the velocity, or come again
/// where the target is again: those of whole sets, or those of one frame of each.
///
/// Frames of a set may share the error of its reading, so that a mean scatters as those of sets do.
pub fn is_steady(jitters: &Jitters, kind: usize, sigma: f64) -> bool {
    let kind = &KINDS[kind];
    if comes_again(jitters, kind.of, sigma) {
        return true;
    }
    let all = sets(jitters.frames().iter(), kind, sigma);
    let mut of_number = BTreeMap::<(usize, usize), Vec<&Frame>>::new();
    jitters.frames().iter().for_each(|frame| of_number.entry(frame.number).or_default().push(frame));
    let of_number: Vec<Vec<Set>> =
        of_number.into_values().map(|frames| sets(frames.into_iter(), kind, sigma)).collect();
    let squares: f64 = sigma * sigma * all.iter().map(|set| set.weight).sum::<f64>();
    kind.with.iter().any(|with| {
        let steady = |sets: &[Set]| {
            let (deviations, explained) = explained(sets, *with);
            if deviations > STEADY { explained } else { 0.0 }
        };
        let of_number: f64 = of_number.iter().map(|sets| steady(sets)).sum();
        steady(&all).max(of_number) > SHARE * squares
    })
}

/// The errors of sets, each the mean of those of its `frames`.
fn sets<'a>(frames: impl Iterator<Item = &'a Frame>, kind: &Kind, sigma: f64) -> Vec<Set> {
    let mut sets = BTreeMap::<usize, (f64, f64, f64)>::new();
    for frame in frames {
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
    sets.into_values().map(set).collect()
}

/// By how many standard deviations the errors of `sets` go with a function of the velocity, and what of their squares, weighted, is explained by it.
fn explained(sets: &[Set], with: fn(f64) -> f64) -> (f64, f64) {
    let sum = |of: &dyn Fn(&Set, f64) -> f64| -> f64 {
        sets.iter().map(|set| of(set, with(set.velocity_m_s))).sum()
    };
    let seen = sets.iter().filter(|set| with(set.velocity_m_s) != 0.0).count();
    if seen < LEAST_SETS {
        return (0.0, 0.0);
    }
    let information = sum(&|set, x| set.weight * x * x);
    let slope = sum(&|set, x| set.weight * x * set.mean) / information;
    let scatter = sum(&|set, x| (set.weight * x * (set.mean - slope * x)).powi(2)).sqrt();
    let deviations = if scatter > 0.0 { (slope * information / scatter).abs() } else { 0.0 };
    (deviations, slope * slope * information)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    const FRAMES: usize = 4;
    const SIGMA: f64 = 2e-3;

    /// Times of the frames of a hundred sets, which go to and fro: random ones, and those of `steady`, by the velocity.
    fn times(seed: u64, steady: impl Fn(f64) -> f64, reading: f64) -> Jitters {
        of_sets(100, seed, steady, reading)
    }

    fn of_sets(sets: usize, seed: u64, steady: impl Fn(f64) -> f64, reading: f64) -> Jitters {
        of_frames(sets, seed, |_, velocity_m_s| steady(velocity_m_s), reading)
    }

    /// The same of `steady` errors by the frame's number, and the velocity.
    fn of_frames(sets: usize, seed: u64, steady: impl Fn(usize, f64) -> f64, reading: f64) -> Jitters {
        let mut jitters = Jitters::default();
        for set in 0..sets {
            let draws = Draws::of(seed, set as u64).normal(FRAMES + 1);
            let velocity_m_s = if set % 2 == 0 { 1.0 } else { -1.0 };
            for (number, draw) in draws[..FRAMES].iter().enumerate() {
                let error = steady(number, velocity_m_s) + SIGMA * draw + reading * draws[FRAMES];
                let information = 1e8;
                let nothing = (0.0, 0.0);
                let time = (information * error, information);
                let number = (number, FRAMES);
                jitters.add(Frame {
                    phase: nothing,
                    time,
                    shared: 0.0,
                    take: 0,
                    time_s: (set * FRAMES + number.0) as f64,
                    set,
                    number,
                    velocity_m_s,
                    position_m: 1.0,
                    offset_rad: 0.0,
                });
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
        }
    }

    #[test]
    fn a_phase_that_goes_with_the_velocity_is_no_jitter() {
        let phases = |steady: fn(f64) -> f64| {
            let mut phases = Jitters::default();
            for frame in times(3, steady, 0.0).frames() {
                phases.add(Frame { phase: frame.time, time: (0.0, 0.0), ..*frame });
            }
            phases
        };
        assert!(is_steady(&phases(|velocity| SIGMA * velocity), 0, SIGMA));
        // Its mean is the pixels' own.
        assert!(!is_steady(&phases(|_| SIGMA), 0, SIGMA));
        assert!(!is_steady(&phases(|_| 0.0), 0, SIGMA));
    }

    #[test]
    fn frames_of_a_set_that_are_late_and_early_in_turn_are_no_jitter() {
        let turns = [1.0, -1.0, 1.0, -1.0];
        for seed in 0..40 {
            let late = of_frames(100, seed, |number, _| SIGMA * turns[number], 0.0);
            assert!(is_steady(&late, 1, SIGMA), "{seed}");
            let by_velocity = of_frames(100, seed, |number, velocity| SIGMA * turns[number] * velocity, 0.0);
            assert!(is_steady(&by_velocity, 1, SIGMA), "{seed}");
        }
        let a_little = of_frames(4000, 5, |number, _| 0.1 * SIGMA * turns[number], 0.0);
        assert!(!is_steady(&a_little, 1, SIGMA));
    }

    #[test]
    fn a_jitter_of_many_sets_may_have_a_little_of_a_mean() {
        assert!(!is_steady(&of_sets(4000, 5, |_| 0.1 * SIGMA, 0.0), 1, SIGMA));
        assert!(is_steady(&of_sets(4000, 5, |_| SIGMA, 0.0), 1, SIGMA));
    }
}
