//! Cosine and sine of many angles: the same bits on every machine, and fast enough for millions of pixels a second.
//!
//! The platform's own functions differ in their last bits from one to the next, and a library's call for each angle keeps
//! the compiler from doing several at once. These are the kernels of Sun's fdlibm (k_sin.c, k_cos.c, Sun Microsystems 1993) on
//! an argument reduced in three steps (Cody and Waite 1980), without branches and without fused operations.

// The constants are as fdlibm prints them.
#![expect(clippy::excessive_precision)]

const TWO_OVER_PI: f64 = std::f64::consts::FRAC_2_PI;
// π/2 in three parts; the first two have 33 bits, so that their products with small integers are exact (fdlibm e_rem_pio2.c).
const HALF_PI_1: f64 = 1.570_796_326_734_125_614_17;
const HALF_PI_2: f64 = 6.077_100_506_303_965_976_60e-11;
const HALF_PI_3: f64 = 2.022_266_248_795_950_631_54e-21;
/// Adding and subtracting it rounds to an integer, which stands in the lowest bits of the sum.
pub(super) const ROUND: f64 = 6_755_399_441_055_744.0;

const SINE: [f64; 6] = [
    -1.666_666_666_666_663_243_48e-1,
    8.333_333_333_322_489_461_24e-3,
    -1.984_126_982_985_794_931_34e-4,
    2.755_731_370_707_006_767_89e-6,
    -2.505_076_025_340_686_341_95e-8,
    1.589_690_995_211_550_102_21e-10,
];
const COSINE: [f64; 6] = [
    4.166_666_666_666_660_190_37e-2,
    -1.388_888_888_887_410_957_49e-3,
    2.480_158_728_947_672_941_78e-5,
    -2.755_731_435_139_066_330_35e-7,
    2.087_572_321_298_174_827_90e-9,
    -1.135_964_755_778_819_482_65e-11,
];

/// Cosine and sine of `angle_rad`, |angle| up to a million: within 2e-16 for angles of a few turns.
#[inline(always)]
pub fn cos_sin(angle_rad: f64) -> (f64, f64) {
    let shifted = angle_rad * TWO_OVER_PI + ROUND;
    let quarters = shifted - ROUND;
    let quadrant = shifted.to_bits() & 3;
    let x = angle_rad - quarters * HALF_PI_1 - quarters * HALF_PI_2 - quarters * HALF_PI_3;
    let z = x * x;
    let horner = |c: &[f64; 6]| c[0] + z * (c[1] + z * (c[2] + z * (c[3] + z * (c[4] + z * c[5]))));
    let sine = x + x * z * horner(&SINE);
    let cosine = 1.0 - 0.5 * z + z * z * horner(&COSINE);
    let swap = quadrant & 1 == 1;
    let (cosine, sine) = (if swap { sine } else { cosine }, if swap { cosine } else { sine });
    // Quadrants 1 and 2 have a negative cosine, 2 and 3 a negative sine.
    let cosine = if (quadrant + 1) & 2 == 2 { -cosine } else { cosine };
    let sine = if quadrant & 2 == 2 { -sine } else { sine };
    (cosine, sine)
}

#[cfg(test)]
mod tests {
    use super::cos_sin;

    #[test]
    fn it_is_cosine_and_sine() {
        for number in -200_000..200_000 {
            let angle_rad = f64::from(number) * 1.234_567e-3;
            let (cosine, sine) = cos_sin(angle_rad);
            assert!((cosine - libm::cos(angle_rad)).abs() < 3e-16, "cos {angle_rad}");
            assert!((sine - libm::sin(angle_rad)).abs() < 3e-16, "sin {angle_rad}");
        }
        for angle_rad in [1e5, -1e5, 123_456.789] {
            assert!((cos_sin(angle_rad).0 - libm::cos(angle_rad)).abs() < 1e-11);
        }
        assert_eq!(cos_sin(0.0), (1.0, 0.0));
    }
}
