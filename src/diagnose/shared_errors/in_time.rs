//! Whether errors of frames are a line in time, or those of a few frames: neither is a jitter, which is new in every frame. A spurious tone of a clock looks as random
//! as a jitter to one who sees only how great the errors are, and so does what befalls every tenth set.

use super::again::Said;
use super::jitters::{Frame, Jitters};
use super::swings::usual;
use crate::diagnose::periodic::lines::strongest;
use crate::diagnose::statistics::evidence::Greatest;
use crate::diagnose::statistics::periodogram::{FINENESS, Sum, longest, power};
use std::collections::BTreeMap;

/// Evidence (nats) from which on there is a line beside errors that are random.
const LINE_NATS: f64 = 5.0;
/// Of what errors have beyond the noise, chi squared, a line explains this share, to be what they are.
const LINE_SHARE: f64 = 0.5;
/// A line's numbers in a recording: cosine and sine.
const NUMBERS: usize = 2;
/// Cycles over the longest recording from which on it is one.
const LEAST_CYCLES: f64 = 1.0;
/// Products of frequencies and frames that are looked at, at most: of recordings with very many frames, or that take very long, the lower frequencies.
const MOST_PRODUCTS: f64 = 2e8;

/// Fewer frames do not tell how errors are distributed.
const LEAST_FRAMES: usize = 100;
/// The shares of all frames that a few may be, and the variance of the few, over what all would have if theirs were spread over all.
const FEW: [f64; 4] = [0.01, 0.02, 0.05, 0.1];
const OF_FEW: [f64; 3] = [0.25, 1.0, 4.0];
/// The variance that all may have besides, over what it is if all have it alone.
const OF_ALL: [f64; 6] = [0.0625, 0.125, 0.25, 0.5, 1.0, 2.0];
/// That a few frames have the errors must be so much likelier (nats) than that all have,
const LIKELIER: f64 = 5.0;
/// and that all have some besides less than so much likelier than that.
const BESIDES: f64 = 3.0;

/// Whether most of the errors, of which `of` tells score and information of a frame, and which scatter by `sigma`, is one line in time with a phase of its own in each
/// recording.
pub fn is_line(jitters: &Jitters, of: Said, sigma: f64) -> bool {
    is_line_where(jitters, of, |_| 1.0, sigma)
}

/// Whether errors of times are such a line where those of a target that comes nearer are turned over, of one that goes either way: what shakes a carriage is a place, and
/// no time.
pub fn is_shaken(jitters: &Jitters, of: Said, sigma: f64) -> bool {
    let turned = |frame: &Frame| if frame.velocity_m_s < 0.0 { -1.0 } else { 1.0 };
    let nearer = heard(jitters, of).filter(|(frame, _)| turned(frame) < 0.0).count();
    (1..heard(jitters, of).count()).contains(&nearer) && is_line_where(jitters, of, turned, sigma)
}

/// The same of errors times what `sign` says of a frame.
fn is_line_where(jitters: &Jitters, of: Said, sign: fn(&Frame) -> f64, sigma: f64) -> bool {
    let mut takes = BTreeMap::<usize, Vec<(f64, Sum)>>::new();
    let of_one_set = jitters.frames().windows(2).filter(|pair| pair[0].set == pair[1].set);
    let period_s = usual(of_one_set.map(|pair| pair[1].time_s - pair[0].time_s).collect());
    let beyond_noise: f64 = heard(jitters, of).map(|(_, (score, k))| score * score / k - 1.0).sum();
    for (frame, (score, information)) in heard(jitters, of) {
        takes.entry(frame.take).or_default().push((frame.time_s, (sign(frame) * score, information)));
    }
    let takes: Vec<_> = takes.into_values().collect();
    // As if every frame had the random error: what a line is beside it.
    let beside = |&(at, (score, information)): &(f64, Sum)| {
        let noise = 1.0 + sigma * sigma * information;
        (at, (score / noise, information / noise))
    };
    let random: Vec<Vec<_>> = takes.iter().map(|take| take.iter().map(beside).collect()).collect();
    let longest_s = longest(&takes);
    let Some(period_s) = period_s else { return false };
    let frames = takes.iter().map(Vec::len).sum::<usize>() as f64;
    let most_hz = MOST_PRODUCTS / (frames * FINENESS * longest_s);
    let ends = (LEAST_CYCLES / longest_s, (0.5 / period_s).min(most_hz));
    if ends.0.is_nan() || !longest_s.is_finite() || ends.0 >= ends.1 {
        return false;
    }
    let Some(line) = strongest(&random, ends, 0.0) else { return false };
    let numbers = NUMBERS * takes.len();
    let explained: f64 = takes.iter().map(|take| power(take, line.frequency)).sum();
    Greatest::of(line.chi2, numbers, line.looked).ln_bayes > LINE_NATS
        && explained - numbers as f64 > LINE_SHARE * beyond_noise
}

/// Whether the errors are those of a few frames, and all others have none.
pub fn is_of_few(jitters: &Jitters, of: Said, sigma: f64) -> bool {
    let frames: Vec<(f64, f64)> = heard(jitters, of).map(|(_, (score, k))| (score * score / k, k)).collect();
    if frames.len() < LEAST_FRAMES {
        return false;
    }
    let variance = sigma * sigma;
    let greatest = |alls: &[f64]| {
        let of = |&all: &f64| {
            let few = FEW.iter().flat_map(|&share| OF_FEW.map(|of_few| (share, of_few * variance / share)));
            few.map(|few| likelihood(&frames, all * variance, few)).fold(f64::NEG_INFINITY, f64::max)
        };
        alls.iter().map(of).fold(f64::NEG_INFINITY, f64::max)
    };
    let of_all = OF_ALL.iter().map(|all| likelihood(&frames, all * variance, (0.0, 0.0)));
    let of_few = greatest(&[0.0]);
    of_few > of_all.fold(0.0, f64::max) + LIKELIER && greatest(&OF_ALL) < of_few + BESIDES
}

/// How much likelier (nats) than noise alone it makes the squares of `frames`, over their noise, and their information, that all have errors of variance `all`, and a share of
/// them one that is greater by so much.
fn likelihood(frames: &[(f64, f64)], all: f64, (share, few): (f64, f64)) -> f64 {
    let ln_normal = |square: f64, variance: f64| -0.5 * (square / variance + variance.ln());
    let of = |&(square, information): &(f64, f64)| {
        let of_all = 1.0 + all * information;
        let usual = ln_normal(square, of_all);
        let likelier = ln_normal(square, of_all + few * information) - usual;
        // Of a frame that is far off the exponential would be infinite.
        let by_few = match likelier > 30.0 {
            true => likelier + share.ln(),
            false => (share * likelier.exp_m1()).ln_1p(),
        };
        usual + by_few - ln_normal(square, 1.0)
    };
    frames.iter().map(of).sum()
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
            for size in [0.05, 0.3, 1.0, 10.0] {
                assert!(
                    !is_line(&phases(seed, |_, _, draw| size * SIGMA * draw), of, size * SIGMA),
                    "{seed}"
                );
            }
        }
        // A jitter beside a tone of a third of its variance is one, and so is one of which frames of a set share an error of the reading.
        let both = |take, time_s, draw| SIGMA * draw + 0.577 * line(take, time_s);
        let read =
            |take: usize, time_s: f64| Draws::of(take as u64, (time_s / 0.13).floor() as u64).normal(1)[0];
        for seed in 0..20 {
            assert!(!is_line(&phases(seed, both), of, 1.15 * SIGMA), "{seed}");
            let shared = phases(seed, |take, time_s, draw| SIGMA * (draw + read(take, time_s)));
            assert!(!is_line(&shared, of, 1.4 * SIGMA), "{seed}");
        }
        assert!(!is_line(&Jitters::default(), of, SIGMA));
    }

    /// What shakes a carriage moves it, whichever way it goes: as times of frames that is turned over by the way back.
    #[test]
    fn what_shakes_a_carriage_is_a_line() {
        let velocity_m_s =
            |time_s: f64| -> f64 { if (time_s / 1.3).floor() as i64 % 2 == 0 { 0.5 } else { -0.5 } };
        let with_velocity = |errors: Jitters, turns: bool| {
            let mut jitters = Jitters::default();
            for frame in errors.frames() {
                let velocity_m_s = velocity_m_s(frame.time_s - 0.02 * frame.number.0 as f64);
                let sign = if turns { velocity_m_s.signum() } else { 1.0 };
                let (score, information) = frame.phase;
                jitters.add(Frame { phase: (sign * score, information), velocity_m_s, ..*frame });
            }
            jitters
        };
        let shaken =
            |seed: u64, turns: bool| with_velocity(phases(seed, |take, time_s, _| line(take, time_s)), turns);
        for seed in 0..20 {
            let (place, time) = (shaken(seed, true), shaken(seed, false));
            assert!(is_shaken(&place, of, SIGMA) && !is_line(&place, of, SIGMA), "{seed}");
            assert!(is_line(&time, of, SIGMA) && !is_shaken(&time, of, SIGMA), "{seed}");
            let jitter = with_velocity(phases(seed, |_, _, draw| SIGMA * draw), true);
            assert!(!is_shaken(&jitter, of, SIGMA), "{seed}");
        }
    }

    /// Frames of which this share is hit.
    fn hit(seed: u64, share: f64, size: f64, error: impl Fn(f64) -> f64) -> Jitters {
        let every = (1.0 / share) as usize;
        let is_hit = |time_s: f64| ((time_s / 0.02).round() as usize * 7).is_multiple_of(every);
        phases(seed, |_, time_s, draw| error(draw) + if is_hit(time_s) { size * SIGMA } else { 0.0 })
    }

    fn scatter(jitters: &Jitters) -> f64 {
        let squares = jitters.frames().iter().map(|frame| (frame.phase.0 / INFORMATION).powi(2));
        let variance = squares.sum::<f64>() / jitters.frames().len() as f64 - SIGMA * SIGMA;
        variance.max(0.01 * SIGMA * SIGMA).sqrt()
    }

    #[test]
    fn errors_of_a_few_frames_are_no_jitter() {
        for seed in 0..20 {
            for share in [0.02, 0.05, 0.1] {
                let few = hit(seed, share, 6.0, |_| 0.0);
                assert!(is_of_few(&few, of, scatter(&few)), "{seed} {share}");
            }
            for size in [0.3, 1.0, 10.0] {
                let jitter = phases(seed, |_, _, draw| size * SIGMA * draw);
                assert!(!is_of_few(&jitter, of, scatter(&jitter)), "{seed} {size}");
                // Beside one some frames may be far off.
                let beside = hit(seed, 0.01, 8.0, |draw| size.max(0.6) * SIGMA * draw);
                assert!(!is_of_few(&beside, of, scatter(&beside)), "{seed} {size}");
            }
        }
    }

    /// By hand: of a frame of square 9 and information 1, errors of variance 8 make the normal density exp(-9 / 18) / 3 over exp(-9 / 2).
    #[test]
    fn the_likelihood_is_that_of_a_mixture() {
        let frame = [(9.0, 1.0)];
        let of_all = 4.0 - 3f64.ln();
        assert!((likelihood(&frame, 8.0, (0.0, 0.0)) - of_all).abs() < 1e-12);
        assert!((likelihood(&frame, 0.0, (0.1, 8.0)) - (0.9 + 0.1 * of_all.exp()).ln()).abs() < 1e-12);
        let far = likelihood(&[(1e6, 1.0)], 0.0, (0.01, 1e6));
        assert!((far - (0.5e6 - 0.5 - 1e3f64.ln() + 0.01f64.ln())).abs() < 1e-2, "{far}");
    }
}
