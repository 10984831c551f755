//! What stands before the camera on the bench: a target plane on a rail, and a still background.

use super::draws::Draws;
use super::pixels::Pixels;
use super::scene::{Object, Scene};
use super::sensor::Sensor;
use super::shape::Shape;
use crate::frames::Geometry;

/// The bench. The target fills a window of the image at every distance, as the carriage carries it; what is beyond the window's
/// edge never moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Share of the image's columns and rows, on each side, that see past the target, 0 to 0.5.
    pub border: (f64, f64),
    /// Columns and rows of patches on the target, each with a reflectivity of its own.
    pub patches: (usize, usize),
    /// Least and greatest reflectivity of a patch.
    pub reflectivity: (f64, f64),
    /// Standard deviation of the reflectivity from pixel to pixel, relative.
    pub grain: f64,
    /// Standard deviation of the pixels' own phases (fixed pattern), rad.
    pub fixed_pattern_rad: f64,
    /// What stands behind and beside the target.
    pub background: Scene,
}

impl Stage {
    /// A target of grey patches before a wall at 4.4 m with two boxes, so that there are edges.
    pub fn bench() -> Self {
        let still =
            |shape, reflectivity| Object { shape, reflectivity, check_m: None, velocity_m_s: [0.0; 3] };
        let wall =
            Shape::Panel { centre_m: [0.0, 0.0, 4.4], half_edges_m: [[20.0, 0.0, 0.0], [0.0, 20.0, 0.0]] };
        let low = Shape::Box { low_m: [-4.0, 0.8, 3.5], high_m: [0.3, 4.0, 3.9] };
        let side = Shape::Box { low_m: [1.2, -4.0, 3.8], high_m: [4.0, 0.2, 4.1] };
        Self {
            border: (1.0 / 12.0, 1.0 / 9.0),
            patches: (6, 4),
            reflectivity: (0.3, 1.0),
            grain: 0.03,
            fixed_pattern_rad: 0.025,
            background: Scene { objects: vec![still(wall, 0.45), still(low, 0.7), still(side, 0.3)] },
        }
    }

    /// Whether each pixel sees the target, `[row, column]`.
    pub fn target(&self, geometry: Geometry) -> Vec<bool> {
        let inside = |index: usize, size: usize, border: f64| {
            let skipped = (size as f64 * border).round() as usize;
            (skipped..size.saturating_sub(skipped)).contains(&index)
        };
        let sees = |pixel| {
            let (row, column) = geometry.row_column(pixel);
            inside(column, geometry.width, self.border.0) && inside(row, geometry.height, self.border.1)
        };
        (0..geometry.pixels()).map(sees).collect()
    }

    /// The pixels of `sensor` before this bench; `seed` draws texture and fixed pattern.
    ///
    /// Reflectivity falls with the cosine of incidence (Lambert), as on a plane across the axis.
    pub fn pixels(&self, sensor: &Sensor, seed: u64) -> Pixels {
        let geometry = sensor.geometry;
        let target = self.target(geometry);
        let edges = Pixels::edges_of(geometry, &target);
        let mut draws = Draws::of(seed, u64::MAX);
        let (columns, rows) = (self.patches.0.max(1), self.patches.1.max(1));
        let (least, greatest) = self.reflectivity;
        let patches: Vec<f64> =
            (0..columns * rows).map(|_| least + (greatest - least) * draws.even()).collect();
        let grain = draws.normal(geometry.pixels());
        let fixed_pattern = draws.normal(geometry.pixels());
        let plane = Scene::wall(1.0).view(geometry, sensor.focal_length_px, 0.0);
        let behind = self.background.view(geometry, sensor.focal_length_px, 0.0);
        let reflectivity = |pixel: usize| {
            let (row, column) = geometry.row_column(pixel);
            let patch = (row * rows / geometry.height) * columns + column * columns / geometry.width;
            let surface = match target[pixel] {
                true => patches[patch] * plane[pixel].map_or(0.0, |surface| surface.reflectivity),
                false => behind[pixel].map_or(0.0, |surface| surface.reflectivity),
            };
            surface * (1.0 + self.grain * grain[pixel]).max(0.0)
        };
        let amplitude_dn = sensor.amplitude_1m_e / sensor.gain_e_per_dn;
        let amplitude_1m_dn: Vec<f64> =
            (0..geometry.pixels()).map(|pixel| amplitude_dn * reflectivity(pixel)).collect();
        // Where nothing is, nothing comes back, from wherever.
        let background_m = behind.iter().map(|s| s.map_or(1.0, |s| s.range_m)).collect();
        Pixels {
            geometry,
            obliquity: plane.iter().map(|s| s.map_or(1.0, |s| s.range_m)).collect(),
            background_m,
            at_frequencies: Vec::new(),
            phase_rad: fixed_pattern.iter().map(|draw| self.fixed_pattern_rad * draw).collect(),
            constant_1m_dn: amplitude_1m_dn.iter().map(|a| sensor.constant_ratio * a).collect(),
            amplitude_1m_dn,
            ambient_dn: vec![sensor.ambient_e / sensor.gain_e_per_dn; geometry.pixels()].into(),
            full_scale_dn: sensor.full_scale_dn(),
            pedestal_dn: sensor.pedestal_dn,
            edge_counts: Pixels::edge_counts_of(&edges),
            edges,
            target,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_target_is_a_window_with_texture_and_the_wall_is_behind() {
        let geometry = Geometry { width: 24, height: 18 };
        let sensor = Sensor::vuris().with_geometry(geometry);
        let pixels = Stage::bench().pixels(&sensor, 1);
        assert_eq!(pixels.target.iter().filter(|&&sees| sees).count(), 20 * 14);
        // Radial over axial distance, as the recording format has it.
        let (x, y) = (11.5 / sensor.focal_length_px, 8.5 / sensor.focal_length_px);
        assert!((pixels.obliquity[0] - (1.0 + x * x + y * y).sqrt()).abs() < 1e-12);
        assert!(pixels.background_m.iter().all(|range_m| (3.4..6.0).contains(range_m)));
        // A rectangle's rim: 2 (20 + 14) pairs, from both sides.
        assert_eq!(pixels.edges.len(), 2 * 2 * (20 + 14));
        let amplitudes = &pixels.amplitude_1m_dn;
        assert!(amplitudes.iter().all(|a| *a > 0.0));
        assert_ne!(pixels, Stage::bench().pixels(&sensor, 2));
        assert_eq!(pixels, Stage::bench().pixels(&sensor, 1));
    }
}
