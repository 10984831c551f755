//! What the sums of given weights are for a sinusoid, in arbitrary-precision arithmetic.

use super::exact::{Real, cosine_and_sine, integer};
use super::scheme::Irrational;
use super::step_angle::StepAngle;

/// Parts of a sum of weights that count as zero: far above what 192 bits leave of an exact zero, and far below anything
/// that a phase word could show.
pub(super) const ZERO: f64 = 1e-40;

/// Of I_n = A cos(angle_n − φ), the vector is x + i y = A (gain exp(i(φ + turn)) + image exp(−iφ)); without error, turn
/// and image are 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Response {
    /// Length of the vector at amplitude 1, without the image, > 0.
    pub gain: f64,
    /// The constant part of the phase's error, rad, −π to π.
    pub turn_rad: f64,
    /// Length of the image over `gain`: the phase's error swings by its arc sine, the amplitude by the ratio itself.
    pub image: f64,
}

impl Response {
    /// Of the weights `in_phase` and `quadrature` (whose sum is still to be multiplied by `irrational`) at `angles`;
    /// `None` where they are blind to the sinusoid.
    pub fn new(
        angles: &[StepAngle],
        in_phase: &[i64],
        quadrature: &[i64],
        irrational: Irrational,
    ) -> Option<Self> {
        let factor = integer(irrational.squared()).sqrt();
        let zero = || integer(0);
        // Sums of weight × cosine and weight × sine; the quadrature's with its factor.
        let (mut i_cos, mut i_sin, mut q_cos, mut q_sin) = (zero(), zero(), zero(), zero());
        for ((&angle, &i), &q) in angles.iter().zip(in_phase).zip(quadrature) {
            let (cosine, sine) = cosine_and_sine(angle);
            i_cos += integer(i) * &cosine;
            i_sin += integer(i) * &sine;
            q_cos += integer(q) * &cosine;
            q_sin += integer(q) * &sine;
        }
        let (q_cos, q_sin) = (q_cos * &factor, q_sin * &factor);
        // c_n = in_phase_n + i factor quadrature_n; gain = |Σ c_n exp(−i angle_n)| / 2, image = |Σ c_n exp(i angle_n)| / 2.
        let (real, imaginary) = (&i_cos + &q_sin, &q_cos - &i_sin);
        let gain = length(&real, &imaginary);
        let image = length(&(&i_cos - &q_sin), &(&q_cos + &i_sin));
        let weights: i64 = in_phase.iter().chain(quadrature).map(|weight| weight.abs()).sum();
        let scale = weights as f64;
        let value = |real: &Real| real.to_f64().value();
        if value(&gain) <= ZERO * scale {
            return None;
        }
        let ratio = |part: &Real| Some(value(&(part / &gain))).filter(|ratio| ratio.abs() > ZERO * scale);
        Some(Self {
            gain: value(&(&gain / integer(2))),
            turn_rad: f64::atan2(ratio(&imaginary).unwrap_or(0.0), ratio(&real).unwrap_or(0.0)),
            image: ratio(&image).unwrap_or(0.0),
        })
    }

    /// Largest error of a sinusoid's phase, rad.
    pub fn phase_rad(&self) -> f64 {
        self.turn_rad.abs() + self.image.min(1.0).asin()
    }
}

fn length(x: &Real, y: &Real) -> Real {
    (x * x + y * y).sqrt()
}

/// Whether the sum of `weights` at `angles` is blind to the fundamental.
pub(super) fn is_blind(angles: &[StepAngle], weights: &[i64]) -> bool {
    Response::new(angles, weights, &vec![0; weights.len()], Irrational::One).is_none()
}
