//! Waves over rows, or over columns, that move in time: bands that drift as a supply's ripple meets the row clock. Neither a function of the row
//! nor errors of single rows say much of them; a wave of the right length and speed does.

use rayon::prelude::*;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;
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
}

/// The strongest wave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// Lines (rows or columns) from crest to crest.
    pub lines: f64,
    /// Cycles a second at a row; negative where it moves towards smaller numbers.
    pub hz: f64,
    /// Evidence, nats.
    pub ln_bayes: f64,
    /// Chi squared that it explains, and by how many numbers.
    pub chi2: (f64, usize),
}

/// Cycles over all lines that are looked at: from one, in halves, to so many.
const CYCLES: (f64, f64) = (1.0, 24.0);
const CYCLE_STEP: f64 = 0.5;
/// The shortest wave has so many lines.
const SHORTEST: f64 = 2.5;
/// Places in time between a frame and the next, on which frames are put.
const PLACES: f64 = 2.0;
/// Frequencies are so many times finer than the inverse of the longest recording.
const FINENESS: usize = 2;
/// Frames that a recording has at least.
const LEAST_FRAMES: usize = 32;
/// Coordinates among which waves are: each has to be believed against the others.
const LOOKED: f64 = 25.0;

impl Waves {
    /// With one more frame.
    pub fn add(&mut self, take: usize, time_s: f64, lines: &[(f64, f64)]) {
        self.frames.push(Seen { take, time_s, lines: lines.to_vec() });
    }

    /// Those of both.
    pub fn and(mut self, other: Self) -> Self {
        self.frames.extend(other.frames);
        self
    }

    /// The strongest wave, where enough was seen to tell, with frames `frame_period_s` apart.
    ///
    /// Its power is that of a periodogram with a phase of its own in each recording (Lomb 1976), over the periodogram's mean where that is above
    /// what the noise makes: errors of rows that are white raise all waves alike.
    pub fn strongest(&self, frame_period_s: f64) -> Option<Wave> {
        let count = self.frames.first()?.lines.len();
        let takes = self.frames.iter().map(|seen| seen.take + 1).max()?;
        let of_take = |take: usize| self.frames.iter().filter(move |seen| seen.take == take);
        let takes: Vec<usize> = (0..takes).filter(|&take| of_take(take).count() >= LEAST_FRAMES).collect();
        let latest_s = self.frames.iter().map(|seen| seen.time_s).fold(0.0, f64::max);
        let most = (count as f64 / SHORTEST).min(CYCLES.1);
        if takes.is_empty() || most < CYCLES.0 || frame_period_s <= 0.0 {
            return None;
        }
        let place_s = frame_period_s / PLACES;
        let length = (FINENESS * (latest_s / place_s).ceil() as usize + 1).next_power_of_two();
        let fft = FftPlanner::new().plan_fft_forward(length);
        // More than from frame to frame is seen as less.
        let half = (length as f64 / (2.0 * PLACES)) as usize;
        let cycles: Vec<f64> = (0..=((most - CYCLES.0) / CYCLE_STEP) as usize)
            .map(|step| CYCLES.0 + CYCLE_STEP * step as f64)
            .collect();
        let power = |&cycles: &f64| {
            let turns: Vec<Complex64> =
                (0..count).map(|n| Complex64::cis(-TAU * cycles * n as f64 / count as f64)).collect();
            let mut power = vec![0.0; 2 * half];
            for &take in &takes {
                let mut series = vec![Complex64::default(); length];
                let mut information = 0.0;
                for seen in of_take(take) {
                    let wave: Complex64 =
                        seen.lines.iter().zip(&turns).map(|((score, _), turn)| turn * score).sum();
                    series[(seen.time_s / place_s).round().max(0.0) as usize] += wave;
                    information += seen.lines.iter().map(|line| line.1).sum::<f64>();
                }
                if information <= 0.0 {
                    continue;
                }
                fft.process(&mut series);
                for (at, sum) in power.iter_mut().enumerate() {
                    *sum += series[(at + length - half) % length].norm_sqr() / (0.5 * information);
                }
            }
            power
        };
        let powers: Vec<Vec<f64>> = cycles.par_iter().map(power).collect();
        let numbers = 2 * takes.len();
        let cells = (powers.len() * 2 * half) as f64;
        let mean = powers.iter().flatten().sum::<f64>() / cells;
        let floor = (mean / numbers as f64).max(1.0);
        let places = powers.iter().enumerate().flat_map(|(of, p)| (0..p.len()).map(move |at| (of, at)));
        let (of, at) = places.max_by(|a, b| powers[a.0][a.1].total_cmp(&powers[b.0][b.1]))?;
        let chi2 = powers[of][at] / floor;
        Some(Wave {
            lines: count as f64 / cycles[of],
            hz: -(at as f64 - half as f64) / (length as f64 * place_s),
            ln_bayes: of_greatest(chi2, numbers, cells),
            chi2: (chi2, numbers),
        })
    }
}

/// Evidence (nats) of the greatest among so many `cells`, a `chi2` of so many `numbers`: what its chance is worth at most, p by Chernoff's bound,
/// -1 / (e p ln p) (Sellke, Bayarri, Berger 2001).
pub fn of_greatest(chi2: f64, numbers: usize, cells: f64) -> f64 {
    let numbers = numbers as f64;
    let surprise = 0.5 * chi2 - 0.5 * numbers * (1.0 + (chi2 / numbers).max(1.0).ln()) - cells.ln();
    if surprise > 1.0 { surprise - 1.0 - surprise.ln() - LOOKED.ln() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    const ROWS: usize = 16;
    const FRAME_PERIOD_S: f64 = 0.025;

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
            waves.add(0, time_s, &lines);
        }
        waves.strongest(FRAME_PERIOD_S).unwrap()
    }

    #[test]
    fn a_band_that_drifts_is_found_below_the_noise() {
        let wave = strongest(1.0, |row, time_s| 0.1 * (TAU * (row / 5.0 - time_s / 3.0)).cos());
        assert!(wave.ln_bayes > 4.0, "{wave:?}");
        assert!((wave.lines - 5.0).abs() < 0.4 && (wave.hz - 1.0 / 3.0).abs() < 0.01, "{wave:?}");
    }

    #[test]
    fn noise_has_no_wave_even_where_rows_have_more_of_it() {
        for noise in [1.0, 5.0] {
            let wave = strongest(noise, |_, _| 0.0);
            assert!(wave.ln_bayes < 1.0, "{noise}: {wave:?}");
        }
    }
}
