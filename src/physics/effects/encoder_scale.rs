//! The encoder's scale is off.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

/// Relative error of the position.
pub static EFFECT: Effect = Effect {
    name: "encoder_scale",
    sentence: "The encoder's scale is off: the target's true position is the reading times a factor.",
    reference: "d = (1 + eps) reading",
    parameters: &[Parameter::strength("relative", "1", 0.0, (-0.05, 0.05), 1e-3)],
    place: Place::Encoder,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    exposure.position_m *= 1.0 + values[0];
}
