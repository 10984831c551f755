//! Sensitivity curves as CSV.

use super::super::table::csv_text;
use crate::algorithms::{Algorithm, Curve};
use crate::problem::Result;
use crate::units::{phase_rad, range_m, unambiguous_range_m};
use std::fmt;

/// What makes a phase of a velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bench {
    /// Modulation frequency, Hz.
    pub frequency_hz: f64,
    /// Time from one frame to the next, s.
    pub frame_s: f64,
}

impl Bench {
    /// Phase from one frame to the next at `velocity_m_s`, rad.
    pub fn motion_rad(&self, velocity_m_s: f64) -> f64 {
        phase_rad(velocity_m_s * self.frame_s, self.frequency_hz)
    }

    /// `phase_rad` as a range, mm.
    pub fn mm(&self, phase_rad: f64) -> f64 {
        1e3 * range_m(phase_rad, self.frequency_hz)
    }

    /// The curve of `algorithm` on this bench.
    pub fn curve(&self, curve: Curve, algorithm: &Algorithm) -> Vec<(f64, crate::algorithms::PhaseError)> {
        curve.of(algorithm, unambiguous_range_m(self.frequency_hz).recip(), self.frame_s)
    }
}

impl fmt::Display for Bench {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} MHz, {} ms a frame", self.frequency_hz / 1e6, self.frame_s * 1e3)
    }
}

/// All curves of `algorithms` as CSV text, a line a point.
pub fn curves_csv(algorithms: &[Algorithm], bench: &Bench) -> Result<String> {
    let header = ["algorithm", "curve", "unit", "value", "mean_mrad", "rms_mrad", "peak_mrad"];
    let mut rows = vec![header.map(str::to_owned)];
    for algorithm in algorithms {
        for curve in Curve::ALL {
            let (name, unit) = curve.axis();
            for (value, error) in bench.curve(curve, algorithm) {
                let errors = [error.mean_rad, error.rms_rad, error.peak_rad];
                // Adding 0 takes the sign off a zero.
                let [mean, rms, peak] = errors.map(|rad| format!("{:.6}", (1e9 * rad).round() / 1e6 + 0.0));
                let [name, unit] = [name, unit].map(str::to_owned);
                rows.push([algorithm.name.clone(), name, unit, value.to_string(), mean, rms, peak]);
            }
        }
    }
    csv_text(rows)
}
