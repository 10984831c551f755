//! Slopes of an image along its columns and rows: what a scene that moves sideways changes.

use super::pixels::Pixels;
use crate::frames::Geometry;

/// Along what an image has slopes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// From column to column.
    Columns,
    /// From row to row.
    Rows,
}

impl Side {
    /// Both, columns first.
    pub const ALL: [Self; 2] = [Self::Columns, Self::Rows];

    /// The pixels before and after a pixel along it.
    fn beside(self, geometry: Geometry, pixel: usize) -> [Option<usize>; 2] {
        let [left, right, above, below] = geometry.beside(pixel);
        if self == Self::Columns { [left, right] } else { [above, below] }
    }

    fn other(self) -> Self {
        if self == Self::Columns { Self::Rows } else { Self::Columns }
    }
}

/// Slopes of `values` along `side`, a pixel, on the side from which the image comes that moves by `moved` pixels; 0 beyond the image's border.
pub fn slopes(pixels: &Pixels, values: &[f64], side: Side, moved: f64) -> Vec<f64> {
    let of = |pixel: usize| match side.beside(pixels.geometry, pixel) {
        [Some(before), _] if moved > 0.0 => values[pixel] - values[before],
        [_, Some(after)] if moved < 0.0 => values[after] - values[pixel],
        _ => 0.0,
    };
    (0..values.len()).map(of).collect()
}

/// The same of the target's texture, whichever way it moves: the mean over the pixel's row or column and those beside it, which the pixels' own gains change
/// less. There is one where the target is on both sides; a pixel beyond the target has none.
pub fn slopes_of_texture(pixels: &Pixels, values: &[f64], side: Side) -> Vec<f64> {
    let (geometry, target) = (pixels.geometry, &pixels.target);
    let own = |pixel: usize| match side.beside(geometry, pixel) {
        [Some(before), Some(after)] if target[before] && target[after] => {
            Some(0.5 * (values[after] - values[before]))
        }
        _ => None,
    };
    let own: Vec<Option<f64>> = (0..values.len()).map(own).collect();
    let mean = |pixel: usize| {
        let [before, after] = side.other().beside(geometry, pixel);
        let there = [Some(pixel), before, after].into_iter().flatten().filter_map(|pixel| own[pixel]);
        let (sum, count) = there.fold((0.0, 0.0), |(sum, count), slope| (sum + slope, count + 1.0));
        if target[pixel] && count > 0.0 { sum / count } else { 0.0 }
    };
    (0..values.len()).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::pixels::plain;

    /// Pixels of which those at these places see the background.
    fn pixels(width: usize, height: usize, background: &[usize]) -> Pixels {
        let geometry = Geometry { width, height };
        let target = (0..geometry.pixels()).map(|pixel| !background.contains(&pixel)).collect();
        Pixels { target, ..plain(geometry) }
    }

    /// A plane has its slopes within an image that the target fills, and none across its border or over the target's edge.
    #[test]
    fn a_texture_has_slopes_where_both_sides_are_the_targets() {
        let plane: Vec<f64> =
            (0..12).map(|pixel| 2.0 * (pixel % 4) as f64 - 0.5 * (pixel / 4) as f64).collect();
        let slopes = |pixels: &Pixels, places: [usize; 3]| {
            let of = Side::ALL.map(|side| slopes_of_texture(pixels, &plane, side));
            places.map(|pixel| (of[0][pixel], of[1][pixel]))
        };
        let full = pixels(4, 3, &[]);
        assert_eq!(slopes(&full, [5, 6, 5])[..2], [(2.0, -0.5), (2.0, -0.5)]);
        // At the border there is one side alone along it.
        assert_eq!(slopes(&full, [0, 1, 4]), [(0.0, 0.0), (2.0, 0.0), (0.0, -0.5)]);
        // What the background shows does not count.
        let window = pixels(4, 3, &[0, 4, 8]);
        assert_eq!(slopes(&window, [4, 5, 6]), [(0.0, 0.0), (0.0, -0.5), (2.0, -0.5)]);
        assert_eq!(slopes_of_texture(&pixels(1, 1, &[]), &[7.0], Side::Rows), [0.0]);
    }

    /// Squares of the columns: the slope differs by the side from which the image comes.
    #[test]
    fn an_image_has_slopes_on_the_side_from_which_it_comes() {
        let squares: Vec<f64> = (0..8).map(|pixel| f64::from((pixel % 4) * (pixel % 4))).collect();
        let image = pixels(4, 2, &[]);
        assert_eq!(slopes(&image, &squares, Side::Columns, 0.1)[..4], [0.0, 1.0, 3.0, 5.0]);
        assert_eq!(slopes(&image, &squares, Side::Columns, -0.1)[4..], [1.0, 3.0, 5.0, 0.0]);
        let rows: Vec<f64> = (0..8).map(|pixel| f64::from(pixel / 4 * 7)).collect();
        assert_eq!(slopes(&image, &rows, Side::Rows, 2.0), [0.0, 0.0, 0.0, 0.0, 7.0, 7.0, 7.0, 7.0]);
        assert_eq!(slopes(&image, &rows, Side::Rows, 0.0), [0.0; 8]);
    }
}
