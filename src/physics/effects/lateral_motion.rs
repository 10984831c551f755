//! The scene moves sideways during a set.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

/// Columns and rows by which the image moves, a second, or, where the carriage's way is not the camera's axis, a metre of that way. All that is in the image moves
/// (0), with what the pixels' own gains make of it; or the target's texture within its outline (1).
pub static EFFECT: Effect = Effect {
    name: "lateral_motion",
    sentence: "The image moves sideways during a set, so edges and texture are in another place in every frame.",
    reference: "Lindner 2009; I_n(x) = I(x - v t_n)",
    parameters: &[
        Parameter::strength("columns_a_second", "1/s", 0.0, (-20.0, 20.0), 0.5),
        Parameter::strength("rows_a_second", "1/s", 0.0, (-20.0, 20.0), 0.5),
        Parameter::strength("columns_a_metre", "1/m", 0.0, (-20.0, 20.0), 0.5).instead(),
        Parameter::strength("rows_a_metre", "1/m", 0.0, (-20.0, 20.0), 0.5).instead(),
        Parameter::choice("of_texture", "1", &[0.0, 1.0]),
    ],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let of = |side: usize| (values[side] + values[2 + side] * exposure.velocity_m_s) * exposure.in_set_s;
    let moved = [of(0), of(1)];
    let own = exposure.signal_dn.clone();
    for (pixel, signal) in exposure.signal_dn.iter_mut().enumerate() {
        let (along, down) = match values[4] > 0.5 {
            true => exposure.pixels.slopes_of_texture(&own, pixel),
            false => exposure.pixels.slopes(&own, pixel, moved),
        };
        *signal -= moved[0] * along + moved[1] * down;
    }
}
