//! Figure 2: linearity of four frames by moving the target.

use super::camera::{Camera, Conditions, Method};
use super::figure::{Figure, Plot};
use super::linearity::{by_moving, by_phase_stepping};

/// Figure `number`, 2 or 10: the linearity error of `method`, moved and phase-stepped.
pub fn figure(number: u32, title: &'static str, method: &Method) -> Figure {
    let camera = Camera::new(Conditions::table_1());
    Figure {
        number,
        title,
        abscissa: "distance, m",
        ordinate: "error, m",
        plots: vec![
            Plot::dots("moved, 100 measurements a step", by_moving(&camera, method)),
            Plot::line("phase stepping", by_phase_stepping(&camera, method)),
        ],
        assumed: "phases 0; rail from 0.9 to 4.9 m; light and noise of the simulator's camera",
    }
}
