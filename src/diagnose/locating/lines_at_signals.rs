//! Rows or columns that are off where the signal is of some height: amplifiers and converters of a line, which sag, or do not settle.

use super::areas::{Rectangle, Said, Search, beside_own, leave_common, spans};
use super::ranges::Ranges;
use crate::diagnose::fitting::gram::Whitened;
use crate::diagnose::reading::data::Data;
use crate::diagnose::statistics::evidence::Greatest;
use crate::diagnose::tangents::columns::OWN;
use nalgebra::{Matrix4, Vector4};

/// Signals are parted where so many parts have as many samples each; any parts that follow one another are looked at together.
pub const PARTS: usize = 8;
/// Up to a few whole rows, or columns.
const SIZES: [(usize, usize); 8] = [(1, 0), (2, 0), (3, 0), (4, 0), (0, 1), (0, 2), (0, 3), (0, 4)];
/// Sums of a part: score, information, what an offset shares with the pixel's own numbers, and, of all samples, residuals' squares and how many they are.
const SUMS: usize = 4 + OWN;

/// Sums over parts of the signals: `[part][pixel][sum]`, nothing before the first frame.
#[derive(Debug, Clone, Default)]
pub struct LinesAtSignals {
    sums: Vec<f32>,
}

/// A few lines that stand out.
#[derive(Debug, Clone, PartialEq)]
pub struct Lines {
    /// Of columns, or of rows.
    pub are_columns: bool,
    /// The first and the last, of those that are looked at.
    pub lines: (usize, usize),
    /// First and last part of the signals.
    pub parts: (usize, usize),
    /// Their evidence.
    pub found: Greatest,
}

impl Lines {
    /// What they are lines of.
    pub fn coordinate(&self) -> &'static str {
        if self.are_columns { "column" } else { "row" }
    }

    /// They in words: lines are the sensor's.
    pub fn shape(&self, data: &Data, ranges: &Ranges) -> String {
        let pixels = data.grid.pixels();
        let at = |line: usize| {
            let pixel = if self.are_columns { line } else { line * data.geometry().width };
            let (row, column) = data.grid.sensor.row_column(pixels[pixel]);
            if self.are_columns { column } else { row }
        };
        let (first, last, lines) = (at(self.lines.0), at(self.lines.1), self.coordinate());
        let edges = &ranges.signals_dn;
        let (from, to) =
            (self.parts.0.checked_sub(1).map(|edge| edges[edge]), edges.get(self.parts.1).copied());
        let signals = match (from, to) {
            (None, Some(to)) => format!(" at signals below {to:.0} DN"),
            (Some(from), None) => format!(" at signals above {from:.0} DN"),
            (Some(from), Some(to)) => format!(" at signals from {from:.0} to {to:.0} DN"),
            (None, None) => String::new(),
        };
        format!("offset in {lines}s {first} to {last}{signals}")
    }
}

impl LinesAtSignals {
    /// With one more frame.
    pub fn with(mut self, ranges: &Ranges, whitened: &Whitened) -> Self {
        let (frame, pixels) = (whitened.frame, whitened.roots.len());
        self.sums.resize(PARTS * SUMS * pixels, 0.0);
        for (pixel, (&root, &signal_dn)) in whitened.roots.iter().zip(frame.base.iter()).enumerate() {
            let part = ranges.signals_dn.iter().filter(|edge| signal_dn > **edge).count();
            let sums = &mut self.sums[(part * pixels + pixel) * SUMS..][..SUMS];
            sums[0] += (root * whitened.residual[pixel]) as f32;
            sums[1] += (root * root) as f32;
            for (sum, own) in sums[2..].iter_mut().zip(&frame.own) {
                *sum += (root * root * own[pixel]) as f32;
            }
            sums[2 + OWN] += whitened.residual[pixel].powi(2) as f32;
            sums[3 + OWN] += if root > 0.0 { 1.0 } else { 0.0 };
        }
        self
    }

    /// Of other frames, too.
    pub fn and(mut self, other: Self) -> Self {
        if self.sums.is_empty() {
            return other;
        }
        self.sums.iter_mut().zip(other.sums).for_each(|(sum, other)| *sum += other);
        self
    }

    /// The lines that stand out most, over what as many lines usually say. `inverses`: of the normal equations of each pixel's own numbers.
    pub fn strongest(&self, data: &Data, inverses: &[Matrix4<f64>]) -> Option<Lines> {
        if self.sums.is_empty() {
            return None;
        }
        let geometry = data.geometry();
        let noise: Vec<f64> = (0..inverses.len()).map(|pixel| self.noise(pixel, inverses.len())).collect();
        let mut search = Search::of(&SIZES);
        for part in spans(PARTS) {
            search.look(&self.said(data, inverses, &noise, part), geometry.width, part);
        }
        let lines = (geometry.width + geometry.height) * SIZES.len() / 2;
        let looked = (spans(PARTS).count() * lines) as f64;
        let lines = |of: Rectangle<(usize, usize)>| {
            let are_columns = of.size.0 == 0;
            let lines = if are_columns { of.columns } else { of.rows };
            Lines { are_columns, lines, parts: of.part, found: Greatest::of(of.chi2, 1, looked) }
        };
        search.end().map(lines).max_by(|a, b| a.found.chi2.0.total_cmp(&b.found.chi2.0))
    }

    /// One of a pixel's sums, over some parts.
    fn sum(&self, (first, last): (usize, usize), number: usize, pixel: usize, pixels: usize) -> f64 {
        (first..=last).map(|part| f64::from(self.sums[(part * pixels + pixel) * SUMS + number])).sum()
    }

    /// The variance of a pixel's noise over what is taken for it, where it is more: a pixel that is noisier than others knows less.
    fn noise(&self, pixel: usize, pixels: usize) -> f64 {
        let [squares, samples] =
            [2 + OWN, 3 + OWN].map(|number| self.sum((0, PARTS - 1), number, pixel, pixels));
        (squares / samples.max(1.0)).max(1.0)
    }

    /// What each pixel, of its `noise`, says at signals of some parts, beside its own numbers, and beside what all pixels of the target, or of the background, do there.
    fn said(&self, data: &Data, inverses: &[Matrix4<f64>], noise: &[f64], part: (usize, usize)) -> Vec<Said> {
        let pixels = inverses.len();
        let of_pixel = |pixel: usize| {
            let sum = |number: usize| self.sum(part, number, pixel, pixels);
            let own = Vector4::from_fn(|number, _| sum(2 + number));
            let (score, information) = beside_own(sum(0), sum(1), own, &inverses[pixel]);
            (score / noise[pixel], information / noise[pixel])
        };
        let mut said: Vec<Said> = (0..pixels).map(of_pixel).collect();
        leave_common(&mut said, &data.target);
        said
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::locating::location::{LOCATED_NATS, locate};
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;
    use crate::physics::Draws;

    const WIDTH: usize = 16;
    const PIXELS: usize = WIDTH * 12;

    /// What is said of lines in a clean rail of 16 x 12 pixels, of which `change` has changed every signal (row, column, signal, a normal draw).
    fn found(change: impl Fn(usize, usize, f64, f64) -> f64) -> (String, f64) {
        let recordings = taken(Geometry { width: WIDTH, height: 12 }, 3, &[], &["four-rail", "wdft-rail"]);
        let mut data = Data::of(&recordings.unwrap(), Vec::new()).unwrap();
        for (number, take) in data.takes.iter_mut().enumerate() {
            let draws = Draws::of(5, number as u64).normal(take.signal_dn.len());
            for (at, (signal, draw)) in take.signal_dn.iter_mut().zip(draws).enumerate() {
                let (row, column) = (at % PIXELS / WIDTH, at % WIDTH);
                *signal = change(row, column, f64::from(*signal), draw) as f32;
            }
        }
        let noise = stated_noise(&data);
        let location = locate(&data, &unfitted(&data, noise), noise);
        let lines = location.columns.into_iter().find(|located| located.shape.contains(" at signals "));
        lines.map_or((String::new(), 0.0), |located| (located.shape, located.ln_bayes))
    }

    #[test]
    fn lines_that_sag_are_found_where_they_are() {
        const BRIGHT_DN: f64 = 500.0;
        let sagged = |is_there: bool, signal: f64| {
            signal - if is_there { 0.05 * (signal - BRIGHT_DN).max(0.0) } else { 0.0 }
        };
        let columns = found(|_, column, signal, _| sagged((9..11).contains(&column), signal));
        let rows = found(|row, _, signal, _| sagged(row == 4, signal));
        for (place, (shape, ln_bayes)) in [("columns 9 to 10 at ", columns), ("rows 4 to 4 at ", rows)] {
            assert!(shape.contains(place) && ln_bayes > 20.0, "{shape}: {ln_bayes}");
        }
    }

    /// A line of noisy pixels is none that sags, nor is a clean one.
    #[test]
    fn what_is_only_noisy_does_not_sag() {
        let noisy_column = |line: usize, noise_dn: f64| {
            found(|_, column, signal, draw| signal + if column == line { noise_dn * draw } else { 0.0 })
        };
        let noisy_row = |line: usize, noise_dn: f64| {
            found(|row, _, signal, draw| signal + if row == line { noise_dn * draw } else { 0.0 })
        };
        // With the noise that is stated, the second and the last two of these would be lines that sag.
        let noisy = [noisy_column(5, 20.0), noisy_column(9, 40.0), noisy_row(5, 14.0), noisy_row(5, 20.0)];
        let clean = found(|_, _, signal, _| signal);
        for (shape, ln_bayes) in noisy.into_iter().chain([clean]) {
            assert!(ln_bayes < LOCATED_NATS, "{shape}: {ln_bayes}");
        }
    }
}
