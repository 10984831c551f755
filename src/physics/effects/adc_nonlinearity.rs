//! The converter's integral non-linearity.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place, cos_sin};
use std::f64::consts::TAU;

/// An error that is periodic in the code: its parts, and its period.
pub static EFFECT: Effect = Effect {
    name: "adc_nonlinearity",
    sentence: "The converter's code is off by an amount that repeats with the code (integral non-linearity of its stages).",
    reference: "code -> code + a cos(2 pi code / p) + b sin(2 pi code / p)",
    parameters: &[
        Parameter::strength("cosine_dn", "DN", 0.0, (-50.0, 50.0), 1.0),
        Parameter::strength("sine_dn", "DN", 0.0, (-50.0, 50.0), 1.0),
        Parameter::shape("period_dn", "DN", 256.0, (16.0, 2048.0), &[64.0, 128.0, 256.0, 512.0, 1024.0])
            .period_in_code(),
    ],
    place: Place::Readout,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let pedestal_dn = exposure.pixels.pedestal_dn;
    for signal in &mut exposure.signal_dn {
        let (cosine, sine) = cos_sin(TAU * (*signal + pedestal_dn) / values[2]);
        *signal += values[0] * cosine + values[1] * sine;
    }
}
