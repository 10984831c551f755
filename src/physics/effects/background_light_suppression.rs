//! The pixel takes charge away where there is much light.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// What is added to the charge of a pixel whose constant and ambient light is above a threshold, a share of full scale: its circuit against background light takes as much from both taps, but for
/// this. It comes within some per cent of the threshold.
pub static EFFECT: Effect = Effect {
    name: "background_light_suppression",
    sentence: "Where there is much light the pixel's suppression of background light works, and leaves a pedestal (SBI step).",
    reference: "D_n -> D_n + o where the constant light is above a threshold (PMD's suppression of background illumination)",
    parameters: &[
        Parameter::strength("pedestal_dn", "DN", 0.0, (-300.0, 300.0), 2.0),
        Parameter::shape("threshold_of_full_scale", "1", 0.1, (2e-3, 2.0), &SHARES),
    ],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Loose,
    act: Act::Code(act),
};

/// A step at one of them is nearly one at the next.
const SHARES: [f64; 16] =
    [0.01, 0.013, 0.018, 0.024, 0.031, 0.042, 0.055, 0.073, 0.097, 0.13, 0.17, 0.23, 0.3, 0.4, 0.53, 0.7];
/// Within this share of the threshold most of the step comes.
const WIDTH: f64 = 0.03;

fn act(values: &[f64], exposure: &mut Exposure) {
    if values[0] == 0.0 {
        return;
    }
    let threshold_dn = values[1] * exposure.pixels.full_scale_dn;
    let light = exposure.constant_dn.iter().zip(&*exposure.ambient_dn);
    let shares: Vec<f64> = light
        .map(|(constant, ambient)| {
            let beyond = ((constant + ambient) / threshold_dn - 1.0) / WIDTH;
            1.0 / (1.0 + libm::exp(-beyond))
        })
        .collect();
    for (signal, share) in exposure.signal_dn.iter_mut().zip(shares) {
        *signal += values[0] * share;
    }
}
