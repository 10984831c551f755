//! Light and demodulation as pulses in time, and the correlation waveform that they make.

use super::correlation::{Correlation, Harmonic};
use crate::problem::{Problem, Result};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// A periodic pulse with straight edges behind a low-pass of first order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// Share of the period at which it is above half its height, in (0, 1).
    pub duty: f64,
    /// Duration of each edge, s, 0 or more: at most the pulse's and the pause's.
    pub edge_s: f64,
    /// Frequency at which the low-pass has 3 dB, Hz, > 0; infinite where there is none.
    pub bandwidth_hz: f64,
}

impl Pulse {
    /// A square wave.
    pub const SQUARE: Self = Self { duty: 0.5, edge_s: 0.0, bandwidth_hz: f64::INFINITY };

    /// Coefficient of exp(i m ω t) of a pulse of height 1 whose middle is at t = 0: a rectangle, convolved with one of the edge's
    /// duration, times the low-pass.
    fn coefficient(&self, number: u32, frequency_hz: f64) -> Complex64 {
        let m = f64::from(number);
        let sinc = |x: f64| if x == 0.0 { 1.0 } else { libm::sin(PI * x) / (PI * x) };
        let pulse = self.duty * sinc(m * self.duty) * sinc(m * self.edge_s * frequency_hz);
        let low_pass = Complex64::new(1.0, m * frequency_hz / self.bandwidth_hz);
        Complex64::new(pulse, 0.0) / low_pass
    }

    fn check(&self, name: &str, frequency_hz: f64) -> Result<()> {
        let edge = self.edge_s * frequency_hz;
        let refuse = |found: String, expected: &str| Err(Problem::at(name, found).expected(expected));
        if !(self.duty > 0.0 && self.duty < 1.0) {
            return refuse(format!("duty = {}", self.duty), "a share of the period between 0 and 1");
        }
        if !(0.0..=self.duty.min(1.0 - self.duty)).contains(&edge) {
            return refuse(
                format!("edge_s = {:e}", self.edge_s),
                "0 or more, and no longer than pulse and pause",
            );
        }
        if self.bandwidth_hz.is_nan() || self.bandwidth_hz <= 0.0 {
            return refuse(format!("bandwidth_hz = {:e}", self.bandwidth_hz), "a frequency above 0");
        }
        Ok(())
    }
}

impl Correlation {
    /// The correlation of `light` with `demodulation` at `frequency_hz` (> 0), harmonics up to number `highest` (>= 1), relative to the
    /// fundamental in amplitude and phase; and the constant part over the fundamental's amplitude.
    ///
    /// The coefficients of a correlation are the products of those of its factors, one of them conjugate.
    ///
    /// # Errors
    /// A pulse beyond the ranges of [`Pulse`]'s fields, or without a fundamental.
    pub fn of_pulses(
        light: &Pulse,
        demodulation: &Pulse,
        frequency_hz: f64,
        highest: u32,
    ) -> Result<(Self, f64)> {
        light.check("light", frequency_hz)?;
        demodulation.check("demodulation", frequency_hz)?;
        let product = |number| {
            light.coefficient(number, frequency_hz).conj() * demodulation.coefficient(number, frequency_hz)
        };
        let length = |z: Complex64| libm::hypot(z.re, z.im);
        let phase = |z: Complex64| libm::atan2(z.im, z.re);
        let fundamental = product(1);
        if length(fundamental) < 1e-12 {
            return Err(
                Problem::at("light", "has no fundamental").expected("a longer pulse or a shorter edge")
            );
        }
        let harmonics: Vec<Harmonic> = (2..=highest)
            .map(|number| {
                let turned = phase(product(number)) - f64::from(number) * phase(fundamental);
                let phase_rad = turned - TAU * (turned / TAU).round();
                Harmonic { number, amplitude: length(product(number)) / length(fundamental), phase_rad }
            })
            .collect();
        let constant_ratio = product(0).re / (2.0 * length(fundamental));
        Ok((Self::with_harmonics(&harmonics), constant_ratio))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEPS: usize = 1 << 14;
    const FREQUENCY_HZ: f64 = 30e6;

    /// One period in time, by straight edges and the low-pass's differential equation.
    fn in_time(pulse: &Pulse) -> Vec<f64> {
        let edge = pulse.edge_s * FREQUENCY_HZ;
        let height = |step: usize| {
            let from_middle = ((step as f64 + 0.5) / STEPS as f64 - 0.5).abs();
            let inside = pulse.duty / 2.0 - from_middle;
            if edge == 0.0 {
                f64::from(u8::from(inside > 0.0))
            } else {
                (inside / edge + 0.5).clamp(0.0, 1.0)
            }
        };
        let mut samples: Vec<f64> = (0..STEPS).map(height).collect();
        if pulse.bandwidth_hz.is_finite() {
            // y' = 2π f_b (x − y), for enough periods to settle.
            let share = 1.0 - (-TAU * pulse.bandwidth_hz / (FREQUENCY_HZ * STEPS as f64)).exp();
            let (mut y, mut settled) = (0.0, vec![0.0; STEPS]);
            for _ in 0..20 {
                for (step, x) in samples.iter().enumerate() {
                    y += share * (x - y);
                    settled[step] = y;
                }
            }
            samples = settled;
        }
        samples
    }

    /// Correlating in time and multiplying coefficients is the same.
    #[test]
    fn harmonics_are_those_of_the_correlation_in_time() {
        let square = Pulse::SQUARE;
        let pulses = [
            (square, square),
            (Pulse { duty: 0.42, ..square }, square),
            (Pulse { duty: 0.36, edge_s: 4e-9, ..square }, Pulse { duty: 0.55, edge_s: 1e-9, ..square }),
            (
                Pulse { edge_s: 2e-9, bandwidth_hz: 60e6, ..square },
                Pulse { duty: 0.45, bandwidth_hz: 200e6, ..square },
            ),
        ];
        for (light, demodulation) in pulses {
            let (correlation, constant_ratio) =
                Correlation::of_pulses(&light, &demodulation, FREQUENCY_HZ, 7).unwrap();
            let (light_in_time, demodulation_in_time) = (in_time(&light), in_time(&demodulation));
            let lags = 512;
            let correlated: Vec<f64> = (0..lags)
                .map(|lag| {
                    let shift = lag * STEPS / lags;
                    let products = light_in_time.iter().enumerate();
                    products.map(|(t, l)| l * demodulation_in_time[(t + shift) % STEPS]).sum::<f64>()
                        / STEPS as f64
                })
                .collect();
            let harmonic = |number: u32| -> Complex64 {
                let terms = correlated.iter().enumerate().map(|(lag, value)| {
                    value
                        * Complex64::from_polar(
                            2.0 / lags as f64,
                            -TAU * f64::from(number) * lag as f64 / lags as f64,
                        )
                });
                terms.sum()
            };
            let first = harmonic(1);
            // Pulses have edges between samples. Samples of the correlation alias harmonic 511 and up, 4e-6, into these.
            let tolerance = 3e-4;
            assert!((harmonic(0).re / 2.0 / first.norm() - constant_ratio).abs() < tolerance, "{light:?}");
            for h in correlation.harmonics() {
                let turned = harmonic(h.number)
                    * Complex64::from_polar(1.0 / first.norm(), -f64::from(h.number) * first.arg());
                let table = Complex64::from_polar(h.amplitude, h.phase_rad);
                assert!((turned - table).norm() < tolerance, "{light:?} {}: {turned}, not {table}", h.number);
            }
        }
    }

    /// Two square waves correlate to a triangle: odd harmonics falling as 1/m², a constant part of π²/8.
    #[test]
    fn square_waves_make_a_triangle() {
        let (triangle, constant_ratio) =
            Correlation::of_pulses(&Pulse::SQUARE, &Pulse::SQUARE, FREQUENCY_HZ, 9).unwrap();
        assert!((constant_ratio - PI * PI / 8.0).abs() < 1e-12);
        for h in triangle.harmonics() {
            let expected = if h.number % 2 == 1 { f64::from(h.number).powi(-2) } else { 0.0 };
            assert!((h.amplitude - expected).abs() < 1e-12, "{h:?}");
        }
    }

    #[test]
    fn impossible_pulses_are_refused() {
        for (pulse, word) in [
            (Pulse { duty: 1.0, ..Pulse::SQUARE }, "duty"),
            (Pulse { duty: f64::NAN, ..Pulse::SQUARE }, "duty"),
            (Pulse { edge_s: 1e-7, ..Pulse::SQUARE }, "edge_s"),
            (Pulse { bandwidth_hz: 0.0, ..Pulse::SQUARE }, "bandwidth_hz"),
        ] {
            let refusal =
                Correlation::of_pulses(&Pulse::SQUARE, &pulse, FREQUENCY_HZ, 3).unwrap_err().to_string();
            assert!(refusal.contains(word) && refusal.starts_with("demodulation"), "{refusal}");
        }
    }
}
