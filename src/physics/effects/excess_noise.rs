//! Noise that grows with the signal itself.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Standard deviation relative to the signal, of every pixel and frame.
pub static EFFECT: Effect = Effect {
    name: "excess_noise",
    sentence: "There is more noise than shot and read noise: it grows in proportion to the signal (laser speckle, gain noise).",
    reference: "variance s^2 + g I + eta^2 I^2",
    parameters: &[Parameter::strength("relative", "1", 0.0, (0.0, 0.3), 0.005)],
    place: Place::Readout,
    chance: Chance::Pixel,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let draws = exposure.pixel_deviates.clone();
    exposure
        .signal_dn
        .iter_mut()
        .zip(draws)
        .for_each(|(signal, deviate)| *signal *= 1.0 + values[0] * deviate);
}
