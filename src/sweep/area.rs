//! What a configuration costs: LUT4 + 2 · CCU2C of an ECP5, synthesised or by a fitted model.

use super::configuration::Configuration;
use crate::problem::{Problem, Result};
use crate::spec::exact;

/// Where an area comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AreaSource {
    /// The fitted model.
    Fitted,
    /// Synthesis of this very configuration.
    Synthesised,
}

impl AreaSource {
    /// What tables and pictures say.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fitted => "fitted model",
            Self::Synthesised => "synthesised",
        }
    }
}

/// An area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Area {
    /// LUT4 + 2 · CCU2C.
    pub luts: f64,
    /// Where the number comes from.
    pub source: AreaSource,
}

/// How iterations become hardware.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// A stage for each.
    Unrolled,
    /// One stage, one iteration a clock.
    Iterative,
}

/// Bits of hardware that are counted: the model is linear in them.
const FEATURES: [&str; 5] = ["fold", "shift", "vector", "angle", "once"];

/// LUT4 + 2 · CCU2C a counted bit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AreaModel {
    /// The layout that it is for.
    pub layout: Layout,
    /// One coefficient for each of: bits folded (magnitude, compare, swap), bits shifted by multiplexers, adder bits of x and y, adder
    /// bits of the angle, and 1 (control).
    pub coefficients: [f64; 5],
}

impl AreaModel {
    /// The model of `layout`, with the coefficients of this table.
    pub const fn of(layout: Layout) -> Self {
        let coefficients = match layout {
            Layout::Unrolled => [3.0, 0.5, 1.5, 1.3, 20.0],
            Layout::Iterative => [3.0, 0.5, 1.5, 1.3, 60.0],
        };
        Self { layout, coefficients }
    }

    /// The counted bits of `configuration`.
    ///
    /// - fold: both words;
    /// - shift: two magnitudes a stage of the normaliser, a stage a bit of the shift; one iterating stage also shifts x and y by a variable
    ///   number of places;
    /// - vector: the adders of x and y. y loses a bit an iteration; x no longer changes where 2i exceeds its fraction bits. With √3, the
    ///   adders of its two constant multiplications, one a non-zero digit but the first (canonical signed digits);
    /// - angle: the adders of the angle, and the last rounding and unfolding.
    fn features(layout: Layout, configuration: &Configuration) -> [f64; 5] {
        let &Configuration { x_bits, y_bits, phase_bits, iterations, angle_guard_bits, .. } = configuration;
        let fraction_bits = configuration.fraction_bits();
        let (scaled_bits, scaling_adders) = scaling(configuration);
        let angle_bits = phase_bits + angle_guard_bits - 1;
        let stages = |bits: u32| 32 - (bits - 1).leading_zeros();
        let normaliser = if configuration.normaliser { 2 * scaled_bits * stages(scaled_bits) } else { 0 };
        let y_bits_after = |i: u32| (fraction_bits + 3).saturating_sub(i).max(2);
        let x_bits_at = |i: u32| if 2 * i > fraction_bits { 0 } else { fraction_bits + 2 };
        let (shift, vector, angle) = match layout {
            Layout::Unrolled => (
                normaliser,
                (1..=iterations).map(|i| x_bits_at(i) + y_bits_after(i)).sum::<u32>(),
                iterations * angle_bits,
            ),
            Layout::Iterative => {
                (normaliser + 2 * (fraction_bits + 2) * stages(iterations), 2 * fraction_bits + 5, angle_bits)
            }
        };
        [x_bits + y_bits, shift, vector + scaling_adders, angle + phase_bits, 1].map(f64::from)
    }

    /// The area of `configuration`.
    pub fn area(&self, configuration: &Configuration) -> Area {
        let features = Self::features(self.layout, configuration);
        let luts = features.iter().zip(self.coefficients).map(|(bits, cost)| bits * cost).sum();
        Area { luts, source: AreaSource::Fitted }
    }

    /// The coefficients with the least squared relative error for synthesised areas, and the largest relative error that is left.
    ///
    /// # Errors
    /// Fewer points than coefficients, or points that do not tell them apart.
    pub fn fit(layout: Layout, points: &[(Configuration, f64)]) -> Result<(Self, f64)> {
        let refuse = |found: &str| {
            Problem::at("--fit-area", found)
                .expected(format_args!(
                    "at least {} synthesised points that differ in words, phase bits, iterations and guard bits",
                    FEATURES.len()
                ))
                .remedy("`vuris sweep --synthesise --out DIR` makes points")
        };
        if points.len() < FEATURES.len() {
            return Err(refuse(&format!("{} points", points.len())));
        }
        // Normal equations of the relative errors, with the right side in the last column.
        let mut rows = [[0.0; FEATURES.len() + 1]; FEATURES.len()];
        for (configuration, luts) in points {
            let features = Self::features(layout, configuration).map(|bits| bits / luts);
            for (row, &one) in rows.iter_mut().zip(&features) {
                for (cell, other) in row.iter_mut().zip(features.into_iter().chain([1.0])) {
                    *cell += one * other;
                }
            }
        }
        let coefficients = solved(rows).ok_or_else(|| refuse("points that are too much alike"))?;
        let model = Self { layout, coefficients };
        let relative = |(configuration, luts): &(Configuration, f64)| {
            (model.area(configuration).luts / luts - 1.0).abs()
        };
        let worst = points.iter().map(relative).fold(0.0, f64::max);
        Ok((model, worst))
    }

    /// The coefficients with their names.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, f64)> + '_ {
        FEATURES.into_iter().zip(self.coefficients)
    }
}

/// Bits of the larger magnitude behind the scaling, and adder bits that √3 takes.
fn scaling(configuration: &Configuration) -> (u32, u32) {
    let &Configuration { x_bits, y_bits, metric, phase_bits, .. } = configuration;
    if metric == 1 {
        return (x_bits.max(y_bits), 0);
    }
    let (y_factor, x_factor) = exact::sqrt3_ratio(std::f64::consts::TAU / f64::from(phase_bits).exp2() / 8.0);
    let bits = |factor: i64| 64 - factor.leading_zeros();
    // Non-zero digits of the canonical signed-digit form: of 3f xor f.
    let adders = |factor: i64| ((3 * factor) ^ factor).count_ones() - 1;
    let scaled = (x_bits + bits(x_factor)).max(y_bits + bits(y_factor));
    (scaled, scaled * (adders(x_factor) + adders(y_factor)))
}

/// Gauss' elimination with pivots; the last column is the right side.
fn solved<const N: usize, const M: usize>(mut rows: [[f64; M]; N]) -> Option<[f64; N]> {
    let scale = rows.iter().flatten().fold(0.0, |largest: f64, cell| largest.max(cell.abs()));
    for step in 0..N {
        let pivot = (step..N).max_by(|&a, &b| rows[a][step].abs().total_cmp(&rows[b][step].abs()))?;
        rows.swap(step, pivot);
        let pivot_row = rows[step];
        if pivot_row[step].abs() <= 1e-12 * scale {
            return None;
        }
        for (_, row) in rows.iter_mut().enumerate().filter(|(place, _)| *place != step) {
            let factor = row[step] / pivot_row[step];
            for (cell, other) in row.iter_mut().zip(pivot_row) {
                *cell -= factor * other;
            }
        }
    }
    Some(std::array::from_fn(|place| rows[place][M - 1] / rows[place][place]))
}

#[cfg(test)]
mod tests {
    use super::super::configuration::tests::word;
    use super::*;

    fn varied() -> Vec<Configuration> {
        let mut varied = Vec::new();
        for (bits, phase_bits) in [(8, 10), (12, 12), (12, 18), (16, 16), (20, 14)] {
            for (iterations, vector_guard_bits, angle_guard_bits) in [(10, 2, 2), (8, 4, 5), (13, 6, 1)] {
                varied.push(Configuration {
                    iterations,
                    vector_guard_bits,
                    angle_guard_bits,
                    ..word(bits, phase_bits)
                });
            }
        }
        varied
    }

    /// Areas made by known coefficients give these back.
    #[test]
    fn a_fit_finds_the_coefficients_that_made_its_points() {
        for layout in [Layout::Unrolled, Layout::Iterative] {
            let truth = AreaModel { layout, coefficients: [2.5, 0.75, 1.25, 1.5, 40.0] };
            let points: Vec<_> = varied().iter().map(|c| (*c, truth.area(c).luts)).collect();
            let (found, worst) = AreaModel::fit(layout, &points).unwrap();
            for (a, b) in found.coefficients.iter().zip(truth.coefficients) {
                assert!((a - b).abs() < 1e-6, "{found:?}");
            }
            assert!(worst < 1e-9);
            assert!(AreaModel::fit(layout, &points[..4]).is_err());
            assert!(AreaModel::fit(layout, &[points[0]; 9]).is_err());
        }
    }

    #[test]
    fn more_of_anything_costs_more_and_one_stage_less_than_many() {
        for layout in [Layout::Unrolled, Layout::Iterative] {
            let luts = |configuration| AreaModel::of(layout).area(&configuration).luts;
            let base = word(16, 14);
            for more in [
                Configuration { x_bits: 18, ..base },
                Configuration { phase_bits: 16, ..base },
                Configuration { vector_guard_bits: 5, ..base },
                Configuration { angle_guard_bits: 5, ..base },
                Configuration { metric: 3, ..base },
            ] {
                assert!(luts(more) > luts(base), "{layout:?} {more}");
            }
            assert!(luts(Configuration { normaliser: false, ..base }) < luts(base));
        }
        let unrolled = AreaModel::of(Layout::Unrolled).area(&word(16, 16)).luts;
        assert!(AreaModel::of(Layout::Iterative).area(&word(16, 16)).luts < unrolled / 2.0);
    }
}
