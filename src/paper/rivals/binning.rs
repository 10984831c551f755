//! Binning: the mean of neighbouring pixels. It halves noise with 2 × 2, and leaves the motion error, which all of them share.

use crate::paper::camera::{Camera, Conditions, Method, Set, read};
use crate::paper::linearity::SEED;
use crate::paper::residual::{rms, without_mean};
use crate::physics::{Draws, FREQUENCY_HZ};

const TRIALS: usize = 1000;
const STREAM: u64 = 8;
const STILL_M: f64 = 2.0;

/// RMS random error, m, of a still target at 2 m, the mean of `pixels` alike.
pub fn binned_rms_m(method: &Method, pixels: usize) -> f64 {
    let frames =
        Camera::new(Conditions::table_1()).frames_dn(&method.steps_rad, &Set::still(method, STILL_M));
    let mut draws = Draws::of(SEED, STREAM);
    let error = |_| method.error_m(&read(&frames, pixels, &mut draws), STILL_M, FREQUENCY_HZ);
    rms(&without_mean(&(0..TRIALS).map(error).collect::<Vec<_>>()))
}
