//! Conversions between physical units, each written once.

use fixed::types::U0F64;
use std::f64::consts::TAU;

/// Speed of light in vacuum, exact by definition of the metre (BIPM, 2019).
pub const SPEED_OF_LIGHT_M_S: f64 = 299_792_458.0;

/// A phase as a fraction of a turn in [0, 1): its wrap is the phase's wrap.
pub type Turns = U0F64;

/// The unambiguous range c / (2 f) in metres of the modulation frequency `frequency_hz` (> 0).
#[inline(always)]
pub fn unambiguous_range_m(frequency_hz: f64) -> f64 {
    SPEED_OF_LIGHT_M_S / (2.0 * frequency_hz)
}

/// The phase 4π f d / c in radians (not wrapped) of an object at `range_m` (Drayton 2012, equation for d).
#[inline(always)]
pub fn phase_rad(range_m: f64, frequency_hz: f64) -> f64 {
    TAU * range_m / unambiguous_range_m(frequency_hz)
}

/// The range in metres, of either sign and not wrapped, whose phase is `phase_rad`: the inverse of [`phase_rad`].
pub fn range_m(phase_rad: f64, frequency_hz: f64) -> f64 {
    phase_rad / TAU * unambiguous_range_m(frequency_hz)
}

/// `difference_rad` brought into [−π, π).
pub fn wrap_rad(difference_rad: f64) -> f64 {
    (difference_rad + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0
}

/// A phase word of `bits` bits (1 to 63) as a fraction of a turn, exactly.
pub fn turns_of_code(code: i64, bits: u32) -> Turns {
    Turns::from_bits((code as u64) << (64 - bits))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A turn at 30 MHz is c / 60 MHz: 4.996 540 966 6 m by the speed of light's definition.
    #[test]
    fn a_turn_is_the_unambiguous_range_and_phases_go_there_and_back() {
        assert!((range_m(TAU, 30e6) - 4.996_540_966_6).abs() < 1e-9);
        for there_m in [-3.0, 0.0, 0.7, 12.5] {
            assert!((range_m(phase_rad(there_m, 41e6), 41e6) - there_m).abs() < 1e-12);
        }
    }
}
