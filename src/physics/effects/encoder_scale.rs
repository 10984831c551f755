//! The encoder's scale is off.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Relative error of the position. The carriage moves as fast as it is commanded (0), or, controlled by this very encoder, by this factor faster (1), which all
/// recordings take for an error of the modulation frequency.
pub static EFFECT: Effect = Effect {
    name: "encoder_scale",
    sentence: "The encoder's scale is off: the target's true position is the reading times a factor.",
    reference: "d = (1 + eps) reading",
    parameters: &[
        Parameter::strength("relative", "1", 0.0, (-0.06, 0.06), 1e-3),
        Parameter::choice("controls_carriage", "1", &[0.0, 1.0]),
    ],
    place: Place::Encoder,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let factor = 1.0 + values[0];
    exposure.position_m *= factor;
    if values[1] > 0.5 {
        exposure.velocity_m_s *= factor;
    }
}
