//! What is true of each pixel in all frames.

use super::per_pixel::PerPixel;
use crate::frames::Geometry;
use serde::Serialize;

/// What pixels' own phases are at another modulation frequency than the one at which they stand.
///
/// Cables and clock trees delay, so that a phase grows with the frequency, and a frequency's own synthesiser begins anywhere: no recording states that.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AtFrequency {
    /// The modulation frequency, Hz.
    pub frequency_hz: f64,
    /// So many times the pixel's own phase is there: 1 where it is a phase, the ratio of the frequencies where it is a delay.
    pub times: f64,
    /// What all pixels have there besides, rad.
    pub phase_rad: f64,
}

/// Modulation frequencies that differ by less of themselves are one.
const SAME_FREQUENCY: f64 = 1e-6;

/// Whether two modulation frequencies, Hz, are one, written with other digits.
pub fn is_same_frequency(a_hz: f64, b_hz: f64) -> bool {
    (a_hz / b_hz - 1.0).abs() < SAME_FREQUENCY
}

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
    /// What these are at other modulation frequencies: the same, where nothing is said.
    pub at_frequencies: Vec<AtFrequency>,
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

    /// What is said of the pixels' own phases at a modulation frequency, by its number.
    pub fn at_frequency(&self, frequency_hz: f64) -> Option<usize> {
        self.at_frequencies.iter().position(|at| is_same_frequency(at.frequency_hz, frequency_hz))
    }

    /// How many times the pixels' own phases count at a modulation frequency, and what all pixels have besides, rad.
    pub fn own_phase_at(&self, frequency_hz: f64) -> (f64, f64) {
        let at = self.at_frequency(frequency_hz).map(|number| self.at_frequencies[number]);
        at.map_or((1.0, 0.0), |at| (at.times, at.phase_rad))
    }

    /// The own phase of a `pixel` at a modulation frequency, rad.
    pub fn own_phase_rad(&self, pixel: usize, frequency_hz: f64) -> f64 {
        let (times, all_rad) = self.own_phase_at(frequency_hz);
        times * self.phase_rad[pixel] + all_rad
    }

    /// Column and row from the centre, as a share of the sensor's width and height: −0.5 to 0.5.
    pub fn place(&self, pixel: usize) -> (f64, f64) {
        let Geometry { width, height } = self.geometry;
        let (row, column) = self.geometry.row_column(pixel);
        let share = |index: usize, size: usize| (index as f64 + 0.5) / size as f64 - 0.5;
        (share(column, width), share(row, height))
    }

    /// What the direction of each pixel has of what lies `aside` of the camera's axis, along the columns and the rows: the sines of its angle to the
    /// axis, by the obliquity and the side of the image's middle, times these, added.
    pub fn along(&self, aside: [f64; 2]) -> Vec<f64> {
        let Geometry { width, height } = self.geometry;
        let off_axis = |index: usize, size: usize| index as f64 + 0.5 - 0.5 * size as f64;
        let mut along = vec![0.0; self.count()];
        let rows = along.chunks_exact_mut(width.max(1)).zip(self.obliquity.chunks_exact(width.max(1)));
        for (row, (along, obliquity)) in rows.enumerate() {
            let y = off_axis(row, height);
            for (column, (along, obliquity)) in along.iter_mut().zip(obliquity).enumerate() {
                let x = off_axis(column, width);
                let from_middle = x * x + y * y;
                let squared_sine = (1.0 - 1.0 / (obliquity * obliquity)).max(0.0);
                let sine = (squared_sine / from_middle).sqrt() * (aside[0] * x + aside[1] * y);
                *along = if from_middle > 0.0 { sine } else { 0.0 };
            }
        }
        along
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
}

/// Pixels that all see the target, straight ahead, alike.
#[cfg(test)]
pub(super) fn plain(geometry: Geometry) -> Pixels {
    let of = |value: f64| vec![value; geometry.pixels()];
    Pixels {
        geometry,
        target: vec![true; geometry.pixels()],
        obliquity: of(1.0),
        background_m: of(4.0),
        phase_rad: of(0.0),
        at_frequencies: Vec::new(),
        amplitude_1m_dn: of(1.0),
        constant_1m_dn: of(1.0),
        ambient_dn: of(0.0).into(),
        full_scale_dn: 4095.0,
        pedestal_dn: 0.0,
        edges: Vec::new(),
        edge_counts: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the tangents of a camera of this focal length: x / √(f² + x² + y²) along the columns, and y along the rows.
    #[test]
    fn sines_are_those_of_the_pixels_directions() {
        let geometry = Geometry { width: 5, height: 2 };
        let (focal_px, count) = (4.0_f64, geometry.pixels());
        let aside = |pixel: usize| [(pixel % 5) as f64 - 2.0, (pixel / 5) as f64 - 0.5];
        let away =
            |pixel: usize| (focal_px.powi(2) + aside(pixel).map(|px| px * px).iter().sum::<f64>()).sqrt();
        let obliquity = (0..count).map(|pixel| away(pixel) / focal_px).collect();
        let pixels = Pixels { obliquity, ..plain(geometry) };
        let found = [[1.0, 0.0], [0.0, 1.0]].map(|aside| pixels.along(aside));
        let both = pixels.along([0.3, -0.2]);
        for pixel in 0..count {
            let expected = aside(pixel).map(|px| px / away(pixel));
            let found = [found[0][pixel], found[1][pixel]];
            assert!((0..2).all(|side| (found[side] - expected[side]).abs() < 1e-12), "{pixel}: {found:?}");
            assert!((both[pixel] - (0.3 * expected[0] - 0.2 * expected[1])).abs() < 1e-12);
        }
    }
}
