//! The hardware's constants, in arbitrary-precision arithmetic, so that every machine generates the same file.
//!
//! Nothing here uses `f64` functions: results are correctly rounded integers.

use super::step_angle::StepAngle;
use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

/// A binary floating-point number of [`PRECISION_BITS`] bits.
pub(super) type Real = FBig<HalfEven, 2>;

/// Far more than the 63 bits of the widest register: rounding to an integer is then the only rounding that counts.
pub(super) const PRECISION_BITS: usize = 192;

pub(super) fn integer(value: i64) -> Real {
    Real::from(value).with_precision(PRECISION_BITS).value()
}

/// The exact value of a finite `f64`.
fn of_f64(value: f64) -> Real {
    Real::try_from(value).expect("callers pass finite numbers").with_precision(PRECISION_BITS).value()
}

pub(super) fn power_of_two(exponent: i64) -> Real {
    Real::from_parts(1.into(), exponent as isize).with_precision(PRECISION_BITS).value()
}

/// Nearest integer (ties away from zero, which no constant here meets).
pub(super) fn rounded(value: &Real) -> i64 {
    i64::try_from(value.round().to_int().value()).expect("constants are bounded by their words")
}

/// The angle unit's gain: Π √(1 + metric · 2^−2i) over i = 0 … `x_iterations`, and the middle of the lengths that the last
/// angles, up to √metric · 2^−`x_iterations`, leave of it.
fn angle_gain(metric: i64, x_iterations: u32) -> Real {
    let stretch = |i: u32| integer(1) + integer(metric) * power_of_two(-2 * i64::from(i));
    let squared = (0..=x_iterations).map(stretch).fold(integer(1), |product, factor| product * factor);
    squared.sqrt() * (integer(1) + integer(1) / stretch(x_iterations).sqrt()) / integer(2)
}

/// Cosine and sine of `angle`.
pub(super) fn cosine_and_sine(angle: StepAngle) -> (Real, Real) {
    let turn = Real::pi(PRECISION_BITS) * integer(2);
    let (sine, cosine) = (turn * integer(angle.numerator()) / integer(angle.denominator())).sin_cos();
    (cosine, sine)
}

/// The angle unit's gain as an `f64`, for reports.
pub fn angle_gain_f64(metric: i64, x_iterations: u32) -> f64 {
    angle_gain(metric, x_iterations).to_f64().value()
}

/// A rational or irrational factor as hardware multiplies by it: value ≈ multiplier · 2^−shift, rounding half up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ScaledConstant {
    /// A positive integer.
    pub multiplier: i64,
    /// Places by which the product is shifted to the right, at least 1.
    pub shift: u32,
}

impl ScaledConstant {
    /// `value` with exactly `bits` significant bits; `None` where the shift would be below 1 or above 62.
    fn new(value: &Real, bits: u32) -> Option<Self> {
        let half = integer(1) / integer(2);
        let mut shift: i64 = 0;
        // Bring value · 2^shift into [2^(bits−1), 2^bits).
        let (low, high) = (power_of_two(i64::from(bits) - 1), power_of_two(bits.into()));
        while value * power_of_two(shift) < low {
            shift += 1;
        }
        while value * power_of_two(shift) >= &high - &half {
            shift -= 1;
        }
        let multiplier = rounded(&(value * power_of_two(shift)));
        // Trailing zeros are wires, not bits: drop them.
        let spare = i64::from(multiplier.trailing_zeros()).min(shift - 1).max(0);
        let shift = u32::try_from(shift - spare).ok().filter(|shift| (1..=62).contains(shift))?;
        Some(Self { multiplier: multiplier >> spare, shift })
    }

    /// `value` · factor, rounded half up; `extra_shift` more places to the right.
    pub const fn apply(self, value: i64, extra_shift: u32) -> i64 {
        let places = self.shift + extra_shift - 1;
        (((value * self.multiplier) >> if places < 63 { places } else { 63 }) + 1) >> 1
    }

    /// The factor that is really applied.
    pub fn value(self) -> f64 {
        self.multiplier as f64 / 2f64.powi(self.shift as i32)
    }
}

/// 2^`exponent` / (the angle unit's gain · `divisor`), to `bits` significant bits.
pub fn amplitude_factor(
    metric: i64,
    x_iterations: u32,
    divisor: f64,
    exponent: i64,
    bits: u32,
) -> Option<ScaledConstant> {
    let gain = angle_gain(metric, x_iterations) * of_f64(divisor);
    ScaledConstant::new(&(power_of_two(exponent) / gain), bits)
}

/// 2^`exponent` / `divisor`, to `bits` significant bits.
pub fn ratio_factor(divisor: i64, exponent: i64, bits: u32) -> Option<ScaledConstant> {
    ScaledConstant::new(&(power_of_two(exponent) / integer(divisor)), bits)
}

/// Distance units a phase code: c / (2 · `frequency_hz` · `unit_m`) / (2^`phase_bits` · `divisor`), to `bits` significant bits.
pub fn distance_factor(
    frequency_hz: f64,
    unit_m: f64,
    phase_bits: u32,
    divisor: i64,
    bits: u32,
) -> Option<ScaledConstant> {
    let code = power_of_two(-i64::from(phase_bits)) / integer(divisor);
    ScaledConstant::new(&(units_a_turn(frequency_hz, unit_m) * code), bits)
}

/// Distance units in `times` the unambiguous range, rounded.
pub fn distance_units(frequency_hz: f64, unit_m: f64, times: i64) -> i64 {
    rounded(&(units_a_turn(frequency_hz, unit_m) * integer(times)))
}

fn units_a_turn(frequency_hz: f64, unit_m: f64) -> Real {
    integer(299_792_458) / (integer(2) * of_f64(frequency_hz) * of_f64(unit_m))
}

/// Integers (numerator, denominator) with numerator² − 3 · denominator² = 1, so that numerator/denominator
/// exceeds √3 by a relative error below 1/(6 · denominator²): the least pair whose error is at most
/// `relative_error` (> 0).
///
/// The pairs are the powers of 2 + √3, the fundamental solution of Pell's equation for 3.
pub fn sqrt3_ratio(relative_error: f64) -> (i64, i64) {
    let (mut numerator, mut denominator) = (2_i64, 1_i64);
    while sqrt3_ratio_error(denominator) > relative_error && denominator < 1 << 20 {
        (numerator, denominator) = (2 * numerator + 3 * denominator, numerator + 2 * denominator);
    }
    (numerator, denominator)
}

/// The proved bound 1/(6 · denominator²) on the relative error of a pair of [`sqrt3_ratio`]:
/// n² = 3d² + 1 gives n/(d√3) = √(1 + 1/(3d²)) < 1 + 1/(6d²).
pub fn sqrt3_ratio_error(denominator: i64) -> f64 {
    1.0 / (6.0 * (denominator * denominator) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_solve_pells_equation() {
        for error in [1e-2, 1e-4, 1e-6, 1e-9, 1e-11] {
            let (n, d) = sqrt3_ratio(error);
            assert_eq!(n * n - 3 * d * d, 1);
            assert!(sqrt3_ratio_error(d) <= error);
        }
        assert_eq!(sqrt3_ratio(4e-6), (362, 209));
        assert_eq!(sqrt3_ratio(1e-6), (1351, 780));
    }

    #[test]
    fn a_scaled_constant_rounds_half_up() {
        let half = ScaledConstant { multiplier: 1, shift: 1 };
        assert_eq!([-3, -2, -1, 0, 1, 2, 3].map(|v| half.apply(v, 0)), [-1, -1, 0, 0, 1, 1, 2]);
        assert_eq!(ratio_factor(4, 0, 8), Some(ScaledConstant { multiplier: 1, shift: 2 }));
        let ninth = ratio_factor(9, 0, 20).unwrap();
        assert_eq!(ninth.apply(36_855, 0), 4095);
    }
}
