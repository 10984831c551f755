//! What is asked of a unit: a largest error, or a share of the sensor's own noise.

use super::figures::Row;
use crate::physics::{Light, Sensor};
use crate::problem::{Problem, Result};
use crate::spec::Pipeline;
use crate::units::unambiguous_range_m;
use std::f64::consts::TAU;

/// The phase noise that the sensor brings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorNoise {
    /// Standard deviation of the phase, turns.
    pub turns: f64,
    /// Octave of the sums' vector at this amplitude.
    pub octave: u32,
}

impl SensorNoise {
    /// The noise of a pixel with `light` in a raw frame, for the scheme and frames a step of `pipeline`.
    ///
    /// A raw frame's variance is the mean charge (shot noise; A cos averages to 0 over the phase) plus the read noise squared; M frames
    /// a step divide it by M; the scheme makes σ_φ = noise factor · σ / A of it (`Scheme::noise_factor`).
    ///
    /// # Errors
    /// An amplitude that is not positive, or so weak that the sums hold no vector.
    pub fn of(pipeline: &Pipeline, sensor: &Sensor, light: Light) -> Result<Self> {
        let refuse = |found: String| {
            Problem::at("--add-noise", found)
                .expected("an amplitude of a code or more, and an offset not below 0")
        };
        let Light { amplitude_e, offset_e } = light;
        let amplitude_dn = amplitude_e / sensor.gain_e_per_dn;
        if !(amplitude_dn >= 1.0 && amplitude_dn.is_finite() && offset_e >= 0.0 && offset_e.is_finite()) {
            return Err(refuse(format!(
                "amplitude {amplitude_dn} DN, offset {} DN",
                offset_e / sensor.gain_e_per_dn
            )));
        }
        let frames = pipeline.modulation.frames_per_step as f64;
        let scheme = &pipeline.modulation.scheme;
        let sigma_e = ((offset_e + sensor.read_noise_e * sensor.read_noise_e) / frames).sqrt();
        let length = scheme.gain * frames * amplitude_dn;
        Ok(Self {
            turns: scheme.noise_factor() * sigma_e / amplitude_e / TAU,
            octave: length.log2().floor() as u32,
        })
    }
}

/// What a unit must hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Requirement {
    /// No vector is further off, turns.
    Error {
        /// The limit, turns.
        turns: f64,
    },
    /// √(noise² + RMS²) exceeds the noise by at most this share of it, in the noise's octave of the amplitude.
    AddedNoise {
        /// Such as 0.01.
        share: f64,
        /// What the sensor brings.
        noise: SensorNoise,
    },
}

impl Requirement {
    /// Reads a largest error: a number with `mrad`, `rad`, `deg`, `turn`, or `mm`, `m` at the modulation frequency.
    pub fn error(text: &str, frequency_hz: f64) -> Result<Self> {
        let refuse = || {
            Problem::at("--error", format_args!("\"{text}\""))
                .expected("a positive number with mrad, rad, deg, turn, mm or m, such as 0.1mrad")
        };
        let unit_at = text.find(|c: char| c.is_ascii_alphabetic() && c != 'e').unwrap_or(text.len());
        let value: f64 = text[..unit_at].trim().parse().map_err(|_| refuse())?;
        let turn_m = unambiguous_range_m(frequency_hz);
        let turns = match &text[unit_at..] {
            "mrad" => value * 1e-3 / TAU,
            "rad" => value / TAU,
            "deg" => value / 360.0,
            "turn" => value,
            "mm" => value * 1e-3 / turn_m,
            "m" => value / turn_m,
            _ => return Err(refuse()),
        };
        if turns > 0.0 && turns < 0.5 { Ok(Self::Error { turns }) } else { Err(refuse()) }
    }

    /// Reads a share such as `1%` or `0.01`.
    pub fn share(text: &str) -> Result<f64> {
        let value = match text.strip_suffix('%') {
            Some(percent) => percent.trim().parse::<f64>().map(|percent| percent / 100.0),
            None => text.parse(),
        };
        value.ok().filter(|share| (1e-6..=1.0).contains(share)).ok_or_else(|| {
            Problem::at("--add-noise", format_args!("\"{text}\"")).expected("0.0001% to 100%, such as 1%")
        })
    }

    /// Whether a unit with these errors holds it.
    pub fn is_met(&self, rows: &[Row]) -> bool {
        match *self {
            Self::Error { turns } => rows.first().is_some_and(|row| row.figures.max_turns <= turns),
            Self::AddedNoise { share, noise } => {
                Self::added_noise(rows, noise).is_some_and(|added| added <= share)
            }
        }
    }

    /// By what share of the sensor's noise a unit with these errors adds to it.
    pub fn added_noise(rows: &[Row], noise: SensorNoise) -> Option<f64> {
        let row = rows.iter().find(|row| row.octave == Some(noise.octave))?;
        Some((row.figures.rms_turns / noise.turns).hypot(1.0) - 1.0)
    }

    /// The least phase bits with which it can be met at all: an even spread over a code, or half a code at the worst.
    pub fn least_phase_bits(&self) -> u32 {
        let code_turns = match *self {
            Self::Error { turns } => 2.0 * turns,
            Self::AddedNoise { share, noise } => {
                12f64.sqrt() * noise.turns * ((1.0 + share) * (1.0 + share) - 1.0).sqrt()
            }
        };
        (-code_turns.log2()).ceil().max(0.0) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_and_shares_are_read_with_their_units() {
        let turns = |text| match Requirement::error(text, 30e6) {
            Ok(Requirement::Error { turns }) => turns,
            other => panic!("{text}: {other:?}"),
        };
        assert!((turns("0.1mrad") - 1e-4 / TAU).abs() < 1e-12);
        assert!((turns("1e-4rad") - 1e-4 / TAU).abs() < 1e-12);
        assert!((turns("3.6deg") - 0.01).abs() < 1e-12);
        // 299792458 / 60e6 = 4.99654 m a turn.
        assert!((turns("4.99654mm") - 1e-3).abs() < 1e-8);
        for text in ["", "1", "mrad", "-1mrad", "0mm", "1km", "NaNm", "inf m", "0.6turn"] {
            assert!(Requirement::error(text, 30e6).is_err(), "{text}");
        }
        assert_eq!((Requirement::share("1%").unwrap(), Requirement::share("0.25").unwrap()), (0.01, 0.25));
        for text in ["", "%", "-1%", "0", "200%", "NaN"] {
            assert!(Requirement::share(text).is_err(), "{text}");
        }
    }

    /// Four frames, 100 DN of amplitude at 1 e/DN, 400 e of offset, no read noise: σ = 20 e, σ_φ = 20/(100 √2) rad; the sums' vector
    /// is 200 long: octave 7.
    #[test]
    fn noise_by_hand() {
        let pipeline = Pipeline::named("vuris-four-frame").unwrap();
        let sensor = Sensor { gain_e_per_dn: 1.0, read_noise_e: 0.0, ..Sensor::vuris() };
        let light = Light { amplitude_e: 100.0, offset_e: 400.0 };
        let noise = SensorNoise::of(&pipeline, &sensor, light).unwrap();
        assert!((noise.turns * TAU - 20.0 / 100.0 / 2f64.sqrt()).abs() < 1e-12);
        assert_eq!(noise.octave, 7);
        let read = Sensor { read_noise_e: 20.0, ..sensor.clone() };
        let louder = SensorNoise::of(&pipeline, &read, light).unwrap();
        assert!((louder.turns / noise.turns - 2f64.sqrt()).abs() < 1e-12);
        for (amplitude_e, offset_e) in [(0.0, 1.0), (-5.0, 1.0), (f64::NAN, 1.0), (100.0, -1.0)] {
            assert!(SensorNoise::of(&pipeline, &sensor, Light { amplitude_e, offset_e }).is_err());
        }
    }

    /// Quantisation alone: q/√12 RMS, and 1 % more noise means RMS = noise · √(1.01² − 1).
    #[test]
    fn the_least_phase_bits_by_hand() {
        assert_eq!(Requirement::Error { turns: 1.0 / 65536.0 }.least_phase_bits(), 15);
        assert_eq!(Requirement::Error { turns: 0.99 / 65536.0 }.least_phase_bits(), 16);
        let noise = SensorNoise { turns: 1e-3, octave: 5 };
        // code ≤ √12 · 0.14177e-3 = 4.911e-4 turn: 2^-11 = 4.88e-4.
        assert_eq!(Requirement::AddedNoise { share: 0.01, noise }.least_phase_bits(), 11);
    }
}
