//! Figure 4: four frames' motion error for three velocities, by the change of phase alone.

use super::camera::{Camera, Conditions, Method};
use super::figure::{Figure, Plot};
use super::motion::error_curve;

/// The figure; `four` is the four-frame method.
pub fn figure(four: &Method) -> Figure {
    let camera = Camera::new(Conditions::sinusoidal());
    let plot = |velocity_m_s: f64| {
        Plot::line(format!("{velocity_m_s} m/s"), error_curve(&camera, four, velocity_m_s))
    };
    Figure {
        number: 4,
        title: "Four frames: motion error about its mean, phase change alone",
        abscissa: "distance, m",
        ordinate: "error, m",
        plots: [0.5, 1.0, 2.0].map(plot).to_vec(),
        assumed: "30 MHz, four frames of 31.25 ms, no harmonics, no falloff of light",
    }
}
