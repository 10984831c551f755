//! Figure 7: the motion error that was measured of four frames.

use super::camera::{Camera, Conditions, Method};
use super::figure::{Figure, Plot};
use super::motion::{VELOCITY_M_S, error_curve, runs};

/// Table I and light that falls off within a set, its constant part `constant_ratio` times its modulated one.
pub fn with_falloff(constant_ratio: f64) -> Conditions {
    Conditions { falloff: true, constant_ratio, ..Conditions::table_1() }
}

/// Figure `number`, 7 or 11: a hundred simulated runs of `method`, and the curves behind them.
pub fn figure(number: u32, title: &'static str, method: &Method) -> Figure {
    let with = Camera::new(with_falloff(1.0));
    let without = Camera::new(Conditions::table_1());
    Figure {
        number,
        title,
        abscissa: "distance, m",
        ordinate: "error, m",
        plots: vec![
            Plot::dots("100 runs", runs(&with, method).points),
            Plot::line("with falloff, no noise", error_curve(&with, method, VELOCITY_M_S)),
            Plot::line("without falloff", error_curve(&without, method, VELOCITY_M_S)),
        ],
        assumed: "phases 0, 30 MHz, constant part of the light equal to the modulated one, noise of the simulator's camera",
    }
}
