//! The phase drifts with temperature.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place, settled};

/// Drift of the phase by the time a warm-up takes, by how much it had drifted when the recording began, and the time of a warm-up. Or of one that
/// accelerates: how far it comes in the first minute, and the time in which it becomes twice as fast.
pub static EFFECT: Effect = Effect {
    name: "phase_drift",
    sentence: "The phase of light against sensor drifts while the camera warms up, for all pixels alike.",
    reference: "Corti et al. 2015; phi_0(t) = k (1 - exp(-t/tau)); or k s(t) / s(1 min), s = t + t^2 / (2 tau)",
    parameters: &[
        Parameter::strength("drift_rad", "rad", 0.0, (-1.0, 1.0), 0.01),
        Parameter::strength("drift_before_rad", "rad", 0.0, (-1.0, 1.0), 0.01).of_recording(),
        Parameter::shape("time_constant_s", "s", 30.0, (2.0, 2000.0), &[10.0, 60.0, 600.0]),
        Parameter::choice("course", "1", &[0.0, 1.0]),
    ],
    place: Place::Clock,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    // A later phase of the light is an earlier angle.
    exposure.angle_rad -= values[1] + values[0] * settled(exposure.moment.time_s, values[2], values[3]);
}
