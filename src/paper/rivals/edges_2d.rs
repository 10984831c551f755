//! Edges of a 2D camera: pixels over which an edge of its image moves during a set have no distance, or a neighbour's.
//!
//! After Lottner, Sluiter, Hartmann and Weihs 2007, who put a 2D camera beside the range camera. Their thresholds and their rule of
//! replacement are not known here: edges are where Sobel's operator exceeds a share of the image's mean, an edge has moved where it is in
//! some frames' images and not in all, gaps between are closed, and the rule is the nearest pixel over which none has.

use super::image::Image;

/// Sobel's slope, as a share of the mean intensity a pixel, from which on there is an edge: half a check's contrast makes a third.
const SHARE: f64 = 0.1;

/// Pixels to every side by which the marked ones grow, and shrink again: an edge moves by some pixels from frame to frame.
const CLOSED: i64 = 2;

/// Where the image has an edge.
fn edges(image: &Image) -> Vec<bool> {
    let mean = image.values.iter().sum::<f64>() / image.values.len() as f64;
    let geometry = image.geometry;
    let is_edge = |pixel| {
        let (row, column) = geometry.row_column(pixel);
        let (row, column) = (row as i64, column as i64);
        let across = |row: i64| image.at(column + 1, row) - image.at(column - 1, row);
        let down = |column: i64| image.at(column, row + 1) - image.at(column, row - 1);
        let x = across(row - 1) + 2.0 * across(row) + across(row + 1);
        let y = down(column - 1) + 2.0 * down(column) + down(column + 1);
        x.hypot(y) / 8.0 > SHARE * mean
    };
    (0..geometry.pixels()).map(is_edge).collect()
}

/// Pixels over which an edge moves, of intensity images one a frame.
pub fn crossed(intensity_dn: &[Image]) -> Vec<bool> {
    let all: Vec<Vec<bool>> = intensity_dn.iter().map(edges).collect();
    let count = |pixel: usize| all.iter().filter(|edges| edges[pixel]).count();
    let geometry = intensity_dn[0].geometry;
    let is_crossed =
        |column, row| f64::from(u8::from((1..all.len()).contains(&count(row * geometry.width + column))));
    let grown = Image::of(geometry, is_crossed).summed(CLOSED);
    let free =
        Image::of(geometry, |column, row| f64::from(u8::from(grown.at(column as i64, row as i64) < 0.5)));
    free.summed(CLOSED).values.into_iter().map(|free| free < 0.5).collect()
}

/// Each pixel's nearest one that is not `crossed`, itself where it is not; `None` where all are.
pub fn replacements(image: &Image, crossed: &[bool]) -> Vec<Option<usize>> {
    let geometry = image.geometry;
    let place = |pixel| {
        let (row, column) = geometry.row_column(pixel);
        (row as i64, column as i64)
    };
    let free: Vec<usize> = (0..crossed.len()).filter(|pixel| !crossed[*pixel]).collect();
    let nearest = |pixel: usize| {
        let (row, column) = place(pixel);
        let squared = |other: &&usize| {
            let (other_row, other_column) = place(**other);
            (row - other_row).pow(2) + (column - other_column).pow(2)
        };
        if crossed[pixel] { free.iter().min_by_key(squared).copied() } else { Some(pixel) }
    };
    (0..crossed.len()).map(nearest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frames::Geometry;

    const GEOMETRY: Geometry = Geometry { width: 24, height: 6 };

    /// Bright on the left of `edge`, and a still edge at column 20.
    fn image(edge: usize) -> Image {
        Image::of(GEOMETRY, |column, _| if column < edge || column >= 20 { 300.0 } else { 100.0 })
    }

    #[test]
    fn moving_edges_are_found_and_still_ones_left() {
        let crossed = crossed(&[image(6), image(8), image(10)]);
        let columns: Vec<usize> =
            (0..GEOMETRY.width).filter(|column| crossed[2 * GEOMETRY.width + column]).collect();
        assert_eq!(columns, (5..11).collect::<Vec<_>>());
        assert!(super::crossed(&[image(6), image(6), image(6)]).iter().all(|crossed| !crossed));
        let nearest = replacements(&image(6), &crossed);
        let row = |column: usize| nearest[2 * GEOMETRY.width + column].map(|pixel| pixel % GEOMETRY.width);
        assert_eq!([row(4), row(6), row(9), row(11)], [Some(4), Some(4), Some(11), Some(11)]);
        assert_eq!(replacements(&image(6), &vec![true; GEOMETRY.pixels()])[0], None);
    }
}
