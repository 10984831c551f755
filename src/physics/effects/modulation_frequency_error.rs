//! The modulation frequency is not the one commanded.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Relative error of the frequency.
pub static EFFECT: Effect = Effect {
    name: "modulation_frequency_error",
    sentence: "The modulation frequency is not the one commanded, so all distances are scaled.",
    reference: "f -> f (1 + eps)",
    parameters: &[Parameter::strength("relative", "1", 0.0, (-0.06, 0.06), 1e-3)],
    place: Place::Clock,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    exposure.frequency_hz *= 1.0 + values[0];
}
