//! The phase changes while a set is taken.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Share of the recorded velocity that the phase follows from frame to frame; 1 is physics.
pub static EFFECT: Effect = Effect {
    name: "axial_motion",
    sentence: "The target moves along the optical axis during a set, so the phase changes from frame to frame, with the sign of \
               the velocity.",
    reference: "Drayton, Carnegie, Dorrington 2012: phase_n = phase_1 + (n - 1) 4 pi f v t / c",
    parameters: &[Parameter::strength("share", "1", 0.0, (-1.5, 2.0), 1.0)],
    place: Place::Clock,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Law,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    exposure.motion_share += values[0];
}
