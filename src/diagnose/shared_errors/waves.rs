//! Waves over rows, or over columns, that move in time: bands that drift as a supply's ripple meets the row clock. Neither a function of the row
//! nor errors of single rows say much of them; a wave of the right length and speed does.

use crate::diagnose::statistics::evidence::Greatest;
use rayon::prelude::*;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// What a frame's rows, or columns, say of an offset of their own: score and information.
type Line = Vec<(f64, f64)>;

/// One frame: its recording, its time (s), and its lines.
#[derive(Debug, Clone)]
struct Seen {
    take: usize,
    time_s: f64,
    lines: Line,
}

/// What all frames say of offsets of their rows, or columns.
#[derive(Debug, Clone, Default)]
pub struct Waves {
    frames: Vec<Seen>,
    /// From a frame to the next, where that is shortest, s.
    shortest_s: Option<f64>,
}

/// The strongest wave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// Lines (rows or columns) from crest to crest.
    pub lines: f64,
    /// Cycles a second at a row; negative where it moves towards smaller numbers.
    pub hz: f64,
    /// What it says among all waves.
    pub found: Greatest,
}

/// Cycles over all lines that are looked at: from one, in halves, to so many.
const CYCLES: (f64, f64) = (1.0, 24.0);
const CYCLE_STEP: f64 = 0.5;
/// The shortest wave has so many lines.
const SHORTEST: f64 = 2.5;
/// Places in time between a frame and the next, on which frames are put.
const PLACES: f64 = 2.0;
/// Places in time at most.
const MOST_PLACES: f64 = 65_535.0;
/// Frequencies are so many times finer than the inverse of the longest recording.
const FINENESS: usize = 2;
/// Frames that a recording has at least.
const LEAST_FRAMES: usize = 32;

impl Waves {
    /// With one more frame, which the next one follows after `frame_period_s`.
    pub fn add(&mut self, take: usize, time_s: f64, frame_period_s: f64, lines: &[(f64, f64)]) {
        // What all lines share is the frame's.
        let (score, information) =
            lines.iter().fold((0.0, 0.0), |sum, line| (sum.0 + line.0, sum.1 + line.1));
        let common = if information > 0.0 { score / information } else { 0.0 };
        let lines = lines.iter().map(|&(score, information)| (score - common * information, information));
        self.frames.push(Seen { take, time_s, lines: lines.collect() });
        if frame_period_s > 0.0 {
            self.shortest_s = Some(self.shortest_s.map_or(frame_period_s, |other| other.min(frame_period_s)));
        }
    }

    /// Those of both.
    pub fn and(mut self, other: Self) -> Self {
        self.frames.extend(other.frames);
        self.shortest_s = [self.shortest_s, other.shortest_s].into_iter().flatten().reduce(f64::min);
        self
    }

    /// The strongest wave, where enough was seen to tell.
    ///
    /// Its power is that of a periodogram with a phase of its own in each recording (Lomb 1976), over the mean of all waves of this length where that
    /// is above what the noise makes: errors of rows that are white raise them alike.
    pub fn strongest(&self) -> Option<Wave> {
        let count = self.frames.first()?.lines.len();
        let frame_period_s = self.shortest_s?;
        let mut takes: BTreeMap<usize, Vec<&Seen>> = BTreeMap::new();
        self.frames.iter().for_each(|seen| takes.entry(seen.take).or_default().push(seen));
        takes.retain(|_, seen| seen.len() >= LEAST_FRAMES);
        let ends_s = |seen: &Vec<&Seen>| {
            let times = seen.iter().map(|seen| seen.time_s);
            times.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| (low.min(s), high.max(s)))
        };
        let takes: Vec<(f64, Vec<&Seen>)> = takes.into_values().map(|seen| (ends_s(&seen).0, seen)).collect();
        let longest_s = takes.iter().map(|(start_s, seen)| ends_s(seen).1 - start_s).fold(0.0, f64::max);
        let most = (count as f64 / SHORTEST).min(CYCLES.1);
        if takes.is_empty() || most < CYCLES.0 || !longest_s.is_finite() {
            return None;
        }
        // A recording that is very long shows no fast waves.
        let place_s = (frame_period_s / PLACES).max(longest_s / MOST_PLACES);
        let length = (FINENESS * (longest_s / place_s).ceil() as usize + 1).next_power_of_two();
        let fft = FftPlanner::new().plan_fft_forward(length);
        // More than from frame to frame is seen as less.
        let half = (length as f64 * place_s / (2.0 * frame_period_s)).min(length as f64 / 2.0) as usize;
        let numbers = 2 * takes.len();
        let strongest = |cycles: f64| {
            let turns: Vec<Complex64> =
                (0..count).map(|n| Complex64::cis(-TAU * cycles * n as f64 / count as f64)).collect();
            let mut powers = vec![0.0; 2 * half];
            for (start_s, seen) in &takes {
                let mut series = vec![Complex64::default(); length];
                let mut information = 0.0;
                for Seen { time_s, lines, .. } in seen {
                    let wave: Complex64 =
                        lines.iter().zip(&turns).map(|((score, _), turn)| turn * score).sum();
                    series[((time_s - start_s) / place_s).round() as usize] += wave;
                    information += lines.iter().map(|line| line.1).sum::<f64>();
                }
                if information <= 0.0 {
                    continue;
                }
                fft.process(&mut series);
                for (at, sum) in powers.iter_mut().enumerate() {
                    *sum += series[(at + length - half) % length].norm_sqr() / (0.5 * information);
                }
            }
            let mean = powers.iter().sum::<f64>() / powers.len().max(1) as f64;
            let best = (0..powers.len()).max_by(|&a, &b| powers[a].total_cmp(&powers[b]))?;
            Some((powers[best] / (mean / numbers as f64).max(1.0), cycles, best))
        };
        let lengths = ((most - CYCLES.0) / CYCLE_STEP) as usize + 1;
        let all: Vec<_> = (0..lengths)
            .into_par_iter()
            .filter_map(|step| strongest(CYCLES.0 + CYCLE_STEP * step as f64))
            .collect();
        let (chi2, cycles, at) = all.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        let looked = (lengths * 2 * half) as f64;
        Some(Wave {
            lines: count as f64 / cycles,
            hz: -(at as f64 - half as f64) / (length as f64 * place_s),
            found: Greatest::of(chi2, numbers, looked),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    const ROWS: usize = 16;
    const FRAME_PERIOD_S: f64 = 0.025;

    #[test]
    fn long_recordings_and_odd_times_need_no_more_memory() {
        for times in [[0.0, 1e9], [f64::NAN, 1.0], [0.0, f64::INFINITY], [-1e9, 0.0]] {
            let mut waves = Waves::default();
            for frame in 0..LEAST_FRAMES {
                waves.add(0, times[frame % 2], 1e-9, &[(1.0, 1.0); ROWS]);
            }
            let wave = waves.strongest();
            assert!(wave.is_none_or(|wave| wave.found.looked < 2e6), "{times:?}: {wave:?}");
        }
    }

    /// Of 200 sets of four frames with a pause after each, noise of so many standard deviations a row.
    fn strongest(noise: f64, offset: impl Fn(f64, f64) -> f64) -> Wave {
        let mut waves = Waves::default();
        for frame in 0..800_usize {
            let time_s = FRAME_PERIOD_S * frame as f64 + 0.13 * (frame / 4) as f64;
            let draws = Draws::of(3, frame as u64).normal(ROWS);
            let lines: Line = draws
                .iter()
                .enumerate()
                .map(|(row, n)| (noise * n + offset(row as f64, time_s), 1.0))
                .collect();
            // Since some other time.
            waves.add(0, time_s - 1e9, FRAME_PERIOD_S, &lines);
        }
        waves.strongest().unwrap()
    }

    #[test]
    fn a_band_that_drifts_is_found_below_the_noise() {
        let wave = strongest(1.0, |row, time_s| 0.1 * (TAU * (row / 5.0 - time_s / 3.0)).cos());
        assert!(wave.found.ln_bayes > 4.0, "{wave:?}");
        assert!((wave.lines - 5.0).abs() < 0.4 && (wave.hz - 1.0 / 3.0).abs() < 0.01, "{wave:?}");
    }

    #[test]
    fn noise_has_no_wave_even_where_rows_have_more_of_it() {
        for noise in [1.0, 5.0] {
            let wave = strongest(noise, |_, _| 0.0);
            assert!(wave.found.ln_bayes < 1.0, "{noise}: {wave:?}");
        }
    }
}
