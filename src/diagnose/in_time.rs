//! Whether errors of frames are a line in time, or those of a few frames: neither is a jitter, which is new in every frame. A spurious tone of a clock looks as random
//! as a jitter to one who sees only how great the errors are, and so does what befalls every tenth set.

use super::again::Said;
use super::evidence::{Greatest, of_variance};
use super::jitters::{Frame, Jitters};
use super::lines::strongest;
use super::periodogram::{FINENESS, Sum, longest, power};
use std::collections::BTreeMap;

/// Evidence (nats) from which on there is a line beside errors that are random.
const LINE_NATS: f64 = 5.0;
/// Of the evidence for random errors a line has this share, to be what they are.
const LINE_SHARE: f64 = 0.5;
/// Cycles over the longest recording from which on it is one.
const LEAST_CYCLES: f64 = 1.0;
/// Products of frequencies and frames that are looked at, at most.
const MOST_PRODUCTS: f64 = 2e8;

/// The median of a normal error's square, and by what the median of so many scatters, over the root of their number (of its density there).
const MEDIAN: (f64, f64) = (0.454_936, 1.061);
/// Fewer frames do not tell how errors are distributed.
const LEAST_FRAMES: usize = 100;
/// By so many standard deviations the fourth power is above that of normal errors,
const PEAKED: f64 = 6.0;
/// and the frame in the middle is less than so many above what it is of noise.
const BEYOND_NOISE: f64 = 2.0;

/// Whether most of the errors, of which `of` tells score and information of a frame, and which scatter by `sigma`, is one line in time with a phase of its own in each
/// recording.
pub fn is_line(jitters: &Jitters, of: Said, sigma: f64) -> bool {
    let mut takes = BTreeMap::<usize, Vec<(f64, Sum)>>::new();
    let mut periods_s = Vec::new();
    for (frame, next) in jitters.frames().iter().zip(jitters.frames().iter().skip(1)) {
        if frame.set == next.set && next.time_s > frame.time_s {
            periods_s.push(next.time_s - frame.time_s);
        }
    }
    let evidence: f64 = heard(jitters, of).map(|(_, sum)| of_variance(sigma * sigma, sum.0, sum.1)).sum();
    for (frame, sum) in heard(jitters, of) {
        takes.entry(frame.take).or_default().push((frame.time_s, sum));
    }
    let takes: Vec<_> = takes.into_values().collect();
    // As if every frame had the random error: what a line is beside it.
    let beside = |&(at, (score, information)): &(f64, Sum)| {
        let noise = 1.0 + sigma * sigma * information;
        (at, (score / noise, information / noise))
    };
    let random: Vec<Vec<_>> = takes.iter().map(|take| take.iter().map(beside).collect()).collect();
    let longest_s = longest(&takes);
    periods_s.sort_by(f64::total_cmp);
    let Some(period_s) = periods_s.get(periods_s.len() / 2) else { return false };
    let frames = takes.iter().map(Vec::len).sum::<usize>() as f64;
    let most_hz = MOST_PRODUCTS / (frames * FINENESS * longest_s);
    let ends = (LEAST_CYCLES / longest_s, (0.5 / period_s).min(most_hz));
    if ends.0.is_nan() || !longest_s.is_finite() || ends.0 >= ends.1 {
        return false;
    }
    let Some(line) = strongest(&random, ends, 0.0) else { return false };
    let explained: f64 = takes.iter().map(|take| power(take, line.frequency)).sum();
    Greatest::of(line.chi2, 2 * takes.len(), line.looked).ln_bayes > LINE_NATS
        && 0.5 * explained > LINE_SHARE * evidence
}

/// Whether the errors are those of a few frames, and all others have none.
pub fn is_of_few(jitters: &Jitters, of: Said, sigma: f64) -> bool {
    let mut squares = Vec::new();
    let (mut second, mut fourth) = (0.0, 0.0);
    for (_, (score, information)) in heard(jitters, of) {
        let square = score * score / information;
        let normal = square / (1.0 + sigma * sigma * information);
        squares.push(square);
        second += normal;
        fourth += normal * normal;
    }
    if squares.len() < LEAST_FRAMES {
        return false;
    }
    let count = squares.len() as f64;
    let kurtosis = count * fourth / (second * second);
    let is_peaked = kurtosis - 3.0 > PEAKED * (24.0 / count).sqrt();
    squares.sort_by(f64::total_cmp);
    let (usual, scatter) = MEDIAN;
    is_peaked && squares[squares.len() / 2] < usual + BEYOND_NOISE * scatter / count.sqrt()
}

/// The frames that say something.
fn heard(jitters: &Jitters, of: Said) -> impl Iterator<Item = (&Frame, Sum)> {
    let all = jitters.frames().iter().map(move |frame| (frame, of(frame)));
    all.filter(|(_, sum)| sum.1 > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;
    use std::f64::consts::TAU;

    const FRAMES: usize = 4;
    const SIGMA: f64 = 4e-3;
    /// Of a frame: it knows its phase to as much as SIGMA.
    const INFORMATION: f64 = 1.0 / (SIGMA * SIGMA);

    /// Frames of two recordings of 120 sets each, with noise: errors of phase by recording, time, and a draw.
    fn phases(seed: u64, error: impl Fn(usize, f64, f64) -> f64) -> Jitters {
        let mut jitters = Jitters::default();
        for (take, set) in (0..2_usize).flat_map(|take| (0..120_usize).map(move |set| (take, set))) {
            let draws = Draws::of(seed, (200 * take + set) as u64).normal(2 * FRAMES);
            for number in 0..FRAMES {
                let time_s = 0.02 * number as f64 + 0.13 * set as f64;
                let off = SIGMA * draws[number] + error(take, time_s, draws[FRAMES + number]);
                jitters.add(Frame {
                    phase: (INFORMATION * off, INFORMATION),
                    time: (0.0, 0.0),
                    shared: 0.0,
                    take,
                    time_s,
                    set: 120 * take + set,
                    number: (number, FRAMES),
                    velocity_m_s: 0.0,
                    position_m: 1.0,
                    offset_rad: 0.0,
                });
            }
        }
        jitters
    }

    fn of(frame: &Frame) -> Sum {
        frame.phase
    }

    fn line(take: usize, time_s: f64) -> f64 {
        2f64.sqrt() * SIGMA * (TAU * 5.143 * time_s + take as f64).sin()
    }

    #[test]
    fn a_tone_is_a_line_and_a_jitter_is_none() {
        for seed in 0..20 {
            assert!(is_line(&phases(seed, |take, time_s, _| line(take, time_s)), of, SIGMA), "{seed}");
            for size in [0.3, 1.0, 10.0] {
                assert!(
                    !is_line(&phases(seed, |_, _, draw| size * SIGMA * draw), of, size * SIGMA),
                    "{seed}"
                );
            }
        }
        // A tone of a fourth of a jitter's size is not what it is.
        let both = |take, time_s, draw| SIGMA * draw + 0.25 * line(take, time_s);
        assert!(!is_line(&phases(3, both), of, 1.03 * SIGMA));
        assert!(!is_line(&Jitters::default(), of, SIGMA));
    }

    #[test]
    fn errors_of_a_few_frames_are_no_jitter() {
        let glitch = |_: usize, time_s: f64, _: f64| {
            // The first frame of every eleventh set: 2 in 100.
            if (time_s / 0.13).fract() < 0.1 && ((time_s / 0.13) as usize).is_multiple_of(11) {
                5.0 * SIGMA
            } else {
                0.0
            }
        };
        for seed in 0..20 {
            let few = phases(seed, glitch);
            let variance =
                few.frames().iter().map(|frame| (frame.phase.0 / INFORMATION).powi(2)).sum::<f64>()
                    / few.frames().len() as f64;
            assert!(is_of_few(&few, of, (variance - SIGMA * SIGMA).sqrt()), "{seed}");
            for size in [0.3, 1.0, 10.0] {
                assert!(
                    !is_of_few(&phases(seed, |_, _, draw| size * SIGMA * draw), of, size * SIGMA),
                    "{seed}"
                );
            }
            // A jitter beside which a few frames are far off is one.
            let beside = phases(seed, |take, time_s, draw| SIGMA * draw + 2.0 * glitch(take, time_s, draw));
            assert!(!is_of_few(&beside, of, 1.5 * SIGMA), "{seed}");
        }
    }

    /// Abramowitz and Stegun (1964), 26.2.17 and 26.2.23: half of all normal errors are within 0.6745 standard deviations.
    #[test]
    fn the_median_is_that_of_normal_errors() {
        let (usual, scatter) = MEDIAN;
        let root = usual.sqrt();
        assert!((libm::erf(root / 2f64.sqrt()) - 0.5).abs() < 1e-6);
        let density = (-0.5 * usual).exp() / (TAU * usual).sqrt();
        assert!((0.5 / density - scatter).abs() < 1e-3, "{}", 0.5 / density);
    }
}
