//! The scene moves sideways during a set.

use crate::physics::slopes::{Side, slopes, slopes_of_texture};
use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};
use std::sync::Arc;

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
    fidelity: Fidelity::Loose,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let of = |side: usize| (values[side] + values[2 + side] * exposure.velocity_m_s) * exposure.in_set_s;
    let moved = [of(0), of(1)];
    if moved == [0.0; 2] {
        return;
    }
    let (own, pixels) = (exposure.signal_dn.clone(), Arc::clone(&exposure.pixels));
    for (side, moved) in Side::ALL.into_iter().zip(moved).filter(|(_, moved)| *moved != 0.0) {
        let slopes = match values[4] > 0.5 {
            true => slopes_of_texture(&pixels, &own, side),
            false => slopes(&pixels, &own, side, moved),
        };
        exposure.signal_dn.iter_mut().zip(slopes).for_each(|(signal, slope)| *signal -= moved * slope);
    }
}
