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

/// An error that is periodic in the code: its parts, and its period; a wave (0); what a bit of a wrong weight makes, a square wave (1, from top to bottom
/// pi / 2 times this fundamental); a triangle (-1); or what a stage of a wrong gain makes, a sawtooth that falls slowly and rises at once (0.5), or the other
/// way round (-0.5). Up to the twelfth harmonic: the noise leaves little of higher ones.
pub static EFFECT: Effect = Effect {
    name: "adc_nonlinearity",
    sentence: "The converter's code is off by an amount that repeats with the code (integral non-linearity of its stages).",
    reference: "code -> code + a cos(2 pi code / p) + b sin(2 pi code / p)",
    parameters: &[
        Parameter::strength("cosine_dn", "DN", 0.0, (-50.0, 50.0), 1.0).within_full_scales(MOST),
        Parameter::strength("sine_dn", "DN", 0.0, (-50.0, 50.0), 1.0).within_full_scales(MOST),
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
        (exposure.pixels.pedestal_dn, values[0], values[1], values[2]);
    let signals: &mut [f64] = &mut exposure.signal_dn;
    match harmonics(values[3]) {
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
