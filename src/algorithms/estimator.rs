//! Algorithms that estimate the phase step too: not linear in the frames.

use super::polynomial::Polynomial;
use crate::spec::StepAngle;
use num_complex::Complex64;

/// Such an algorithm. Both put the phase's origin in the middle of the frames.
///
/// Both are φ = atan2(√(a b), D) with a, b and D linear in the frames. On frames of a step δ, a and b are multiples of sin φ
/// whose ratio depends on δ alone. So the gradient of √(a b), ½ (√(b/a) ∇a + √(a/b) ∇b), is the same at every phase: around
/// frames of the nominal step the algorithm is a linear one, and that one has a characteristic polynomial. It holds for small
/// disturbances; the larger ones are simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Estimator {
    /// Carré (1966), four frames: tan φ = √((u + v)(3 v − u)) / ((I2 + I3) − (I1 + I4)), u = I1 − I4, v = I2 − I3.
    Carre,
    /// Novák (2003), five frames: tan φ = √(4 (I2 − I4)² − (I1 − I5)²) / (2 I3 − I1 − I5).
    Novak,
}

impl Estimator {
    /// Frames.
    pub const fn frames(self) -> usize {
        match self {
            Self::Carre => 4,
            Self::Novak => 5,
        }
    }

    /// The vector whose argument is φ, in the paper's sign: I_n = A cos(angle_n − φ) + B. Where noise makes the radicand
    /// negative, the root is taken of 0.
    pub fn vector(self, frames: &[f64]) -> Complex64 {
        match (self, frames) {
            (Self::Carre, &[i1, i2, i3, i4]) => {
                let (u, v) = (i1 - i4, i2 - i3);
                Complex64::new(i2 + i3 - i1 - i4, -signed_root((u + v) * (3.0 * v - u), v))
            }
            (Self::Novak, &[i1, i2, i3, i4, i5]) => {
                let (a, b) = (i1 - i5, i2 - i4);
                Complex64::new(2.0 * i3 - i1 - i5, -signed_root(4.0 * b * b - a * a, b))
            }
            // A wrong number of frames has no phase.
            _ => Complex64::new(f64::NAN, f64::NAN),
        }
    }

    /// The linear algorithm that it is around frames of `step`, exactly: Carré's is c = sin δ (I2 + I3 − I1 − I4)
    /// − i ((2 + cos δ)(I2 − I3) − cos δ (I1 − I4)), Novák's sin δ (2 I3 − I1 − I5) − i (2 (I2 − I4) − cos δ (I1 − I5)).
    /// `None` where the step's numbers are too large, or where the ratio of a and b has no value: at half a turn.
    pub fn linearised(self, step: StepAngle) -> Option<Polynomial> {
        let angle = |numerator, denominator| StepAngle::new(numerator, denominator);
        let (p, q) = (step.numerator(), step.denominator());
        // Twice the weights: cosines and sines are sums of exp(±iδ), and i a quarter of a turn.
        let cosine = |factor: i64| Some(vec![(angle(p, q)?, factor), (angle(-p, q)?, factor)]);
        // 2 sin δ = −i (exp(iδ) − exp(−iδ)).
        let sine = |factor: i64| {
            let turned = |sign: i64| angle(4 * sign * p - q, 4 * q);
            Some(vec![(turned(1)?, factor), (turned(-1)?, -factor)])
        };
        // −i times terms.
        let back = |terms: Vec<(StepAngle, i64)>| -> Option<Vec<(StepAngle, i64)>> {
            let turned = |a: StepAngle| angle(4 * a.numerator() - a.denominator(), 4 * a.denominator());
            terms.into_iter().map(|(a, factor)| Some((turned(a)?, factor))).collect()
        };
        let constant = |factor: i64| Some(vec![(angle(0, 1)?, factor)]);
        let join = |one: Vec<(StepAngle, i64)>, other: Vec<(StepAngle, i64)>| [one, other].concat();
        let frames = self.frames();
        let coefficients = match self {
            Self::Carre => {
                let inner = join(constant(4)?, cosine(1)?);
                let minus = inner.iter().map(|&(a, factor)| (a, -factor)).collect();
                vec![
                    join(sine(-1)?, back(cosine(-1)?)?),
                    join(sine(1)?, back(inner)?),
                    join(sine(1)?, back(minus)?),
                    join(sine(-1)?, back(cosine(1)?)?),
                ]
            }
            Self::Novak => vec![
                join(sine(-1)?, back(cosine(-1)?)?),
                back(constant(4)?)?,
                sine(2)?,
                back(constant(-4)?)?,
                join(sine(-1)?, back(cosine(1)?)?),
            ],
        };
        (2 * p.rem_euclid(q) != q && p % q != 0)
            .then(|| centred_angles(step, frames).and_then(|angles| Polynomial::new(&angles, &coefficients)))
            .flatten()
    }
}

/// √`square` with the sign of `sign`.
fn signed_root(square: f64, sign: f64) -> f64 {
    square.max(0.0).sqrt().copysign(sign)
}

/// The angles of `frames` equal steps, their middle at 0.
pub fn centred_angles(step: StepAngle, frames: usize) -> Option<Vec<StepAngle>> {
    let last = frames as i64 - 1;
    (0..frames as i64)
        .map(|n| StepAngle::new(step.numerator() * (2 * n - last), 2 * step.denominator()))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    const STEPS: [(i64, i64); 5] = [(1, 4), (1, 3), (1, 5), (11, 36), (2, 9)];

    fn frames(angles_rad: &[f64], phase_rad: f64) -> Vec<f64> {
        angles_rad.iter().map(|angle| (angle - phase_rad).cos() + 2.0).collect()
    }

    #[test]
    fn both_measure_the_phase_at_any_step_below_half_a_turn() {
        for estimator in [Estimator::Carre, Estimator::Novak] {
            for step_rad in [0.6, 1.3, 2.0] {
                let middle = (estimator.frames() as f64 - 1.0) / 2.0;
                let angles: Vec<f64> =
                    (0..estimator.frames()).map(|n| (n as f64 - middle) * step_rad).collect();
                for k in 0..50 {
                    let phase_rad = TAU * (f64::from(k) + 0.5) / 50.0;
                    let found = estimator.vector(&frames(&angles, phase_rad));
                    let off = (found * Complex64::from_polar(1.0, -phase_rad)).arg();
                    assert!(off.abs() < 1e-9, "{estimator:?} {step_rad} {phase_rad}: {off}");
                }
            }
        }
    }

    /// The linear algorithm moves as the real one does when a single frame is disturbed, at every phase.
    #[test]
    fn the_linear_algorithm_is_the_gradient_at_every_phase() {
        for estimator in [Estimator::Carre, Estimator::Novak] {
            for (p, q) in STEPS {
                let step = StepAngle::new(p, q).unwrap();
                let linear = estimator.linearised(step).unwrap();
                let coefficients = linear.coefficients();
                let vector = |frames: &[f64]| -> Complex64 {
                    coefficients.iter().zip(frames).map(|(c, frame)| c * frame).sum()
                };
                for k in 0..20 {
                    let phase_rad = TAU * (f64::from(k) + 0.3) / 20.0;
                    let still = frames(linear.angles_rad(), phase_rad);
                    let back = Complex64::from_polar(1.0, -phase_rad);
                    assert!((vector(&still) * back).arg().abs() < 1e-12);
                    for n in 0..estimator.frames() {
                        let mut moved = still.clone();
                        moved[n] += 1e-6;
                        let slope = (estimator.vector(&moved) * back).arg() / 1e-6;
                        let linear = (vector(&moved) * back).arg() / 1e-6;
                        assert!((slope - linear).abs() < 1e-4, "{estimator:?} {step} {n}: {slope} {linear}");
                    }
                }
            }
        }
        assert_eq!(Estimator::Carre.linearised(StepAngle::new(1, 2).unwrap()), None);
    }
}
