//! How a phase moves when something disturbs the frames: by simulation, over a whole turn of phases.

use super::table::Algorithm;
use crate::units::wrap_rad;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// What is wrong with the frames I_n = A cos(angle_n − φ) + B.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Disturbance {
    /// A harmonic of the waveform: its number and its share of the fundamental's amplitude.
    pub harmonic: (usize, f64),
    /// Relative error of every angle.
    pub step_error: f64,
    /// Phase that the object's motion adds from each frame to the next, rad.
    pub motion_rad: f64,
    /// Relative change of the amplitude from each frame to the next, of the first frame's.
    pub amplitude_drift: f64,
    /// Change of the offset from each frame to the next, in parts of the amplitude.
    pub offset_drift: f64,
}

/// What becomes of the phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhaseError {
    /// The mean over all phases, rad: motion's choice of a reference frame, say.
    pub mean_rad: f64,
    /// RMS around the mean, rad.
    pub rms_rad: f64,
    /// Largest distance from the mean, rad.
    pub peak_rad: f64,
}

/// Phases of a turn that are simulated: a prime, in no ratio with any step's parts. Those that estimate the step have narrow
/// peaks where the radicand changes its sign.
const fn phases(linear: bool) -> u32 {
    if linear { 719 } else { 7193 }
}

impl Disturbance {
    /// Intensity of the frame `n` at `angle_rad`: amplitude 1, offset 2.
    fn frame(&self, n: usize, angle_rad: f64, phase_rad: f64) -> f64 {
        let n = n as f64;
        let phase_rad = phase_rad + n * self.motion_rad;
        let argument = angle_rad * (1.0 + self.step_error) - phase_rad;
        let (harmonic, share) = self.harmonic;
        let wave = argument.cos() + share * (harmonic as f64 * argument).cos();
        (1.0 + n * self.amplitude_drift) * wave + 2.0 + n * self.offset_drift
    }

    /// The error at `phase_rad`, rad, −π to π.
    pub fn error_rad(&self, algorithm: &Algorithm, phase_rad: f64) -> f64 {
        let frames: Vec<f64> = algorithm
            .polynomial
            .angles_rad()
            .iter()
            .enumerate()
            .map(|(n, &angle)| self.frame(n, angle, phase_rad))
            .collect();
        (algorithm.vector(&frames) * Complex64::from_polar(1.0, -phase_rad)).arg()
    }

    /// The errors over a turn of phases, their mean that of unit vectors.
    pub fn error(&self, algorithm: &Algorithm) -> PhaseError {
        let phases = phases(algorithm.estimator.is_none());
        let errors: Vec<f64> = (0..phases)
            .map(|k| self.error_rad(algorithm, TAU * (f64::from(k) + 0.25) / f64::from(phases)))
            .collect();
        let mean_rad = errors.iter().map(|&error| Complex64::from_polar(1.0, error)).sum::<Complex64>().arg();
        let away = || errors.iter().map(|error| wrap_rad(error - mean_rad));
        PhaseError {
            mean_rad,
            rms_rad: (away().map(|error| error * error).sum::<f64>() / f64::from(phases)).sqrt(),
            peak_rad: away().map(f64::abs).fold(0.0, f64::max),
        }
    }
}

/// A curve's quantity, and the values at which it is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Curve {
    /// 1 % of each harmonic.
    Harmonic,
    /// The relative step error in per cent.
    StepError,
    /// The object's velocity in m/s.
    Velocity,
    /// The amplitude's relative drift a frame in per cent.
    AmplitudeDrift,
    /// The offset's drift a frame in per cent of the amplitude.
    OffsetDrift,
}

impl Curve {
    /// All curves.
    pub const ALL: [Self; 5] =
        [Self::Harmonic, Self::StepError, Self::Velocity, Self::AmplitudeDrift, Self::OffsetDrift];

    /// Name and unit of its axis.
    pub const fn axis(self) -> (&'static str, &'static str) {
        match self {
            Self::Harmonic => ("harmonic", "number, at 1 % of the fundamental"),
            Self::StepError => ("step error", "%"),
            Self::Velocity => ("velocity", "m/s"),
            Self::AmplitudeDrift => ("amplitude drift", "% a frame"),
            Self::OffsetDrift => ("offset drift", "% of the amplitude a frame"),
        }
    }

    /// The axis' values.
    fn values(self) -> Vec<f64> {
        let around = |most: f64, steps: i32| {
            (-steps..=steps).map(|k| most * f64::from(k) / f64::from(steps)).collect::<Vec<_>>()
        };
        match self {
            Self::Harmonic => (2..=super::verdict::MOST_HARMONIC).map(|m| m as f64).collect(),
            Self::StepError => around(20.0, 20),
            Self::Velocity => around(4.0, 16),
            Self::AmplitudeDrift | Self::OffsetDrift => around(5.0, 10),
        }
    }

    /// The curve of `algorithm`: values with errors. `turns_a_metre` is the phase of a metre of range in turns, and
    /// `frame_s` the time from one frame to the next: what makes a phase of a velocity.
    pub fn of(self, algorithm: &Algorithm, turns_a_metre: f64, frame_s: f64) -> Vec<(f64, PhaseError)> {
        let disturbance = |value: f64| match self {
            Self::Harmonic => Disturbance { harmonic: (value as usize, 0.01), ..Disturbance::default() },
            Self::StepError => Disturbance { step_error: value / 100.0, ..Disturbance::default() },
            Self::Velocity => {
                Disturbance { motion_rad: TAU * turns_a_metre * value * frame_s, ..Disturbance::default() }
            }
            Self::AmplitudeDrift => Disturbance { amplitude_drift: value / 100.0, ..Disturbance::default() },
            Self::OffsetDrift => Disturbance { offset_drift: value / 100.0, ..Disturbance::default() },
        };
        self.values().into_iter().map(|value| (value, disturbance(value).error(algorithm))).collect()
    }
}
