//! The characteristic polynomial of a phase algorithm, and its roots on the unit circle, in exact arithmetic.

use super::cyclotomic::Cyclotomic;
use crate::spec::{Irrational, Scheme, StepAngle};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// What a root is counted in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// The frames' angles: an error that grows with the angle, as a wrong step does.
    Angle,
    /// The frames' numbers, in the order of the row: an error that grows with time, as motion and drift do. With equal steps
    /// this is the same.
    Time,
}

/// Σ c_n I_n with c_n in Z\[ζ\], ζ = exp(2πi / order), and every frame's angle a power of ζ; the phase is its argument.
///
/// With equal steps and Surrel's sign, which is the conjugate of the paper's, P(x) = Σ conj(c_n) xⁿ is what Surrel (1996)
/// calls the characteristic polynomial.
#[derive(Debug, Clone, PartialEq)]
pub struct Polynomial {
    order: i64,
    /// Angles in parts of a turn / order.
    angles: Vec<i64>,
    /// Angles as small whole numbers from 0 on: in units of their common divisor.
    places: Vec<i64>,
    /// Of each frame: exponents of ζ and their factors.
    coefficients: Vec<Vec<(i64, i64)>>,
    /// The same in floating point.
    values: Vec<Complex64>,
    angles_rad: Vec<f64>,
}

/// Largest order of the roots of unity: what unequal steps with many different denominators could need.
const MOST_ORDER: i64 = 1 << 20;

impl Polynomial {
    /// Of the frames at `angles`, each with the sum of its `coefficients`: factors of angles' exponentials. `None` where
    /// there is no frame, or the angles have no common part of a turn above 2⁻²⁰.
    pub fn new(angles: &[StepAngle], coefficients: &[Vec<(StepAngle, i64)>]) -> Option<Self> {
        let all = angles.iter().chain(coefficients.iter().flatten().map(|(angle, _)| angle));
        let order = all.map(|angle| angle.denominator()).try_fold(1_i64, |multiple, denominator| {
            let multiple = multiple / divisor(multiple, denominator) * denominator;
            (multiple <= MOST_ORDER).then_some(multiple)
        })?;
        let part = |angle: &StepAngle| angle.numerator() * (order / angle.denominator());
        let angles: Vec<i64> = angles.iter().map(part).collect();
        let least = *angles.iter().min()?;
        let unit = angles.iter().fold(0, |unit, angle| divisor(unit, angle - least)).max(1);
        let coefficients: Vec<Vec<(i64, i64)>> = coefficients
            .iter()
            .map(|terms| terms.iter().map(|(angle, factor)| (part(angle), *factor)).collect())
            .collect();
        let rad = |angle: i64| TAU * angle as f64 / order as f64;
        let root = |exponent: i64| Complex64::from_polar(1.0, rad(exponent.rem_euclid(order)));
        let value = |terms: &Vec<(i64, i64)>| terms.iter().map(|&(e, factor)| root(e) * factor as f64).sum();
        Some(Self {
            order,
            places: angles.iter().map(|angle| (angle - least) / unit).collect(),
            angles_rad: angles.iter().map(|&angle| rad(angle)).collect(),
            values: coefficients.iter().map(value).collect(),
            angles,
            coefficients,
        })
    }

    /// Of the weights of `scheme`, as they are: rounded where they are.
    pub fn of_scheme(scheme: &Scheme) -> Option<Self> {
        let angle = |numerator, denominator| StepAngle::new(numerator, denominator);
        // i, and i √3 = ω − ω² with ω the third root of 1.
        let unit = match scheme.irrational {
            Irrational::One => vec![(angle(1, 4)?, 1)],
            Irrational::Sqrt3 => vec![(angle(1, 3)?, 1), (angle(2, 3)?, -1)],
        };
        let one = angle(0, 1)?;
        let coefficient = |(&in_phase, &quadrature): (&i64, &i64)| {
            let imaginary = unit.iter().map(|&(angle, factor)| (angle, factor * quadrature));
            [(one, in_phase)].into_iter().chain(imaginary).collect()
        };
        let coefficients: Vec<_> = scheme.in_phase.iter().zip(&*scheme.quadrature).map(coefficient).collect();
        Self::new(&scheme.angles, &coefficients)
    }

    /// Of a plain or windowed DFT: `window`'s weights times the exponentials of the angles themselves.
    pub fn of_window(angles: &[StepAngle], window: &[i64]) -> Option<Self> {
        let coefficients: Vec<_> =
            angles.iter().zip(window).map(|(&angle, &weight)| vec![(angle, weight)]).collect();
        Self::new(angles, &coefficients)
    }

    /// Frames.
    pub fn frames(&self) -> usize {
        self.angles.len()
    }

    /// How many times exp(i `harmonic` δ) is a root, in Surrel's sign: 1 is the fundamental itself, −1 its image, 0 constant
    /// light. That is, for how many k = 0, 1, … all Σ c_n binomial(place_n, k) exp(−i harmonic angle_n) are 0, with the
    /// places that `basis` says. Exact; a count at which a binomial leaves 90 bits ends it (angles of a thousandth of a turn).
    pub fn multiplicity(&self, harmonic: i64, basis: Basis) -> usize {
        let frames = self.frames();
        let mut factors = vec![1_i128; frames];
        for multiplicity in 0..frames {
            let mut sum = Cyclotomic::zero(self.order);
            for ((&angle, terms), &binomial) in self.angles.iter().zip(&self.coefficients).zip(&factors) {
                let turned = (-harmonic).rem_euclid(self.order) * angle.rem_euclid(self.order);
                for &(exponent, factor) in terms {
                    sum.add(turned + exponent, binomial * i128::from(factor));
                }
            }
            if !sum.is_zero() {
                return multiplicity;
            }
            for (n, binomial) in factors.iter_mut().enumerate() {
                let place = match basis {
                    Basis::Angle => self.places[n],
                    Basis::Time => n as i64,
                };
                let k = multiplicity as i64;
                *binomial = *binomial * i128::from((place - k).max(0)) / i128::from(k + 1);
                if *binomial >= 1 << 90 {
                    return multiplicity + 1;
                }
            }
        }
        frames
    }

    /// Coefficients c_n in the paper's sign of φ: φ = arg Σ c_n I_n.
    pub fn coefficients(&self) -> &[Complex64] {
        &self.values
    }

    /// The frames' angles, rad.
    pub fn angles_rad(&self) -> &[f64] {
        &self.angles_rad
    }

    /// Σ c_n factor_n exp(−i `harmonic` angle_n): what a harmonic's term exp(i harmonic φ) is multiplied by, twice over.
    pub fn response(&self, harmonic: i64, factor: impl Fn(usize) -> f64) -> Complex64 {
        let terms = self.values.iter().zip(&self.angles_rad).enumerate();
        terms.map(|(n, (c, angle))| c * Complex64::from_polar(factor(n), -(harmonic as f64) * angle)).sum()
    }

    /// Noise factor: the phase's standard deviation in radians times amplitude over the frames' noise, σ_φ A / σ =
    /// √(2 Σ|c_n|²) / |Σ c_n exp(−i angle_n)| for white noise.
    pub fn noise_factor(&self) -> f64 {
        let power: f64 = self.values.iter().map(Complex64::norm_sqr).sum();
        (2.0 * power).sqrt() / self.response(1, |_| 1.0).norm()
    }
}

/// The greatest common divisor, at least 0.
pub(super) fn divisor(a: i64, b: i64) -> i64 {
    let (mut a, mut b) = (a.abs(), b.abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}
