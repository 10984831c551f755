//! Two taps that take turns, and are not alike.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Moment, Parameter, Place};
use std::f64::consts::{PI, TAU};

/// Steps are what they are taken for within this, rad, in recordings.
const ROUNDED_RAD: f64 = 1e-4;

/// Relative gain of one tap against that of the other, less 1, and its pedestal. The taps take turns, and the odd frames are this one's (0); or it has the
/// frames of the second half of a turn, which the sensor makes by exchanging its taps: by the step within the set (1), or by the whole setting, the set's phase
/// offset included (0.5).
pub static EFFECT: Effect = Effect {
    name: "tap_mismatch",
    sentence: "Frames are read from two taps, even and odd ones or by halves of a turn, whose gains or pedestals differ.",
    reference: "I_A = g_A (...), I_B = g_B (...)",
    parameters: &[
        Parameter::strength("gain", "1", 0.0, (-0.3, 0.3), 0.01),
        Parameter::strength("pedestal_dn", "DN", 0.0, (-200.0, 200.0), 2.0),
        Parameter::choice("by_half_turn", "1", &[0.0, 1.0, 0.5]),
    ],
    place: Place::Readout,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let Moment { frame, step_rad, offset_rad, .. } = exposure.moment;
    let is_second = match values[2] {
        by if by > 0.75 => is_of_second_half(step_rad),
        by if by > 0.25 => is_of_second_half(step_rad + offset_rad),
        _ => frame % 2 == 1,
    };
    let side = if is_second { 0.5 } else { -0.5 };
    exposure
        .signal_dn
        .iter_mut()
        .for_each(|signal| *signal = *signal * (1.0 + side * values[0]) + side * values[1]);
}

/// Whether a phase step is of the second half of a turn, as half a turn is and a whole one is not, however they are rounded.
fn is_of_second_half(step_rad: f64) -> bool {
    (step_rad + ROUNDED_RAD).rem_euclid(TAU) >= PI
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_of_a_half_however_it_is_rounded() {
        let off = 9e-5;
        for first in [0.0, -off, off, 0.5 * PI, PI - 0.01, TAU, TAU - off, 2.0 * PI / 3.0, 8.0 * PI / 3.0] {
            assert!(!is_of_second_half(first), "{first}");
        }
        for second in [PI, PI - off, PI + off, 1.5 * PI, -0.5 * PI, 4.0 * PI / 3.0, 5.0 * PI, TAU - 0.01] {
            assert!(is_of_second_half(second), "{second}");
        }
    }
}
