//! Frames of a set with gains of their own.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

const fn gain(name: &'static str) -> Parameter {
    Parameter::strength(name, "1", 0.0, (-0.3, 0.3), 0.005)
}

/// Relative gain of frame 0, 1, … of a set, less 1; frames beyond the last have none. It is that of all light (0), as an exposure's, or of the camera's
/// own alone (1), as its source's.
pub static EFFECT: Effect = Effect {
    name: "frame_gain",
    sentence: "Single frames of a set are brighter or darker as a whole, in every set alike (exposure or source power by phase step).",
    reference: "I_n -> (1 + g_n) I_n, or B + (1 + g_n) (I_n - B) with the ambient light B",
    parameters: &[
        gain("frame_0"),
        gain("frame_1"),
        gain("frame_2"),
        gain("frame_3"),
        gain("frame_4"),
        gain("frame_5"),
        gain("frame_6"),
        gain("frame_7"),
        gain("frame_8"),
        gain("frame_9"),
        gain("frame_10"),
        gain("frame_11"),
        gain("frame_12"),
        gain("frame_13"),
        gain("frame_14"),
        gain("frame_15"),
        gain("frame_16"),
        gain("frame_17"),
        gain("frame_18"),
        gain("frame_19"),
        gain("frame_20"),
        gain("frame_21"),
        gain("frame_22"),
        gain("frame_23"),
        gain("frame_24"),
        gain("frame_25"),
        gain("frame_26"),
        gain("frame_27"),
        gain("frame_28"),
        gain("frame_29"),
        gain("frame_30"),
        gain("frame_31"),
        gain("frame_32"),
        gain("frame_33"),
        gain("frame_34"),
        gain("frame_35"),
        gain("frame_36"),
        gain("frame_37"),
        gain("frame_38"),
        gain("frame_39"),
        gain("frame_40"),
        gain("frame_41"),
        gain("frame_42"),
        gain("frame_43"),
        gain("frame_44"),
        gain("frame_45"),
        gain("frame_46"),
        gain("frame_47"),
        gain("frame_48"),
        gain("frame_49"),
        gain("frame_50"),
        gain("frame_51"),
        gain("frame_52"),
        gain("frame_53"),
        gain("frame_54"),
        gain("frame_55"),
        gain("frame_56"),
        gain("frame_57"),
        gain("frame_58"),
        gain("frame_59"),
        gain("frame_60"),
        gain("frame_61"),
        gain("frame_62"),
        gain("frame_63"),
        Parameter::choice("of_own_light", "1", &[0.0, 1.0]),
    ],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let [gains @ .., of_own_light] = values else { return };
    let Some(gain) = gains.get(exposure.moment.frame).filter(|gain| **gain != 0.0) else { return };
    let of_own_light = *of_own_light > 0.5;
    for (signal, ambient) in exposure.signal_dn.iter_mut().zip(exposure.ambient_dn.iter()) {
        *signal += gain * if of_own_light { *signal - ambient } else { *signal };
    }
}
