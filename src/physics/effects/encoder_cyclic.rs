//! The encoder errs periodically.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place, cos_sin};
use std::f64::consts::TAU;

/// Parts of the error, and its period. The carriage moves as it is commanded (0), or, controlled by this very encoder, as its readings say, faster and slower
/// in time with its error (1).
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
    let turn_per_m = TAU / values[2];
    let at = |reading_m: f64| {
        let (cosine, sine) = cos_sin(turn_per_m * reading_m);
        (values[0] * cosine + values[1] * sine, turn_per_m * (values[1] * cosine - values[0] * sine))
    };
    let reading_m = exposure.moment.place_m;
    let (error_m, slope) = at(reading_m);
    exposure.position_m += error_m;
    if values[3] > 0.5 {
        // Of the way since the set's start the mean velocity is what counts: errors may come and go within a set.
        let way_m = exposure.way_m();
        let faster = if way_m == 0.0 { slope } else { (at(reading_m + way_m).0 - error_m) / way_m };
        exposure.velocity_m_s *= 1.0 + faster;
    }
}
