//! Phase schemes: which raw frames a phase is made of, and with which weights. One row each.

use num_complex::Complex64;
use std::f64::consts::TAU;

/// The factor by which the quadrature sum's integer weights fall short of the true ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Irrational {
    /// None: the weights are the true ones.
    One,
    /// √3, from sin 60°.
    Sqrt3,
}

impl Irrational {
    /// The factor's square, an integer.
    pub const fn squared(self) -> i64 {
        match self {
            Self::One => 1,
            Self::Sqrt3 => 3,
        }
    }
}

/// A way of making a phase from raw frames I_n = A cos(n δ − φ) + B, n = 0, 1, …:
/// tan φ = factor · Σ quadrature_n I_n / Σ in_phase_n I_n.
#[derive(Debug, PartialEq)]
pub struct Scheme {
    /// What a specification and a command line call it.
    pub name: &'static str,
    /// The phase step δ as a fraction of a turn: numerator and denominator.
    pub step_turns: (u32, u32),
    /// Weights of the in-phase sum, which is gain · A cos φ.
    pub in_phase: &'static [i64],
    /// Weights of the quadrature sum, which is gain · A sin φ / factor.
    pub quadrature: &'static [i64],
    /// Weights of the offset sum, blind to the fundamental; they add up to the offset's gain.
    pub offset: &'static [i64],
    /// What the quadrature sum is still to be multiplied by.
    pub irrational: Irrational,
    /// The in-phase sum's gain: sum = gain · A cos φ.
    pub gain: i64,
    /// Where it comes from.
    pub reference: &'static str,
}

/// All schemes, in the order in which `--scheme auto` tries them.
pub const SCHEMES: &[Scheme] = &[
    Scheme {
        name: "four_frame",
        step_turns: (1, 4),
        in_phase: &[1, 0, -1, 0],
        quadrature: &[0, 1, 0, -1],
        offset: &[1, 1, 1, 1],
        irrational: Irrational::One,
        gain: 2,
        reference: "Drayton, Carnegie, Dorrington 2012: phase = atan2(I2 - I4, I1 - I3)",
    },
    Scheme {
        name: "wdft",
        step_turns: (1, 3),
        in_phase: &[2, -2, -3, 4, -1],
        quadrature: &[0, 2, -3, 0, 1],
        // The weights 1 2 3 2 1 have double roots at both harmonics 1 and -1: neither the fundamental nor
        // a linear step error leaks into the offset, as it would into a plain mean of five frames.
        offset: &[1, 2, 3, 2, 1],
        irrational: Irrational::Sqrt3,
        gain: 9,
        reference: "Surrel 1996; Drayton, Carnegie, Dorrington 2012: \
                    phase = atan2(sqrt(3) (2 I2 - 3 I3 + I5), 2 I1 - 2 I2 - 3 I3 + 4 I4 - I5)",
    },
];

/// The scheme called `name`.
pub fn scheme(name: &str) -> Option<&'static Scheme> {
    SCHEMES.iter().find(|scheme| scheme.name == name)
}

/// The names of all schemes, for a refusal.
pub fn scheme_names() -> String {
    SCHEMES.iter().map(|scheme| scheme.name).collect::<Vec<_>>().join(", ")
}

impl Scheme {
    /// Phase steps in a set.
    pub fn steps(&self) -> usize {
        self.in_phase.len()
    }

    /// The phase step δ in radians.
    pub fn step_rad(&self) -> f64 {
        TAU * f64::from(self.step_turns.0) / f64::from(self.step_turns.1)
    }

    /// What the offset sum must be divided by.
    pub fn offset_gain(&self) -> i64 {
        self.offset.iter().sum()
    }

    /// Coefficients c_n of the characteristic polynomial P(x) = Σ c_n xⁿ (Surrel 1996), in the paper's sign of
    /// φ: c_n = in_phase_n + i · factor · quadrature_n, so that φ = arg Σ c_n I_n.
    pub fn characteristic_polynomial(&self) -> Vec<Complex64> {
        let factor = (self.irrational.squared() as f64).sqrt();
        self.in_phase
            .iter()
            .zip(self.quadrature)
            .map(|(&i, &q)| Complex64::new(i as f64, factor * q as f64))
            .collect()
    }

    /// How many times P(x) has the root exp(i m δ): 0 where harmonic m comes through.
    pub fn root_multiplicity(&self, harmonic: i32) -> usize {
        let root = Complex64::from_polar(1.0, f64::from(harmonic) * self.step_rad());
        let mut polynomial = self.characteristic_polynomial();
        let scale: f64 = polynomial.iter().map(|c| c.norm()).sum();
        let mut multiplicity = 0;
        while polynomial.len() > 1 {
            let value = polynomial.iter().rev().fold(Complex64::ZERO, |sum, c| sum * root + c);
            if value.norm() > 1e-9 * scale {
                break;
            }
            multiplicity += 1;
            polynomial = polynomial.iter().enumerate().skip(1).map(|(n, c)| c * n as f64).collect();
        }
        multiplicity
    }

    /// Noise factor: the phase's standard deviation in radians times amplitude over the frames' noise,
    /// σ_φ A / σ = √(Σ|c_n|²/2) / gain for white noise.
    pub fn noise_factor(&self) -> f64 {
        let power: f64 = self.characteristic_polynomial().iter().map(|c| c.norm_sqr()).sum();
        (power / 2.0).sqrt() / self.gain as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every row says what it claims: on I_n = A cos(nδ − φ) + B its sums are gain·A cos φ, gain·A sin φ and gain·B.
    #[test]
    fn every_row_recovers_phase_amplitude_and_offset() {
        for scheme in SCHEMES {
            assert_eq!(scheme.quadrature.len(), scheme.steps(), "{}", scheme.name);
            assert_eq!(scheme.offset.len(), scheme.steps(), "{}", scheme.name);
            let factor = (scheme.irrational.squared() as f64).sqrt();
            for step in 0..24 {
                let phase = TAU * f64::from(step) / 24.0;
                let frames: Vec<f64> = (0..scheme.steps())
                    .map(|n| 100.0 * (n as f64 * scheme.step_rad() - phase).cos() + 300.0)
                    .collect();
                let sum = |weights: &[i64]| -> f64 {
                    weights.iter().zip(&frames).map(|(&w, frame)| w as f64 * frame).sum()
                };
                let gain = scheme.gain as f64;
                assert!((sum(scheme.in_phase) - gain * 100.0 * phase.cos()).abs() < 1e-9, "{}", scheme.name);
                assert!(
                    (factor * sum(scheme.quadrature) - gain * 100.0 * phase.sin()).abs() < 1e-9,
                    "{}",
                    scheme.name
                );
                assert!((sum(scheme.offset) - scheme.offset_gain() as f64 * 300.0).abs() < 1e-9);
            }
        }
    }

    /// Roots as the paper lists them (with its sign of φ every root is the conjugate of Surrel's).
    #[test]
    fn roots_are_the_papers() {
        let four = scheme("four_frame").unwrap();
        let wdft = scheme("wdft").unwrap();
        let roots = |scheme: &Scheme| (-5..=5).map(|m| scheme.root_multiplicity(m)).collect::<Vec<_>>();
        //                        m = -5 -4 -3 -2 -1  0  1  2  3  4  5
        assert_eq!(roots(four), [0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1]);
        assert_eq!(roots(wdft), [2, 0, 2, 2, 0, 2, 2, 0, 2, 2, 0]);
    }

    /// c_N of the catalogue: 0.707 for four frames (σ_φ = σ/(A√2)), 0.685 for the WDFT.
    #[test]
    fn noise_factors_are_the_catalogues() {
        assert!((scheme("four_frame").unwrap().noise_factor() - 0.707).abs() < 5e-4);
        assert!((scheme("wdft").unwrap().noise_factor() - 0.685).abs() < 5e-4);
    }
}
