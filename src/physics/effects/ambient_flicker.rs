//! Ambient light from lamps on the mains.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place, cos_sin, root_mean_square};
use std::f64::consts::TAU;

/// Number of the overtone's cosine among the parameters; its sine comes after it.
pub const OVERTONE: usize = 2;
/// Number of the frequency.
pub const FREQUENCY: usize = 4;
/// Number of whether it is even.
pub const IS_EVEN: usize = FREQUENCY + 1;

/// Relative modulation of the ambient light at twice the mains frequency, and, where a lamp is no filament, at twice that. Each pixel's own ambient light is
/// modulated (0), or as much is added to all as the root of their mean square would be (1): where recordings do not tell a pixel's ambient light from the constant part of the
/// camera's own, what seems to be the former has the latter's texture.
pub static EFFECT: Effect = Effect {
    name: "ambient_flicker",
    sentence: "The ambient light flickers with the mains (100 or 120 Hz), and the frames sample it at different moments.",
    reference: "B_n = B0 (1 + b cos(2 pi f t_n + x) + b2 cos(4 pi f t_n + x2))",
    parameters: &[
        Parameter::strength("cosine", "1", 0.0, (-1.0, 1.0), 0.1),
        Parameter::strength("sine", "1", 0.0, (-1.0, 1.0), 0.1),
        Parameter::strength("second_cosine", "1", 0.0, (-1.0, 1.0), 0.03).looked_for(),
        Parameter::strength("second_sine", "1", 0.0, (-1.0, 1.0), 0.03).looked_for(),
        Parameter::shape("frequency_hz", "Hz", 100.0, (40.0, 400.0), &[100.0, 120.0]),
        Parameter::choice("is_even", "1", &[0.0, 1.0]),
    ],
    place: Place::Light,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let (cosine, sine) = cos_sin((TAU * values[FREQUENCY] * exposure.taken_s()) % TAU);
    // cos 2a and sin 2a.
    let (twice_cosine, twice_sine) = (cosine * cosine - sine * sine, 2.0 * sine * cosine);
    let overtone = values[OVERTONE] * twice_cosine + values[OVERTONE + 1] * twice_sine;
    let more = values[0] * cosine + values[1] * sine + overtone;
    let all: &mut [f64] = &mut exposure.ambient_dn;
    if values[IS_EVEN] > 0.5 {
        let usual = root_mean_square(all);
        all.iter_mut().for_each(|ambient| *ambient += more * usual);
    } else {
        all.iter_mut().for_each(|ambient| *ambient *= 1.0 + more);
    }
}
