//! Figure 2: linearity of four frames by moving the target.

use super::camera::{Camera, Conditions, Method};
use super::figure::{Figure, Plot};
use super::linearity::{by_moving, by_phase_stepping};

/// The figure; `four` is the four-frame method.
pub fn figure(four: &Method) -> Figure {
    let camera = Camera::new(Conditions::table_1());
    Figure {
        number: 2,
        title: "Four frames: linearity error with the target moved in steps of 50 mm",
        abscissa: "distance, m",
        ordinate: "error, m",
        plots: vec![
            Plot::dots("moved, 100 measurements a step", by_moving(&camera, four)),
            Plot::line("phase stepping", by_phase_stepping(&camera, four)),
        ],
        assumed: "phases 0; rail from 0.9 to 4.9 m; light and noise of the simulator's camera",
    }
}
