//! Ambient light from lamps on the mains.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place, cos_sin};
use std::f64::consts::TAU;

/// Relative modulation of the ambient light at twice the mains frequency.
pub static EFFECT: Effect = Effect {
    name: "ambient_flicker",
    sentence: "The ambient light flickers with the mains (100 or 120 Hz), and the frames sample it at different moments.",
    reference: "B_n = B0 (1 + b cos(2 pi f t_n + x))",
    parameters: &[
        Parameter::strength("cosine", "1", 0.0, (-1.0, 1.0), 0.1),
        Parameter::strength("sine", "1", 0.0, (-1.0, 1.0), 0.1),
        Parameter::shape("frequency_hz", "Hz", 100.0, (40.0, 400.0), &[100.0, 120.0]),
    ],
    place: Place::Light,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let (cosine, sine) = cos_sin((TAU * values[2] * exposure.taken_s()) % TAU);
    let factor = 1.0 + values[0] * cosine + values[1] * sine;
    exposure.ambient_dn.iter_mut().for_each(|ambient| *ambient *= factor);
}
