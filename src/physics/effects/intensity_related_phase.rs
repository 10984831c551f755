//! A phase that depends on the amplitude.

use crate::physics::powers::{ln, power};
use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

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
    act: Act::Code(act),
};

/// The amplitude at which nothing is added, DN: any other moves the pixel's own phase.
const REFERENCE_DN: f64 = 300.0;

fn act(values: &[f64], exposure: &mut Exposure) {
    let (rad, exponent) = (values[0], values[1]);
    let moved = exposure.phase_rad.iter_mut().zip(&exposure.amplitude_dn);
    // With the widest registers that the machine has. No amplitude has no phase that could move.
    pulp::Arch::new().dispatch(|| {
        for (phase, &amplitude) in moved {
            let level = if amplitude > 0.0 { amplitude / REFERENCE_DN } else { 1.0 };
            let moved = if exponent == 0.0 { ln(level) } else { (power(level, exponent) - 1.0) / exponent };
            *phase += rad * moved;
        }
    });
}
