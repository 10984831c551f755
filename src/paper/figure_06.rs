//! Figure 6: four frames' motion error with Table I's harmonics.

use super::camera::{Camera, Conditions, Method};
use super::figure::{Figure, Plot};
use super::motion::{VELOCITY_M_S, error_curve, places_m};
use super::residual::without_mean;

/// The figure; `four` is the four-frame method.
pub fn figure(four: &Method) -> Figure {
    let camera = Camera::new(Conditions::table_1());
    let whole =
        |place_m: &f64| camera.error_m(four, &super::camera::Set::moving(four, *place_m, VELOCITY_M_S));
    let places_m = places_m();
    let errors_m = without_mean(&places_m.iter().map(whole).collect::<Vec<_>>());
    Figure {
        number: 6,
        title: "Four frames: motion error at 2 m/s with the harmonics of Table I",
        abscissa: "distance, m",
        ordinate: "error, m",
        plots: vec![
            Plot::line("moving", places_m.into_iter().zip(errors_m).collect()),
            Plot::line("less the static error", error_curve(&camera, four, VELOCITY_M_S)),
        ],
        assumed: "phases 0, 30 MHz, four frames of 31.25 ms, no falloff of light; means removed",
    }
}
