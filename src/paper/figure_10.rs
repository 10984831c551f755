//! Figure 10: linearity of the WDFT, both ways.

use super::camera::{Camera, Conditions, Method};
use super::figure::{Figure, Plot};
use super::linearity::{by_moving, by_phase_stepping};

/// The figure.
pub fn figure(wdft: &Method) -> Figure {
    let camera = Camera::new(Conditions::table_1());
    Figure {
        number: 10,
        title: "WDFT: linearity error, both ways",
        abscissa: "distance, m",
        ordinate: "error, m",
        plots: vec![
            Plot::dots("moved, 100 measurements a step", by_moving(&camera, wdft)),
            Plot::line("phase stepping", by_phase_stepping(&camera, wdft)),
        ],
        assumed: "phases 0; rail from 0.9 to 4.9 m; light and noise of the simulator's camera",
    }
}
