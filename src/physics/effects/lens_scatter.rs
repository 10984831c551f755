//! Light that the lens and the camera scatter over the whole image.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

/// Share of every pixel's light that is spread over all pixels.
pub static EFFECT: Effect = Effect {
    name: "lens_scatter",
    sentence: "The lens scatters part of the light over the whole image, so every pixel carries some of what all others see.",
    reference: "Mure-Dubois 2007; Kavli 2008: z -> z + h * z",
    parameters: &[Parameter::strength("share", "1", 0.0, (0.0, 0.5), 0.02)],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let mean_dn = exposure.signal_dn.iter().sum::<f64>() / exposure.signal_dn.len().max(1) as f64;
    exposure.signal_dn.iter_mut().for_each(|signal| *signal += values[0] * (mean_dn - *signal));
}
