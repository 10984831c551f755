//! Calibration by a polynomial of sixth order.

use super::calibration::Calibration;

/// Chebyshev's polynomials up to the sixth over a turn: the same functions as powers, better conditioned.
pub const POLYNOMIAL: Calibration = Calibration {
    name: "6th-order polynomial",
    basis: |turns| {
        (0..=6).map(|order| (f64::from(order) * (2.0 * turns - 1.0).clamp(-1.0, 1.0).acos()).cos()).collect()
    },
};
