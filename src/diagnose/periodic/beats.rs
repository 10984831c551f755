//! Beats: modulated light that is not the camera's own, and so is a line in time whose phase follows the phase steps.

use super::lamps::MAINS_OFF;
use super::lines::{CLEARLY_MORE, DRIFT_CYCLES, Line, Series, most_between};
use crate::diagnose::statistics::evidence::Greatest;
use crate::diagnose::statistics::periodogram::{ANY, FINENESS, Scan, chi2, greatest, longest};

/// Of what frames are off by in offset, beyond the noise, a beat that is looked at explains at least this share: it may be there beside something greater, and is looked at
/// again when that is named.
const LEAST_SHARE: f64 = 0.1;
/// Products of frequencies and frames that are looked at, at most.
pub const MOST_PRODUCTS: f64 = 1e9;
/// Numbers of a beat in a recording: cosine and sine.
const NUMBERS: usize = 2;

impl Series {
    /// The strongest beat, Hz: its phase goes with the phase that is commanded, it has a beginning of its own in every recording, and any
    /// frequency that frames see as one of its own, whichever of both lights is ahead.
    pub fn beat(&self) -> Option<Line> {
        let takes = self.by_take();
        let of_take = |take: usize| {
            let frames = self.frames.iter().filter(|frame| frame.take == take);
            frames.map(|frame| -frame.turns).collect()
        };
        let turns: Vec<Vec<f64>> = (0..takes.len()).map(of_take).collect();
        let products = self.frames.len() as f64 * 2.0 * FINENESS * longest(&takes);
        let most_hz = (0.5 / self.frame_period_s).min(MOST_PRODUCTS / products);
        let is_some = most_hz.is_finite() && most_hz > 0.0;
        let scan = is_some.then(|| Scan::turned(&takes, &turns, (-most_hz, most_hz), ANY)).flatten()?;
        let best = greatest(&scan.powers);
        Some(Line {
            frequency: scan.low + best as f64 * scan.step,
            chi2: *scan.powers.get(best)?,
            looked: scan.powers.len() as f64,
        })
    }

    /// The strongest beat, if it turns in the longest recording (what does not is the phasor of a crosstalk, or the drift of one, and is named first: where frames are not evenly
    /// apart in time it has images that turn), and is seen above the noise and what else is there.
    pub fn turning_beat(&self) -> Option<Line> {
        let longest_s = longest(&self.by_take());
        self.beat().filter(|beat| beat.frequency.abs() * longest_s > DRIFT_CYCLES && self.is_clear(beat))
    }

    /// Whether a line with a phase of its own in each recording is seen above the noise and what else is there.
    pub fn is_clear(&self, line: &Line) -> bool {
        let takes = self.by_take();
        let beyond_noise: f64 = takes.iter().map(|take| chi2(take) - take.len() as f64).sum();
        let found = Greatest::of(line.chi2, NUMBERS * takes.len(), line.looked);
        line.chi2 > LEAST_SHARE * beyond_noise && found.ln_bayes > 0.0
    }

    /// What such a line says among all that were looked at, in the noise that frames have beside it.
    pub fn seen_beside_the_rest(&self, line: &Line) -> Greatest {
        let takes = self.by_take();
        let numbers = NUMBERS * takes.len();
        let frames: usize = takes.iter().map(Vec::len).sum();
        let rest = takes.iter().map(|take| chi2(take)).sum::<f64>() - line.chi2;
        let noise = (rest / frames.saturating_sub(numbers).max(1) as f64).max(1.0);
        Greatest::of(line.chi2 / noise, numbers, line.looked)
    }

    /// The strongest beat, Hz, if it explains clearly more than a line of the ambient light that is near `frequency_hz`; noise has `inflation` times the variance
    /// that was stated.
    pub fn beats_more(&self, frequency_hz: f64, inflation: f64) -> Option<Line> {
        let ends = (frequency_hz * (1.0 - MAINS_OFF), frequency_hz * (1.0 + MAINS_OFF));
        // The mains wander from recording to recording. What one sees at rest is the lamp's, too, where others see it move.
        let of_take = |take: &Vec<_>| most_between(std::slice::from_ref(take), ends, 0.0);
        let of_line: f64 = self.by_take().iter().map(of_take).sum();
        self.beat().filter(|beat| beat.chi2 > of_line + CLEARLY_MORE * inflation.max(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::periodic::lines::FrameSeen;
    use crate::physics::Draws;
    use std::f64::consts::TAU;

    const PERIOD_S: f64 = 0.025;

    /// Sets of four and of five frames, those of the second recording with another phase offset each, which see a `line`, by time and commanded turns.
    fn series(line: &dyn Fn(f64, f64) -> f64) -> Series {
        let mut series = Series { frame_period_s: PERIOD_S, ..Series::default() };
        for (take, frames) in [(0, 4), (1, 5)] {
            let noise = Draws::of(take as u64, 3).normal(60 * frames);
            for (number, noise) in noise.into_iter().enumerate() {
                let (set, frame) = (number / frames, number % frames);
                let time_s = PERIOD_S * (frame + 11 * set) as f64;
                let turns = frame as f64 / frames as f64 + take as f64 * set as f64 / 64.0;
                let ambient = (line(time_s, turns) + noise, 1.0);
                series.frames.push(FrameSeen { take, time_s, turns, ambient, ..FrameSeen::default() });
            }
        }
        series
    }

    /// Of a beat whichever light is ahead nearly all is explained, of a lamp much less.
    #[test]
    fn a_beat_follows_the_phase_steps_and_a_lamp_does_not() {
        let of = |line: &dyn Fn(f64, f64) -> f64| series(line).beat().map_or(0.0, |beat| beat.chi2);
        let beat = |hz: f64| of(&move |time_s, turns| (TAU * (turns - hz * time_s + 0.2)).cos());
        let lamp = |time_s: f64, _: f64| (TAU * (100.3 * time_s + 0.2)).cos();
        // 540 frames, half of a square each, and what noise adds.
        let all = 0.5 * 540.0;
        for hz in [0.7, -1.3, 9.0] {
            assert!(beat(hz) > 0.8 * all, "{hz} Hz: {}", beat(hz));
        }
        assert!(of(&lamp) < 0.6 * all, "{}", of(&lamp));
        assert!(of(&|_, _| 0.0) < 60.0);
        assert!(Series::default().beat().is_none());
        // Whatever a lamp explains, a beat explains no more; and the other way round.
        assert!(series(&lamp).beats_more(100.3, 1.0).is_none());
        // Nor where recordings of a quarter of a minute see a third of a cycle.
        let rests = |time_s: f64, _: f64| (TAU * (120.02 * time_s + 0.2)).cos();
        assert!(series(&rests).beat().is_some_and(|beat| beat.chi2 > 0.3 * all));
        assert!(series(&rests).beats_more(120.02, 1.0).is_none());
        let seen = series(&|time_s, turns| (TAU * (turns - 0.7 * time_s + 0.2)).cos()).beats_more(100.3, 1.0);
        assert!(seen.is_some_and(|beat| (beat.frequency - 0.7).abs() < 0.02), "{seen:?}");
    }

    #[test]
    fn a_beat_that_is_looked_at_turns_and_stands_above_the_rest() {
        let seen = |line: &dyn Fn(f64, f64) -> f64| series(line).turning_beat().is_some();
        let beat = |hz: f64, time_s: f64, turns: f64| (TAU * (turns - hz * time_s + 0.2)).cos();
        assert!(seen(&|time_s, turns| beat(0.7, time_s, turns)));
        // Noise, a crosstalk, and a beat beside errors of frames that are ten times as strong.
        let errors = |time_s: f64| 10.0 * Draws::of((1e4 * time_s) as u64, 9).normal(1)[0];
        assert!(!seen(&|_, _| 0.0));
        assert!(!seen(&|time_s, turns| beat(0.0, time_s, turns)));
        assert!(!seen(&|time_s, turns| beat(0.7, time_s, turns) + errors(time_s)));
    }
}
