//! What a configuration costs: LUT4 + 2 · CCU2C of an ECP5, synthesised or by a fitted model.

use crate::problem::{Problem, Result};
use crate::spec::{AngleUnit, Architecture, Throughput};

/// Where an area comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AreaSource {
    /// The fitted model.
    Fitted,
    /// The fitted model, of a unit unlike those that it was fitted to.
    Extrapolated,
    /// Synthesis of this very configuration.
    Synthesised,
}

impl AreaSource {
    /// What tables and pictures say.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fitted => "fitted model",
            Self::Extrapolated => "fitted model, extrapolated",
            Self::Synthesised => "synthesised",
        }
    }
}

impl AreaSource {
    /// What stands over a table or beside an axis: each that is there, once.
    pub fn names(sources: impl IntoIterator<Item = Self>) -> String {
        let mut names: Vec<&str> = sources.into_iter().map(Self::name).collect();
        names.sort_unstable();
        names.dedup();
        names.join("; ")
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

/// Bits of hardware that are counted: the model is linear in them.
const FEATURES: [&str; 5] = ["fold", "shift", "vector", "tripled", "angle"];

/// What a counted bit costs in one architecture: LUT4 + 2 · CCU2C.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AreaModel {
    /// One coefficient for each of: bits folded, bits shifted by multiplexers, adder bits of x and y, bits of tripled y, and bits of
    /// the angle.
    pub coefficients: [f64; 5],
}

impl AreaModel {
    /// The model of `architecture`, with the coefficients that `vuris sweep --fit-area tests/data/area-points.csv` prints.
    ///
    /// The points are 57 units without length, synthesised by Yosys 0.70 (`synth_ecp5`): words of 8 to 24 bits, phases of 8 to 20. No
    /// point is further off than 3 % unrolled, 5 % folded (four clocks a vector), 12 % for one iteration a clock. Of other words or
    /// phases, other clocks a vector, fewer registers or a length it is an [extrapolation](AreaSource::Extrapolated). `vuris sweep --synthesise --out DIR` over several words, phase bits,
    /// iterations and guard bits, of both metrics, makes new points (the rows of DIR/sweep.csv).
    pub const fn of(architecture: Architecture) -> Self {
        let coefficients = match architecture {
            Architecture::Unrolled => [2.6971, 0.8215, 1.4759, 0.9255, 2.9167],
            Architecture::Folded { .. } => [2.0157, 0.9944, 1.1963, 1.0956, 1.4307],
            Architecture::Iterative => [1.4099, -10.2515, 4.1805, 4.1514, 4.7316],
            // Not a CORDIC: no model, and no number either.
            Architecture::Tables => [f64::NAN; 5],
        };
        Self { coefficients }
    }

    /// The counted bits of `unit`, from its derived widths.
    ///
    /// - fold: both words;
    /// - shift: two magnitudes a stage of the normaliser, and where a stage of a ring serves several iterations, the choice of the
    ///   places by which its y is shifted for x. The iterative unit's normaliser shifts a place a clock while it loads, which
    ///   costs next to nothing: here 1, for what depends on no word;
    /// - vector: y's adder of every stage that is built, and x's as long as x follows;
    /// - tripled: with metric 3, another adder of y's bits wherever x follows;
    /// - angle: the sums of the angle's groups, or the one angle.
    fn features(unit: &AngleUnit) -> [f64; 5] {
        let levels = unit.shifts.len() as u32;
        let follows = |i: u32| i <= unit.stages.x_iterations;
        let bits_at = |i: u32| {
            let (x, y) = (unit.stages.x[i as usize].bits, unit.stages.y[i as usize].bits);
            y + if follows(i) { x } else { 0 }
        };
        let tripled_at =
            |i: u32| if unit.metric == 3 && follows(i) { unit.stages.y[i as usize].bits } else { 0 };
        let y_bits = unit.stages.y[0].bits;
        let angles = unit.groups.iter().map(|group| group.bits).sum::<u32>();
        let choice = |of: u32| y_bits * (u32::BITS - of.saturating_sub(1).leading_zeros());
        let magnitudes = 2 * unit.magnitude_bits;
        let over = |stages: u32, bits: &dyn Fn(u32) -> u32| (0..stages).map(bits).sum::<u32>();
        let (shift, built, angle) = match unit.architecture {
            Architecture::Unrolled => (magnitudes * levels, unit.iterations, angles),
            Architecture::Folded { stages, rounds } => {
                (magnitudes * levels + stages * choice(rounds), stages, angles)
            }
            Architecture::Iterative => (1, 1, unit.angle_bits),
            Architecture::Tables => (0, 0, 0),
        };
        let fold = unit.x_bits + unit.y_bits;
        [fold, shift, over(built, &bits_at), over(built, &tripled_at), angle].map(f64::from)
    }

    /// Whether `unit` is like the points that the coefficients were fitted to.
    fn is_covered(unit: &AngleUnit) -> bool {
        let clocks = match unit.architecture {
            Architecture::Folded { .. } => unit.cordic.throughput == Throughput::CyclesPerPixel(4),
            Architecture::Unrolled | Architecture::Iterative => true,
            Architecture::Tables => false,
        };
        let words = [unit.x_bits, unit.y_bits].iter().all(|bits| (8..=24).contains(bits));
        clocks
            && words
            && (8..=20).contains(&unit.phase_bits)
            && unit.length_bits == 0
            && unit.cordic.pipeline_every == 1
    }

    /// The area of `unit`.
    pub fn area(&self, unit: &AngleUnit) -> Area {
        let luts = Self::features(unit).iter().zip(self.coefficients).map(|(bits, cost)| bits * cost).sum();
        let source = if Self::is_covered(unit) { AreaSource::Fitted } else { AreaSource::Extrapolated };
        Area { luts, source }
    }

    /// The coefficients with the least squared relative error for synthesised areas of units of one architecture, and the largest
    /// relative error that is left.
    ///
    /// # Errors
    /// Fewer points than coefficients, or points that do not tell them apart.
    pub fn fit(points: &[(AngleUnit, f64)]) -> Result<(Self, f64)> {
        let refuse = |found: &str| {
            Problem::at("--fit-area", found)
                .expected(format_args!(
                    "at least {} synthesised points of one architecture that differ in words, phase bits, iterations and guard bits",
                    FEATURES.len()
                ))
                .remedy("`vuris sweep --synthesise --out DIR` over more values makes them")
        };
        if points.len() < FEATURES.len() {
            return Err(refuse(&format!("{} points", points.len())));
        }
        // Normal equations of the relative errors, with the right side in the last column.
        let mut rows = [[0.0; FEATURES.len() + 1]; FEATURES.len()];
        for (unit, luts) in points {
            let features = Self::features(unit).map(|bits| bits / luts);
            for (row, &one) in rows.iter_mut().zip(&features) {
                for (cell, other) in row.iter_mut().zip(features.into_iter().chain([1.0])) {
                    *cell += one * other;
                }
            }
        }
        let coefficients = solved(rows).ok_or_else(|| refuse("points that are too much alike"))?;
        let model = Self { coefficients };
        let relative = |(unit, luts): &(AngleUnit, f64)| (model.area(unit).luts / luts - 1.0).abs();
        let worst = points.iter().map(relative).fold(0.0, f64::max);
        Ok((model, worst))
    }

    /// The coefficients with their names.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, f64)> + '_ {
        FEATURES.into_iter().zip(self.coefficients)
    }
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
    use super::super::configuration::Configuration;
    use super::super::configuration::tests::word;
    use super::*;

    const THROUGHPUTS: [Throughput; 3] =
        [Throughput::CyclesPerPixel(1), Throughput::CyclesPerPixel(4), Throughput::OneIterationAClock];

    fn varied(throughput: Throughput) -> Vec<AngleUnit> {
        let mut varied = Vec::new();
        for (bits, phase_bits) in [(8, 10), (12, 12), (12, 18), (16, 16), (20, 14)] {
            for (iterations, vector_guard_bits, angle_guard_bits) in [(10, 2, 2), (8, 4, 5), (13, 6, 1)] {
                let metric = if bits == 12 { 3 } else { 1 };
                let changed = Configuration {
                    metric,
                    iterations,
                    vector_guard_bits,
                    angle_guard_bits,
                    ..word(bits, phase_bits)
                };
                varied.push(Configuration { throughput, ..changed }.unit().unwrap());
            }
        }
        varied
    }

    /// Areas made by known coefficients give these back.
    #[test]
    fn a_fit_finds_the_coefficients_that_made_its_points() {
        let truth = AreaModel { coefficients: [2.5, 0.75, 1.25, 1.5, 3.0] };
        for throughput in THROUGHPUTS {
            let points: Vec<_> =
                varied(throughput).into_iter().map(|unit| (unit.clone(), truth.area(&unit).luts)).collect();
            let (found, worst) = AreaModel::fit(&points).unwrap();
            for (a, b) in found.coefficients.iter().zip(truth.coefficients) {
                assert!((a - b).abs() < 1e-6, "{found:?}");
            }
            assert!(worst < 1e-9);
            assert!(AreaModel::fit(&points[..4]).is_err());
            assert!(AreaModel::fit(&vec![points[0].clone(); 9]).is_err());
        }
    }

    #[test]
    fn units_unlike_the_fitted_ones_are_said_to_be_extrapolated() {
        let source = |configuration: Configuration| {
            let unit = configuration.unit().unwrap();
            AreaModel::of(unit.architecture).area(&unit).source
        };
        let unit = word(16, 16);
        assert_eq!(source(unit), AreaSource::Fitted);
        for other in [
            Configuration { length_bits: 12, ..unit },
            Configuration { x_bits: 7, ..unit },
            Configuration { phase_bits: 22, iterations: 22, ..unit },
            Configuration { throughput: Throughput::CyclesPerPixel(8), ..unit },
            Configuration { pipeline_every: 2, ..unit },
        ] {
            assert_eq!(source(other), AreaSource::Extrapolated, "{other}");
        }
    }

    #[test]
    fn more_of_anything_costs_more_and_one_stage_less_than_many() {
        let luts = |configuration: Configuration| {
            let unit = configuration.unit().unwrap();
            AreaModel::of(unit.architecture).area(&unit).luts
        };
        for throughput in THROUGHPUTS {
            let base = Configuration { throughput, ..word(16, 14) };
            for more in [
                Configuration { x_bits: 18, ..base },
                Configuration { phase_bits: 16, ..base },
                Configuration { vector_guard_bits: 5, ..base },
                Configuration { angle_guard_bits: 5, ..base },
                Configuration { metric: 3, ..base },
            ] {
                assert!(luts(more) > luts(base), "{more}");
            }
            assert!(luts(Configuration { normaliser: false, ..base }) <= luts(base));
        }
        let of = |throughput| luts(Configuration { throughput, ..word(16, 16) });
        let [unrolled, folded, iterative] = THROUGHPUTS.map(of);
        assert!(iterative < folded && folded < unrolled);
    }
}
