//! The pixel's response is not linear in the light.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

/// Quadratic and cubic part, relative to the linear one at full scale.
pub static EFFECT: Effect = Effect {
    name: "intensity_nonlinearity",
    sentence: "The pixel's response is not linear in the light, so harmonics appear that grow with the amplitude.",
    reference: "I -> I + alpha I^2 + beta I^3",
    parameters: &[
        Parameter::strength("quadratic", "1", 0.0, (-0.6, 0.6), 0.02),
        Parameter::strength("cubic", "1", 0.0, (-0.6, 0.6), 0.02),
    ],
    place: Place::Readout,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let full_scale_dn = exposure.pixels.full_scale_dn;
    for signal in &mut exposure.signal_dn {
        let share = *signal / full_scale_dn;
        *signal += *signal * share * (values[0] + values[1] * share);
    }
}
