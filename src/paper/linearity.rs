//! Linearity, measured both ways: by stepping the phase before a still target, and by moving the target.

use super::camera::{Camera, Conditions, Method, Set, read};
use super::residual::{without_line, without_mean};
use crate::physics::{Correlation, Draws, FREQUENCY_HZ, Harmonic};
use crate::units::{phase_rad, range_m};
use std::f64::consts::TAU;

/// Phase offsets of a turn: with every method here they fall on different places of its cycles.
const OFFSETS: u32 = 400;
/// Where the still target stands, m: assumed.
const STILL_M: f64 = 2.0;
/// The moved target's first place, m (assumed), and number of steps of 50 mm.
const FIRST_M: f64 = 0.9;
const STEPS: u32 = 80;
const STEP_M: f64 = 0.05;
/// Measurements a step, whose intensities are averaged.
const REPEATS: usize = 100;
/// Stream of the random phases, and of the moved target's noise.
const PHASES_STREAM: u64 = 1;
const NOISE_STREAM: u64 = 2;
/// Seed of all that is drawn in the paper's experiments.
pub const SEED: u64 = 2012;

/// Distance and error, m, of a still target whose initial phase offset is stepped over a turn: the distance is the one that has the
/// offset's phase. The mean is removed.
pub fn by_phase_stepping(camera: &Camera, method: &Method) -> Vec<(f64, f64)> {
    let places_m = (0..OFFSETS).map(|n| range_m(TAU * f64::from(n) / f64::from(OFFSETS), FREQUENCY_HZ));
    let places_m: Vec<f64> = places_m.collect();
    let error_m = |place_m: &f64| {
        // The light's path has the phase of 2 m, the offset the rest.
        let offset_rad = phase_rad(STILL_M - place_m, FREQUENCY_HZ);
        camera.error_m(method, &Set { offset_rad, ..Set::still(method, STILL_M) })
    };
    let errors_m = without_mean(&places_m.iter().map(error_m).collect::<Vec<_>>());
    places_m.into_iter().zip(errors_m).collect()
}

/// Distance and error, m, of a target that is moved in steps of 50 mm over 4 m, the mean of 100 measurements each. A line is fitted and
/// taken away.
pub fn by_moving(camera: &Camera, method: &Method) -> Vec<(f64, f64)> {
    let mut draws = Draws::of(SEED, NOISE_STREAM);
    let places_m: Vec<f64> = (0..=STEPS).map(|n| FIRST_M + f64::from(n) * STEP_M).collect();
    let mut error_m = |place_m: &f64| {
        let frames = camera.frames_dn(&method.steps_rad, &Set::still(method, *place_m));
        (*place_m, method.error_m(&read(&frames, REPEATS, &mut draws), *place_m, FREQUENCY_HZ))
    };
    let errors: Vec<(f64, f64)> = places_m.iter().map(&mut error_m).collect();
    places_m.into_iter().zip(without_line(&errors)).collect()
}

/// The second elements.
pub fn errors(points: &[(f64, f64)]) -> Vec<f64> {
    points.iter().map(|point| point.1).collect()
}

/// `count` times Table I with random phases of its harmonics, each evenly distributed over a turn.
pub fn random_phases(count: usize) -> Vec<Conditions> {
    let mut draws = Draws::of(SEED, PHASES_STREAM);
    let table = Correlation::measured();
    let mut drawn = || {
        let others = table.harmonics().iter().filter(|harmonic| harmonic.number > 1);
        let turned = others.map(|harmonic| Harmonic { phase_rad: TAU * draws.even(), ..*harmonic });
        let correlation = Correlation::with_harmonics(&turned.collect::<Vec<_>>());
        Conditions { correlation, ..Conditions::table_1() }
    };
    (0..count).map(|_| drawn()).collect()
}

#[cfg(test)]
mod tests {
    use super::super::residual::rms;
    use super::*;

    /// 1/31 of the third harmonic alone: to first order the four frames' error is its amplitude in radians, in four cycles.
    #[test]
    fn four_frames_have_four_cycles_and_the_wdft_three() {
        for (method, cycles) in Method::both().unwrap().iter().zip([4.0, 3.0]) {
            let points = by_phase_stepping(&Camera::new(Conditions::table_1()), method);
            let errors_m = errors(&points);
            let part = |of: fn(f64) -> f64| {
                let turn_m = range_m(TAU, FREQUENCY_HZ);
                let sum: f64 = points.iter().map(|(x, y)| y * of(TAU * cycles * x / turn_m)).sum();
                2.0 * sum / f64::from(OFFSETS)
            };
            let amplitude_m = part(f64::cos).hypot(part(f64::sin));
            assert!(amplitude_m > 0.95 * 2f64.sqrt() * rms(&errors_m), "{}: {amplitude_m}", method.name);
        }
    }
}
