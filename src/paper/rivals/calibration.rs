//! Calibrations of four frames at one modulation frequency, applied at others.

use super::b_spline::B_SPLINE;
use super::frequency::waveform_at;
use super::least_squares::fit;
use super::look_up::LOOK_UP;
use super::polynomial::POLYNOMIAL;
use super::sinusoid::SINUSOID;
use crate::paper::camera::{Camera, Conditions, Method, Set, read};
use crate::paper::figure::{Table, mm};
use crate::paper::linearity::SEED;
use crate::paper::residual::{rms, without_mean};
use crate::physics::{Correlation, Draws, FREQUENCY_HZ};
use crate::units::{phase_rad, unambiguous_range_m};
use std::f64::consts::TAU;

/// A way of writing the error as a function of the measured phase.
#[derive(Debug, Clone, Copy)]
pub struct Calibration {
    /// Its name.
    pub name: &'static str,
    /// The functions whose sum it is, of the measured phase in turns, 0 to 1.
    pub basis: fn(f64) -> Vec<f64>,
}

/// All four.
pub const CALIBRATIONS: [Calibration; 4] = [SINUSOID, POLYNOMIAL, B_SPLINE, LOOK_UP];

/// Phase offsets of a calibration, measurements of each, and where the target stands, m.
const OFFSETS: u32 = 100;
const REPEATS: usize = 100;
const STILL_M: f64 = 2.0;
/// Where results are judged: places between those of the calibration.
const JUDGED: u32 = 331;
const NOISE_STREAM: u64 = 6;
/// Where they are applied, Hz.
const APPLIED_HZ: [f64; 3] = [FREQUENCY_HZ, 20e6, 40e6];

/// Measured phase and error, both in turns, at `count` offsets over a turn; noise with `draws` only.
fn sweep(
    method: &Method,
    waveform: Correlation,
    frequency_hz: f64,
    count: u32,
    mut draws: Option<Draws>,
) -> Vec<(f64, f64)> {
    let camera = Camera::new(Conditions { correlation: waveform, ..Conditions::table_1() });
    let range_m = unambiguous_range_m(frequency_hz);
    let mut point = |n: u32| {
        let turns = f64::from(n) / f64::from(count);
        let offset_rad = phase_rad(STILL_M, frequency_hz) - TAU * turns;
        let set = Set { offset_rad, frequency_hz, ..Set::still(method, STILL_M) };
        let exact = camera.frames_dn(&method.steps_rad, &set);
        let frames = match &mut draws {
            Some(draws) => read(&exact, REPEATS, draws),
            None => exact,
        };
        let error = method.error_m(&frames, turns * range_m, frequency_hz) / range_m;
        ((turns + error).rem_euclid(1.0), error)
    };
    (0..count).map(&mut point).collect()
}

/// RMS error, m, of `method` at `frequency_hz` and `waveform`, about its mean, after the error that `calibration` found at 30 MHz is
/// subtracted at the same measured phase; uncalibrated without one. NaN where the calibration has no solution.
pub fn calibrated_rms_m(
    method: &Method,
    calibration: Option<&Calibration>,
    waveform: Correlation,
    frequency_hz: f64,
) -> f64 {
    let judged = sweep(method, waveform, frequency_hz, JUDGED, None);
    let found = calibration.and_then(|calibration| {
        let draws = Some(Draws::of(SEED, NOISE_STREAM));
        fit(calibration.basis, &sweep(method, Correlation::measured(), FREQUENCY_HZ, OFFSETS, draws))
    });
    let corrected = |(turns, error): &(f64, f64)| match (calibration, &found) {
        (None, _) => *error,
        (Some(calibration), Some(found)) => {
            let basis = (calibration.basis)(*turns);
            error - basis.iter().zip(found).map(|(b, c)| b * c).sum::<f64>()
        }
        (Some(_), None) => f64::NAN,
    };
    let errors = without_mean(&judged.iter().map(corrected).collect::<Vec<_>>());
    rms(&errors) * unambiguous_range_m(frequency_hz)
}

/// The table: four frames calibrated at 30 MHz, and the WDFT without any calibration.
pub fn table([four, wdft]: &[Method; 2]) -> Table {
    let row = |name: String, method: &Method, calibration: Option<&Calibration>| {
        let at = |hz: f64| mm(calibrated_rms_m(method, calibration, waveform_at(hz), hz));
        let same = mm(calibrated_rms_m(method, calibration, Correlation::measured(), 40e6));
        std::iter::once(name).chain(APPLIED_HZ.map(at)).chain([same]).collect::<Vec<_>>()
    };
    let calibrated =
        CALIBRATIONS.iter().map(|one| row(format!("four frames, {}", one.name), four, Some(one)));
    let first = row("four frames, uncalibrated".to_owned(), four, None);
    let last = row("WDFT, uncalibrated".to_owned(), wdft, None);
    let head = ["RMS linearity error, mm", "30 MHz", "20 MHz", "40 MHz", "40 MHz, same waveform"];
    Table {
        name: "rivals-linearity",
        title: "Rivals against linearity error: calibrated at 30 MHz, applied at others",
        head: head.map(str::to_owned).to_vec(),
        rows: std::iter::once(first).chain(calibrated).chain([last]).collect(),
        notes: vec![
            "Assumed: phases of Table I 0 at 30 MHz, a low-pass of 60 MHz for other frequencies, calibration over the measured phase at 100 offsets, \
             100 measurements each, with the noise of the simulator's camera at 2 m."
                .to_owned(),
            "A calibration is as good as its waveform is the same: the last column is with Table I at 40 MHz, too. It is judged here at the light's \
             level and target of the calibration, which flatters it."
                .to_owned(),
        ],
    }
}
