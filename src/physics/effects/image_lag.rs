//! Charge that stays behind for the next frame.

use crate::physics::{Act, Before, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Share of a frame's charge that is read with the next one. Before a set's first frame the camera took a step that is as far from the first as
/// the first from the second (0), or the set's last step (1), or the first one (-3), or it rested since the last frame of the set before (-2); or the pixels were
/// emptied then (-1).
pub static EFFECT: Effect = Effect {
    name: "image_lag",
    sentence: "Part of a frame's charge stays in the pixel and is read with the next frame (image lag).",
    reference: "I_n -> (1 - l) I_n + l I_(n-1)",
    parameters: &[
        Parameter::strength("share", "1", 0.0, (0.0, 0.5), 0.01),
        Parameter::choice("last_step_before_first", "1", &[0.0, EMPTIED, RESTED, WAITED, 1.0]),
    ],
    place: Place::Charge,
    chance: Chance::None,
    looks_back: true,
    fidelity: Fidelity::Loose,
    act: Act::Code(act),
};

// Below 1: what is above it would say how many strengths there are.
const EMPTIED: f64 = -1.0;
const RESTED: f64 = -2.0;
const WAITED: f64 = -3.0;

fn act(values: &[f64], exposure: &mut Exposure) {
    let which = values[1];
    let is_first = exposure.moment.frame == 0;
    if which == WAITED && is_first {
        return;
    }
    if which == EMPTIED && is_first {
        exposure.signal_dn.iter_mut().for_each(|signal| *signal *= 1.0 - values[0]);
    } else if let Some(Before { evenly_dn, again_dn, kept_dn }) = exposure.before.as_deref() {
        let before_dn = if which == RESTED {
            kept_dn
        } else if which > 0.5 {
            again_dn
        } else {
            evenly_dn
        };
        for (signal, before) in exposure.signal_dn.iter_mut().zip(before_dn) {
            *signal += values[0] * (before - *signal);
        }
    }
}
