//! The camera's own light weakens within a set.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

/// Relative change of the camera's own light from the set's first frame to its last.
pub static EFFECT: Effect = Effect {
    name: "illumination_droop",
    sentence: "The camera's own light weakens from the first to the last frame of every set (supply droop, heating).",
    reference: "Godbaz et al. 2012; A_n = A (1 - k n/(N - 1)), B likewise",
    parameters: &[Parameter::strength("relative", "1", 0.0, (-0.5, 0.5), 0.01)],
    place: Place::Light,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let last = exposure.moment.frames.saturating_sub(1).max(1) as f64;
    exposure.scale_light(1.0 - values[0] * exposure.moment.frame as f64 / last);
}
