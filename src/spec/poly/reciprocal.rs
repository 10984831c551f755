//! The reciprocal of a number from 1.0 to 2.0 by a table of factors and one multiplication.
//!
//! The number m lies δ above the middle c of its interval of the table. Its mirror image m' = c − δ is m with the bits
//! below the index complemented, and m·m' = c² − δ², so that m'/c² is the reciprocal but for δ²/c² of it: a table of
//! constants and one multiplier are as good as a table of lines, which would take an adder and a second table
//! (Takagi, "Powering by a table look-up and a multiplication with operand modification", 1998).

use super::Tables;
use crate::spec::exact::{Real, integer, power_of_two, rounded};

/// The table of factors and its words.
#[derive(Debug, Clone, PartialEq)]
pub struct Reciprocal {
    /// Bits below the leading one that choose the factor.
    pub index_bits: u32,
    /// Fraction bits of a factor, which is from 1/4 to below 1.
    pub factor_bits: u32,
    /// Fraction bits of the result, which is below 1: the product rounded down.
    pub result_bits: u32,
    /// The result is (1 − 2^−`scale_bits`) times the reciprocal, so that no rounding can bring a ratio up to 1.0. The
    /// arctangent's table takes it out again.
    pub scale_bits: u32,
    /// The factors, by index.
    pub factors: Vec<i64>,
    /// Largest error of the result in either direction, relative to itself, the result's rounding included.
    pub relative_error: f64,
}

impl Reciprocal {
    pub(super) fn new(phase_bits: u32, coordinate_bits: u32, tables: Tables) -> Self {
        let index_bits = match tables {
            Tables::Logic => (phase_bits - 3) / 2,
            Tables::Memory => 10.min(coordinate_bits - 3),
        };
        let factor_bits = match tables {
            Tables::Logic => phase_bits + 1,
            Tables::Memory => phase_bits + 2,
        };
        let result_bits = phase_bits + 2;
        // The error is at most 2^-(2 index_bits + 3) by δ², half an ulp of a factor of 1/4 and an ulp of a result of 1/2.
        let scale_bits = (2 * index_bits + 2).min(factor_bits - 3);
        let mut reciprocal = Self {
            index_bits,
            factor_bits,
            result_bits,
            scale_bits,
            factors: Vec::new(),
            relative_error: 0.0,
        };
        reciprocal.factors =
            (0..1 << index_bits).map(|index| reciprocal.factor(coordinate_bits, index)).collect();
        reciprocal.relative_error = reciprocal.error(coordinate_bits);
        reciprocal
    }

    /// The factor that balances the errors: the middle of the interval gets too much by what its ends get too little.
    fn factor(&self, coordinate_bits: u32, index: i64) -> i64 {
        let (middle, reach) = self.interval(coordinate_bits, index);
        let unit = power_of_two(1 - i64::from(coordinate_bits));
        let (middle, reach) = (integer(middle) * &unit / integer(2), integer(reach) * unit / integer(2));
        let scale = integer(1) - power_of_two(-i64::from(self.scale_bits));
        let balanced = integer(2) * scale / (integer(2) * &middle * &middle - &reach * &reach);
        // Rounding down takes half an ulp of the result on average.
        let rounding: Real = integer(1) + power_of_two(-1 - i64::from(self.result_bits)) * &middle;
        let largest = (1 << self.factor_bits) - 1;
        rounded(&(balanced * rounding * power_of_two(self.factor_bits.into()))).min(largest)
    }

    /// Twice the middle of an interval, and twice the distance of its ends from there, in units of the coordinate.
    fn interval(&self, coordinate_bits: u32, index: i64) -> (i64, i64) {
        let low_bits = coordinate_bits - 1 - self.index_bits;
        let first = (1 << (coordinate_bits - 1)) + (index << low_bits);
        let last = first + (1 << low_bits) - 1;
        (first + last, last - first)
    }

    fn error(&self, coordinate_bits: u32) -> f64 {
        let one = f64::from(coordinate_bits - 1).exp2();
        let scale = 1.0 - (-f64::from(self.scale_bits)).exp2();
        let ulp = (-f64::from(self.result_bits)).exp2();
        (0..)
            .zip(&self.factors)
            .map(|(index, &factor)| {
                let (middle, reach) = self.interval(coordinate_bits, index);
                let (middle, reach) = (middle as f64 / 2.0 / one, reach as f64 / 2.0 / one);
                let factor = factor as f64 / f64::from(self.factor_bits).exp2() / scale;
                let high = factor * middle * middle - 1.0;
                let low = factor * (middle * middle - reach * reach) - ulp * (middle + reach) - 1.0;
                high.max(-low)
            })
            .fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every coordinate there is: the error is within the bound and comes near it, and no ratio reaches 1.
    #[test]
    fn every_reciprocal_is_within_the_bound_and_no_ratio_reaches_one() {
        for (phase_bits, tables) in
            [(8, Tables::Logic), (13, Tables::Logic), (16, Tables::Logic), (16, Tables::Memory)]
        {
            let coordinate_bits = phase_bits + 2;
            let reciprocal = Reciprocal::new(phase_bits, coordinate_bits, tables);
            let low_bits = coordinate_bits - 1 - reciprocal.index_bits;
            let one = 1_i64 << (coordinate_bits - 1);
            let unit = (one as f64) * f64::from(reciprocal.result_bits).exp2();
            let scale = 1.0 - (-f64::from(reciprocal.scale_bits)).exp2();
            let mut largest: f64 = 0.0;
            for major in one..2 * one {
                let mirrored = major ^ ((1 << low_bits) - 1);
                let factor = reciprocal.factors[((major - one) >> low_bits) as usize];
                let result = (mirrored * factor)
                    >> (coordinate_bits - 1 + reciprocal.factor_bits - reciprocal.result_bits);
                assert!(result * major < one << reciprocal.result_bits, "{tables:?} {phase_bits}: {major}");
                assert!(result < 1 << reciprocal.result_bits);
                largest = largest.max(((result * major) as f64 / unit / scale - 1.0).abs());
            }
            let bound = reciprocal.relative_error;
            assert!(largest <= bound && largest > 0.8 * bound, "{tables:?} {phase_bits}: {largest} {bound}");
        }
    }
}
