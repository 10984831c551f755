//! The angle by tables and multipliers, for FPGAs with DSP blocks: `atan = "poly"`.
//!
//! The vector is folded into the octant 0 ≤ minor ≤ major and shifted by its leading zeros; the minor coordinate times
//! the reciprocal of the major one is the tangent; a table of lines, bent by a small table of curves, is its arctangent.
//! Three multiplications, each of which fits one 18 × 18 multiplier as long as the phase has at most 16 bits.
//!
//! Every width follows from the number of phase bits P: an error of 2^-(P+1) of a word is 0.08 phase codes, whatever P is,
//! and the error of a table of 2^k lines falls with 2^-2k, so that half a bit of index a phase bit keeps it.

mod arctangent;
mod budget;
mod reciprocal;

pub use arctangent::Arctangent;
pub use reciprocal::Reciprocal;

use super::refused;
use crate::problem::Result;

/// What the tables are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tables {
    /// Look-up tables of the logic: short tables, and a curve beside the lines.
    Logic,
    /// Block RAM, one for the reciprocal and one for the arctangent: long tables, and lines alone.
    Memory,
}

impl Tables {
    /// Both kinds.
    pub const ALL: [Self; 2] = [Self::Logic, Self::Memory];

    /// What a specification calls it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Logic => "logic",
            Self::Memory => "memory",
        }
    }

    /// Clocks from an index to its word: a block RAM's output is late in its clock and gets a register of its own.
    pub const fn clocks(self) -> u32 {
        match self {
            Self::Logic => 1,
            Self::Memory => 2,
        }
    }
}

/// What the unit is to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PolySpecification {
    /// Bits of x, signed, 2 to 40.
    pub x_bits: u32,
    /// Bits of y, signed, 2 to 40.
    pub y_bits: u32,
    /// Bits of the phase, a fraction of a turn, 8 to 20; up to 16 every product fits one 18 × 18 multiplier.
    pub phase_bits: u32,
    /// What the tables are made of.
    pub tables: Tables,
}

/// A checked [`PolySpecification`] with every number that follows from it.
#[derive(Debug, Clone, PartialEq)]
pub struct Poly {
    specification: PolySpecification,
    /// Bits of a folded coordinate: the wider input's magnitude bits, and below them one that stands for the carry of a
    /// negation that is not made. A coordinate v is held as 2v, −v as the complement 2v − 1.
    pub word_bits: u32,
    /// Shifts of the normaliser's stages, largest first: together they reach every leading-zero count of a word.
    pub shifts: Vec<u32>,
    /// Bits of a normalised coordinate, 1.0 to 2.0 for the major one: one integer bit. What a shift brings in below is the
    /// sign: ones below a complement, so that it falls short of the magnitude by one unit of *this* word, not of the input's.
    pub coordinate_bits: u32,
    /// The reciprocal of the major coordinate.
    pub reciprocal: Reciprocal,
    /// Fraction bits of the ratio minor/major, rounded down; it is below 1.0 by the reciprocal's scale.
    pub ratio_bits: u32,
    /// The arctangent of the ratio.
    pub arctangent: Arctangent,
    /// Clocks from a vector to its phase, without back-pressure.
    pub latency_clocks: u32,
}

impl std::ops::Deref for Poly {
    type Target = PolySpecification;

    fn deref(&self) -> &PolySpecification {
        &self.specification
    }
}

/// Clocks of a multiplier: its operands', its product's and its result's register.
pub const MULTIPLIER_CLOCKS: u32 = 3;

impl Poly {
    /// Checks `specification` and derives everything; `source` is the name that a refusal gives.
    pub fn new(source: &str, specification: PolySpecification) -> Result<Self> {
        let PolySpecification { x_bits, y_bits, phase_bits, tables } = specification;
        for (field, bits) in [("vector.x_bits", x_bits), ("vector.y_bits", y_bits)] {
            if !(2..=40).contains(&bits) {
                return Err(refused(source, field, bits).expected("a whole number from 2 to 40"));
            }
        }
        if !(8..=20).contains(&phase_bits) {
            return Err(refused(source, "output.phase_bits", phase_bits)
                .expected("a whole number from 8 to 20 for atan = \"poly\"")
                .remedy("choose atan = \"cordic\", which has no such limit"));
        }
        let word_bits = x_bits.max(y_bits);
        let shifts: Vec<u32> =
            (0..6).rev().map(|stage| 1 << stage).filter(|&places| places < word_bits).collect();
        let coordinate_bits = phase_bits + 2;
        let reciprocal = Reciprocal::new(phase_bits, coordinate_bits, tables);
        let ratio_bits = phase_bits + 1;
        let arctangent = Arctangent::new(phase_bits, ratio_bits, reciprocal.scale_bits, tables);
        // Comparison, swap, shifts; factor, reciprocal, ratio, line, product; sum, unfolding.
        let latency_clocks = 2 + shifts.len() as u32 + 2 * tables.clocks() + 3 * MULTIPLIER_CLOCKS + 2;
        let unit = Self {
            specification,
            word_bits,
            shifts,
            coordinate_bits,
            reciprocal,
            ratio_bits,
            arctangent,
            latency_clocks,
        };
        Ok(unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(bits: u32, phase_bits: u32, tables: Tables) -> Poly {
        Poly::new("test", PolySpecification { x_bits: bits, y_bits: bits, phase_bits, tables }).unwrap()
    }

    /// A bound below one code makes the phase faithful: one of the two codes next to the truth, for every vector.
    #[test]
    fn every_unit_that_can_be_specified_is_faithful() {
        for tables in [Tables::Logic, Tables::Memory] {
            for phase_bits in 8..=20 {
                let unit = unit(16, phase_bits, tables);
                let codes = unit.phase_codes();
                println!(
                    "{tables:?} {phase_bits}: {codes:.3}, {:?}",
                    unit.budget().iter().map(|c| (c.name, c.phase_codes)).collect::<Vec<_>>()
                );
                assert!((0.5..1.0).contains(&codes), "{tables:?} {phase_bits}: {codes}");
            }
        }
    }

    #[test]
    fn a_word_or_phase_out_of_range_is_refused() {
        let good = PolySpecification { x_bits: 16, y_bits: 16, phase_bits: 16, tables: Tables::Logic };
        for (bad, field) in [
            (PolySpecification { x_bits: 1, ..good }, "vector.x_bits = 1"),
            (PolySpecification { y_bits: 41, ..good }, "vector.y_bits = 41"),
            (PolySpecification { phase_bits: 7, ..good }, "output.phase_bits = 7"),
            (PolySpecification { phase_bits: 21, ..good }, "output.phase_bits = 21"),
        ] {
            assert_eq!(Poly::new("test", bad).unwrap_err().found(), field);
        }
    }
}
