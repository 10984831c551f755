//! Figure 5: four frames' motion error for each frame as the reference.

use super::camera::{Camera, Conditions, Method};
use super::figure::{Figure, Plot};
use super::motion::{VELOCITY_M_S, moved_error_m, places_m};
use super::residual::mean;

/// Place and error, m, at 2 m/s, with the target's place at the start of frame `frame` (from 0) as the truth; nothing is removed.
pub fn about_frame(four: &Method, frame: u32) -> Vec<(f64, f64)> {
    let camera = Camera::new(Conditions::sinusoidal());
    let way_m = VELOCITY_M_S * f64::from(frame) * four.frame_period_s();
    let error = |place_m: f64| (place_m, moved_error_m(&camera, four, place_m, VELOCITY_M_S) - way_m);
    places_m().into_iter().map(error).collect()
}

/// Means over whole cycles of the error with each of the four frames as the reference, m.
pub fn means_m(four: &Method) -> [f64; 4] {
    // Two cycles in 5 m: the places from 1 m on within 2.5 m, of which 2 m are on the rail, would not be whole ones.
    let camera = Camera::new(Conditions::sinusoidal());
    let turn_m = crate::units::range_m(std::f64::consts::TAU, crate::physics::FREQUENCY_HZ);
    let places = (0..100).map(|n| 1.0 + turn_m * f64::from(n) / 100.0);
    let errors: Vec<f64> = places.map(|place| moved_error_m(&camera, four, place, VELOCITY_M_S)).collect();
    [0.0, 1.0, 2.0, 3.0].map(|frame| mean(&errors) - VELOCITY_M_S * frame * four.frame_period_s())
}

/// The figure; `four` is the four-frame method.
pub fn figure(four: &Method) -> Figure {
    let plot = |frame| Plot::line(format!("frame {}", frame + 1), about_frame(four, frame));
    Figure {
        number: 5,
        title: "Four frames: motion error at 2 m/s for each reference frame",
        abscissa: "distance, m",
        ordinate: "error, m",
        plots: (0..4).map(plot).collect(),
        assumed: "30 MHz, four frames of 31.25 ms, no harmonics, no falloff of light; measured less true range",
    }
}
