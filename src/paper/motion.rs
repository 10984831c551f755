//! Motion: the paper's procedure, static calibration subtracted and mean removed.

use super::camera::{Camera, MEASUREMENT_S, Method, Set, read};
use super::linearity::SEED;
use super::residual::{mean, rms, span, without_mean};
use crate::physics::{Draws, FREQUENCY_HZ};

/// The carriage's velocity in the measurements, m/s.
pub const VELOCITY_M_S: f64 = 2.0;
/// Where a measurement may begin, m.
const FROM_M: f64 = 1.0;
const TO_M: f64 = 3.0;
/// From one place to the next of [`error_curve`], m.
const SPACING_M: f64 = 0.01;
const RUNS: usize = 100;
const CALIBRATIONS: usize = 5;
const NOISE_STREAM: u64 = 3;

/// The places at which [`error_curve`] begins a measurement, m.
pub fn places_m() -> Vec<f64> {
    let count = ((TO_M - FROM_M) / SPACING_M).round() as u32;
    (0..=count).map(|n| FROM_M + f64::from(n) * SPACING_M).collect()
}

/// Error of a measurement that begins at `place_m` with the static error subtracted, m: what the encoder says there is the reference.
pub fn moved_error_m(camera: &Camera, method: &Method, place_m: f64, velocity_m_s: f64) -> f64 {
    let moving = camera.error_m(method, &Set::moving(method, place_m, velocity_m_s));
    moving - camera.error_m(method, &Set::still(method, place_m))
}

/// Place and error, m, of measurements that begin anywhere from 1 to 3 m, without noise: static error and mean removed.
pub fn error_curve(camera: &Camera, method: &Method, velocity_m_s: f64) -> Vec<(f64, f64)> {
    let places_m = places_m();
    let errors_m = places_m.iter().map(|place_m| moved_error_m(camera, method, *place_m, velocity_m_s));
    let errors_m = without_mean(&errors_m.collect::<Vec<_>>());
    places_m.into_iter().zip(errors_m).collect()
}

/// A quantity of every run: its mean over runs, and its standard deviation from run to run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
    /// The standard deviation.
    pub deviation: f64,
}

impl Spread {
    fn of(values: &[f64]) -> Self {
        Self { mean: mean(values), deviation: rms(&without_mean(values)) }
    }
}

/// A hundred runs with noise, as the paper takes them.
#[derive(Debug, Clone, PartialEq)]
pub struct Runs {
    /// Place and error, m, of every measurement; the mean over all removed.
    pub points: Vec<(f64, f64)>,
    /// RMS of a run's errors, m.
    pub rms_m: Spread,
    /// Range of a run's errors, m.
    pub span_m: Spread,
}

/// Runs at 2 m/s, one measurement behind the other from 1 to 3 m, less five static measurements at the same points, averaged.
///
/// Where a run begins within the first measurement's way is drawn: the paper does not say it.
pub fn runs(camera: &Camera, method: &Method) -> Runs {
    let mut draws = Draws::of(SEED, NOISE_STREAM);
    let way_m = VELOCITY_M_S * MEASUREMENT_S;
    let (mut points, mut rms_m, mut span_m) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..RUNS {
        let start_m = FROM_M + way_m * draws.even();
        let count = ((TO_M - start_m) / way_m).floor() as u32;
        let mut error_m = |set: &Set| {
            let frames = camera.frames_dn(&method.steps_rad, set);
            method.error_m(&read(&frames, 1, &mut draws), set.range_m, FREQUENCY_HZ)
        };
        let places_m = (0..=count).map(|n| start_m + f64::from(n) * way_m).collect::<Vec<_>>();
        let errors_m = places_m.iter().map(|place_m| {
            let moving_m = error_m(&Set::moving(method, *place_m, VELOCITY_M_S));
            let still_m: f64 = (0..CALIBRATIONS).map(|_| error_m(&Set::still(method, *place_m))).sum();
            moving_m - still_m / CALIBRATIONS as f64
        });
        let errors_m: Vec<f64> = errors_m.collect();
        let about_mean_m = without_mean(&errors_m);
        rms_m.push(rms(&about_mean_m));
        span_m.push(span(&about_mean_m));
        points.extend(places_m.into_iter().zip(errors_m));
    }
    // A run's own mean depends on where it began: for the picture the mean of all is taken away.
    let all = mean(&points.iter().map(|point| point.1).collect::<Vec<_>>());
    points.iter_mut().for_each(|point| point.1 -= all);
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    Runs { points, rms_m: Spread::of(&rms_m), span_m: Spread::of(&span_m) }
}
