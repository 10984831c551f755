//! The converter's integral non-linearity.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place, cos_sin};
use crate::widest::widest;
use std::f64::consts::TAU;

/// Periods from which a search starts: those of the converter's bits.
const SHAPES: &[f64] =
    &[64.0, 128.0, 256.0, 512.0, 1024.0, 2048.0, 4096.0, 8192.0, 16_384.0, 32_768.0, 65_536.0];

/// Of full scale, no converter is off by more: what is, is a response.
const MOST: f64 = 0.02;
/// The longest period in full scales: that of the first bit, all codes, of which some are below the pedestal.
const LONGEST: f64 = 1.05;

/// An error that is periodic in the code: its parts, and its period; a wave (0), or one with the third and fifth harmonic of what a bit of a wrong weight
/// makes, a square wave (1, from top to bottom pi / 2 times this fundamental), or of a triangle (-1): the noise leaves little of higher ones.
pub static EFFECT: Effect = Effect {
    name: "adc_nonlinearity",
    sentence: "The converter's code is off by an amount that repeats with the code (integral non-linearity of its stages).",
    reference: "code -> code + a cos(2 pi code / p) + b sin(2 pi code / p)",
    parameters: &[
        Parameter::strength("cosine_dn", "DN", 0.0, (-50.0, 50.0), 1.0).within_full_scales(MOST),
        Parameter::strength("sine_dn", "DN", 0.0, (-50.0, 50.0), 1.0).within_full_scales(MOST),
        Parameter::shape("period_dn", "DN", 256.0, (16.0, 81_920.0), SHAPES).within_full_scales(LONGEST),
        Parameter::choice("form", "1", &[0.0, -1.0, 1.0]),
    ],
    place: Place::Readout,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

/// Third and fifth harmonic over the first: of a square wave, and of a triangle.
const SQUARE: [f64; 2] = [-1.0 / 3.0, 1.0 / 5.0];
const TRIANGLE: [f64; 2] = [1.0 / 9.0, 1.0 / 25.0];

fn act(values: &[f64], exposure: &mut Exposure) {
    let (pedestal_dn, cosine_dn, sine_dn, period_dn, form) =
        (exposure.pixels.pedestal_dn, values[0], values[1], values[2], values[3]);
    let [third, fifth] = match form {
        form if form > 0.5 => SQUARE,
        form if form < -0.5 => TRIANGLE,
        _ => [0.0; 2],
    };
    let squared_dn2 = cosine_dn * cosine_dn + sine_dn * sine_dn;
    let per_squared = if squared_dn2 > 0.0 { squared_dn2.recip() } else { 0.0 };
    let signals: &mut [f64] = &mut exposure.signal_dn;
    widest!((signals: &'a mut [f64], pedestal_dn: f64, cosine_dn: f64, sine_dn: f64, period_dn: f64,
             third: f64, fifth: f64, per_squared: f64) {
        for signal in signals {
            let (cosine, sine) = cos_sin(TAU * (*signal + pedestal_dn) / period_dn);
            let wave_dn = cosine_dn * cosine + sine_dn * sine;
            let square = wave_dn * wave_dn * per_squared;
            // Chebyshev's polynomials of the third and the fifth, over the wave.
            let harmonics = third * (4.0 * square - 3.0) + fifth * ((16.0 * square - 20.0) * square + 5.0);
            *signal += wave_dn * (1.0 + harmonics);
        }
    });
}
