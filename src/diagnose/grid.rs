//! Which pixels are looked at: all, or, of a large sensor, those of every so many rows and columns.

use crate::frames::Geometry;
use crate::recording::Camera;

/// So many pixels are enough: a number that they share is known to a hundredth of what one of them tells.
const MOST_PIXELS: usize = 20_000;

/// A sensor, and the pixels of it that are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grid {
    sensor: Geometry,
    /// Every so many rows and columns; 1 where all pixels are looked at.
    pub every: usize,
}

impl Grid {
    /// Of a sensor.
    pub fn of(sensor: Geometry) -> Self {
        let every = (1..).find(|&every| Self { sensor, every }.geometry().pixels() <= MOST_PIXELS);
        Self { sensor, every: every.unwrap_or(1) }
    }

    /// The pixels that are looked at, as a sensor of their own.
    pub fn geometry(self) -> Geometry {
        let Geometry { width, height } = self.sensor;
        Geometry { width: width.div_ceil(self.every), height: height.div_ceil(self.every) }
    }

    /// Their numbers in the sensor; about the same middle.
    pub fn pixels(self) -> Vec<usize> {
        let Geometry { width, height } = self.geometry();
        let first = |size: usize, kept: usize| (size - 1 - self.every * (kept - 1)) / 2;
        let (top, left) = (first(self.sensor.height, height), first(self.sensor.width, width));
        let pixel = |row: usize, column: usize| {
            (top + self.every * row) * self.sensor.width + left + self.every * column
        };
        (0..height).flat_map(|row| (0..width).map(move |column| pixel(row, column))).collect()
    }

    /// `camera` with these pixels alone.
    pub fn camera(self, camera: Camera) -> Camera {
        let focal_length_px = camera.focal_length_px / self.every as f64;
        Camera { geometry: self.geometry(), focal_length_px, ..camera }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_sensor_is_whole_and_a_large_one_is_seen_evenly() {
        let whole = Grid::of(Geometry { width: 160, height: 120 });
        assert_eq!(whole.every, 1);
        assert_eq!(whole.pixels(), (0..160 * 120).collect::<Vec<_>>());
        let large = Grid::of(Geometry { width: 641, height: 480 });
        assert_eq!((large.every, large.geometry()), (4, Geometry { width: 161, height: 120 }));
        let pixels = large.pixels();
        assert_eq!(pixels.len(), 161 * 120);
        assert_eq!((pixels[0], pixels[1], pixels[161]), (641, 645, 5 * 641));
        assert!(*pixels.last().unwrap() < 641 * 480);
    }
}
