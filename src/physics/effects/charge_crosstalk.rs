//! Charge that wanders to neighbouring pixels.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

const fn from(name: &'static str) -> Parameter {
    Parameter::strength(name, "1", 0.0, (0.0, 0.15), 0.005).instead()
}

/// Share of a pixel's charge that wanders, a quarter to each neighbour, and a quarter of theirs to it: at the sensor's border, where there are fewer,
/// less, so that no charge is lost or made. Or how much of the difference comes from each neighbour in the row, in the column (what a line carries), and
/// at the corners.
pub static EFFECT: Effect = Effect {
    name: "charge_crosstalk",
    sentence: "Charge diffuses to neighbouring pixels, which blurs edges and texture.",
    reference: "z -> z * small kernel",
    parameters: &[
        Parameter::strength("share", "1", 0.0, (0.0, 0.6), 0.02),
        from("from_beside"),
        from("from_above_and_below"),
        from("from_diagonal"),
    ],
    place: Place::Charge,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Loose,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let own = exposure.signal_dn.clone();
    let geometry = exposure.pixels.geometry;
    let [beside, above] = [1, 2].map(|way| 0.25 * values[0] + values[way]);
    let shares = [beside, beside, above, above];
    for (pixel, signal) in exposure.signal_dn.iter_mut().enumerate() {
        let more = |beside: usize| own[beside] - own[pixel];
        let of_sides = geometry.beside(pixel).into_iter().zip(shares);
        *signal += of_sides.filter_map(|(beside, share)| Some(share * more(beside?))).sum::<f64>();
        if values[3] != 0.0 {
            let diagonal = geometry.diagonal(pixel).into_iter().flatten();
            *signal += values[3] * diagonal.map(more).sum::<f64>();
        }
    }
}
