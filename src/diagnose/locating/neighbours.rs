//! The neighbours as a coordinate: a sample may be off by what others of its frame have more than it.

use super::coordinates::{View, each};
use crate::diagnose::tangents::acting::Acting;
use crate::frames::Geometry;

/// What each column looks like, in words.
pub const NEIGHBOURS: [&str; 4] =
    ["neighbours beside", "neighbours above and below", "neighbours that are brighter", "the whole image"];

/// Columns by how much brighter what is beside a pixel is than the pixel itself.
pub fn neighbours(view: &View) -> Acting {
    let base = &view.frame.base;
    let Geometry { width, height } = view.ranges.geometry;
    let mean = base.iter().sum::<f64>() / base.len().max(1) as f64;
    let mut columns: Vec<Vec<f64>> = vec![vec![0.0; base.len()]; NEIGHBOURS.len()];
    for (pixel, &own) in base.iter().enumerate() {
        let (row, column) = view.ranges.geometry.row_column(pixel);
        let at = |row: usize, column: usize| base[row.min(height - 1) * width + column.min(width - 1)] - own;
        let [left, right] = [at(row, column.saturating_sub(1)), at(row, column + 1)];
        let [above, below] = [at(row.saturating_sub(1), column), at(row + 1, column)];
        columns[0][pixel] = left + right;
        columns[1][pixel] = above + below;
        columns[2][pixel] = [left, right, above, below].iter().map(|more| more.max(0.0)).sum();
        columns[3][pixel] = mean - own;
    }
    each(columns)
}
