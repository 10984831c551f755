//! Pixels at the target's edge that see target and background.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

/// Share of such a pixel that sees what its neighbours beyond the edge see.
pub static EFFECT: Effect = Effect {
    name: "mixed_pixels",
    sentence: "Pixels at the target's edge see target and background at once (mixed or flying pixels).",
    reference: "Lefloch et al. 2013; phasors add with the shares of the area",
    parameters: &[Parameter::strength("share", "1", 0.0, (0.0, 0.6), 0.2)],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let own = exposure.signal_dn.clone();
    for (number, &(pixel, beyond)) in exposure.pixels.edges.iter().enumerate() {
        let share = values[0] / exposure.pixels.edge_counts[number];
        exposure.signal_dn[pixel] += share * (own[beyond] - own[pixel]);
    }
}
