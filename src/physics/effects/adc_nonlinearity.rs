//! The converter's integral non-linearity.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place, cos_sin};
use crate::widest::widest;
use std::f64::consts::TAU;

/// Periods from which a search starts: those of the converter's bits.
const SHAPES: &[f64] =
    &[64.0, 128.0, 256.0, 512.0, 1024.0, 2048.0, 4096.0, 8192.0, 16_384.0, 32_768.0, 65_536.0];

/// Of full scale, no converter is off by more: what is, is a response.
const MOST: f64 = 0.02;
/// The longest period in full scales: that of the first bit, all codes, of which some are below the pedestal.
const LONGEST: f64 = 1.05;

/// Bits of a converter's code that may be of a wrong weight, the first ones: what is finer than these is lost in the noise.
const BITS: usize = 6;
/// Number of the first bit's error among the parameters.
pub const FIRST_BIT: usize = 2;
/// Number of the period.
pub const PERIOD: usize = FIRST_BIT + BITS;
/// Number of the form.
pub const FORM: usize = PERIOD + 1;

const fn bit(name: &'static str) -> Parameter {
    Parameter::strength(name, "DN", 0.0, (-50.0, 50.0), 1.0).within_full_scales(MOST).looked_for()
}

/// An error that is periodic in the code: its parts, and its period; a wave (0); what a bit of a wrong weight makes, a square wave (1, from top to bottom
/// pi / 2 times this fundamental); a triangle (-1); or what a stage of a wrong gain makes, a sawtooth that falls slowly and rises at once (0.5), or the other
/// way round (-0.5). Up to the twelfth harmonic: the noise leaves little of higher ones. Or what the weights of several bits are off by at once.
pub static EFFECT: Effect = Effect {
    name: "adc_nonlinearity",
    sentence: "The converter's code is off by an amount that repeats with the code (integral non-linearity of its stages).",
    reference: "code -> code + a cos(2 pi code / p) + b sin(2 pi code / p)",
    parameters: &[
        Parameter::strength("cosine_dn", "DN", 0.0, (-50.0, 50.0), 1.0).within_full_scales(MOST),
        Parameter::strength("sine_dn", "DN", 0.0, (-50.0, 50.0), 1.0).within_full_scales(MOST),
        bit("bit_1_dn"),
        bit("bit_2_dn"),
        bit("bit_3_dn"),
        bit("bit_4_dn"),
        bit("bit_5_dn"),
        bit("bit_6_dn"),
        Parameter::shape("period_dn", "DN", 256.0, (16.0, 81_920.0), SHAPES).within_full_scales(LONGEST),
        Parameter::choice("form", "1", &[0.0, -1.0, -0.5, 0.5, 1.0]),
    ],
    place: Place::Readout,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

/// Harmonics of a form.
const HARMONICS: usize = 12;

/// A form, and its harmonic of this number: what multiplies sin(n x) beside sin(x).
type Form = (f64, fn(f64) -> f64);

/// The forms that are no wave.
const FORMS: [Form; 4] = [
    (1.0, |n| if n % 2.0 == 0.0 { 0.0 } else { 1.0 / n }),
    (0.5, |n| 1.0 / n),
    (-0.5, |n| if n % 2.0 == 0.0 { -1.0 / n } else { 1.0 / n }),
    (-1.0, |n| match n % 4.0 {
        1.0 => 1.0 / (n * n),
        3.0 => -1.0 / (n * n),
        _ => 0.0,
    }),
];

/// All harmonics of a `form`; nothing of a wave.
fn harmonics(form: f64) -> Option<[f64; HARMONICS]> {
    let (_, harmonic) = FORMS.iter().find(|row| row.0 == form)?;
    Some(std::array::from_fn(|n| harmonic(n as f64 + 1.0)))
}

fn act(values: &[f64], exposure: &mut Exposure) {
    let (pedestal_dn, cosine_dn, sine_dn, period_dn) =
        (exposure.pixels.pedestal_dn, values[0], values[1], values[PERIOD]);
    let codes = exposure.pixels.full_scale_dn + pedestal_dn + 1.0;
    let signals: &mut [f64] = &mut exposure.signal_dn;
    match harmonics(values[FORM]) {
        Some(harmonics) => add_form(signals, pedestal_dn, [cosine_dn, sine_dn], period_dn, harmonics),
        // A wave by itself is what is looked for everywhere: it does without the others' twelve.
        None => {
            widest!((signals: &'a mut [f64], pedestal_dn: f64, cosine_dn: f64, sine_dn: f64, period_dn: f64) {
                for signal in signals {
                    let (cosine, sine) = cos_sin(TAU * (*signal + pedestal_dn) / period_dn);
                    *signal += cosine_dn * cosine + sine_dn * sine;
                }
            })
        }
    }
    for (bit, &weight_dn) in values[FIRST_BIT..PERIOD].iter().enumerate().filter(|(_, dn)| **dn != 0.0) {
        add_bit(signals, pedestal_dn, weight_dn, codes, bit);
    }
}

/// Where a bit changes, the noise makes an edge that is so many of all codes wide, from the middle: of 4096 codes 8, as noise of some 5 makes it.
const EDGE: f64 = 1.0 / 512.0;

/// Adds what is wrong with the weight of a `bit`, of which 0 is the first one, of so many `codes`: half of it where it is set, and takes half of it where it is not.
fn add_bit(signals: &mut [f64], pedestal_dn: f64, weight_dn: f64, codes: f64, bit: usize) {
    let period_dn = codes / (1_u64 << bit) as f64;
    let steep = period_dn / (EDGE * codes);
    widest!((signals: &'a mut [f64], pedestal_dn: f64, weight_dn: f64, period_dn: f64, steep: f64) {
        for signal in signals {
            let place = (*signal + pedestal_dn) / period_dn;
            // From the middle of the half of the period in which it is set.
            let off = (place - libm::floor(place) - 0.75).abs();
            let set = steep * (0.25 - off.min(1.0 - off));
            *signal += 0.5 * weight_dn * set.clamp(-1.0, 1.0);
        }
    });
}

/// Adds a wave of these parts and all its `harmonics`.
fn add_form(
    signals: &mut [f64],
    pedestal_dn: f64,
    [cosine_dn, sine_dn]: [f64; 2],
    period_dn: f64,
    harmonics: [f64; HARMONICS],
) {
    // The wave is its size times sin(x), and so is what it is a quarter of a period later of cos(x).
    let size_dn = libm::hypot(cosine_dn, sine_dn);
    if size_dn == 0.0 {
        return;
    }
    let (of_cosine, of_sine) = (cosine_dn / size_dn, sine_dn / size_dn);
    widest!((signals: &'a mut [f64], pedestal_dn: f64, of_cosine: f64, of_sine: f64, size_dn: f64, period_dn: f64,
             harmonics: [f64; HARMONICS]) {
        for signal in signals {
            let (cosine, sine) = cos_sin(TAU * (*signal + pedestal_dn) / period_dn);
            let (wave, later) = (of_cosine * cosine + of_sine * sine, of_sine * cosine - of_cosine * sine);
            // sin((n + 1) x) = 2 cos(x) sin(n x) - sin((n - 1) x)
            let (mut before, mut now, mut sum) = (0.0, wave, 0.0);
            for harmonic in harmonics {
                sum += harmonic * now;
                (before, now) = (now, 2.0 * later * now - before);
            }
            *signal += size_dn * sum;
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

    /// Of 4096 codes the first bit is set from 2048 on, the third one in every other run of 512.
    #[test]
    fn a_bit_is_set_where_it_is() {
        let shown = |bit: usize, code: f64| {
            let mut signal = [code - 64.0];
            add_bit(&mut signal, 64.0, 3.0, 4096.0, bit);
            signal[0] - (code - 64.0)
        };
        for (bit, of) in [(0, 2048), (2, 512), (5, 64)] {
            for code in (10..4096).step_by(20).filter(|code| (8..of - 8).contains(&(code % of))) {
                let is_set = code / of % 2 == 1;
                let expected = if is_set { 1.5 } else { -1.5 };
                assert!((shown(bit, f64::from(code)) - expected).abs() < 1e-9, "bit {bit} of {code}");
            }
        }
        assert!(shown(0, 2048.0).abs() < 1e-9 && (shown(0, 2052.0) - 0.75).abs() < 1e-9);
    }

    /// By the closed forms, a quarter of a period and more away from where they jump: within what the harmonics beyond the twelfth are there.
    #[test]
    fn forms_are_what_they_are_called() {
        let shown = |form: f64, share: f64| {
            let mut signal = [share * 100.0];
            add_form(&mut signal, 0.0, [0.0, 2.0], 100.0, harmonics(form).unwrap());
            (signal[0] - share * 100.0) / 2.0
        };
        for share in [0.25, 0.3, 0.4, 0.6, 0.75] {
            let x = TAU * share;
            let is = |form: f64, expected: f64| {
                let found = shown(form, share);
                assert!((found - expected).abs() < 0.12, "{form} at {share}: {found}, not {expected}");
            };
            is(1.0, FRAC_PI_4 * (0.5 - share).signum());
            is(0.5, (PI - x) / 2.0);
            is(-0.5, if share < 0.5 { x / 2.0 } else { (x - TAU) / 2.0 });
            is(-1.0, FRAC_PI_4 * (FRAC_PI_2 - (x - FRAC_PI_2).abs()));
        }
    }
}
