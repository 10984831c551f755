//! The modulation couples into the read-out without any light.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place, cos_sin};

/// Parts of a signal at the demodulation's own phase.
pub static EFFECT: Effect = Effect {
    name: "electrical_crosstalk",
    sentence: "The modulation signals couple electrically into the pixels: a constant phasor is added, with the lens covered too.",
    reference: "Godbaz et al. 2012; D_n += C cos(theta_n - phi_C)",
    parameters: &[
        Parameter::strength("cosine_dn", "DN", 0.0, (-300.0, 300.0), 3.0),
        Parameter::strength("sine_dn", "DN", 0.0, (-300.0, 300.0), 3.0),
    ],
    place: Place::Charge,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let (cosine, sine) = cos_sin(exposure.angle_rad);
    let more_dn = values[0] * cosine + values[1] * sine;
    exposure.signal_dn.iter_mut().for_each(|signal| *signal += more_dn);
}
