//! The plain N-frame DFT: cosines and sines of N equal steps of a turn, rounded to a stated number of bits.

use super::exact::{Real, cosine_and_sine, integer, rounded};
use super::response::{Response, ZERO};
use super::scheme::{Irrational, Scheme, SchemeOrigin};
use super::step_angle::{StepAngle, greatest_common_divisor};
use std::ops::RangeInclusive;

/// Frames that a DFT can have: three for phase, amplitude and offset.
pub const DFT_FRAMES: RangeInclusive<usize> = 3..=64;

/// Bits of a cosine or sine, sign included; 18 is what a multiplier of the usual parts takes.
pub const COEFFICIENT_BITS: RangeInclusive<u32> = 4..=18;

impl Scheme {
    /// The DFT of `frames` phase steps of 1/`frames` turn, cosines and sines rounded to `coefficient_bits` bits, sign
    /// included (1 is 2^(bits − 1) − 1); `None` outside [`DFT_FRAMES`] and [`COEFFICIENT_BITS`].
    ///
    /// Constant light must not have a phase, so the weights of either sum add up to exactly 0. The sines do by symmetry,
    /// and with an even number of frames so do the cosines; with an odd number, the cosines that are rounded furthest are
    /// rounded the other way, in pairs of equal ones, so that the even symmetry stays: it is what keeps the in-phase sum
    /// blind to sines. A common divisor is taken out of all weights: four frames always are 1 0 −1 0.
    pub fn dft(frames: usize, coefficient_bits: u32) -> Option<Self> {
        if !DFT_FRAMES.contains(&frames) || !COEFFICIENT_BITS.contains(&coefficient_bits) {
            return None;
        }
        let largest = (1 << (coefficient_bits - 1)) - 1;
        let angles: Vec<StepAngle> =
            (0..frames as i64).map(|n| StepAngle::of(1, frames as i64).times(n)).collect();
        let exact: Vec<(Real, Real)> = angles
            .iter()
            .map(|&angle| cosine_and_sine(angle))
            .map(|(cosine, sine)| (cosine * integer(largest), sine * integer(largest)))
            .collect();
        let mut in_phase: Vec<i64> = exact.iter().map(|(cosine, _)| nearest(cosine)).collect();
        let mut quadrature: Vec<i64> = exact.iter().map(|(_, sine)| nearest(sine)).collect();
        let cosines: Vec<&Real> = exact.iter().map(|(cosine, _)| cosine).collect();
        balance(&mut in_phase, &cosines, largest);

        let divisor =
            in_phase.iter().chain(&quadrature).fold(0, |divisor, &w| greatest_common_divisor(divisor, w));
        for weight in in_phase.iter_mut().chain(&mut quadrature) {
            *weight /= divisor;
        }
        let response = Response::new(&angles, &in_phase, &quadrature, Irrational::One)?;
        Some(Self {
            name: "dft".into(),
            angles: angles.into(),
            in_phase: in_phase.into(),
            quadrature: quadrature.into(),
            offset: vec![1; frames].into(),
            irrational: Irrational::One,
            gain: response.gain,
            weight_error_rad: response.phase_rad(),
            weight_error_amplitude: response.image,
            origin: SchemeOrigin::Dft { coefficient_bits },
            reference: format!(
                "plain DFT of {frames} frames, cosines and sines of {coefficient_bits} bits: \
                 phase = atan2(sum of I_n sin(n/{frames} turn), sum of I_n cos(n/{frames} turn))"
            )
            .into(),
        })
    }
}

/// `value` to the nearest integer, halves away from zero: the sine of a twelfth is 1/2, and what 192 bits make of it must
/// not decide.
fn nearest(value: &Real) -> i64 {
    let twice = rounded(&(value * integer(2)));
    let off = (value * integer(2) - integer(twice)).to_f64().value();
    if off.abs() < ZERO && twice % 2 != 0 { (twice + twice.signum()) / 2 } else { rounded(value) }
}

/// Makes `weights`, `exact` cosines (whose sum is 0) rounded to nearest, add up to 0; none leaves ±`largest`.
///
/// The first is the cosine of 0; the others come in pairs n and N − n of equal cosines (and one alone in the middle where N
/// is even: then the sum is 0 as it is). The sum is below N/2 by either sign, so there are pairs enough.
fn balance(weights: &mut [i64], exact: &[&Real], largest: i64) {
    let mut surplus: i64 = weights.iter().sum();
    if surplus % 2 != 0 {
        weights[0] -= 1;
        surplus -= 1;
    }
    let steps = weights.len();
    let direction = surplus.signum();
    // How far each pair is rounded in the direction that the sum has too much of.
    let mut pairs: Vec<(f64, usize)> = (1..=(steps - 1) / 2)
        .filter(|&n| weights[n] != -direction * largest)
        .map(|n| (((integer(weights[n]) - exact[n]) * integer(direction)).to_f64().value(), n))
        .collect();
    pairs.sort_by(|one, other| other.0.total_cmp(&one.0).then(one.1.cmp(&other.1)));
    for &(_, n) in pairs.iter().take(surplus.unsigned_abs() as usize / 2) {
        weights[n] -= direction;
        weights[steps - n] -= direction;
    }
    debug_assert_eq!(weights.iter().sum::<i64>(), 0);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constant_light_has_no_phase_whatever_the_rounding() {
        for frames in DFT_FRAMES {
            for bits in COEFFICIENT_BITS {
                let scheme = Scheme::dft(frames, bits).unwrap();
                let largest = (1 << (bits - 1)) - 1;
                for weights in [&scheme.in_phase, &scheme.quadrature] {
                    assert_eq!(weights.len(), frames);
                    assert_eq!(weights.iter().sum::<i64>(), 0, "{frames} frames, {bits} bits");
                    assert!(weights.iter().all(|weight| weight.abs() <= largest));
                }
                for n in 1..frames {
                    assert_eq!(scheme.in_phase[n], scheme.in_phase[frames - n]);
                    assert_eq!(scheme.quadrature[n], -scheme.quadrature[frames - n]);
                }
            }
        }
        assert_eq!(
            [Scheme::dft(2, 8), Scheme::dft(65, 8), Scheme::dft(8, 3), Scheme::dft(8, 19)],
            [const { None }; 4]
        );
    }

    /// Rounding moves each weight by at most half a unit (one and a half where it is balanced), so that no vector turns by
    /// more than 2 · 1.5 · √2 units over the largest.
    #[test]
    fn more_bits_are_a_smaller_error_and_never_more_than_rounding_explains() {
        for frames in DFT_FRAMES {
            let errors: Vec<f64> =
                COEFFICIENT_BITS.map(|bits| Scheme::dft(frames, bits).unwrap().weight_error_rad).collect();
            for (bits, error) in COEFFICIENT_BITS.zip(&errors) {
                let bound = 3.0 * std::f64::consts::SQRT_2 / (f64::from(bits - 1).exp2() - 1.0);
                assert!(*error <= bound, "{frames} frames, {bits} bits: {error} rad, bound {bound}");
            }
            assert!(errors[14] <= errors[0] / 50.0, "{frames} frames: {errors:?}");
        }
    }

    #[test]
    fn four_frames_are_the_named_scheme() {
        for bits in COEFFICIENT_BITS {
            let (dft, named) = (Scheme::dft(4, bits).unwrap(), super::super::scheme("four_frame").unwrap());
            assert_eq!(
                (dft.in_phase, dft.quadrature, dft.offset),
                (named.in_phase.clone(), named.quadrature.clone(), named.offset.clone())
            );
            assert_eq!((dft.gain, dft.weight_error_rad, dft.weight_error_amplitude), (named.gain, 0.0, 0.0));
        }
    }

    /// Seven and five are to each other nearly as 1 and the sine of an eighth. Both sums are rounded alike, so that the
    /// vector is longer or shorter, and does not turn.
    #[test]
    fn the_gain_of_eight_frames_is_that_by_hand() {
        let scheme = Scheme::dft(8, 4).unwrap();
        assert_eq!(*scheme.in_phase, [7, 5, 0, -5, -7, -5, 0, 5]);
        assert_eq!(*scheme.quadrature, [0, 5, 7, 5, 0, -5, -7, -5]);
        assert!((scheme.gain - (14.0 + 20.0 / 2f64.sqrt())).abs() < 1e-12);
        assert_eq!((scheme.weight_error_rad, scheme.weight_error_amplitude), (0.0, 0.0));
    }

    /// Three frames of four bits: the cosines 7, -3.5, -3.5 become 6, -3, -3, the sines 6.06 become 6: an image of
    /// (9 - 6 sqrt 3)/(9 + 6 sqrt 3).
    #[test]
    fn the_error_of_three_frames_is_that_by_hand() {
        let scheme = Scheme::dft(3, 4).unwrap();
        assert_eq!((&*scheme.in_phase, &*scheme.quadrature), (&[2, -1, -1][..], &[0, 2, -2][..]));
        let (x, y) = (3.0, 2.0 * 3f64.sqrt());
        assert!((scheme.gain - (x + y) / 2.0).abs() < 1e-12);
        assert!((scheme.weight_error_amplitude - (y - x) / (x + y)).abs() < 1e-12);
        assert!((scheme.weight_error_rad - ((y - x) / (x + y)).asin()).abs() < 1e-12);
    }
}
