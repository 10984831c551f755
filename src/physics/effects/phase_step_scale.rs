//! All phase steps too large or too small by the same factor.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Relative error of the phase step; and whether the set's phase offset, which the same phase shifter makes, has it too (1) or not (0).
pub static EFFECT: Effect = Effect {
    name: "phase_step_scale",
    sentence: "The phase steps are all too large or too small by one factor (linear miscalibration of the phase step).",
    reference: "Surrel 1996; theta_n -> (1 + eps) theta_n",
    parameters: &[
        Parameter::strength("relative", "1", 0.0, (-0.3, 0.3), 0.01),
        Parameter::choice("scales_the_offset", "1", &[0.0, 1.0]),
    ],
    place: Place::Clock,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let moment = &exposure.moment;
    exposure.angle_rad += values[0] * (moment.step_rad + values[1] * moment.offset_rad);
}
