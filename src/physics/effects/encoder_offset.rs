//! The encoder's zero is off.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// How much farther the target is than the reading says. The pixels' own phases absorb the phase of it; the light falls off with the true distance.
pub static EFFECT: Effect = Effect {
    name: "encoder_offset",
    sentence: "The encoder's zero is not where the camera is: the target's true position is the reading and a constant.",
    reference: "d = reading + d0",
    parameters: &[Parameter::strength("offset_m", "m", 0.0, (-0.3, 0.3), 5e-3)],
    place: Place::Encoder,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    exposure.position_m += values[0];
}
