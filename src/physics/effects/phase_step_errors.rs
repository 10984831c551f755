//! Each phase step with an error of its own.

use crate::physics::{Chance, Effect, Exposure, Parameter, Place};

const fn step(name: &'static str) -> Parameter {
    Parameter::strength(name, "rad", 0.0, (-0.5, 0.5), 0.01)
}

/// Error of the phase step of frame 0, 1, … of a set; frames beyond the last have none.
pub static EFFECT: Effect = Effect {
    name: "phase_step_errors",
    sentence: "Single phase steps are off (PLL or delay-line quanta): the same frame of every set has the same phase error.",
    reference: "theta_n -> theta_n + eps_n",
    parameters: &[
        step("frame_0_rad"),
        step("frame_1_rad"),
        step("frame_2_rad"),
        step("frame_3_rad"),
        step("frame_4_rad"),
        step("frame_5_rad"),
        step("frame_6_rad"),
        step("frame_7_rad"),
    ],
    place: Place::Clock,
    chance: Chance::None,
    looks_back: false,
    act,
};

fn act(values: &[f64], exposure: &mut Exposure) {
    exposure.angle_rad += values.get(exposure.moment.frame).copied().unwrap_or(0.0);
}
