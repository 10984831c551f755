//! The light of another camera.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place, cos_sin};
use std::f64::consts::TAU;

/// Another camera's modulated light beats with this one's demodulation: a phasor that turns with the difference of both frequencies, as frames see it, and from a phase step
/// to the next. It is the same in all pixels (0), or goes with their ambient light, as what a surface of the scene throws back does (1), and is so large in the root of the mean square. What is
/// left after the exposure counts, and it begins anew with every recording.
pub static EFFECT: Effect = Effect {
    name: "multi_camera_interference",
    sentence: "Another camera's modulated light beats with this one's demodulation (multi-camera interference).",
    reference: "D_n += A cos(theta_n - 2 pi df t_n + x)",
    parameters: &[
        Parameter::strength("cosine_dn", "DN", 0.0, (-300.0, 300.0), 2.0),
        Parameter::strength("sine_dn", "DN", 0.0, (-300.0, 300.0), 2.0),
        Parameter::shape("beat_hz", "Hz", 1.0, (-1e4, 1e4), &[1.0]),
        Parameter::choice("goes_with_ambient", "1", &[0.0, 1.0]),
    ],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let (cosine, sine) = cos_sin((exposure.angle_rad - TAU * values[2] * exposure.taken_s()) % TAU);
    let more_dn = exposure.moment.transmission * (values[0] * cosine + values[1] * sine);
    if values[3] < 0.5 {
        exposure.signal_dn.iter_mut().for_each(|signal| *signal += more_dn);
        return;
    }
    let ambient_dn = &exposure.pixels.ambient_dn;
    let usual_dn = (ambient_dn.iter().map(|dn| dn * dn).sum::<f64>() / ambient_dn.len() as f64).sqrt();
    if usual_dn > 0.0 {
        for (signal, ambient) in exposure.signal_dn.iter_mut().zip(&**ambient_dn) {
            *signal += more_dn * ambient / usual_dn;
        }
    }
}
