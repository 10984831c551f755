//! Figure 1: linearity of four frames by phase stepping.

use super::camera::{Camera, Conditions, Method};
use super::figure::{Figure, Plot};
use super::linearity::by_phase_stepping;

/// The figure; `four` is the four-frame method.
pub fn figure(four: &Method) -> Figure {
    let camera = Camera::new(Conditions::table_1());
    Figure {
        number: 1,
        title: "Four frames: linearity error by phase stepping",
        abscissa: "distance, m",
        ordinate: "error, m",
        plots: vec![Plot::line("Table I", by_phase_stepping(&camera, four))],
        assumed: "phases of the harmonics 0; that figure 1 of the paper is the phase-stepped one",
    }
}
