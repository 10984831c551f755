//! The pixel's response is not linear in the light.

use crate::physics::powers::power;
use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};
use crate::widest::widest;

/// Quadratic and cubic part, relative to the linear one at full scale; and by how much the exponent of a response that is a power of the
/// light differs from 1 (the gamma of cameras and projectors: 2.2 is 1.2).
pub static EFFECT: Effect = Effect {
    name: "intensity_nonlinearity",
    sentence: "The pixel's response is not linear in the light, so harmonics appear that grow with the amplitude.",
    reference: "I -> I + alpha I^2 + beta I^3; I -> I0 (I / I0)^(1 + gamma), I0 a quarter of full scale",
    parameters: &[
        Parameter::strength("quadratic", "1", 0.0, (-0.6, 0.6), 0.02),
        Parameter::strength("cubic", "1", 0.0, (-0.6, 0.6), 0.02),
        Parameter::strength("exponent", "1", 0.0, (-0.6, 4.0), 0.02).instead(),
    ],
    place: Place::Readout,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

/// Signal that a power leaves as it is, over full scale: a usual one, so that a pixel's own light hardly depends on the exponent.
const UNMOVED: f64 = 0.25;

fn act(values: &[f64], exposure: &mut Exposure) {
    let full_scale_dn = exposure.pixels.full_scale_dn;
    let (quadratic, cubic, exponent) = (values[0], values[1], values[2]);
    let signals: &mut [f64] = &mut exposure.signal_dn;
    if exponent != 0.0 {
        let (signals, unmoved_dn) = (&mut *signals, UNMOVED * full_scale_dn);
        widest!((signals: &'a mut [f64], unmoved_dn: f64, exponent: f64) {
            for signal in signals {
                // No light is no light by any power.
                let level = if *signal > 0.0 { *signal / unmoved_dn } else { 1.0 };
                *signal *= power(level, exponent);
            }
        });
    }
    widest!((signals: &'a mut [f64], full_scale_dn: f64, quadratic: f64, cubic: f64) {
        for signal in signals {
            let share = *signal / full_scale_dn;
            *signal += *signal * share * (quadratic + cubic * share);
        }
    });
}
