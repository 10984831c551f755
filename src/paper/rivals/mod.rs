//! What the paper names beside its own algorithm: calibrations against the linearity error, other ways of taking frames against motion.

mod b_spline;
mod binning;
mod calibration;
mod edges_2d;
mod frequency;
mod image;
mod lateral;
mod least_squares;
mod look_up;
mod moving_edge;
mod neighbours;
mod optical_flow;
mod polynomial;
mod sinusoid;
mod step_order;

pub use calibration::{CALIBRATIONS, Calibration, calibrated_rms_m};
pub use frequency::waveform_at;
pub use image::Image;
pub use lateral::{Near, REMEDIES, Remedy, near_edges};
pub use moving_edge::{RUNS, Take, take};
pub use neighbours::{at_once_rms_m, texture_rms_m};
pub use step_order::{ordered_rms_m, orders};

use super::camera::Method;
use super::figure::Table;
use crate::problem::Result;

/// The three tables: against linearity error, motion along the axis, and lateral motion.
///
/// # Errors
/// As [`Method::of`].
pub fn tables() -> Result<[Table; 3]> {
    let methods = Method::both()?;
    Ok([calibration::table(&methods), step_order::table(&methods), lateral::table(&methods)])
}
