//! The modulation's phase jitters from frame to frame.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Standard deviation of the phase of a frame, common to all pixels.
pub static EFFECT: Effect = Effect {
    name: "clock_jitter",
    sentence: "The modulation clock jitters slowly: every frame has a random phase error that all pixels share.",
    reference: "theta_n -> theta_n + eta_n",
    parameters: &[Parameter::strength("sigma_rad", "rad", 0.0, (0.0, 0.3), 0.005)],
    place: Place::Clock,
    chance: Chance::Frame,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    exposure.angle_rad += values[0] * exposure.deviate;
}
