//! What is true of each pixel in all frames.

use super::per_pixel::PerPixel;
use crate::frames::Geometry;

/// The pixels of a camera before a scene. Arrays have one entry a pixel, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Pixels {
    /// Columns and rows.
    pub geometry: Geometry,
    /// Whether it sees the target; all others see a still background.
    pub target: Vec<bool>,
    /// Radial over axial distance, >= 1.
    pub obliquity: Vec<f64>,
    /// Radial range of the background, m, > 0; not used where the target is seen.
    pub background_m: Vec<f64>,
    /// Phase of its own (fixed pattern), rad.
    pub phase_rad: Vec<f64>,
    /// Amplitude of the fundamental, DN, of what it sees at 1 m.
    pub amplitude_1m_dn: Vec<f64>,
    /// The constant part of the camera's own light, DN, at 1 m.
    pub constant_1m_dn: Vec<f64>,
    /// Ambient light, DN.
    pub ambient_dn: PerPixel,
    /// Code of full scale, DN above the pedestal.
    pub full_scale_dn: f64,
    /// Code at no light, DN.
    pub pedestal_dn: f64,
    /// Pairs of neighbours of which one sees the target and the other does not: a pixel, and the one beyond the edge.
    pub edges: Vec<(usize, usize)>,
    /// Of each pair: how many neighbours beyond the edge its pixel has.
    pub edge_counts: Vec<f64>,
}

impl Pixels {
    /// Number of pixels.
    pub fn count(&self) -> usize {
        self.geometry.pixels()
    }

    /// Column and row from the centre, as a share of the sensor's width and height: −0.5 to 0.5.
    pub fn place(&self, pixel: usize) -> (f64, f64) {
        let Geometry { width, height } = self.geometry;
        let (row, column) = self.geometry.row_column(pixel);
        let share = |index: usize, size: usize| (index as f64 + 0.5) / size as f64 - 0.5;
        (share(column, width), share(row, height))
    }

    /// The pairs of [`Pixels::edges`] of a mask.
    pub fn edges_of(geometry: Geometry, target: &[bool]) -> Vec<(usize, usize)> {
        let pairs = |pixel: usize| {
            let beside = geometry.beside(pixel).into_iter().flatten();
            beside.filter(move |&beside| target[beside] != target[pixel]).map(move |beside| (pixel, beside))
        };
        (0..geometry.pixels()).flat_map(pairs).collect()
    }

    /// Entries of [`Pixels::edge_counts`] for these pairs.
    pub fn edge_counts_of(edges: &[(usize, usize)]) -> Vec<f64> {
        edges.iter().map(|(pixel, _)| edges.iter().filter(|(own, _)| own == pixel).count() as f64).collect()
    }

    /// Slope of `values` along the columns and the rows at a pixel, a pixel, on the side from which the image comes that
    /// moves by `moved` columns and rows.
    pub fn slopes(&self, values: &[f64], pixel: usize, moved: [f64; 2]) -> (f64, f64) {
        let [left, right, above, below] = self.geometry.beside(pixel);
        let slope = |before: Option<usize>, after: Option<usize>, moved: f64| match (before, after) {
            (Some(before), _) if moved > 0.0 => values[pixel] - values[before],
            (_, Some(after)) if moved < 0.0 => values[after] - values[pixel],
            _ => 0.0,
        };
        (slope(left, right, moved[0]), slope(above, below, moved[1]))
    }

    /// The same of the target's texture there, whichever way it moves: the mean over the pixel's rows and columns and those beside them, which the pixels' own
    /// gains change less. A pixel beyond the target has none.
    pub fn slopes_of_texture(&self, values: &[f64], pixel: usize) -> (f64, f64) {
        if !self.target[pixel] {
            return (0.0, 0.0);
        }
        let (row, column) = self.geometry.row_column(pixel);
        let at = |row: usize, column: usize| {
            let is_there = row < self.geometry.height && column < self.geometry.width;
            let pixel = is_there.then(|| row * self.geometry.width + column);
            pixel.filter(|&pixel| self.target[pixel]).map(|pixel| values[pixel])
        };
        let mean = |ends: &dyn Fn(usize) -> (Option<f64>, Option<f64>)| {
            let slopes = (0..3).filter_map(|side| match ends(side) {
                (Some(before), Some(after)) => Some(0.5 * (after - before)),
                _ => None,
            });
            let (sum, count) = slopes.fold((0.0, 0.0), |(sum, count), slope| (sum + slope, count + 1.0));
            if count > 0.0 { sum / count } else { 0.0 }
        };
        // The side before the first row or column is no place of the image.
        let beside = |place: usize, side: usize| (place + side).wrapping_sub(1);
        let along = mean(&|side| {
            let row = beside(row, side);
            (at(row, beside(column, 0)), at(row, column + 1))
        });
        let down = mean(&|side| {
            let column = beside(column, side);
            (at(beside(row, 0), column), at(row + 1, column))
        });
        (along, down)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pixels of which those at these places see the background.
    fn pixels(width: usize, height: usize, background: &[usize]) -> Pixels {
        let geometry = Geometry { width, height };
        let count = geometry.pixels();
        let of = |value: f64| vec![value; count];
        Pixels {
            geometry,
            target: (0..count).map(|pixel| !background.contains(&pixel)).collect(),
            obliquity: of(1.0),
            background_m: of(4.0),
            phase_rad: of(0.0),
            amplitude_1m_dn: of(1.0),
            constant_1m_dn: of(1.0),
            ambient_dn: of(0.0).into(),
            full_scale_dn: 4095.0,
            pedestal_dn: 0.0,
            edges: Vec::new(),
            edge_counts: Vec::new(),
        }
    }

    /// A plane has its slopes within an image that the target fills, and none across its border or over the target's edge.
    #[test]
    fn a_texture_has_slopes_where_both_sides_are_the_targets() {
        let plane: Vec<f64> =
            (0..12).map(|pixel| 2.0 * (pixel % 4) as f64 - 0.5 * (pixel / 4) as f64).collect();
        let full = pixels(4, 3, &[]);
        let slopes = |pixels: &Pixels, pixel: usize| pixels.slopes_of_texture(&plane, pixel);
        assert_eq!((slopes(&full, 5), slopes(&full, 6)), ((2.0, -0.5), (2.0, -0.5)));
        // At the border there is one side alone along it.
        assert_eq!(
            (slopes(&full, 0), slopes(&full, 1), slopes(&full, 4)),
            ((0.0, 0.0), (2.0, 0.0), (0.0, -0.5))
        );
        // What the background shows does not count.
        let window = pixels(4, 3, &[0, 4, 8]);
        assert_eq!(
            (slopes(&window, 4), slopes(&window, 5), slopes(&window, 6)),
            ((0.0, 0.0), (0.0, -0.5), (2.0, -0.5))
        );
        assert_eq!(pixels(1, 1, &[]).slopes_of_texture(&[7.0], 0), (0.0, 0.0));
    }
}
