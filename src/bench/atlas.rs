//! What an effect does to perfect data: its residual over phase, distance, frame and pixel.

use super::camera::{chain, practice_camera, sensor};
use super::course::Course;
use super::injection::included_without;
use super::simulation::Simulation;
use crate::frames::Geometry;
use crate::physics::{Active, Chain, Effect, FREQUENCY_HZ, Pixels, Sensor, Stage};
use crate::recording::{Camera, Kind, SetRow};
use crate::spec::{SCHEMES, Scheme};
use crate::units::{range_m, unambiguous_range_m, wrap_rad};
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A curve: what it is of, and its points.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// What is different from the other curves.
    pub label: &'static str,
    /// Abscissa and ordinate.
    pub points: Vec<(f64, f64)>,
}

/// What an effect changes for one scheme: with the effect less without it.
#[derive(Debug, Clone, PartialEq)]
pub struct Residuals {
    /// The scheme.
    pub scheme: String,
    /// Error of the range, mm, over the phase in turns, the phase offset stepped: still, and moving both ways.
    pub over_phase: Vec<Line>,
    /// The same over the distance in m: still, and moving both ways.
    pub over_distance: Vec<Line>,
    /// Change of the raw frames, DN, over the frame's number: root mean square over a phase sweep and the target's pixels.
    pub over_frame: Vec<Line>,
    /// Error of the range, mm, `[row, column]`, of a still target.
    pub over_pixels: Vec<f64>,
    /// The largest error of the range, mm, as a root mean square over the target's pixels, of all points of the curves. Theirs is the
    /// mean over those pixels, in which a slope over the image cancels.
    pub largest_rms_mm: f64,
}

impl Residuals {
    /// The largest error of the range in mm, of all curves.
    pub fn largest_mm(&self) -> f64 {
        let curves = self.over_phase.iter().chain(&self.over_distance).flat_map(|line| &line.points);
        curves.fold(0.0, |most, (_, mm)| mm.abs().max(most))
    }
}

/// A camera whose data are perfect: a sinusoidal correlation, no noise, and nothing that its simulation would not know.
#[derive(Debug, Clone)]
pub struct Atlas {
    camera: Camera,
    sensor: Sensor,
    pixels: Arc<Pixels>,
}

/// With an effect, and without.
struct Pair {
    flawed: Chain,
    perfect: Chain,
}

/// Phasors Σ c_n I_n of all sets and pixels, `[set][pixel]`, of the signals that `chain` makes, without noise.
pub fn phasors(chain: &Chain, sensor: &Sensor, scheme: &Scheme, course: &Course) -> Vec<Vec<Complex64>> {
    let simulation = Simulation { chain, sensor, noise: false, seed: 1, recording: 0 };
    let coefficients = scheme.true_coefficients();
    let of_set = |set: usize| {
        let mut sums = vec![Complex64::ZERO; chain.pixels.count()];
        for (frame, coefficient) in coefficients.iter().enumerate() {
            let signal = simulation.signal(course, set * course.frames() + frame);
            sums.iter_mut().zip(&signal).for_each(|(sum, signal)| *sum += coefficient * signal);
        }
        sums
    };
    (0..course.sets.len()).into_par_iter().map(of_set).collect()
}

const GEOMETRY: Geometry = Geometry { width: 24, height: 18 };
const FRAME_PERIOD_S: f64 = 0.025;
const STILL_M: f64 = 2.0;
const OFFSETS: usize = 96;
const FROM_M: f64 = 1.0;
const TO_M: f64 = 4.0;
const POSITIONS: usize = 121;
const VELOCITIES_M_S: [(&str, f64); 3] = [("still", 0.0), ("+1 m/s", 1.0), ("\u{2212}1 m/s", -1.0)];

impl Default for Atlas {
    fn default() -> Self {
        let mut camera = practice_camera(GEOMETRY);
        camera.correlation_amplitude.truncate(1);
        camera.correlation_phase_rad.truncate(1);
        let sensor = sensor(&camera);
        let pixels = Arc::new(Stage::bench().pixels(&sensor, 1));
        Self { camera, sensor, pixels }
    }
}

impl Atlas {
    /// Columns and rows of [`Residuals::over_pixels`].
    pub fn geometry(&self) -> Geometry {
        self.pixels.geometry
    }

    /// Residuals of `effect` at the size of [`Effect::example`], a scheme after the other.
    pub fn residuals(&self, effect: &'static Effect) -> Vec<Residuals> {
        let active = vec![Active { effect, values: effect.example() }];
        let camera = included_without(self.camera.clone(), &active);
        let of = |effects| chain(&camera, Arc::clone(&self.pixels), effects);
        let pair = Pair { flawed: of(active), perfect: of(Vec::new()) };
        SCHEMES.iter().map(|scheme| self.of_scheme(&pair, scheme)).collect()
    }

    fn of_scheme(&self, pair: &Pair, scheme: &Scheme) -> Residuals {
        let offset_rad = |n: usize| n as f64 * TAU / OFFSETS as f64;
        let sweep =
            |velocity_m_s| course(scheme, (0..OFFSETS).map(|n| (STILL_M, velocity_m_s, offset_rad(n))));
        let turns = STILL_M / unambiguous_range_m(FREQUENCY_HZ);
        let mut largest_rms_mm: f64 = 0.0;
        let mut mean = |errors: &[f64]| {
            let squares: Vec<f64> = errors.iter().map(|error| error * error).collect();
            largest_rms_mm = largest_rms_mm.max(self.mean(&squares).sqrt());
            self.mean(errors)
        };
        let over_phase = VELOCITIES_M_S.map(|(label, velocity_m_s)| {
            let errors = self.errors_mm(pair, scheme, &sweep(velocity_m_s)).into_iter().enumerate();
            let phase = |n: usize| (turns - n as f64 / OFFSETS as f64).rem_euclid(1.0);
            let mut points: Vec<_> = errors.map(|(n, error)| (phase(n), mean(&error))).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            Line { label, points }
        });
        let position_m = |n: usize| FROM_M + n as f64 * (TO_M - FROM_M) / (POSITIONS - 1) as f64;
        let over_distance = VELOCITIES_M_S.map(|(label, velocity_m_s)| {
            let course = course(scheme, (0..POSITIONS).map(|n| (position_m(n), velocity_m_s, 0.0)));
            let errors = self.errors_mm(pair, scheme, &course);
            let points = errors.iter().enumerate().map(|(n, error)| (position_m(n), mean(error)));
            Line { label, points: points.collect() }
        });
        let changes = |(label, velocity_m_s): (&'static str, f64)| Line {
            label,
            points: self.changes_dn(pair, &sweep(velocity_m_s)),
        };
        let still = course(scheme, [(STILL_M, 0.0, 0.0)].into_iter());
        Residuals {
            scheme: scheme.name.to_string(),
            over_phase: over_phase.into(),
            over_distance: over_distance.into(),
            over_frame: VELOCITIES_M_S[..2].iter().copied().map(changes).collect(),
            over_pixels: self.errors_mm(pair, scheme, &still).concat(),
            largest_rms_mm,
        }
    }

    /// Errors of the range, mm, `[set][pixel]`.
    fn errors_mm(&self, pair: &Pair, scheme: &Scheme, course: &Course) -> Vec<Vec<f64>> {
        let [flawed, perfect] =
            [&pair.flawed, &pair.perfect].map(|chain| phasors(chain, &self.sensor, scheme, course));
        let error = |(flawed, perfect): (&Complex64, &Complex64)| {
            1e3 * range_m(wrap_rad(flawed.arg() - perfect.arg()), course.frequency_hz)
        };
        let sets = flawed.iter().zip(&perfect);
        sets.map(|(flawed, perfect)| flawed.iter().zip(perfect).map(error).collect()).collect()
    }

    /// Mean over the target's pixels.
    fn mean(&self, values: &[f64]) -> f64 {
        let target = &self.pixels.target;
        let (sum, count) = values
            .iter()
            .zip(target)
            .filter(|(_, sees)| **sees)
            .fold((0.0, 0.0), |(sum, count), (value, _)| (sum + value, count + 1.0));
        sum / count
    }

    fn changes_dn(&self, pair: &Pair, course: &Course) -> Vec<(f64, f64)> {
        let simulation =
            |chain| Simulation { chain, sensor: &self.sensor, noise: false, seed: 1, recording: 0 };
        let squares = |index: usize| {
            let [flawed, perfect] =
                [&pair.flawed, &pair.perfect].map(|chain| simulation(chain).signal(course, index));
            let squares: Vec<f64> = flawed.iter().zip(&perfect).map(|(a, b)| (a - b) * (a - b)).collect();
            self.mean(&squares)
        };
        let squares: Vec<f64> = (0..course.count()).into_par_iter().map(squares).collect();
        let sets = course.sets.len() as f64;
        let of_frame = |frame: usize| squares.iter().skip(frame).step_by(course.frames()).sum::<f64>() / sets;
        (0..course.frames()).map(|frame| (frame as f64, of_frame(frame).sqrt())).collect()
    }
}

/// Sets at (position, velocity, offset), back to back.
fn course(scheme: &Scheme, places: impl Iterator<Item = (f64, f64, f64)>) -> Course {
    let set_s = scheme.steps() as f64 * FRAME_PERIOD_S;
    let row = |(set, (position_m, velocity_m_s, phase_offset_rad)): (usize, (f64, f64, f64))| SetRow {
        time_s: set as f64 * set_s,
        position_m: Some(position_m),
        velocity_m_s,
        phase_offset_rad,
        extra: Vec::new(),
    };
    Course {
        kind: Kind::Other,
        frequency_hz: FREQUENCY_HZ,
        steps_rad: (0..scheme.steps()).map(|step| scheme.angle_rad(step)).collect(),
        frame_period_s: FRAME_PERIOD_S,
        sets: places.enumerate().map(row).collect(),
        frame_times_s: None,
    }
}
