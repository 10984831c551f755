//! Pixels at the target's edge that see target and background.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

const fn share(name: &'static str) -> Parameter {
    Parameter::strength(name, "1", 0.0, (0.0, 0.6), 0.2)
}

/// Share of such a pixel that sees what its neighbours beyond the edge see: of the target's pixels, and of the background's; or of those at each of
/// the target's sides alone. A side that ends within a pixel mixes one of the two.
pub static EFFECT: Effect = Effect {
    name: "mixed_pixels",
    sentence: "Pixels at the target's edge see target and background at once (mixed or flying pixels).",
    reference: "Lefloch et al. 2013; phasors add with the shares of the area",
    parameters: &[
        share("target_share"),
        share("background_share"),
        share("target_left").instead(),
        share("target_right").instead(),
        share("target_top").instead(),
        share("target_bottom").instead(),
        share("background_left").instead(),
        share("background_right").instead(),
        share("background_top").instead(),
        share("background_bottom").instead(),
    ],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Loose,
    act: Act::Code(act),
};

/// The parameter of the target's side that lies between `pixel` and its neighbour `beyond`.
fn side(is_target: bool, pixel: usize, beyond: usize, width: usize) -> usize {
    // Left, right, above, below of the target: of the background's pixels it is the other way round.
    let (own, other) = if is_target { (pixel, beyond) } else { (beyond, pixel) };
    let direction = match (other < own, own.abs_diff(other) < width) {
        (true, true) => 0,
        (false, true) => 1,
        (true, false) => 2,
        (false, false) => 3,
    };
    2 + direction + if is_target { 0 } else { 4 }
}

fn act(values: &[f64], exposure: &mut Exposure) {
    let own = exposure.signal_dn.clone();
    let signals_dn: &mut [f64] = &mut exposure.signal_dn;
    let width = exposure.pixels.geometry.width;
    for (number, &(pixel, beyond)) in exposure.pixels.edges.iter().enumerate() {
        let is_target = exposure.pixels.target[pixel];
        let of_all = values[usize::from(!is_target)];
        let of_side = values[side(is_target, pixel, beyond, width)];
        let share = (of_all + of_side) / exposure.pixels.edge_counts[number];
        signals_dn[pixel] += share * (own[beyond] - own[pixel]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_pixels_at_an_edge_are_of_the_same_side_of_the_target() {
        // In lines of 10, a target at 33 whose neighbours are background.
        for (beyond, name) in [(32, "left"), (34, "right"), (23, "top"), (43, "bottom")] {
            let name_of = |parameter: usize| EFFECT.parameters[parameter].name;
            assert_eq!(name_of(side(true, 33, beyond, 10)), format!("target_{name}"));
            assert_eq!(name_of(side(false, beyond, 33, 10)), format!("background_{name}"));
        }
    }
}
