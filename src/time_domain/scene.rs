//! What stands before the camera, as each pixel sees it.

use crate::frames::Geometry;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// What a pixel sees and is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pixel {
    /// Whether it sees the target (else the still background).
    pub sees_target: bool,
    /// Radial over axial distance.
    pub obliquity: f64,
    /// Amplitude of the fundamental at a radial distance of 1 m, electrons.
    pub amplitude_e: f64,
    /// Charge of the light that the gate does not divide, at 1 m, beyond the waveform's own mean, electrons.
    pub constant_e: f64,
    /// Charge of ambient light, electrons.
    pub ambient_e: f64,
    /// The pixel's own delay, rad.
    pub delay_rad: f64,
}

/// All pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The sensor's size.
    pub geometry: Geometry,
    /// Row by row.
    pub pixels: Vec<Pixel>,
    /// Axial distance of the background, m.
    pub background_m: f64,
    /// Amplitude of the brightest reflectivity at 1 m, electrons.
    pub brightest_e: f64,
}

/// Spots of the target's texture.
const SPOTS: usize = 6;

impl Scene {
    /// A random scene: a window on a target with blotches, before a darker background. `brightest_e` is the amplitude of the
    /// brightest spot at 1 m, `ambient_e` the ambient light's mean charge.
    pub fn random(
        geometry: Geometry,
        focal_length_px: f64,
        brightest_e: f64,
        ambient_e: f64,
        seed: u64,
    ) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let Geometry { width, height } = geometry;
        let mut margin = |side: usize| random.random_range(1..=(side / 6).max(1));
        let (left, right, top, bottom) = (margin(width), margin(width), margin(height), margin(height));
        let spots: Vec<[f64; 4]> = (0..SPOTS).map(|_| std::array::from_fn(|_| random.random())).collect();
        let background_m = random.random_range(3.9..4.7);
        let tilt: [f64; 2] = std::array::from_fn(|_| random.random_range(-0.3..0.3));
        let mut pixels = Vec::with_capacity(geometry.pixels());
        for pixel in 0..geometry.pixels() {
            let (row, column) = geometry.row_column(pixel);
            let (u, v) = (column as f64 / width as f64, row as f64 / height as f64);
            let blotch = |spot: &[f64; 4]| {
                let distance = (u - spot[0]).hypot(v - spot[1]) / (0.1 + 0.2 * spot[2]);
                (spot[3] - 0.5) * (-distance * distance).exp()
            };
            let texture: f64 = (1.2 * spots.iter().map(blotch).sum::<f64>()).exp();
            let grain: f64 = random.random_range(0.75..1.0);
            let reflectivity = (0.6 * texture * grain).clamp(0.12, 1.0);
            let sees_target =
                (left..width - right).contains(&column) && (top..height - bottom).contains(&row);
            // A background at 4 m that gives a twentieth of the target's light at 1 m gives little at its place.
            let amplitude_e = brightest_e * if sees_target { reflectivity } else { 0.5 * reflectivity };
            let (x, y) =
                (column as f64 - (width as f64 - 1.0) / 2.0, row as f64 - (height as f64 - 1.0) / 2.0);
            pixels.push(Pixel {
                sees_target,
                obliquity: (1.0 + (x * x + y * y) / (focal_length_px * focal_length_px)).sqrt(),
                amplitude_e,
                constant_e: 0.0,
                ambient_e: ambient_e * (1.0 + tilt[0] * (u - 0.5) + tilt[1] * (v - 0.5)),
                delay_rad: 0.05 * random.random_range(-1.0..1.0) * TAU,
            });
        }
        Self { geometry, pixels, background_m, brightest_e }
    }

    /// The mask: 1 where the target is seen.
    pub fn mask(&self) -> Vec<bool> {
        self.pixels.iter().map(|pixel| pixel.sees_target).collect()
    }
}
