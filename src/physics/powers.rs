//! Logarithms and powers of many numbers: the same bits on every machine, and fast enough for millions of pixels a second, as [`cos_sin`] is.
//!
//! The kernels are those of Sun's fdlibm (e_log.c, e_exp.c, Sun Microsystems 1993), without branches and without fused operations.
//!
//! [`cos_sin`]: super::cos_sin

// The constants are as fdlibm prints them.
#![expect(clippy::excessive_precision)]

use super::trig::ROUND;

// ln 2 in two parts, of which the first has so few bits that its products with small integers are exact.
const LN_2_HIGH: f64 = 6.931_471_803_691_238_164_90e-1;
const LN_2_LOW: f64 = 1.908_214_929_270_587_700_02e-10;
/// Taken away where an integer stands in its lowest bits, it leaves that.
const WHOLE: f64 = 4_503_599_627_370_496.0;
/// The bits of 1, and of the least mantissa, a root of a half.
const ONE: u64 = 0x3ff0_0000_0000_0000;
const LEAST: u64 = 0x3fe6_a09e_0000_0000;
const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;
const BIAS: u64 = 1023;
/// Beyond it a power of e is no ordinary number.
const MOST: f64 = 700.0;

const LOGARITHM: [f64; 7] = [
    6.666_666_666_666_735_130e-1,
    3.999_999_999_940_941_908e-1,
    2.857_142_874_366_239_149e-1,
    2.222_219_843_214_978_396e-1,
    1.818_357_216_161_805_012e-1,
    1.531_383_769_920_937_332e-1,
    1.479_819_860_511_658_591e-1,
];
const EXPONENTIAL: [f64; 5] = [
    1.666_666_666_666_660_190_37e-1,
    -2.777_777_777_701_559_338_42e-3,
    6.613_756_321_437_934_361_17e-5,
    -1.653_390_220_546_525_153_90e-6,
    4.138_136_797_057_238_460_39e-8,
];

/// Natural logarithm of `value`, which is normal, finite and above 0: within a unit of the last place. Of anything else it makes a number without meaning.
#[inline(always)]
pub fn ln(value: f64) -> f64 {
    let shifted = value.to_bits().wrapping_add(ONE - LEAST);
    let twos = f64::from_bits((shifted >> 52) | WHOLE.to_bits()) - WHOLE - BIAS as f64;
    let f = f64::from_bits((shifted & MANTISSA) + LEAST) - 1.0;
    let s = f / (2.0 + f);
    let (z, half) = (s * s, 0.5 * f * f);
    let w = z * z;
    let c = &LOGARITHM;
    let rest = z * (c[0] + w * (c[2] + w * (c[4] + w * c[6]))) + w * (c[1] + w * (c[3] + w * c[5]));
    twos * LN_2_HIGH - ((half - (s * (half + rest) + twos * LN_2_LOW)) - f)
}

/// `base` to the power of `exponent`, for such a base; up to e to the power of ±700, which stands for all beyond. Within 2e-16 of the result times
/// 1 and the logarithm's size.
#[inline(always)]
pub fn power(base: f64, exponent: f64) -> f64 {
    exp(exponent * ln(base))
}

/// The power of e, up to ±700, which stands for all beyond: within 2e-16 of the result.
#[inline(always)]
pub fn exp(value: f64) -> f64 {
    let value = value.clamp(-MOST, MOST);
    let shifted = value * std::f64::consts::LOG2_E + ROUND;
    let twos = shifted - ROUND;
    let (high, low) = (value - twos * LN_2_HIGH, twos * LN_2_LOW);
    let x = high - low;
    let t = x * x;
    let c = &EXPONENTIAL;
    let c = x - t * (c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4]))));
    let mantissa = 1.0 - ((low - x * c / (2.0 - c)) - high);
    mantissa * f64::from_bits(shifted.to_bits().wrapping_add(BIAS) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_logarithm_and_power() {
        for number in 1..200_000 {
            let value = f64::from(number) * 1.234_567e-3;
            let (is, should) = (ln(value), libm::log(value));
            assert!((is - should).abs() <= 2.3e-16 * should.abs(), "ln {value}: {is} {should}");
            // The reference is off by half of its last place, too.
            for exponent in [-1.0, -0.5, 0.02, 1.2, 4.0] {
                let (is, should) = (power(value, exponent), libm::pow(value, exponent));
                let within = 2.5e-16 * (1.0 + (exponent * ln(value)).abs());
                assert!((is - should).abs() < within * should, "{value} ^ {exponent}: {is} {should}");
            }
        }
        for value in (-7000..7000).map(|number| f64::from(number) * 0.099_87) {
            let (is, should) = (exp(value), libm::exp(value));
            assert!((is - should).abs() <= 4.5e-16 * should, "e ^ {value}: {is} {should}");
        }
        for value in [1e-300, 1e-9, 1e9, 1e300] {
            assert!((ln(value) / libm::log(value) - 1.0).abs() < 1e-15, "{value}");
            assert!((power(value, 0.5) / value.sqrt() - 1.0).abs() < 1e-13, "{value}");
        }
        assert_eq!((ln(2.0), ln(10.0)), (std::f64::consts::LN_2, std::f64::consts::LN_10));
        assert!((power(2.0, 0.5) - std::f64::consts::SQRT_2).abs() < 2.3e-16);
        assert_eq!((ln(1.0), power(1.0, 3.0), power(7.0, 0.0)), (0.0, 1.0, 1.0));
        assert!(power(1e-300, 4.0) < 1e-300 && power(1e300, 4.0) > 1e300);
    }
}
