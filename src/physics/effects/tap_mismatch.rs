//! Two taps that take turns, and are not alike.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

/// Relative gain of the tap of the odd frames against that of the even ones, less 1, and its pedestal.
pub static EFFECT: Effect = Effect {
    name: "tap_mismatch",
    sentence: "Even and odd frames are read from different taps, whose gains or pedestals differ.",
    reference: "I_A = g_A (...), I_B = g_B (...)",
    parameters: &[
        Parameter::strength("gain", "1", 0.0, (-0.3, 0.3), 0.01),
        Parameter::strength("pedestal_dn", "DN", 0.0, (-200.0, 200.0), 2.0),
    ],
    place: Place::Readout,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let side = if exposure.moment.frame % 2 == 1 { 0.5 } else { -0.5 };
    exposure
        .signal_dn
        .iter_mut()
        .for_each(|signal| *signal = *signal * (1.0 + side * values[0]) + side * values[1]);
}
