//! Frames that begin earlier or later than they should.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Standard deviation of a frame's start.
pub static EFFECT: Effect = Effect {
    name: "timing_jitter_of_frames",
    sentence: "Frames begin at irregular times, so a moving target is not where the simulation has it.",
    reference: "t_n -> t_n + eta_n",
    parameters: &[Parameter::strength("sigma_s", "s", 0.0, (0.0, 0.02), 5e-4)],
    place: Place::Clock,
    chance: Chance::Frame,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    exposure.in_set_s += values[0] * exposure.deviate;
}
