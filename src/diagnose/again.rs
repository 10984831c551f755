//! Whether errors of frames come again where the target is again: what does is no jitter. Light that comes another way, or any error that goes with the distance, moves
//! frames as a jitter does to one who sees only how great their errors are.

use super::jitters::{Frame, Jitters};
use std::collections::BTreeMap;

/// Errors of neighbours that are alike by this share of their squares are not random,
const SHARE: f64 = 0.3;
/// where that is more than so many standard deviations of chance.
const SIGMAS: f64 = 4.0;
/// So many of the pairs tell something of their own: frames of a set may share the error of its reading.
const TOLD: f64 = 0.5;
/// A frame's error counts as so many standard deviations at most.
const MOST: f64 = 4.0;

/// What frames have in common whose errors are compared: their number in the set and the set's, the velocity, the phase offset.
type Alike = ((usize, usize), u64, u64);

/// Whether errors, of which `of` tells score and information of a frame, and which scatter by `sigma`, are alike in frames of the same number, velocity and phase offset
/// whose targets are next to each other.
pub fn comes_again(jitters: &Jitters, of: fn(&Frame) -> (f64, f64), sigma: f64) -> bool {
    let mut groups = BTreeMap::<Alike, Vec<(f64, f64)>>::new();
    for frame in jitters.frames() {
        let (score, information) = of(frame);
        if information > 0.0 {
            // Of the variance 1, beside the noise of the frame.
            let error = score / (information * (1.0 + sigma * sigma * information)).sqrt();
            let alike = (frame.number, frame.velocity_m_s.to_bits(), frame.offset_rad.to_bits());
            groups.entry(alike).or_default().push((frame.position_m, error.clamp(-MOST, MOST)));
        }
    }
    let (mut products, mut squares, mut pairs) = (0.0, 0.0, 0);
    for group in groups.values_mut() {
        group.sort_by(|one, other| one.0.total_cmp(&other.0));
        // What all have in common is the pixels' own, or steady.
        let mean = group.iter().map(|error| error.1).sum::<f64>() / group.len() as f64;
        group.iter_mut().for_each(|error| error.1 -= mean);
        for pair in group.windows(2) {
            products += pair[0].1 * pair[1].1;
            squares += 0.5 * (pair[0].1.powi(2) + pair[1].1.powi(2));
            pairs += 1;
        }
    }
    let share = if squares > 0.0 { products / squares } else { 0.0 };
    share > SHARE && share * (TOLD * f64::from(pairs)).sqrt() > SIGMAS
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
}
