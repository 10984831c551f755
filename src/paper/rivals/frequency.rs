//! The waveform at another modulation frequency.

use crate::physics::FREQUENCY_HZ;
use crate::physics::{Correlation, Harmonic};
use num_complex::Complex64;

/// Where light and sensor together have lost 3 dB, Hz: assumed, as the paper gives one frequency's harmonics only.
pub const BANDWIDTH_HZ: f64 = 60e6;

/// Table I at 30 MHz, and at `frequency_hz` (> 0) what a low-pass of first order makes of the same pulses.
pub fn waveform_at(frequency_hz: f64) -> Correlation {
    let low_pass = |hz: f64| Complex64::new(1.0, hz / BANDWIDTH_HZ).inv();
    // Harmonic m relative to the fundamental: its amplitude, and its phase about that of m times the fundamental's.
    let relative = |number: u32, hz: f64| {
        let m = f64::from(number);
        let fundamental = low_pass(hz);
        low_pass(m * hz) / Complex64::from_polar(fundamental.norm(), m * fundamental.arg())
    };
    let table = Correlation::measured();
    let others = table.harmonics().iter().filter(|harmonic| harmonic.number > 1);
    let turned = others.map(|harmonic| {
        let change = relative(harmonic.number, frequency_hz) / relative(harmonic.number, FREQUENCY_HZ);
        Harmonic {
            number: harmonic.number,
            amplitude: harmonic.amplitude * change.norm(),
            phase_rad: harmonic.phase_rad + change.arg(),
        }
    });
    Correlation::with_harmonics(&turned.collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_table_1_where_that_was_measured_and_rounder_above() {
        let third = |hz| waveform_at(hz).harmonics()[2];
        assert!((third(FREQUENCY_HZ).amplitude - 1.0 / 31.0).abs() < 1e-15);
        assert!(third(FREQUENCY_HZ).phase_rad.abs() < 1e-12);
        assert!(third(40e6).amplitude < third(FREQUENCY_HZ).amplitude && third(20e6).amplitude > 1.0 / 31.0);
    }
}
