//! Waves over the converter's codes: errors that come again after so many codes, as those of a bit do, with whatever period.

use crate::diagnose::fitting::gram::Whitened;
use crate::diagnose::statistics::evidence::Greatest;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;

/// Codes that are looked at together, DN.
const BIN_DN: f64 = 2.0;
/// Bins at most: codes of 16 bits. Brighter samples of wider codes do not count.
const MOST: usize = 1 << 15;
/// Periods, DN: shorter ones are lost in the noise, longer ones are the curve of the response.
const PERIODS_DN: (f64, f64) = (8.0, 512.0);
/// Frequencies are so many times finer than the inverse of all codes.
const FINENESS: usize = 2;

/// What samples say of an offset at their expected code: score and information.
#[derive(Debug, Clone, Default)]
pub struct Codes {
    sums: Vec<(f64, f64)>,
}

/// The strongest wave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CodeWave {
    /// From crest to crest, DN.
    pub period_dn: f64,
    /// What it says among all waves.
    pub found: Greatest,
}

impl Codes {
    /// With one more frame.
    pub fn with(mut self, whitened: &Whitened, pedestal_dn: f64) -> Self {
        let samples = whitened.roots.iter().zip(whitened.residual).zip(&whitened.frame.base);
        for ((&root, &residual), &signal_dn) in samples.filter(|((root, _), _)| **root > 0.0) {
            self.add(signal_dn + pedestal_dn, root * residual, root * root);
        }
        self
    }

    /// With a sample whose code should be `code`.
    fn add(&mut self, code: f64, score: f64, information: f64) {
        let bin = (code / BIN_DN).max(0.0) as usize;
        if bin >= MOST {
            return;
        }
        if self.sums.len() <= bin {
            self.sums.resize(bin + 1, (0.0, 0.0));
        }
        self.sums[bin].0 += score;
        self.sums[bin].1 += information;
    }

    /// Those of both.
    pub fn and(mut self, mut other: Self) -> Self {
        if self.sums.len() < other.sums.len() {
            std::mem::swap(&mut self, &mut other);
        }
        for (sum, other) in self.sums.iter_mut().zip(other.sums) {
            *sum = (sum.0 + other.0, sum.1 + other.1);
        }
        self
    }

    /// Scores without the mean over the codes around: the curve of the response is no wave.
    fn without_curve(&self) -> impl Iterator<Item = f64> {
        let mut before = vec![(0.0, 0.0)];
        before.extend(self.sums.iter().scan((0.0, 0.0), |total, sum| {
            *total = (total.0 + sum.0, total.1 + sum.1);
            Some(*total)
        }));
        let around = (PERIODS_DN.1 / BIN_DN) as usize;
        let count = self.sums.len();
        self.sums.iter().enumerate().map(move |(bin, &(score, information))| {
            // As many on either side.
            let reach = around.min(bin).min(count - 1 - bin);
            let (low, high) = (before[bin - reach], before[bin + reach + 1]);
            let (scores, all) = (high.0 - low.0, high.1 - low.1);
            if all > 0.0 { score - information * scores / all } else { score }
        })
    }

    /// The strongest wave, by the periodogram over its mean where that is above what the noise makes.
    pub fn strongest(&self) -> Option<CodeWave> {
        let information: f64 = self.sums.iter().map(|sum| sum.1).sum();
        if information <= 0.0 {
            return None;
        }
        let length = (FINENESS * self.sums.len()).next_power_of_two();
        let mut series: Vec<Complex64> = self.without_curve().map(Complex64::from).collect();
        series.resize(length, Complex64::default());
        FftPlanner::new().plan_fft_forward(length).process(&mut series);
        let period_dn = |at: usize| length as f64 * BIN_DN / at as f64;
        let is_looked_at = |at: &usize| (PERIODS_DN.0..=PERIODS_DN.1).contains(&period_dn(*at));
        let places: Vec<usize> = (1..length / 2).filter(is_looked_at).collect();
        let power = |at: usize| series[at].norm_sqr() / (0.5 * information);
        let mean = places.iter().map(|&at| power(at)).sum::<f64>() / places.len().max(1) as f64;
        let best = places.iter().copied().max_by(|&a, &b| power(a).total_cmp(&power(b)))?;
        let chi2 = power(best) / (0.5 * mean).max(1.0);
        Some(CodeWave { period_dn: period_dn(best), found: Greatest::of(chi2, 2, places.len() as f64) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;
    use std::f64::consts::TAU;

    fn strongest(error: impl Fn(f64) -> f64) -> CodeWave {
        let mut codes = Codes::default();
        for (code, noise) in Draws::of(5, 0).normal(3000).into_iter().enumerate() {
            // A hundred samples of noise 1 at each code.
            let code = code as f64 + 100.0;
            codes.add(code, 10.0 * noise + 100.0 * error(code), 100.0);
        }
        codes.strongest().unwrap()
    }

    #[test]
    fn a_period_that_nobody_knows_is_found() {
        let wave = strongest(|code| 0.02 * (TAU * code / 42.7).cos());
        assert!(wave.found.ln_bayes > 4.0 && (wave.period_dn - 42.7).abs() < 0.5, "{wave:?}");
        assert!(strongest(|_| 0.0).found.ln_bayes < 1.0);
    }

    #[test]
    fn a_curve_is_no_wave() {
        let wave = strongest(|code| 1e-6 * (code - 1600.0).powi(2));
        assert!(wave.found.ln_bayes < 4.0, "{wave:?}");
    }
}
