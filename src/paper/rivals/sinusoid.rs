//! Calibration by a sinusoid of four cycles.

use super::calibration::Calibration;
use std::f64::consts::TAU;

/// A constant, and cosine and sine of four times the phase: what the third harmonic does to four frames.
pub const SINUSOID: Calibration = Calibration {
    name: "sinusoid of 4 cycles",
    basis: |turns| vec![1.0, (4.0 * TAU * turns).cos(), (4.0 * TAU * turns).sin()],
};
