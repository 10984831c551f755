//! Phase schemes: which raw frames a phase is made of, and with which weights. One row each.

use super::file;
use super::step_angle::StepAngle;
use crate::problem::Result;
use num_complex::Complex64;
use std::borrow::Cow;
use std::fmt;

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

    /// Reads "1" or "sqrt(3)".
    pub fn parse(text: &str) -> Option<Self> {
        [Self::One, Self::Sqrt3].into_iter().find(|irrational| irrational.to_string() == text)
    }
}

impl fmt::Display for Irrational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::One => "1",
            Self::Sqrt3 => "sqrt(3)",
        })
    }
}

/// Where a scheme's weights come from: what a specification says of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SchemeOrigin {
    /// A row of [`SCHEMES`].
    Named,
    /// Cosines and sines rounded to so many bits, sign included: [`Scheme::dft`].
    Dft {
        /// The bits.
        coefficient_bits: u32,
    },
    /// A row that the specification gives: [`Scheme::of_row`].
    Row,
}

/// A way of making a phase from raw frames I_n = A cos(angle_n − φ) + B, n = 0, 1, …:
/// tan φ = factor · Σ quadrature_n I_n / Σ in_phase_n I_n.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Scheme {
    /// What a specification and a command line call it.
    pub name: Cow<'static, str>,
    /// The phase steps' angles, one a step.
    pub angles: Cow<'static, [StepAngle]>,
    /// Weights of the in-phase sum, which is gain · A cos φ. They add up to 0.
    pub in_phase: Cow<'static, [i64]>,
    /// Weights of the quadrature sum, which is gain · A sin φ / factor. They add up to 0.
    pub quadrature: Cow<'static, [i64]>,
    /// Weights of the offset sum, none negative, blind to the fundamental; they add up to the offset's gain.
    pub offset: Cow<'static, [i64]>,
    /// What the quadrature sum is still to be multiplied by.
    pub irrational: Irrational,
    /// The in-phase sum's gain: sum = gain · A cos φ.
    pub gain: f64,
    /// Largest error of a sinusoid's phase, rad, that comes from weights which are not quite the true ones; 0 where they
    /// are.
    pub weight_error_rad: f64,
    /// The same of its amplitude, relative.
    pub weight_error_amplitude: f64,
    /// Where the weights come from.
    pub origin: SchemeOrigin,
    /// Where it comes from.
    pub reference: Cow<'static, str>,
}

/// All named schemes, in the order in which `--scheme auto` tries them.
pub const SCHEMES: &[Scheme] = &[
    Scheme {
        name: Cow::Borrowed("four_frame"),
        angles: Cow::Borrowed(&[
            StepAngle::of(0, 1),
            StepAngle::of(1, 4),
            StepAngle::of(1, 2),
            StepAngle::of(3, 4),
        ]),
        in_phase: Cow::Borrowed(&[1, 0, -1, 0]),
        quadrature: Cow::Borrowed(&[0, 1, 0, -1]),
        offset: Cow::Borrowed(&[1, 1, 1, 1]),
        irrational: Irrational::One,
        gain: 2.0,
        weight_error_rad: 0.0,
        weight_error_amplitude: 0.0,
        origin: SchemeOrigin::Named,
        reference: Cow::Borrowed("Drayton, Carnegie, Dorrington 2012: phase = atan2(I2 - I4, I1 - I3)"),
    },
    Scheme {
        name: Cow::Borrowed("wdft"),
        angles: Cow::Borrowed(&[
            StepAngle::of(0, 1),
            StepAngle::of(1, 3),
            StepAngle::of(2, 3),
            StepAngle::of(1, 1),
            StepAngle::of(4, 3),
        ]),
        in_phase: Cow::Borrowed(&[2, -2, -3, 4, -1]),
        quadrature: Cow::Borrowed(&[0, 2, -3, 0, 1]),
        // The weights 1 2 3 2 1 have double roots at both harmonics 1 and -1: neither the fundamental nor
        // a linear step error leaks into the offset, as it would into a plain mean of five frames.
        offset: Cow::Borrowed(&[1, 2, 3, 2, 1]),
        irrational: Irrational::Sqrt3,
        gain: 9.0,
        weight_error_rad: 0.0,
        weight_error_amplitude: 0.0,
        origin: SchemeOrigin::Named,
        reference: Cow::Borrowed(
            "Surrel 1996; Drayton, Carnegie, Dorrington 2012: \
             phase = atan2(sqrt(3) (2 I2 - 3 I3 + I5), 2 I1 - 2 I2 - 3 I3 + 4 I4 - I5)",
        ),
    },
];

/// The scheme called `name`.
pub fn scheme(name: &str) -> Option<&'static Scheme> {
    SCHEMES.iter().find(|scheme| scheme.name == name)
}

/// What a specification may say instead of a scheme's name, for a refusal.
pub fn scheme_names() -> String {
    let names: Vec<_> = SCHEMES.iter().map(|scheme| &*scheme.name).collect();
    format!("{}, dft, or a table [modulation.scheme] with weights of your own", names.join(", "))
}

impl Scheme {
    /// The scheme of the TOML file at `path`: a specification's, or that of a file with nothing but `[modulation.scheme]`.
    /// `names` are the names that would have done, too, for a refusal.
    ///
    /// # Errors
    /// A file that cannot be read, or a scheme that a specification could not have.
    pub fn of_file(path: &str, names: &str) -> Result<Self> {
        file::parse_scheme(path, &file::read_row(path, names)?)
    }

    /// Phase steps in a set.
    pub fn steps(&self) -> usize {
        self.in_phase.len()
    }

    /// The angle of phase step `step` in radians.
    pub fn angle_rad(&self, step: usize) -> f64 {
        self.angles[step].rad()
    }

    /// The angle between each phase step and the next, where all are the same and the first is at 0.
    pub fn equal_step(&self) -> Option<StepAngle> {
        equal_step(&self.angles)
    }

    /// The phase steps in words, such as "5 phase steps of 1/3 turn".
    pub fn steps_in_words(&self) -> String {
        let steps = self.steps();
        match self.equal_step() {
            Some(step) => format!("{steps} phase steps of {step} turn"),
            None => {
                let angles: Vec<String> = self.angles.iter().map(ToString::to_string).collect();
                format!("{steps} phase steps at {} turn", angles.join(", "))
            }
        }
    }

    /// What the offset sum must be divided by.
    pub fn offset_gain(&self) -> i64 {
        self.offset.iter().sum()
    }

    /// Coefficients c_n = in_phase_n + i · factor · quadrature_n, in the paper's sign of φ, so that φ = arg Σ c_n I_n. With
    /// equal steps they are those of the characteristic polynomial P(x) = Σ c_n xⁿ (Surrel 1996).
    pub fn characteristic_polynomial(&self) -> Vec<Complex64> {
        let factor = (self.irrational.squared() as f64).sqrt();
        self.in_phase
            .iter()
            .zip(&*self.quadrature)
            .map(|(&i, &q)| Complex64::new(i as f64, factor * q as f64))
            .collect()
    }

    /// What the coefficients would be without rounding, at the same gain: those of [`Scheme::characteristic_polynomial`],
    /// but for a DFT.
    pub fn true_coefficients(&self) -> Vec<Complex64> {
        match self.origin {
            SchemeOrigin::Named | SchemeOrigin::Row => self.characteristic_polynomial(),
            SchemeOrigin::Dft { .. } => {
                let length = 2.0 * self.gain / self.steps() as f64;
                self.angles.iter().map(|angle| Complex64::from_polar(length, angle.rad())).collect()
            }
        }
    }

    /// Largest share of the vector at amplitude 1 that harmonic `harmonic` of the same amplitude adds to it.
    pub fn harmonic_leakage(&self, harmonic: i32) -> f64 {
        let part = |m: i32| -> f64 {
            let terms = self.characteristic_polynomial().into_iter().zip(&*self.angles);
            let sum: Complex64 =
                terms.map(|(c, angle)| c * Complex64::from_polar(1.0, f64::from(m) * angle.rad())).sum();
            sum.norm()
        };
        (part(harmonic) + part(-harmonic)) / (2.0 * self.gain)
    }

    /// Noise factor: the phase's standard deviation in radians times amplitude over the frames' noise,
    /// σ_φ A / σ = √(Σ|c_n|²/2) / gain for white noise.
    pub fn noise_factor(&self) -> f64 {
        let power: f64 = self.characteristic_polynomial().iter().map(|c| c.norm_sqr()).sum();
        (power / 2.0).sqrt() / self.gain
    }
}

/// See [`Scheme::equal_step`].
pub(super) fn equal_step(angles: &[StepAngle]) -> Option<StepAngle> {
    let step = *angles.get(1)?;
    let expected = (0..).map(|n| step.times(n));
    angles.iter().zip(expected).all(|(&angle, expected)| angle == expected).then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

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
                    .map(|n| 100.0 * (scheme.angle_rad(n) - phase).cos() + 300.0)
                    .collect();
                let sum = |weights: &[i64]| -> f64 {
                    weights.iter().zip(&frames).map(|(&w, frame)| w as f64 * frame).sum()
                };
                let gain = scheme.gain;
                assert!((sum(&scheme.in_phase) - gain * 100.0 * phase.cos()).abs() < 1e-9, "{}", scheme.name);
                assert!(
                    (factor * sum(&scheme.quadrature) - gain * 100.0 * phase.sin()).abs() < 1e-9,
                    "{}",
                    scheme.name
                );
                assert!((sum(&scheme.offset) - scheme.offset_gain() as f64 * 300.0).abs() < 1e-9);
            }
        }
    }

    /// c_N of the catalogue: 0.707 for four frames (σ_φ = σ/(A√2)), 0.685 for the WDFT.
    #[test]
    fn noise_factors_are_the_catalogues() {
        assert!((scheme("four_frame").unwrap().noise_factor() - 0.707).abs() < 5e-4);
        assert!((scheme("wdft").unwrap().noise_factor() - 0.685).abs() < 5e-4);
    }
}
