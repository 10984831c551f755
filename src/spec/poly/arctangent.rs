//! The arctangent of a ratio by a table of lines, bent by a table of curves.
//!
//! The ratio's top bits choose a segment, its other bits are the offset d from the segment's middle. The angle is
//! base + slope·d + curve. What is left between the arctangent and its line is nearly the same arch in neighbouring
//! segments, and symmetric: so the curve's table is chosen by the segment's top bits and the top bits of |d| alone (the
//! bipartite idea of Das Sarma and Matula, 1995, beside a multiplier).
//!
//! Slopes are secants; a base is in the middle of what is left. All in exact arithmetic, rounded once.

use super::Tables;
use crate::spec::exact::{Real, integer, power_of_two, rounded};

/// The tables and their words. Angles are in units of 2^−(phase bits + guard bits) turn.
#[derive(Debug, Clone, PartialEq)]
pub struct Arctangent {
    /// Bits of the angle below the phase's resolution.
    pub guard_bits: u32,
    /// Top bits of the ratio that choose the segment.
    pub segment_bits: u32,
    /// Bits of the offset within a segment.
    pub offset_bits: u32,
    /// Bits of a slope.
    pub slope_bits: u32,
    /// Places by which slope · d is shifted right, rounding down.
    pub slope_shift: u32,
    /// Top bits of the segment that choose the curve.
    pub curve_segment_bits: u32,
    /// Bits of |d| that choose the curve; 0 where there is none.
    pub curve_offset_bits: u32,
    /// Angle of the middle of each segment.
    pub bases: Vec<i64>,
    /// Slope of each segment.
    pub slopes: Vec<i64>,
    /// What is added to the line, 0 to 2^`guard_bits` − 1: by segment's top bits, then by bits of |d|. Empty where there is none.
    pub curves: Vec<i64>,
    /// Largest error of each segment in phase codes, for the middle of what a ratio's word stands for.
    pub segment_errors: Vec<f64>,
}

/// What the tables approximate.
struct Truth {
    ratio_bits: u32,
    /// 1 / (1 − 2^−scale bits): the ratio's words are that much too small.
    scale: Real,
    /// Units of the angle in a radian.
    units_a_rad: Real,
}

impl Truth {
    /// The ratio that a word stands for, rounded down as it is: half an ulp above its value. Twice the word, so that ends
    /// and middles are integers.
    fn ratio(&self, word: i64) -> Real {
        integer(2 * word + 1) * power_of_two(-1 - i64::from(self.ratio_bits)) * &self.scale
    }

    fn angle(&self, word: i64) -> Real {
        self.ratio(word).atan() * &self.units_a_rad
    }

    /// Angle a unit of the ratio, where the ratio is 0 and the angle rises fastest.
    fn steepest(&self) -> Real {
        power_of_two(-i64::from(self.ratio_bits)) * &self.scale * &self.units_a_rad
    }

    /// The word at which the angle rises by `slope` a unit.
    fn touches(&self, slope: &Real) -> i64 {
        let squared = self.steepest() / slope - integer(1);
        if squared <= integer(0) {
            return 0;
        }
        rounded(&(squared.sqrt() / &self.scale * power_of_two(self.ratio_bits.into())))
    }
}

/// Least and greatest of some numbers.
fn range(values: impl IntoIterator<Item = Real>) -> Option<(Real, Real)> {
    values.into_iter().fold(None, |range, value| {
        Some(match range {
            None => (value.clone(), value),
            Some((low, high)) if value < low => (value, high),
            Some((low, high)) if value > high => (low, value),
            Some(range) => range,
        })
    })
}

fn middle(range: &Option<(Real, Real)>) -> Real {
    range.as_ref().map_or_else(|| integer(0), |(low, high)| (low + high) / integer(2))
}

impl Arctangent {
    pub(super) fn new(phase_bits: u32, ratio_bits: u32, scale_bits: u32, tables: Tables) -> Self {
        let guard_bits = 4;
        let (segment_bits, curve_segment_bits, curve_offset_bits) = match tables {
            Tables::Logic => (2.max((phase_bits - 5) / 2), 2, 3),
            Tables::Memory => (8.min(phase_bits - 5), 0, 0),
        };
        let one = power_of_two(scale_bits.into());
        let truth = Truth {
            ratio_bits,
            scale: &one / (&one - integer(1)),
            units_a_rad: power_of_two(i64::from(phase_bits + guard_bits))
                / (integer(2) * Real::pi(crate::spec::exact::PRECISION_BITS)),
        };
        // A slope is off by half an ulp at most, which the longest offset turns into less than 1/16 unit.
        let slope_bits = phase_bits + 1 - segment_bits;
        let fits = |shift: u32| rounded(&(truth.steepest() * power_of_two(shift.into()))) < 1 << slope_bits;
        let slope_shift = (0..40).take_while(|&shift| fits(shift)).last().unwrap_or(0);
        let mut arctangent = Self {
            guard_bits,
            segment_bits,
            offset_bits: ratio_bits - segment_bits,
            slope_bits,
            slope_shift,
            curve_segment_bits,
            curve_offset_bits,
            bases: Vec::new(),
            slopes: Vec::new(),
            curves: Vec::new(),
            segment_errors: Vec::new(),
        };
        arctangent.fit(&truth);
        arctangent
    }

    fn fit(&mut self, truth: &Truth) {
        let segments = 1_i64 << self.segment_bits;
        for segment in 0..segments {
            let first = segment << self.offset_bits;
            let last = first + (1 << self.offset_bits) - 1;
            let secant = (truth.angle(last) - truth.angle(first)) / integer(last - first);
            self.slopes.push(rounded(&(secant * power_of_two(self.slope_shift.into()))));
        }
        // What the line leaves in each cell of each segment: least and greatest.
        let left: Vec<Vec<Option<(Real, Real)>>> =
            (0..segments).map(|segment| self.left_of_line(truth, segment)).collect();
        if self.curve_offset_bits > 0 {
            let group_bits = self.segment_bits - self.curve_segment_bits;
            let cells = 1_usize << self.curve_offset_bits;
            for group in left.chunks(1 << group_bits) {
                // A curve starts from 0 at the segment's ends, which are in the last cell.
                for cell in 0..cells {
                    let arches = group.iter().flat_map(|segment| {
                        let foot = segment[cells - 1].as_ref().map(|(low, _)| low.clone());
                        let (low, high) = segment[cell].clone()?;
                        let foot = foot?;
                        Some([low - &foot, high - &foot])
                    });
                    let curve = rounded(&middle(&range(arches.flatten())));
                    self.curves.push(curve.clamp(0, (1 << self.guard_bits) - 1));
                }
            }
        }
        for (segment, cells) in left.iter().enumerate() {
            let remaining = range(cells.iter().enumerate().flat_map(|(cell, left)| {
                let curve = integer(self.curve(segment, cell));
                left.iter().flat_map(move |(low, high)| [low - &curve, high - &curve]).collect::<Vec<_>>()
            }));
            let base = rounded(&middle(&remaining));
            // Rounding the product down, in the middle half a unit, is off by another half.
            let codes = remaining.map_or(0.0, |(low, high)| {
                let units =
                    (high - integer(base)).to_f64().value().max((integer(base) - low).to_f64().value());
                (units + 0.5) / f64::from(self.guard_bits).exp2()
            });
            self.bases.push(base);
            self.segment_errors.push(codes);
        }
    }

    /// Least and greatest of the angle less its line (in the middle of the product's rounding), in each cell of |d|.
    ///
    /// The difference is concave: it is least at an end, and greatest where its slope vanishes, or at the end next to that.
    fn left_of_line(&self, truth: &Truth, segment: i64) -> Vec<Option<(Real, Real)>> {
        let half = 1_i64 << (self.offset_bits - 1);
        let origin = (segment << self.offset_bits) + half;
        let slope = integer(self.slopes[segment as usize]) * power_of_two(-i64::from(self.slope_shift));
        let left = |offset: i64| truth.angle(origin + offset) - &slope * integer(offset) + power_of_two(-1);
        let top = truth.touches(&slope) - origin;
        let cell_words = half >> self.curve_offset_bits;
        (0..1_i64 << self.curve_offset_bits)
            .map(|cell| {
                let (near, far) = (cell * cell_words, (cell + 1) * cell_words - 1);
                // |d| by complement: −1 − d for a negative d.
                let sides = [(near, far), (-1 - far, -1 - near)];
                // The neighbours too: the top is rounded to a word.
                range(
                    sides
                        .into_iter()
                        .flat_map(|(low, high)| {
                            [
                                low,
                                high,
                                (top - 1).clamp(low, high),
                                top.clamp(low, high),
                                (top + 1).clamp(low, high),
                            ]
                        })
                        .map(left),
                )
            })
            .collect()
    }

    /// What is added to the line in `segment` where the top bits of |d| are `cell`.
    pub fn curve(&self, segment: usize, cell: usize) -> i64 {
        let group = segment >> (self.segment_bits - self.curve_segment_bits);
        self.curves.get((group << self.curve_offset_bits) + cell).copied().unwrap_or(0)
    }
}
