//! The camera's own light drifts over minutes.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place, settled};

/// Relative loss of the camera's own light by the time a warm-up takes, what it had lost when the recording began, and the time of a warm-up. Of light that falls
/// evenly both the first and the last are large; there is none below no light. Or light that fades ever faster:
/// its loss in the first minute, and the time in which that becomes twice as fast.
pub static EFFECT: Effect = Effect {
    name: "illumination_drift",
    sentence: "The power of the camera's own light drifts over minutes as it warms up.",
    reference: "A(t) = A (1 - k (1 - exp(-t/tau))), or A (1 - k s(t) / s(1 min)), s = t + t^2 / (2 tau)",
    parameters: &[
        Parameter::strength("relative", "1", 0.0, (-20.0, 20.0), 0.03),
        Parameter::strength("relative_before", "1", 0.0, (-0.8, 0.8), 0.03).of_recording(),
        Parameter::shape("time_constant_s", "s", 30.0, (2.0, 2000.0), &[10.0, 60.0, 600.0]),
        Parameter::choice("course", "1", &[0.0, 1.0]),
    ],
    place: Place::Light,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let warm = settled(exposure.moment.time_s, values[2], values[3]);
    exposure.scale_light((1.0 - values[1] - values[0] * warm).max(0.0));
}
