//! An image that is sampled between its pixels.

use crate::frames::Geometry;

/// Values, one a pixel, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Columns and rows, at least one of each.
    pub geometry: Geometry,
    /// The values.
    pub values: Vec<f64>,
}

impl Image {
    /// The value of `of` at every column and row.
    pub fn of(geometry: Geometry, of: impl Fn(usize, usize) -> f64) -> Self {
        let value = |pixel| {
            let (row, column) = geometry.row_column(pixel);
            of(column, row)
        };
        Self { geometry, values: (0..geometry.pixels()).map(value).collect() }
    }

    /// The value at column and row; beyond the rim that of the nearest pixel.
    pub fn at(&self, column: i64, row: i64) -> f64 {
        let inside = |index: i64, size: usize| index.clamp(0, size as i64 - 1) as usize;
        let Geometry { width, height } = self.geometry;
        self.values[inside(row, height) * width + inside(column, width)]
    }

    /// The value at a place between pixels, bilinear.
    pub fn sample(&self, column: f64, row: f64) -> f64 {
        let (left, above) = (column.floor(), row.floor());
        let (across, down) = (column - left, row - above);
        let line =
            |row: i64| (1.0 - across) * self.at(left as i64, row) + across * self.at(left as i64 + 1, row);
        (1.0 - down) * line(above as i64) + down * line(above as i64 + 1)
    }

    /// Slopes along columns and rows, a pixel, by central differences.
    pub fn slopes(&self) -> [Self; 2] {
        let slope = |across: i64, down: i64| {
            Self::of(self.geometry, |column, row| {
                let (column, row) = (column as i64, row as i64);
                (self.at(column + across, row + down) - self.at(column - across, row - down)) / 2.0
            })
        };
        [slope(1, 0), slope(0, 1)]
    }

    /// Half as many columns and rows, each the mean of two by two.
    pub fn halved(&self) -> Self {
        let half = |size: usize| size.div_ceil(2);
        let geometry = Geometry { width: half(self.geometry.width), height: half(self.geometry.height) };
        Self::of(geometry, |column, row| self.sample(2.0 * column as f64 + 0.5, 2.0 * row as f64 + 0.5))
    }

    /// The sum over the window of `reach` pixels to every side.
    pub fn summed(&self, reach: i64) -> Self {
        let along = |image: &Self, across: i64, down: i64| {
            Self::of(self.geometry, |column, row| {
                let (column, row) = (column as i64, row as i64);
                (-reach..=reach).map(|step| image.at(column + across * step, row + down * step)).sum()
            })
        };
        along(&along(self, 1, 0), 0, 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GEOMETRY: Geometry = Geometry { width: 6, height: 4 };

    #[test]
    fn a_plane_is_sampled_sloped_and_halved_as_a_plane() {
        let plane = Image::of(GEOMETRY, |column, row| 3.0 + 2.0 * column as f64 - row as f64);
        assert!((plane.sample(2.25, 1.5) - (3.0 + 4.5 - 1.5)).abs() < 1e-12);
        let [across, down] = plane.slopes();
        assert_eq!((across.at(2, 1), down.at(2, 1), across.at(0, 0)), (2.0, -1.0, 1.0));
        let half = plane.halved();
        assert_eq!((half.geometry, half.at(1, 0)), (Geometry { width: 3, height: 2 }, 3.0 + 5.0 - 0.5));
        assert_eq!(plane.summed(1).at(2, 1), 9.0 * plane.at(2, 1));
        assert_eq!((plane.at(-3, 9), plane.sample(99.0, 0.0)), (plane.at(0, 3), plane.at(5, 0)));
    }
}
