//! The encoder errs periodically.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place, cos_sin};
use std::f64::consts::TAU;

/// Parts of the error, and its period. The carriage moves as it is commanded (0), or, controlled by this very encoder, faster and slower in time with
/// its error (1).
pub static EFFECT: Effect = Effect {
    name: "encoder_cyclic",
    sentence: "The encoder's error is periodic in position (lead screw, interpolation).",
    reference: "d = reading + a cos(2 pi reading / p) + b sin(2 pi reading / p)",
    parameters: &[
        Parameter::strength("cosine_m", "m", 0.0, (-0.05, 0.05), 1e-3),
        Parameter::strength("sine_m", "m", 0.0, (-0.05, 0.05), 1e-3),
        Parameter::shape("period_m", "m", 0.1, (0.004, 1.5), &[0.02, 0.05, 0.1, 0.25, 0.5, 1.0]),
        Parameter::choice("controls_carriage", "1", &[0.0, 1.0]),
    ],
    place: Place::Encoder,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let (cosine, sine) = cos_sin(TAU * exposure.moment.place_m / values[2]);
    exposure.position_m += values[0] * cosine + values[1] * sine;
    if values[3] > 0.5 {
        exposure.velocity_m_s *= 1.0 + TAU / values[2] * (values[1] * cosine - values[0] * sine);
    }
}
