//! Frames that are not taken when the camera says.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

const fn late(frame: usize, name: &'static str) -> Parameter {
    Parameter::strength(name, "s", 0.0, (-0.02, 0.02), 1e-3).instead().of_frame(frame)
}

/// By how much, relatively, frames of a set follow each other more slowly than the frame period; or by how much single frames after the first one are late, the same in every set,
/// and the time from the first row's start to that of the one after the last, where rows begin one after the other. That all frames are late by as much, the first one among
/// them, is what an encoder's reading would be that comes early, and is none of these. What moves shows it, and a lamp that flickers (but for its rows, which see it all at once here).
pub static EFFECT: Effect = Effect {
    name: "frame_timing_error",
    sentence: "Frames are not taken when the camera says (another frame period, single frames that are late, rows that begin one after the other): a moving target is not \
               where the simulation has it.",
    reference: "t_n -> (1 + eps) t_n, or t_n + tau_n; rolling shutter: t + row / rows tau",
    parameters: &[
        Parameter::strength("relative", "1", 0.0, (-0.5, 0.5), 0.02),
        late(1, "frame_1_s"),
        late(2, "frame_2_s"),
        late(3, "frame_3_s"),
        late(4, "frame_4_s"),
        late(5, "frame_5_s"),
        late(6, "frame_6_s"),
        late(7, "frame_7_s"),
        Parameter::strength("over_rows_s", "s", 0.0, (-0.05, 0.05), 2e-3).instead(),
    ],
    place: Place::Clock,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let late_s = match exposure.moment.frame {
        0 => 0.0,
        frame => values[1..values.len() - 1].get(frame - 1).copied().unwrap_or(0.0),
    };
    exposure.in_set_s += values[0] * exposure.moment.in_set_s + late_s;
    exposure.over_rows_s += values[values.len() - 1];
}
