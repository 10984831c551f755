//! The camera's own arithmetic: low bits that are cut off before they are accumulated.
//!
//! Recordings hold raw codes, so that no later rounding of a pipeline can be in them. `fixed_point:pipeline=SPEC` on the command line takes
//! the number of bits from a pipeline's specification.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Bits of the code that are cut off.
pub static EFFECT: Effect = Effect {
    name: "fixed_point",
    sentence: "The camera's own arithmetic cuts low bits off the codes: a bias of half a unit, and a staircase.",
    reference: "I -> 2^k floor(I / 2^k)",
    parameters: &[Parameter::strength("bits_cut", "bit", 0.0, (0.0, 16.0), 2.0)],
    place: Place::Readout,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    // With noise it is the codes that are cut, when there are some.
    if values[0] > 0.0 && !exposure.noisy {
        let unit_dn = libm::exp2(values[0]);
        let pedestal_dn = exposure.pixels.pedestal_dn;
        exposure.signal_dn.iter_mut().for_each(|signal| {
            *signal = libm::floor((*signal + pedestal_dn) / unit_dn) * unit_dn - pedestal_dn;
        });
    }
}
