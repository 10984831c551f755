//! Charge that stays behind for the next frame.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

/// Share of a frame's charge that is read with the next one.
pub static EFFECT: Effect = Effect {
    name: "image_lag",
    sentence: "Part of a frame's charge stays in the pixel and is read with the next frame (image lag).",
    reference: "I_n -> (1 - l) I_n + l I_(n-1)",
    parameters: &[Parameter::strength("share", "1", 0.0, (0.0, 0.5), 0.01)],
    place: Place::Charge,
    chance: Chance::None,
    looks_back: true,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    if let Some(before) = exposure.before_dn.clone() {
        exposure
            .signal_dn
            .iter_mut()
            .zip(before.iter())
            .for_each(|(signal, before)| *signal += values[0] * (before - *signal));
    }
}
