//! Which pixels are looked at: all, or, of a large recording, those of every so many rows and columns, and a window without gaps.

use crate::frames::Geometry;

/// Of so many samples all are looked at, if they are of not too many pixels: each pixel has sums of its own for every number that is tried.
const WHOLE_SAMPLES: usize = 8_000_000;
const MOST_PIXELS: usize = 6000;
/// Of more, so many at most: a number that all pixels share is known to a thousandth of what one sample tells.
const MOST_SAMPLES: usize = 5_000_000;

/// A sensor, and the pixels of it that are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grid {
    /// The sensor.
    pub sensor: Geometry,
    /// Every so many rows and columns; 1 where there are no gaps.
    pub every: usize,
    /// Row and column of the first one.
    first: (usize, usize),
    size: Geometry,
}

impl Grid {
    /// Of a sensor of which so many frames were taken.
    pub fn of(sensor: Geometry, frames: usize) -> Self {
        let spread = |every: usize| {
            let size =
                Geometry { width: sensor.width.div_ceil(every), height: sensor.height.div_ceil(every) };
            // About the same middle.
            let first = |size: usize, kept: usize| (size - 1 - every * (kept - 1)) / 2;
            Self {
                sensor,
                every,
                first: (first(sensor.height, size.height), first(sensor.width, size.width)),
                size,
            }
        };
        let samples = |grid: &Self| grid.size.pixels() * frames;
        let whole = spread(1);
        if samples(&whole) <= WHOLE_SAMPLES && sensor.pixels() <= MOST_PIXELS {
            return whole;
        }
        let is_enough = |grid: &Self| samples(grid) <= MOST_SAMPLES && grid.size.pixels() <= MOST_PIXELS;
        let most = sensor.width.max(sensor.height);
        (2..most).map(spread).find(is_enough).unwrap_or_else(|| spread(most))
    }

    /// As many pixels without gaps, of which `is_target` (all of the sensor's) tells where most edges are; nothing where this has none.
    pub fn close(self, is_target: &[bool]) -> Option<Self> {
        if self.every == 1 {
            return None;
        }
        let Self { sensor, size, .. } = self;
        let window = |first: (usize, usize)| Self { sensor, every: 1, first, size };
        let edges = |grid: &Self| {
            let pixels = grid.pixels();
            pixels.windows(2).filter(|pair| is_target[pair[0]] != is_target[pair[1]]).count()
        };
        let (rows, columns) = (sensor.height - size.height, sensor.width - size.width);
        let middle = window((rows / 2, columns / 2));
        let steps = |room: usize, size: usize| (0..=room).step_by(size.div_ceil(2).max(1));
        let others = steps(rows, size.height)
            .flat_map(|row| steps(columns, size.width).map(move |column| window((row, column))));
        // The middle, unless another has more.
        Some(others.fold(middle, |best, grid| if edges(&grid) > edges(&best) { grid } else { best }))
    }

    /// The pixels that are looked at, as a sensor of their own.
    pub fn geometry(self) -> Geometry {
        self.size
    }

    /// Their numbers in the sensor.
    pub fn pixels(self) -> Vec<usize> {
        let Geometry { width, height } = self.size;
        let (top, left) = self.first;
        let pixel = |row: usize, column: usize| {
            (top + self.every * row) * self.sensor.width + left + self.every * column
        };
        (0..height).flat_map(|row| (0..width).map(move |column| pixel(row, column))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SENSOR: Geometry = Geometry { width: 160, height: 120 };

    #[test]
    fn what_is_small_is_whole_and_what_is_large_is_seen_evenly() {
        let small = Geometry { width: 80, height: 60 };
        let whole = Grid::of(small, 1600);
        assert_eq!(whole.every, 1);
        assert_eq!(whole.pixels(), (0..80 * 60).collect::<Vec<_>>());
        assert_eq!(whole.close(&[true; 80 * 60]), None);
        assert_eq!(Grid::of(small, 2000).every, 2);
        assert_eq!(Grid::of(SENSOR, 1).every, 2);
        // 2500 frames: 5 million samples are 2000 pixels; 54 x 40 are too many, 40 x 30 are not.
        let large = Grid::of(SENSOR, 2500);
        assert_eq!((large.every, large.geometry()), (4, Geometry { width: 40, height: 30 }));
        let pixels = large.pixels();
        assert_eq!((pixels[0], pixels[1], pixels[40]), (161, 165, 161 + 4 * 160));
        // Frames without end leave one pixel, not none.
        assert_eq!(Grid::of(SENSOR, usize::MAX / 40_000).geometry().pixels(), 1);
    }

    #[test]
    fn a_window_lies_where_the_edges_are() {
        let grid = Grid::of(SENSOR, 2500);
        let middle = grid.close(&[true; 160 * 120]).unwrap();
        assert_eq!((middle.every, middle.geometry()), (1, grid.geometry()));
        assert_eq!(middle.pixels()[0], 45 * 160 + 60);
        let left: Vec<bool> = (0..160 * 120).map(|pixel| pixel % 160 > 20).collect();
        let pixels = grid.close(&left).unwrap().pixels();
        assert!(pixels.iter().any(|&pixel| left[pixel]) && pixels.iter().any(|&pixel| !left[pixel]));
        assert!(pixels.windows(2).filter(|pair| pair[1] == pair[0] + 1).count() > 1000);
    }
}
