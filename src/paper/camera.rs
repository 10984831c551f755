//! The camera as these experiments need it: one pixel of the simulator before the target on the rail.

use crate::algorithms::{Algorithm, named};
use crate::frames::Geometry;
use crate::physics::{
    Active, Chain, Correlation, Draws, FREQUENCY_HZ, Included, Memory, Moment, Pixels, Sensor,
};
use crate::problem::{Problem, Result};
use crate::units::{phase_rad, range_m, wrap_rad};
use std::f64::consts::PI;
use std::sync::Arc;

/// What a measurement of the motion experiments takes, s.
pub const MEASUREMENT_S: f64 = 0.125;
/// Amplitude of a frame with the target at 1 m, DN: assumed. It fills the converter at some 0.8 m.
const AMPLITUDE_1M_DN: f64 = 1200.0;
const AMBIENT_DN: f64 = 100.0;

/// Two square waves correlate to a triangle whose mean is π²/8 of its fundamental.
pub const SQUARE_WAVES_RATIO: f64 = PI * PI / 8.0;

/// What is assumed of waveform and light.
#[derive(Debug, Clone)]
pub struct Conditions {
    /// The correlation waveform.
    pub correlation: Correlation,
    /// Whether the light falls off as the target moves within a set; from set to set it always does.
    pub falloff: bool,
    /// The constant part of the camera's own light over its modulated part.
    pub constant_ratio: f64,
    /// What else acts.
    pub effects: Vec<Active>,
}

impl Conditions {
    /// A pure sine, and nothing else.
    pub fn sinusoidal() -> Self {
        let constant_ratio = SQUARE_WAVES_RATIO;
        Self { correlation: Correlation::sinusoidal(), falloff: false, constant_ratio, effects: Vec::new() }
    }

    /// Table I's harmonics, their phases 0.
    pub fn table_1() -> Self {
        Self { correlation: Correlation::measured(), ..Self::sinusoidal() }
    }
}

/// An algorithm with what the experiments call it.
#[derive(Debug, Clone, PartialEq)]
pub struct Method {
    /// Its name in tables and legends.
    pub name: &'static str,
    /// Its weights.
    pub algorithm: Algorithm,
    /// The phase step of each frame, rad.
    pub steps_rad: Vec<f64>,
}

impl Method {
    /// The row `row` of the table of algorithms.
    ///
    /// # Errors
    /// No such row: a slip in this module.
    pub fn of(name: &'static str, row: &str) -> Result<Self> {
        let missing = || {
            Problem::at("the table of algorithms", format_args!("{row} is none of its rows")).expected("wdft")
        };
        let algorithm = named(row)?.ok_or_else(missing)?;
        let steps_rad = algorithm.polynomial.angles_rad().to_vec();
        Ok(Self { name, algorithm, steps_rad })
    }

    /// The paper's two: four frames, and the windowed DFT with N = 3.
    ///
    /// # Errors
    /// As [`Method::of`].
    pub fn both() -> Result<[Self; 2]> {
        Ok([Self::of("four frames", "four_frame")?, Self::of("WDFT", "wdft")?])
    }

    /// From the start of a frame to the start of the next, s, where frames fill [`MEASUREMENT_S`].
    pub fn frame_period_s(&self) -> f64 {
        MEASUREMENT_S / self.steps_rad.len() as f64
    }

    /// Measured range less `true_m`, m, within half the unambiguous range.
    pub fn error_m(&self, frames: &[f64], true_m: f64, frequency_hz: f64) -> f64 {
        let found_rad = self.algorithm.vector(frames).arg();
        range_m(wrap_rad(found_rad - phase_rad(true_m, frequency_hz)), frequency_hz)
    }
}

/// How a set is taken.
#[derive(Debug, Clone)]
pub struct Set {
    /// Range at the set's start, m, > 0.
    pub range_m: f64,
    /// Velocity away from the camera, m/s.
    pub velocity_m_s: f64,
    /// Phase offset of all frames, rad.
    pub offset_rad: f64,
    /// Modulation frequency, Hz.
    pub frequency_hz: f64,
    /// Start of each frame, s, from the set's start.
    pub starts_s: Vec<f64>,
}

impl Set {
    /// Of a still target.
    pub fn still(method: &Method, range_m: f64) -> Self {
        Self::moving(method, range_m, 0.0)
    }

    /// Of a target that moves, the frames filling [`MEASUREMENT_S`] in their usual order.
    pub fn moving(method: &Method, range_m: f64, velocity_m_s: f64) -> Self {
        let period_s = method.frame_period_s();
        let starts_s = (0..method.steps_rad.len()).map(|n| n as f64 * period_s).collect();
        Self { range_m, velocity_m_s, offset_rad: 0.0, frequency_hz: FREQUENCY_HZ, starts_s }
    }
}

/// One pixel of the camera.
#[derive(Debug, Clone)]
pub struct Camera(Chain);

impl Camera {
    /// Under `conditions`.
    pub fn new(conditions: Conditions) -> Self {
        let Conditions { correlation, falloff, constant_ratio, effects } = conditions;
        let sensor = sensor();
        let pixels = Pixels {
            geometry: Geometry { width: 1, height: 1 },
            target: vec![true],
            obliquity: vec![1.0],
            background_m: vec![1.0],
            phase_rad: vec![0.0],
            at_frequencies: Vec::new(),
            amplitude_1m_dn: vec![AMPLITUDE_1M_DN],
            constant_1m_dn: vec![constant_ratio * AMPLITUDE_1M_DN],
            ambient_dn: vec![AMBIENT_DN].into(),
            full_scale_dn: sensor.full_scale_dn(),
            pedestal_dn: sensor.pedestal_dn,
            edges: Vec::new(),
            edge_counts: vec![0.0],
        };
        let included = Included { axial_motion: true, inverse_square_falloff: falloff };
        Self(Chain::new(Arc::new(pixels), correlation, included, effects))
    }

    /// A set's frames at the steps `steps_rad`, DN above the pedestal, without noise.
    pub fn frames_dn(&self, steps_rad: &[f64], set: &Set) -> Vec<f64> {
        let frame = |(frame, (&step_rad, &in_set_s)): (usize, (&f64, &f64))| {
            let moment = Moment {
                set: 0,
                frame,
                frames: steps_rad.len(),
                time_s: in_set_s,
                in_set_s,
                frame_period_s: MEASUREMENT_S / steps_rad.len() as f64,
                step_rad,
                offset_rad: set.offset_rad,
                position_m: set.range_m,
                place_m: set.range_m,
                velocity_m_s: set.velocity_m_s,
                frequency_hz: set.frequency_hz,
                lit: true,
                transmission: 1.0,
            };
            self.0.expose(moment, Memory::default()).signal_dn[0]
        };
        steps_rad.iter().zip(&set.starts_s).enumerate().map(frame).collect()
    }

    /// Measured range less that at the set's start, m; the set's offset is not in it.
    pub fn error_m(&self, method: &Method, set: &Set) -> f64 {
        let frames = self.frames_dn(&method.steps_rad, set);
        let true_m = set.range_m - range_m(set.offset_rad, set.frequency_hz);
        method.error_m(&frames, true_m, set.frequency_hz)
    }
}

/// Converter and noise: those of the simulator's camera, which the paper does not tell.
fn sensor() -> Sensor {
    Sensor::vuris()
}

/// The mean of `repeats` readings of each of `frames_dn`, with shot noise, read noise, rounding and clipping.
pub fn read(frames_dn: &[f64], repeats: usize, draws: &mut Draws) -> Vec<f64> {
    let sensor = sensor();
    let reading = |frame_dn: &f64| {
        let codes = draws.normal(repeats).into_iter();
        let codes = codes.map(|deviate| sensor.noisy_code(frame_dn * sensor.gain_e_per_dn, deviate));
        codes.map(f64::from).sum::<f64>() / repeats as f64 - sensor.pedestal_dn
    };
    frames_dn.iter().map(reading).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The paper's frames: I_n = A cos((n − 1) δ − φ) + B, and a range that is measured as it is.
    #[test]
    fn a_sine_is_measured_without_error() {
        let camera = Camera::new(Conditions::sinusoidal());
        for method in Method::both().unwrap() {
            for n in 1..40 {
                let set = Set { offset_rad: 0.7, ..Set::still(&method, 0.11 * f64::from(n)) };
                assert!(camera.error_m(&method, &set).abs() < 1e-9, "{}", method.name);
            }
        }
    }

    #[test]
    fn readings_are_clipped_rounded_and_averaged() {
        let mut draws = Draws::of(1, 2);
        let read = read(&[1000.0, 1e6], 10_000, &mut draws);
        // Shot noise of 100 000 e and read noise of 100 e: 3.3 DN, a hundredth of it in the mean.
        assert!((read[0] - 1000.0).abs() < 0.15, "{read:?}");
        assert_eq!(read[1], sensor().full_scale_dn());
    }
}
