//! Charge that wanders to neighbouring pixels.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

/// Share of a pixel's charge that its four neighbours get.
pub static EFFECT: Effect = Effect {
    name: "charge_crosstalk",
    sentence: "Charge diffuses to neighbouring pixels, which blurs edges and texture.",
    reference: "z -> z * small kernel",
    parameters: &[Parameter::strength("share", "1", 0.0, (0.0, 0.6), 0.02)],
    place: Place::Charge,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let own = exposure.signal_dn.clone();
    for (pixel, signal) in exposure.signal_dn.iter_mut().enumerate() {
        *signal += values[0] * (exposure.pixels.neighbours(&own, pixel) - own[pixel]);
    }
}
