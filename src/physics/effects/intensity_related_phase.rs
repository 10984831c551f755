//! A phase that depends on the amplitude.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

/// Phase a factor of e in amplitude.
pub static EFFECT: Effect = Effect {
    name: "intensity_related_phase",
    sentence: "The phase depends on the amplitude (driver or pixel settling): dark targets look nearer or farther.",
    reference: "Lindner, Kolb 2007; phi -> phi + kappa ln A",
    parameters: &[Parameter::strength("rad_a_factor_e", "rad", 0.0, (-0.5, 0.5), 0.01)],
    place: Place::Waveform,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

/// The amplitude at which nothing is added, DN: any other moves the pixel's own phase.
const REFERENCE_DN: f64 = 300.0;

fn act(values: &[f64], exposure: &mut Exposure) {
    for (phase, &amplitude) in exposure.phase_rad.iter_mut().zip(&exposure.amplitude_dn) {
        if amplitude > 0.0 {
            *phase += values[0] * libm::log(amplitude / REFERENCE_DN);
        }
    }
}
