//! The roots of a characteristic polynomial that are no powers of the step, in floating point.

use super::polynomial::{Basis, Polynomial};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Rounds of the iteration, far more than roots of such low degrees take.
const ROUNDS: usize = 500;

/// The roots of `polynomial` (Surrel's sign, frames with equal steps of `parts` parts of a turn) beside those exp(i m δ) that
/// [`Polynomial::multiplicity`] finds; `step_rad` is δ. By dividing those out and Durand and Kerner's iteration.
pub fn other_roots(polynomial: &Polynomial, step_rad: f64, parts: i64) -> Vec<Complex64> {
    let mut own: Vec<Complex64> = polynomial.coefficients().iter().map(Complex64::conj).collect();
    let largest = own.iter().map(|c| c.norm()).fold(0.0, f64::max);
    // What floating point leaves of a coefficient that is 0 would be a root far away.
    while own.last().is_some_and(|c| c.norm() < 1e-12 * largest) {
        own.pop();
    }
    for m in 0..parts {
        let root = Complex64::from_polar(1.0, (m as f64 * step_rad) % TAU);
        for _ in 0..polynomial.multiplicity(m, Basis::Angle) {
            let mut carry = Complex64::ZERO;
            for c in own.iter_mut().rev() {
                carry = *c + carry * root;
                *c = carry;
            }
            // The remainder, which is 0.
            if !own.is_empty() {
                own.remove(0);
            }
        }
    }
    let Some((&highest, lower)) = own.split_last() else { return Vec::new() };
    let value = |x: Complex64| lower.iter().rev().fold(Complex64::ONE, |sum, c| sum * x + c / highest);
    let seed = Complex64::new(0.4, 0.9);
    let mut roots: Vec<Complex64> = (0..lower.len()).map(|n| seed.powu(n as u32)).collect();
    for _ in 0..ROUNDS {
        for n in 0..roots.len() {
            let others = roots.iter().enumerate().filter(|&(other, _)| other != n);
            let apart: Complex64 = others.map(|(_, &other)| roots[n] - other).product();
            let step = value(roots[n]) / apart;
            if step.is_finite() {
                roots[n] -= step;
            }
        }
    }
    roots
}
