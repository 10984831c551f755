//! A phase that depends on the amplitude.

use crate::physics::powers::{ln, power};
use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};
use crate::widest::widest;

/// Phase a factor of e in amplitude, at the reference; in proportion to the logarithm of the amplitude (0), to the amplitude itself (1), or to one
/// over it (-1) or its root (-0.5).
pub static EFFECT: Effect = Effect {
    name: "intensity_related_phase",
    sentence: "The phase depends on the amplitude (driver or pixel settling): dark targets look nearer or farther.",
    reference: "Lindner, Kolb 2007; phi -> phi + kappa ln A; or kappa ((A / A0)^p - 1) / p",
    parameters: &[
        Parameter::strength("rad_a_factor_e", "rad", 0.0, (-0.5, 0.5), 0.01),
        Parameter::choice("exponent", "1", &[0.0, -0.5, -1.0, 1.0]),
    ],
    place: Place::Waveform,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Loose,
    act: Act::Code(act),
};

/// The amplitude at which nothing is added, DN: any other moves the pixel's own phase.
const REFERENCE_DN: f64 = 300.0;

fn act(values: &[f64], exposure: &mut Exposure) {
    let (rad, exponent) = (values[0], values[1]);
    let (phases, amplitudes): (&mut [f64], &[f64]) = (&mut exposure.phase_rad, &exposure.amplitude_dn);
    if exponent == 0.0 {
        widest!((phases: &'a mut [f64], amplitudes: &'a [f64], rad: f64) {
            for (phase, &amplitude) in phases.iter_mut().zip(amplitudes) {
                *phase += rad * ln(level(amplitude));
            }
        });
    } else {
        widest!((phases: &'a mut [f64], amplitudes: &'a [f64], rad: f64, exponent: f64) {
            for (phase, &amplitude) in phases.iter_mut().zip(amplitudes) {
                *phase += rad * ((power(level(amplitude), exponent) - 1.0) / exponent);
            }
        });
    }
}

/// An amplitude over that at which nothing is added. No amplitude has no phase that could move.
#[inline(always)]
fn level(amplitude_dn: f64) -> f64 {
    if amplitude_dn > 0.0 { amplitude_dn / REFERENCE_DN } else { 1.0 }
}
