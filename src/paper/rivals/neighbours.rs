//! All four phases at once, in neighbouring pixels.

use crate::paper::camera::{Camera, Conditions, Method, Set};
use crate::paper::linearity::SEED;
use crate::paper::motion::VELOCITY_M_S;
use crate::paper::residual::{rms, without_mean};
use crate::physics::{Draws, FREQUENCY_HZ};
use std::f64::consts::TAU;

/// Standard deviation of the reflectivity from pixel to pixel: that of the simulator's bench, assumed.
pub const GRAIN: f64 = 0.03;
const TRIALS: u32 = 2000;
const OFFSETS: u32 = 60;
const STREAM: u64 = 7;
const STILL_M: f64 = 2.0;

/// RMS motion error, m, about its mean at 2 m/s, the static error subtracted: all frames begin at once.
pub fn at_once_rms_m(method: &Method, conditions: Conditions) -> f64 {
    let camera = Camera::new(conditions);
    let starts_s = vec![0.0; method.steps_rad.len()];
    let error = |n: u32| {
        let offset_rad = TAU * f64::from(n) / f64::from(OFFSETS);
        let moving =
            Set { offset_rad, starts_s: starts_s.clone(), ..Set::moving(method, STILL_M, VELOCITY_M_S) };
        let still = Set { velocity_m_s: 0.0, ..moving.clone() };
        camera.error_m(method, &moving) - camera.error_m(method, &still)
    };
    rms(&without_mean(&(0..OFFSETS).map(error).collect::<Vec<_>>()))
}

/// RMS error, m, of a still target whose reflectivity differs from pixel to pixel by a standard deviation of 3 %, over all phases.
pub fn texture_rms_m(method: &Method) -> f64 {
    let camera = Camera::new(Conditions::sinusoidal());
    let mut draws = Draws::of(SEED, STREAM);
    let mut error = |n: u32| {
        let range_m = STILL_M + f64::from(n) / f64::from(TRIALS) * 2.5;
        let frames = camera.frames_dn(&method.steps_rad, &Set::still(method, range_m));
        let grain = draws.normal(frames.len());
        let textured: Vec<f64> =
            frames.iter().zip(grain).map(|(frame, g)| frame * (1.0 + GRAIN * g)).collect();
        method.error_m(&textured, range_m, FREQUENCY_HZ)
    };
    rms(&(0..TRIALS).map(&mut error).collect::<Vec<_>>())
}
