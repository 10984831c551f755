//! Frames of a set with gains of their own.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

const fn gain(name: &'static str) -> Parameter {
    Parameter::strength(name, "1", 0.0, (-0.3, 0.3), 0.005)
}

/// Relative gain of frame 0, 1, … of a set, less 1; frames beyond the last have none.
pub static EFFECT: Effect = Effect {
    name: "frame_gain",
    sentence: "Single frames of a set are brighter or darker as a whole, in every set alike (exposure or source power by phase step).",
    reference: "I_n -> (1 + g_n) I_n",
    parameters: &[
        gain("frame_0"),
        gain("frame_1"),
        gain("frame_2"),
        gain("frame_3"),
        gain("frame_4"),
        gain("frame_5"),
        gain("frame_6"),
        gain("frame_7"),
    ],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let factor = 1.0 + values.get(exposure.moment.frame).copied().unwrap_or(0.0);
    exposure.signal_dn.iter_mut().for_each(|signal| *signal *= factor);
}
