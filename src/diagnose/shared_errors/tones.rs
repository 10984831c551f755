//! Tones: what all pixels of a frame share and comes and goes with one period in time, within the sets: a bench that shakes, the ripple of a source's supply. Functions of the
//! time are too coarse for it, and so are whole sets; errors of single frames say little of it.

use super::levels::{LIGHT, MODES, PHASE, POSITION};
use super::ripples::beside_mean;
use super::swings::{LEAST_SETS, move_apart, usual};
use crate::diagnose::periodic::lines::blur;
use crate::diagnose::statistics::amplitudes::agree;
use crate::diagnose::statistics::evidence::Greatest;
use crate::diagnose::statistics::periodogram::{ANY, FINENESS, Sum, chi2, greatest, longest, powers};
use crate::physics::cos_sin;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Ways in which frames may be off together, of [`MODES`]: in phase (rad), in proportion to the camera's own light, or as if the target were at another place (m), whether it moves or not.
pub const WAYS: [usize; 3] = [PHASE, LIGHT, POSITION];

/// A frame.
#[derive(Debug, Clone, Copy)]
pub struct Heard {
    /// Its recording.
    pub take: usize,
    /// Number of its set, and its own number in that.
    pub number: (usize, usize),
    /// When it was taken, s.
    pub time_s: f64,
    /// Phase offset (rad) and commanded position (m).
    pub at: [f64; 2],
    /// What it says of each way.
    pub ways: [Sum; WAYS.len()],
}

/// What all frames say.
#[derive(Debug, Clone, Default)]
pub struct Tones {
    frames: Vec<Heard>,
}

/// The strongest tone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tone {
    /// Its way.
    pub way: &'static str,
    /// Its frequency, Hz, or that of an image of it.
    pub hz: f64,
    /// What it says among all frequencies.
    pub found: Greatest,
}

/// A recording, of one way.
struct Recording {
    /// When, and what is said then, but for what each frame of a set has every time, and for what a set's frames share.
    frames: Vec<(f64, Sum)>,
    /// Of some of its sets: when their frames are taken, and the information of each.
    some: Vec<Vec<(f64, f64)>>,
    /// Numbers that were taken from it.
    taken: usize,
    /// What its sets leave of a tone of each frequency that is looked at, a share.
    left: Vec<f64>,
}

/// A tone's numbers in a recording: cosine and sine.
const NUMBERS: usize = 2;
/// A frame is taken to be off by so many times what frames are off by in the root of the mean square, at most: a tone is by the root of two.
const MOST: f64 = 4.0;
/// Products of frequencies and frames that are looked at, at most.
const MOST_PRODUCTS: f64 = 2e8;
/// So many sets of a recording tell what its sets leave of a tone, which must be so much at least.
const SOME: usize = 8;
const LEAST_LEFT: f64 = 0.2;
const LEAST: f64 = 1e-6;

impl Tones {
    /// With one more frame; the frames of a set come one after the other.
    pub fn add(&mut self, heard: Heard) {
        self.frames.push(heard);
    }

    /// Those of both.
    pub fn and(mut self, other: Self) -> Self {
        self.frames.extend(other.frames);
        self
    }

    /// The strongest tone, with a phase of its own in each recording and of the same size in all that have sets enough; nothing where these all move alike, because there what
    /// comes again with the phase or the position does so in time.
    pub fn strongest(&self) -> Option<Tone> {
        let tones = (0..WAYS.len()).filter_map(|way| self.tone(way));
        tones.max_by(|a, b| a.found.ln_bayes.total_cmp(&b.found.ln_bayes))
    }

    /// That of a way.
    fn tone(&self, way: usize) -> Option<Tone> {
        let mut takes: BTreeMap<usize, BTreeMap<usize, Vec<&Heard>>> = BTreeMap::new();
        for heard in self.frames.iter().filter(|heard| heard.ways[way].1 > 0.0) {
            takes.entry(heard.take).or_default().entry(heard.number.0).or_default().push(heard);
        }
        takes.retain(|_, sets| sets.len() >= LEAST_SETS);
        if !move_apart(takes.values().map(|sets| sets.values().flatten().map(|heard| heard.at))) {
            return None;
        }
        let mut takes: Vec<Recording> = takes.values().map(|sets| Recording::of(sets, way)).collect();
        let periods = takes.iter().flat_map(|take| take.frames.windows(2).map(|pair| pair[1].0 - pair[0].0));
        let period_s = usual(periods.collect())?;
        let longest_s =
            takes.iter().map(|take| longest(std::slice::from_ref(&take.frames))).fold(0.0, f64::max);
        let frames = takes.iter().map(|take| take.frames.len()).sum::<usize>() as f64;
        let step_hz = (FINENESS * longest_s).recip();
        let most = (0.5 / period_s).min(MOST_PRODUCTS * step_hz / frames) / step_hz;
        if !longest_s.is_finite() || !(1.0..MOST_PRODUCTS).contains(&most) {
            return None;
        }
        let count = most as usize;
        takes.iter_mut().for_each(|take| take.listen(step_hz, count));
        let strongest = |takes: &[Recording]| {
            let powers: Vec<Vec<f64>> = takes.iter().map(|take| take.powers(step_hz)).collect();
            let sums: Vec<f64> = (0..count).map(|at| powers.iter().map(|of| of[at]).sum()).collect();
            let best = greatest(&sums);
            (best, powers.iter().map(|of| of[best]).collect::<Vec<f64>>())
        };
        // Errors that are new in each frame raise all frequencies of a recording alike.
        let (_, powers) = strongest(&takes);
        takes.iter_mut().zip(powers).for_each(|(take, power)| take.calm(power));
        let (best, powers) = strongest(&takes);
        let size = |(take, power): (&Recording, &f64)| {
            let sigma = blur(take.frames.iter().map(|(_, sum)| sum.1).sum::<f64>() * take.left[best]);
            (sigma * power.sqrt(), sigma)
        };
        let sizes: Vec<(f64, f64)> = takes.iter().zip(&powers).map(size).collect();
        let looked = (WAYS.len() * count) as f64;
        let found = Greatest::of(powers.iter().sum(), NUMBERS * takes.len(), looked);
        agree(&sizes).then_some(Tone { way: MODES[WAYS[way]], hz: (best + 1) as f64 * step_hz, found })
    }
}

impl Recording {
    /// Of the frames of its sets.
    fn of(sets: &BTreeMap<usize, Vec<&Heard>>, way: usize) -> Self {
        let mut numbers: BTreeMap<usize, Sum> = BTreeMap::new();
        for heard in sets.values().flatten() {
            let (score, information) = numbers.entry(heard.number.1).or_default();
            *score += heard.ways[way].0;
            *information += heard.ways[way].1;
        }
        let beside_every = |heard: &&Heard| {
            let ((score, k), (scores, information)) = (heard.ways[way], numbers[&heard.number.1]);
            (heard.time_s, (score - k * scores / information, k))
        };
        let of_set = |set: &Vec<&Heard>| beside_mean(&set.iter().map(beside_every).collect::<Vec<_>>());
        let mut frames: Vec<_> = sets.values().flat_map(of_set).collect();
        let mean = chi2(&frames) / frames.len() as f64;
        for (_, (score, k)) in &mut frames {
            let most = MOST * (mean * *k).sqrt();
            *score = score.clamp(-most, most);
        }
        let information =
            |set: &Vec<&Heard>| set.iter().map(|heard| (heard.time_s, heard.ways[way].1)).collect();
        let some = sets.values().step_by(sets.len().div_ceil(SOME)).map(information).collect();
        Self { frames, some, taken: sets.len() + numbers.len(), left: Vec::new() }
    }

    /// In units of what frames scatter beside a line of this `power`.
    fn calm(&mut self, power: f64) {
        let degrees = self.frames.len().saturating_sub(self.taken + NUMBERS).max(1) as f64;
        let noise = ((chi2(&self.frames) - power) / degrees).max(1.0);
        self.frames.iter_mut().for_each(|(_, sum)| *sum = (sum.0 / noise, sum.1 / noise));
    }

    /// Learns what its sets leave of tones at a `count` of frequencies, each a step above the last.
    fn listen(&mut self, step_hz: f64, count: usize) {
        self.left = (1..=count).into_par_iter().map(|number| self.left_at(number as f64 * step_hz)).collect();
    }

    /// What is left of a tone's information of this frequency when its sets' means are taken from it, a share.
    fn left_at(&self, hz: f64) -> f64 {
        let (mut shared, mut all) = (0.0, 0.0);
        for set in &self.some {
            let (mut cosines, mut sines, mut information) = (0.0, 0.0, 0.0);
            for &(time_s, k) in set {
                let (cosine, sine) = cos_sin(TAU * ((time_s - set[0].0) * hz).fract());
                cosines += k * cosine;
                sines += k * sine;
                information += k;
            }
            shared += (cosines * cosines + sines * sines) / information;
            all += information;
        }
        (1.0 - shared / all).max(LEAST)
    }

    /// Chi squared that tones of these frequencies explain; none where its sets leave too little of one.
    fn powers(&self, step_hz: f64) -> Vec<f64> {
        let group = std::slice::from_ref(&self.frames);
        let powers = powers(group, &[], (step_hz, step_hz), self.left.len(), ANY);
        let explained = |(power, &left): (f64, &f64)| if left < LEAST_LEFT { 0.0 } else { power / left };
        powers.into_iter().zip(&self.left).map(explained).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    const FRAMES: usize = 4;

    /// What recordings are like: so many of them, of so many sets of four frames, from set to set so long, the last one with so much information a frame, all others with 1.
    #[derive(Clone, Copy)]
    struct Bench {
        takes: usize,
        sets: usize,
        set_s: f64,
        last: f64,
    }

    const SWEEP_AND_RAIL: Bench = Bench { takes: 2, sets: 120, set_s: 0.2, last: 1.0 };

    /// Of sweeps and rails with noise: what there is in a frame of a recording at a time, by its number, beside an error that its set shares, and one of its own, of so much.
    fn heard(
        bench: Bench,
        seed: u64,
        errors: [f64; 2],
        error: impl Fn(usize, usize, f64) -> f64,
    ) -> Option<Tone> {
        let mut tones = Tones::default();
        for take in 0..bench.takes {
            let draws = Draws::of(seed, take as u64).normal(bench.sets * (2 * FRAMES + 1));
            let k = if take + 1 == bench.takes { bench.last } else { 1.0 };
            for (set, draws) in draws.chunks_exact(2 * FRAMES + 1).enumerate() {
                for number in 0..FRAMES {
                    let time_s = bench.set_s * set as f64 + 0.025 * number as f64;
                    let mut at = [0.0; 2];
                    at[take % 2] = set as f64;
                    let off = errors[0] * draws[2 * FRAMES]
                        + errors[1] * draws[FRAMES + number]
                        + error(take, number, time_s);
                    let sum = (k * off + k.sqrt() * draws[number], k);
                    tones.add(Heard {
                        take,
                        number: (set, number),
                        time_s,
                        at,
                        ways: [sum, (0.0, 0.0), (0.0, 0.0)],
                    });
                }
            }
        }
        tones.strongest()
    }

    fn shaking(take: usize, time_s: f64) -> f64 {
        (TAU * 3.73 * time_s + 2.0 * take as f64).sin()
    }

    #[test]
    fn a_bench_that_shakes_is_heard_below_the_noise_and_far_above_it() {
        for (size, last, least) in [(0.9, 1.0, 20.0), (6.0, 1.0, 500.0), (30.0, 4.0, 1e4)] {
            let bench = Bench { last, ..SWEEP_AND_RAIL };
            let tone = heard(bench, 3, [0.0; 2], |take, _, time_s| size * shaking(take, time_s)).unwrap();
            assert!(tone.found.ln_bayes > least && (tone.hz - 3.73).abs() < 0.02, "{size} {tone:?}");
            assert_eq!(tone.way, "phase");
        }
        // What errors of sets hide is told by their frames.
        let tone =
            heard(SWEEP_AND_RAIL, 3, [8.0, 0.0], |take, _, time_s| 2.0 * shaking(take, time_s)).unwrap();
        assert!(tone.found.ln_bayes > 50.0 && (tone.hz - 3.73).abs() < 0.02, "{tone:?}");
    }

    fn is_silent(bench: Bench, errors: [f64; 2], error: &(dyn Fn(usize, usize, f64) -> f64 + Sync)) {
        (0..24_u64).into_par_iter().for_each(|seed| {
            let tone = heard(bench, seed, errors, error);
            assert!(tone.is_none_or(|tone| tone.found.ln_bayes < 1.0), "{seed} {errors:?} {tone:?}");
        });
    }

    /// Neither what is new in each frame, in bright recordings or dark ones, nor in each set, with pauses or without.
    #[test]
    fn jitters_and_errors_of_sets_are_no_tone() {
        for last in [1.0, 9.0, 100.0] {
            for errors in [[0.0, 0.0], [0.0, 1.0], [0.0, 5.0], [1.0, 0.3], [5.0, 0.0], [20.0, 2.0]] {
                is_silent(Bench { last, ..SWEEP_AND_RAIL }, errors, &|_, _, _| 0.0);
                is_silent(Bench { takes: 6, sets: 48, set_s: 0.1, last }, errors, &|_, _, _| 0.0);
            }
        }
    }

    /// Nor what frames of all sets have alike, nor a drift, nor what comes again with the setting of one recording.
    #[test]
    fn what_is_no_tone_says_nothing() {
        for bench in [SWEEP_AND_RAIL, Bench { takes: 3, set_s: 0.1, ..SWEEP_AND_RAIL }] {
            is_silent(bench, [0.0; 2], &|_, number, _| [30.0, -10.0, 20.0, 5.0][number]);
            is_silent(bench, [0.0; 2], &|_, _, time_s| 30.0 * (1.0 - (-time_s / 4.0).exp()));
            is_silent(bench, [0.0; 2], &|_, _, time_s| 0.1 * time_s * time_s);
            is_silent(bench, [0.0; 2], &|take, _, time_s| {
                if take == 0 { 4.0 * shaking(0, time_s) } else { 0.0 }
            });
        }
    }

    #[test]
    fn recordings_that_move_alike_and_odd_times_say_nothing() {
        let tone = |at: f64, time_s: &dyn Fn(usize) -> f64| {
            let mut tones = Tones::default();
            for (take, frame) in (0..128).map(|n| (n / 64, n % 64)) {
                let at = [frame as f64, at * (take * frame) as f64];
                let ways = [((frame % 3) as f64, 1.0); WAYS.len()];
                tones.add(Heard { take, number: (frame / 2, frame % 2), time_s: time_s(frame), at, ways });
            }
            tones.strongest()
        };
        assert_eq!(tone(0.0, &|frame| frame as f64), None);
        for time_s in [0.0, f64::NAN, f64::INFINITY] {
            assert_eq!(tone(1.0, &|_| time_s), None, "{time_s}");
        }
        assert_eq!(Tones::default().strongest(), None);
    }
}
