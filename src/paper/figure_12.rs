//! Figure 12: a deliberate step error, phase-stepped, does what motion does.

use super::camera::{Camera, Conditions, Method, Set};
use super::figure::{Figure, Plot};
use super::motion::VELOCITY_M_S;
use super::residual::without_mean;
use crate::physics::{Correlation, FREQUENCY_HZ};
use crate::units::{phase_rad, range_m};
use std::f64::consts::TAU;

const OFFSETS: u32 = 120;

/// The step error, as a share of the step, that is motion at `velocity_m_s`: ε = −v α / δ (Drayton 2012).
pub fn step_error(method: &Method, velocity_m_s: f64) -> f64 {
    let way_m = velocity_m_s * method.frame_period_s();
    -phase_rad(way_m, FREQUENCY_HZ) / (method.steps_rad[1] - method.steps_rad[0])
}

/// Distance and error, m, of a still target over a turn of phase offsets, all steps too long by `step_error` of themselves; the mean
/// is removed.
pub fn phase_stepped(method: &Method, correlation: &Correlation, step_error: f64) -> Vec<(f64, f64)> {
    let camera = Camera::new(Conditions { correlation: correlation.clone(), ..Conditions::sinusoidal() });
    let wrong: Vec<f64> = method.steps_rad.iter().map(|step| step * (1.0 + step_error)).collect();
    let error = |place_m: f64| {
        let offset_rad = phase_rad(1.0 - place_m, FREQUENCY_HZ);
        let frames = camera.frames_dn(&wrong, &Set { offset_rad, ..Set::still(method, 1.0) });
        method.error_m(&frames, place_m, FREQUENCY_HZ)
    };
    about_mean(error)
}

/// The same of a target that moves and whose steps are right, the phase of its first frame stepped over a turn.
pub fn moved(method: &Method, correlation: &Correlation, velocity_m_s: f64) -> Vec<(f64, f64)> {
    let camera = Camera::new(Conditions { correlation: correlation.clone(), ..Conditions::sinusoidal() });
    about_mean(|place_m| {
        let offset_rad = phase_rad(1.0 - place_m, FREQUENCY_HZ);
        let frames = camera
            .frames_dn(&method.steps_rad, &Set { offset_rad, ..Set::moving(method, 1.0, velocity_m_s) });
        method.error_m(&frames, place_m, FREQUENCY_HZ)
    })
}

fn about_mean(error_m: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let places_m = (0..OFFSETS).map(|n| range_m(TAU * f64::from(n) / f64::from(OFFSETS), FREQUENCY_HZ));
    let places_m: Vec<f64> = places_m.collect();
    let errors_m = without_mean(&places_m.iter().map(|place_m| error_m(*place_m)).collect::<Vec<_>>());
    places_m.into_iter().zip(errors_m).collect()
}

/// The figure, both methods.
pub fn figure(methods: &[Method; 2]) -> Figure {
    let table_1 = Correlation::measured();
    let plots = methods.iter().flat_map(|method| {
        let step_error = step_error(method, VELOCITY_M_S);
        [
            Plot::line(
                format!("{}, step error {:.1} %", method.name, 100.0 * step_error),
                phase_stepped(method, &table_1, step_error),
            ),
            Plot::line(format!("{}, right steps", method.name), phase_stepped(method, &table_1, 0.0)),
        ]
    });
    Figure {
        number: 12,
        title: "A deliberate step error, as large as 2 m/s makes it, phase-stepped",
        abscissa: "distance, m",
        ordinate: "error, m",
        plots: plots.collect(),
        assumed: "Table I with phases 0, 30 MHz; the step errors of 2 m/s in 125 ms, as the paper's own are not known here",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the paper states, and what is not so for another step error.
    #[test]
    fn motion_is_a_step_error() {
        let table_1 = Correlation::measured();
        for method in Method::both().unwrap() {
            let moved = moved(&method, &table_1, 2.0);
            let apart = |step_error| {
                let stepped = phase_stepped(&method, &table_1, step_error);
                moved.iter().zip(&stepped).map(|(a, b)| (a.1 - b.1).abs()).fold(0.0, f64::max)
            };
            let right = step_error(&method, 2.0);
            assert!(apart(right) < 1e-9, "{}: {}", method.name, apart(right));
            assert!(apart(0.9 * right) > 1e-4 && apart(-right) > 1e-4, "{}", method.name);
        }
    }
}
