//! Two taps that take turns, and are not alike.

use crate::physics::{Act, Chance, Effect, Exposure, Moment, Parameter, Place};
use std::f64::consts::TAU;

/// Turns by which a step may be off half a turn.
const ROUNDED: f64 = 1e-6;

/// Relative gain of one tap against that of the other, less 1, and its pedestal. The taps take turns, and the odd frames are this one's (0); or it has the
/// frames of the second half of a turn, whose steps the sensor makes by exchanging its taps (1).
pub static EFFECT: Effect = Effect {
    name: "tap_mismatch",
    sentence: "Frames are read from two taps, even and odd ones or by halves of a turn, whose gains or pedestals differ.",
    reference: "I_A = g_A (...), I_B = g_B (...)",
    parameters: &[
        Parameter::strength("gain", "1", 0.0, (-0.3, 0.3), 0.01),
        Parameter::strength("pedestal_dn", "DN", 0.0, (-200.0, 200.0), 2.0),
        Parameter::choice("by_half_turn", "1", &[0.0, 1.0]),
    ],
    place: Place::Readout,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let Moment { frame, step_rad, .. } = exposure.moment;
    let is_second = match values[2] > 0.5 {
        // Half a turn is a step of the second half, however it is rounded.
        true => (step_rad / TAU + ROUNDED).rem_euclid(1.0) >= 0.5,
        false => frame % 2 == 1,
    };
    let side = if is_second { 0.5 } else { -0.5 };
    exposure
        .signal_dn
        .iter_mut()
        .for_each(|signal| *signal = *signal * (1.0 + side * values[0]) + side * values[1]);
}
