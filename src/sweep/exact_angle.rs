//! The exact angle of an integer vector, as far as a decision needs it: fixed-point with a proved bound, and 192 bits where
//! that bound does not decide.
//!
//! # The bound
//! With u ≥ v ≥ 0 the folded coordinates and k = round(256 v/u),
//! atan(v/u) = atan(k/256) + atan(t), t = (256 v − k u)/(256 u + k v), |t| ≤ 2⁻⁹.
//! In units of 2⁻⁵⁶ turn, for words of at most 31 bits:
//!
//! | error | units |
//! | --- | --- |
//! | table entry, correctly rounded, below 2⁻³ turn | 1/2 |
//! | atan(t) by four terms: the fifth is below 2⁻⁸¹/9; roundings of t and the terms, relative 2⁻⁵⁰ of 2⁻⁹/2π turn | < 2⁻⁵ |
//! | the sum's rounding, below 2⁻³ turn | 1/2 |
//! | to an integer | 1 |
//! | metric 3: √3·v is rounded twice, relative below 2⁻⁵²·²; turns by at most half of that | 1.3 |
//!
//! together below 3.4, stated as [`BOUND_UNITS`] = 4. Only IEEE 754 basic operations are used, so every machine gets the same
//! integers. `tests/sweep_angle.rs` compares with another library.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use std::cmp::Ordering;
use std::f64::consts::TAU;
use std::sync::OnceLock;

type Real = FBig<HalfEven, 2>;

/// Angles and errors are integers in units of 2^−`UNIT_BITS` turn.
pub const UNIT_BITS: u32 = 56;

/// How far an angle of [`ExactAngle`] may be from the truth, in units of 2^−[`UNIT_BITS`] turn; axes and (for metric 1) diagonals
/// are exact.
pub const BOUND_UNITS: u64 = 4;

const CELLS: usize = 256;
const WIDE_BITS: usize = 192;

/// The exact angle of (x, √metric · y).
#[derive(Debug, Clone)]
pub struct ExactAngle {
    metric: i64,
    root: f64,
    /// atan(k/256) in turns, correctly rounded.
    table: &'static [f64],
    /// The same as [`BOUND_UNITS`]; larger in tests, so that more decisions are made in wide arithmetic.
    bound: u64,
}

fn wide(value: i64) -> Real {
    Real::from(value).with_precision(WIDE_BITS).value()
}

fn wide_turn() -> Real {
    Real::pi(WIDE_BITS) * wide(2)
}

/// atan(k/256) in turns, correctly rounded, for k from 0 to 256.
fn table() -> &'static [f64] {
    static TABLE: OnceLock<Vec<f64>> = OnceLock::new();
    let entry = |k: usize| {
        let ratio = wide(k as i64) / wide(CELLS as i64);
        if k == 0 { 0.0 } else { (ratio.atan() / wide_turn()).to_f64().value() }
    };
    TABLE.get_or_init(|| (0..=CELLS).map(entry).collect())
}

impl ExactAngle {
    /// For the angle of (x, √`metric` · y); `metric` is 1 or 3.
    pub fn new(metric: i64) -> Self {
        let root = if metric == 1 { 1.0 } else { wide(metric).sqrt().to_f64().value() };
        Self { metric, root, table: table(), bound: BOUND_UNITS }
    }

    /// The same with decisions left to wide arithmetic within `bound` units (at least [`BOUND_UNITS`]): slower, no other result.
    #[must_use]
    pub fn deciding_within(self, bound: u64) -> Self {
        Self { bound: bound.max(BOUND_UNITS), ..self }
    }

    /// The vector's length squared, x² + metric · y².
    pub fn length_squared(&self, x: i64, y: i64) -> i64 {
        x * x + self.metric * (y * y)
    }

    /// The angle of (|x|, √metric |y|), 0 to a quarter turn; whether it is in the upper half of the quadrant. Not both are 0;
    /// both are below 2³¹.
    #[inline]
    pub fn quadrant(&self, x: i64, y: i64) -> (i64, bool) {
        let (x, y) = (x.abs() as f64, y.abs() as f64 * self.root);
        let upper = y > x;
        let (u, v) = if upper { (y, x) } else { (x, y) };
        let cells = CELLS as f64;
        let k = ((v / u * cells + 0.5) as usize).min(CELLS);
        let t = (cells * v - k as f64 * u) / (cells * u + k as f64 * v);
        let square = t * t;
        let small = t * (1.0 - square * (1.0 / 3.0 - square * (0.2 - square * (1.0 / 7.0))));
        let turns = self.table[k] + small * (1.0 / TAU);
        let units = (turns * (1u64 << UNIT_BITS) as f64 + 0.5) as i64;
        if upper { ((1 << (UNIT_BITS - 2)) - units, true) } else { (units, false) }
    }

    /// The angle of (x, √metric y), 0 to (excluding) a turn, from that of its quadrant: reflections are exact.
    #[inline]
    pub fn unfold(x: i64, y: i64, quadrant: i64) -> i64 {
        let half = 1i64 << (UNIT_BITS - 1);
        let angle = if x < 0 { half - quadrant } else { quadrant };
        if y < 0 { -angle & (2 * half - 1) } else { angle }
    }

    /// `code` / 2^`phase_bits` turn minus `angle`, brought into half a turn either way.
    #[inline]
    pub fn error(code: i64, phase_bits: u32, angle: i64) -> i64 {
        const UNUSED: u32 = 64 - UNIT_BITS;
        (((code << (UNIT_BITS - phase_bits)) - angle) << UNUSED) >> UNUSED
    }

    /// Whether the true error of `code` at (x, y), which is near `error`, is smaller than `limit` units in size.
    ///
    /// The distance of a true angle from a phase code is never a whole or half code but where the angle itself is one: the only
    /// angles that are rational parts of a turn with a rational tangent are multiples of 1/8 turn (Niven 1956); with √3 only the axes are
    /// dyadic ones. Those are exact here.
    #[inline]
    pub fn is_below(&self, limit: i64, error: i64, code: i64, phase_bits: u32, (x, y): (i64, i64)) -> bool {
        if error.unsigned_abs().abs_diff(limit as u64) > self.bound {
            error.abs() < limit
        } else {
            self.is_below_wide(limit, error, code, phase_bits, (x, y))
        }
    }

    #[cold]
    fn is_below_wide(&self, limit: i64, error: i64, code: i64, phase_bits: u32, (x, y): (i64, i64)) -> bool {
        if x == 0 || y == 0 || (self.metric == 1 && x.abs() == y.abs()) {
            return error.abs() < limit;
        }
        let wide_error = self.wide_error(code, phase_bits, x, y);
        let size = if wide_error < Real::ZERO { -wide_error } else { wide_error };
        size.partial_cmp(&wide(limit)) == Some(Ordering::Less)
    }

    /// The error in 192 bits, in units of 2^−[`UNIT_BITS`] turn. Neither coordinate is 0.
    fn wide_error(&self, code: i64, phase_bits: u32, x: i64, y: i64) -> Real {
        let full = Real::from_parts(1.into(), UNIT_BITS as isize).with_precision(WIDE_BITS).value();
        let quadrant =
            (wide(y.abs()) * wide(self.metric).sqrt() / wide(x.abs())).atan() / wide_turn() * &full;
        let half = &full / wide(2);
        let angle = if x < 0 { &half - quadrant } else { quadrant };
        let angle = if y < 0 { &full - angle } else { angle };
        let error = wide(code << (UNIT_BITS - phase_bits)) - angle;
        if error >= half {
            error - full
        } else if error < -half {
            error + full
        } else {
            error
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_and_diagonals_are_exact() {
        let exact = ExactAngle::new(1);
        for size in [1, 3, 2048, (1 << 30) - 1] {
            for (eighths, (x, y)) in
                (0..).zip([(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)])
            {
                let (x, y) = (x * size, y * size);
                let (quadrant, _) = exact.quadrant(x, y);
                assert_eq!(ExactAngle::unfold(x, y, quadrant), eighths << (UNIT_BITS - 3), "({x}, {y})");
            }
        }
    }

    /// 60° and 30° with √3 are a sixth and a twelfth of a turn.
    #[test]
    fn with_the_root_of_three_thirty_and_sixty_degrees_are_near() {
        let exact = ExactAngle::new(3);
        for ((x, y), part) in [((1, 1), 6), ((3, 1), 12), ((0, 5), 4)] {
            let truth = (1i64 << UNIT_BITS) / part;
            assert!((exact.quadrant(x, y).0 - truth).unsigned_abs() <= BOUND_UNITS);
        }
    }

    /// The wide error and the fast one differ by no more than the bound, and a decision at the very limit is made by the wide one.
    #[test]
    fn decisions_at_the_limit_are_those_of_the_wide_error() {
        for metric in [1, 3] {
            let exact = ExactAngle::new(metric);
            for (x, y) in [(5, 3), (-7, 2), (1000, -999), (-3, -1), (1, 32_767), (123_456_789, -987_654)] {
                for code in [0, 1, 77, 255] {
                    let error = ExactAngle::error(code, 8, ExactAngle::unfold(x, y, exact.quadrant(x, y).0));
                    let wide_units = exact.wide_error(code, 8, x, y).to_f64().value();
                    assert!((wide_units - error as f64).abs() <= BOUND_UNITS as f64 + 8.0);
                    for limit in error.abs() - 6..=error.abs() + 6 {
                        let below = exact.is_below(limit, error, code, 8, (x, y));
                        let wide_size = exact.wide_error(code, 8, x, y);
                        let wide_size = if wide_size < Real::ZERO { -wide_size } else { wide_size };
                        assert_eq!(below, wide_size < wide(limit), "({x}, {y}) {code} {limit}");
                    }
                }
            }
        }
    }
}
