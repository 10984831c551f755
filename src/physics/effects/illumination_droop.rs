//! The camera's own light weakens within a set.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Relative change of the camera's own light from the set's first frame to its last, and the time in which it relaxes: 1000 s is as good as
/// evenly.
pub static EFFECT: Effect = Effect {
    name: "illumination_droop",
    sentence: "The camera's own light weakens from the first to the last frame of every set (supply droop, heating).",
    reference: "Godbaz et al. 2012; A(t) = A (1 - k (1 - exp(-t/tau)) / (1 - exp(-T/tau))), t from the set's first frame, T its last",
    parameters: &[
        Parameter::strength("relative", "1", 0.0, (-0.5, 0.5), 0.01),
        Parameter::shape("time_constant_s", "s", 1000.0, (0.01, 1000.0), &[0.1, 1.0]),
    ],
    place: Place::Light,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let moment = &exposure.moment;
    let last_s = moment.frames.saturating_sub(1).max(1) as f64 * moment.frame_period_s;
    let weaker = |time_s: f64| libm::expm1(-time_s / values[1]);
    let last = weaker(last_s);
    // Before the set the light has rested.
    let share = if last < 0.0 { weaker(moment.in_set_s.max(0.0)) / last } else { 0.0 };
    exposure.scale_light(1.0 - values[0] * share);
}
