//! Charge that stays behind for the next frame.

use crate::physics::{Act, Before, Chance, Effect, Exposure, Fidelity, Moment, Parameter, Place};

/// Share of a frame's charge that is read with the next one. Before a set's first frame the camera took a step that is as far from the first as
/// the first from the second (0), or the set's last step (1), or the first one (-3), or it rested since the last frame of the set before (-2); or the pixels were
/// emptied then (-1), or only where the sets do not follow each other without a pause (-4): else that frame is the one before.
pub static EFFECT: Effect = Effect {
    name: "image_lag",
    sentence: "Part of a frame's charge stays in the pixel and is read with the next frame (image lag).",
    reference: "I_n -> (1 - l) I_n + l I_(n-1)",
    parameters: &[
        Parameter::strength("share", "1", 0.0, (0.0, 0.5), 0.01),
        Parameter::choice(
            "last_step_before_first",
            "1",
            &[0.0, EMPTIED, RESTED, WAITED, EMPTIED_IN_PAUSES, 1.0],
        ),
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
const EMPTIED_IN_PAUSES: f64 = -4.0;
/// Frame periods between a frame's due start and its start, from which on that was a pause.
const PAUSE: f64 = 0.5;

fn act(values: &[f64], exposure: &mut Exposure) {
    let which = values[1];
    let Moment { frame, frame_period_s, time_s, .. } = exposure.moment;
    let is_first = frame == 0;
    if which == WAITED && is_first {
        return;
    }
    // Before a recording there was a pause, too.
    let pause_s = PAUSE * frame_period_s;
    let has_paused =
        time_s < pause_s || exposure.before.as_ref().is_none_or(|before| before.rested_s > pause_s);
    if is_first && (which == EMPTIED || which == EMPTIED_IN_PAUSES && has_paused) {
        exposure.signal_dn.iter_mut().for_each(|signal| *signal *= 1.0 - values[0]);
    } else if let Some(Before { evenly_dn, again_dn, kept_dn, .. }) = exposure.before.as_deref() {
        let before_dn = if which == RESTED || which == EMPTIED_IN_PAUSES {
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
