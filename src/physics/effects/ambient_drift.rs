//! Ambient light that drifts.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

/// Relative change of the ambient light, a second.
pub static EFFECT: Effect = Effect {
    name: "ambient_drift",
    sentence: "The ambient light drifts during the recording.",
    reference: "B_n = B0 + b n",
    parameters: &[Parameter::strength("relative_a_second", "1/s", 0.0, (-0.5, 0.5), 0.005)],
    place: Place::Light,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let factor = 1.0 + values[0] * exposure.moment.time_s;
    exposure.ambient_dn.iter_mut().for_each(|ambient| *ambient *= factor);
}
