//! The scene moves sideways during a set.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

/// Columns and rows a second by which the image moves.
pub static EFFECT: Effect = Effect {
    name: "lateral_motion",
    sentence: "The image moves sideways during a set, so edges and texture are in another place in every frame.",
    reference: "Lindner 2009; I_n(x) = I(x - v t_n)",
    parameters: &[
        Parameter::strength("columns_a_second", "1/s", 0.0, (-20.0, 20.0), 0.5),
        Parameter::strength("rows_a_second", "1/s", 0.0, (-20.0, 20.0), 0.5),
    ],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let moved = [values[0], values[1]].map(|a_second| a_second * exposure.in_set_s);
    let own = exposure.signal_dn.clone();
    for (pixel, signal) in exposure.signal_dn.iter_mut().enumerate() {
        let (along, down) = exposure.pixels.slopes(&own, pixel, moved);
        *signal -= moved[0] * along + moved[1] * down;
    }
}
