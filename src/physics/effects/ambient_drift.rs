//! Ambient light that drifts.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place, accelerated_s, settled};

/// Relative change of the ambient light, a second, when the recording begins; by how much it had changed before; and the time in which it settles,
/// as lamps do that warm up: 10 000 s is as good as never. Or (1) light that accelerates, as at dawn: the time in which it becomes twice as fast. Or (-1) what
/// begins anew with every set, as the background does of a sensor that warms up while it is read, or of a lamp that is switched with the camera: evenly over a set, of which
/// no time constant is that short. There is no light below none.
pub static EFFECT: Effect = Effect {
    name: "ambient_drift",
    sentence: "The ambient light drifts, during the recording or anew within every set.",
    reference: "B(t) = B0 + b t; or B0 + b tau (1 - exp(-t/tau)); or B0 + b (t + t^2 / (2 tau)); or B0 + b t, t from the set's first frame",
    parameters: &[
        Parameter::strength("relative_a_second", "1/s", 0.0, (-2.0, 2.0), 0.005),
        Parameter::strength("relative_before", "1", 0.0, (-0.9, 9.0), 0.1).of_recording(),
        Parameter::shape("time_constant_s", "s", 1e4, (2.0, 1e4), &[1e4, 60.0, 10.0]),
        Parameter::choice("course", "1", &[0.0, -1.0, 1.0]),
    ],
    place: Place::Light,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

/// The course that begins anew with every set.
const ANEW: f64 = -1.0;

fn act(values: &[f64], exposure: &mut Exposure) {
    let (moment, tau_s) = (exposure.moment, values[2]);
    let passed_s = match values[3] {
        // Before the set it has not begun.
        ANEW => settled(moment.in_set_s.max(0.0), tau_s, 0.0) * tau_s,
        0.0 => settled(moment.time_s, tau_s, 0.0) * tau_s,
        _ => accelerated_s(moment.time_s, tau_s),
    };
    let factor = (1.0 + values[1] + values[0] * passed_s).max(0.0);
    exposure.ambient_dn.iter_mut().for_each(|ambient| *ambient *= factor);
}
