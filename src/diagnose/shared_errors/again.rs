//! Whether errors of frames come again where the target is again: what does is no jitter. Light that comes another way, or any error that goes with the distance, moves
//! frames as a jitter does to one who sees only how great their errors are. And whether they are new where it is again: what the form of an effect leaves is not.

use super::jitters::{Frame, Jitters};
use crate::diagnose::statistics::shared_variance::SharedVariance;
use std::collections::BTreeMap;

/// Errors of neighbours that are alike by this share of their squares are not random,
const SHARE: f64 = 0.3;
/// where that is more than so many standard deviations of chance.
const SIGMAS: f64 = 4.0;
/// So many of the pairs tell something of their own: frames of a set may share the error of its reading.
const TOLD: f64 = 0.5;
/// A frame's error counts as so many standard deviations at most.
const MOST: f64 = 4.0;

/// Targets that are no further from each other are at the same place, m: as far as an encoder may be off.
const SAME_PLACE_M: f64 = 2e-3;
/// Over so much of a distance what goes with it is taken to be straight, m: of a wave of half a metre a fortieth of its square is not.
const STRAIGHT_M: f64 = 0.15;
/// Standard deviations that are looked at: so many in each factor of ten above the one that a frame shows by itself, on average, and factors of ten.
const STEPS: (i32, i32) = (4, 3);

/// What frames have in common whose errors are compared: their number in the set and the set's, the velocity, the phase offset.
type Alike = ((usize, usize), u64, u64);

/// What a frame says of an error: score and information.
pub type Said = fn(&Frame) -> (f64, f64);

/// The first ones of some frames, with weights, and the others.
type Straight<'a> = (Vec<(f64, Frame)>, &'a [Frame]);

/// Whether errors, of which `of` tells score and information of a frame, and which scatter by `sigma`, are alike in frames of the same number, velocity and phase offset
/// whose targets are next to each other.
pub fn comes_again(jitters: &Jitters, of: Said, sigma: f64) -> bool {
    let (mut products, mut squares, mut pairs) = (0.0, 0.0, 0);
    for group in alike(jitters, of) {
        // Of the variance 1, beside the noise of the frame.
        let error = |frame: &Frame| {
            let (score, information) = of(frame);
            (score / (information * (1.0 + sigma * sigma * information)).sqrt()).clamp(-MOST, MOST)
        };
        let mut group: Vec<f64> = group.iter().map(error).collect();
        // What all have in common is the pixels' own, or steady.
        let mean = group.iter().sum::<f64>() / group.len() as f64;
        group.iter_mut().for_each(|error| *error -= mean);
        for pair in group.windows(2) {
            products += pair[0] * pair[1];
            squares += 0.5 * (pair[0].powi(2) + pair[1].powi(2));
            pairs += 1;
        }
    }
    let share = if squares > 0.0 { products / squares } else { 0.0 };
    share > SHARE && share * (TOLD * f64::from(pairs)).sqrt() > SIGMAS
}

/// Evidence (nats) for random errors, of which `of` tells score and information of a frame, from how frames differ that have the same number, velocity and phase
/// offset, and a target at the same place, or from the straight line through those with a target before and behind it: what goes with any of these says nothing.
/// Nor does what all frames of a set share, as the error of its reading. Nothing where no places are that near.
pub fn new_each_time(jitters: &Jitters, of: Said) -> f64 {
    let mut sets = BTreeMap::<usize, (f64, f64, f64)>::new();
    for frame in jitters.frames() {
        let ((score, information), set) = (of(frame), sets.entry(frame.set).or_default());
        *set = (set.0 + score, set.1 + information, set.2 + f64::from(u8::from(information > 0.0)));
    }
    // Error and variance of a frame without what its set shares.
    let error = |frame: &Frame| {
        let ((score, information), set) = (of(frame), sets[&frame.set]);
        (score / information - set.0 / set.1, information.recip() - set.1.recip())
    };
    let mut sums = Vec::new();
    let mut free = 0.0;
    for group in alike(jitters, of) {
        // Each frame is in one sum, so that sums are independent.
        let mut rest = &group[..];
        while let Some((weighted, further)) = straight(rest) {
            rest = further;
            let add = |sum: (f64, f64, f64), &(weight, ref frame): &(f64, Frame)| {
                let (error, variance) = error(frame);
                (sum.0 + weight * error, sum.1 + weight * weight * variance, sum.2 + weight * weight)
            };
            let (sum, variance, squares) = weighted.iter().fold((0.0, 0.0, 0.0), add);
            // Over the root of the weights' squares it scatters as one error does.
            let information = squares / variance;
            if !weighted.is_empty() && information.is_finite() {
                sums.push((sum / squares.sqrt() * information, information));
                // Of a set's errors all but one are free.
                free += 1.0 - sets[&weighted[0].1.set].2.recip();
            }
        }
    }
    if sums.is_empty() {
        return 0.0;
    }
    let count = sums.len() as f64;
    let mean = sums.iter().map(|of| of.1).sum::<f64>() / count;
    let evidence = SharedVariance::of(&sums);
    let (steps, tens) = STEPS;
    let variance = |step: i32| 10f64.powf(2.0 * f64::from(step) / f64::from(steps)) / mean;
    let greatest = (-steps..=tens * steps).map(|step| evidence.evidence(variance(step))).fold(0.0, f64::max);
    free / count * greatest
}

/// The first ones of `frames`, with weights by which what is straight over the distance comes to nothing, and those after them; no first ones where places are too
/// far apart, and nothing at the end.
fn straight(frames: &[Frame]) -> Option<Straight<'_>> {
    let place_m = |number: usize| frames.get(number).map_or(f64::INFINITY, |frame: &Frame| frame.position_m);
    let (span_m, first_m) = (place_m(2) - place_m(0), place_m(1) - place_m(0));
    match frames {
        [one, other, further @ ..] if first_m <= SAME_PLACE_M => {
            Some((vec![(1.0, *one), (-1.0, *other)], further))
        }
        [one, middle, other, further @ ..] if span_m <= STRAIGHT_M => {
            let share = first_m / span_m;
            Some((vec![(share - 1.0, *one), (1.0, *middle), (-share, *other)], further))
        }
        [_, further @ ..] => Some((Vec::new(), further)),
        [] => None,
    }
}

/// Frames that are alike, by their position.
fn alike(jitters: &Jitters, of: Said) -> Vec<Vec<Frame>> {
    let mut groups = BTreeMap::<Alike, Vec<Frame>>::new();
    for frame in jitters.frames().iter().filter(|frame| of(frame).1 > 0.0) {
        let alike = (frame.number, frame.velocity_m_s.to_bits(), frame.offset_rad.to_bits());
        groups.entry(alike).or_default().push(*frame);
    }
    let mut groups: Vec<_> = groups.into_values().collect();
    groups
        .iter_mut()
        .for_each(|group| group.sort_by(|one, other| one.position_m.total_cmp(&other.position_m)));
    groups
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    const SIGMA: f64 = 0.01;

    /// Phases of the frames of so many sets, at distances from one to three metres in no order: `systematic` ones, and random ones of this standard deviation.
    fn phases(sets: u64, systematic: fn(f64) -> f64, random: f64) -> Jitters {
        let mut jitters = Jitters::default();
        for set in 0..sets {
            let draws = Draws::of(17, set).normal(4);
            let position_m = 1.0 + 2.0 * (set as f64 * 0.618_034).fract();
            for (number, draw) in draws.into_iter().enumerate() {
                let sign = if number % 2 == 0 { 1.0 } else { -1.0 };
                let error = sign * systematic(position_m) + random * draw;
                jitters.add(Frame {
                    phase: (1e8 * error, 1e8),
                    time: (0.0, 0.0),
                    shared: 0.0,
                    take: 0,
                    time_s: (4 * set) as f64 + number as f64,
                    set: set as usize,
                    number: (number, 4),
                    velocity_m_s: 2.0,
                    position_m,
                    offset_rad: 0.0,
                });
            }
        }
        jitters
    }

    #[test]
    fn what_goes_with_the_distance_comes_again_and_a_jitter_does_not() {
        let of = |frame: &Frame| frame.phase;
        let wave = |position_m: f64| 1.4 * SIGMA * (2.0 * position_m).sin();
        for sets in [27, 100, 1000] {
            assert!(comes_again(&phases(sets, wave, 0.0), of, SIGMA), "{sets}");
            assert!(comes_again(&phases(sets, wave, 0.5 * SIGMA), of, SIGMA), "{sets}");
            assert!(!comes_again(&phases(sets, |_| 0.0, SIGMA), of, SIGMA), "{sets}");
            // A jitter beside which a little is left.
            assert!(!comes_again(
                &phases(sets, |position_m| 0.3 * SIGMA * position_m.sin(), SIGMA),
                of,
                SIGMA
            ));
        }
        assert!(!comes_again(&Jitters::default(), of, SIGMA));
    }

    #[test]
    fn a_jitter_is_new_each_time_and_what_goes_with_the_distance_is_not() {
        let of = |frame: &Frame| frame.phase;
        // Each place twice, within a millimetre; frames have a noise of 1e-4 besides, here none.
        let twice = |jitters: [Jitters; 2]| {
            let mut both = Jitters::default();
            for (n, jitters) in jitters.iter().enumerate() {
                for frame in jitters.frames() {
                    both.add(Frame {
                        position_m: frame.position_m + 1e-3 * n as f64,
                        set: 2 * frame.set + n,
                        ..*frame
                    });
                }
            }
            both
        };
        let wave = |position_m: f64| 10.0 * SIGMA * (2.0 * position_m).sin();
        let again = twice([phases(100, wave, 0.0), phases(100, wave, 0.0)]);
        assert_eq!(new_each_time(&again, of), 0.0);
        let still = phases(100, |_| 0.0, 0.0);
        // Of 400 differences, over the root of two, of errors of a hundred times the noise on one side only: 5000 times its variance. Of four of a set three are free.
        for systematic in [wave as fn(f64) -> f64, |_| 0.0] {
            let nats =
                new_each_time(&twice([phases(100, systematic, SIGMA), phases(100, systematic, 0.0)]), of);
            assert!((nats / 300.0 / 2500.0 - 1.0).abs() < 0.2, "{nats}");
        }
        // What all frames of a set share is its reading's.
        let mut read = twice([still.clone(), still.clone()]);
        read = read.frames().iter().fold(Jitters::default(), |mut all, frame| {
            let error = SIGMA * Draws::of(3, frame.set as u64).normal(1)[0];
            all.add(Frame { phase: (1e8 * error, 1e8), ..*frame });
            all
        });
        assert_eq!(new_each_time(&read, of), 0.0);
        assert_eq!(new_each_time(&twice([still.clone(), still.clone()]), of), 0.0);
        // No place is seen twice, but a hundred in two metres are near, of which three make a sum; ten are not.
        let nats = new_each_time(&phases(100, wave, SIGMA), of);
        assert!((nats / (33.0 * 3.0 * 5000.0) - 1.0).abs() < 0.25, "{nats}");
        assert!(new_each_time(&phases(100, wave, 0.0), of) < 0.01);
        assert_eq!(new_each_time(&phases(10, wave, SIGMA), of), 0.0);
    }
}
