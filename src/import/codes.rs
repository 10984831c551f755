//! From the numbers that stand in a file to raw codes of the ADC.

use crate::problem::Problem;
use crate::recording::MOST_BITS;
use std::fmt::Display;

/// Of an ADC whose bits nobody knows, codes of so many are taken.
const USUAL_BITS: u32 = 16;

/// How a file's numbers become codes: `number · scale + add`, and what may come out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Levels {
    /// Factor on a file's numbers; where there is one, products are rounded to the nearest code (a half away from 0).
    pub scale: Option<f64>,
    /// Whole codes that are added afterwards.
    pub add: f64,
    /// Bits of the ADC, 1 to 24, where they are known: no code may be above 2^bits − 1.
    pub adc_bits: Option<u32>,
    /// The code from which on the camera saturates, where that is below 2^bits − 1: such codes become 2^bits − 1, by
    /// which the format and the hardware know a clipped sample. Needs [`Levels::adc_bits`].
    pub saturation_code: Option<u32>,
}

impl Levels {
    /// The numbers themselves.
    pub const AS_THEY_ARE: Self = Self { scale: None, add: 0.0, adc_bits: None, saturation_code: None };

    /// The greatest code that may come out.
    pub fn greatest(&self) -> u32 {
        (1 << self.adc_bits.unwrap_or(USUAL_BITS).min(MOST_BITS)) - 1
    }

    /// The code of `number`.
    pub(super) fn code(&self, number: f64) -> Code {
        let exact = number * self.scale.unwrap_or(1.0) + self.add;
        let code = exact.round();
        // Not a number, too, is outside.
        if !(0.0..=f64::from(self.greatest())).contains(&code) {
            return Code::Outside(code);
        }
        if self.scale.is_none() && code != exact {
            return Code::Fraction;
        }
        let code = code as u32;
        match (self.saturation_code, self.adc_bits) {
            (Some(saturated), Some(_)) if code >= saturated => Code::Saturated(self.greatest()),
            _ => Code::Good { code, rounded: f64::from(code) != exact },
        }
    }

    /// What to expect and to do where a number gave no code; `problem` says which number stands where.
    pub(super) fn refuse(&self, problem: Problem, code: Code) -> Problem {
        match code {
            Code::Fraction => problem
                .expected("whole codes of the ADC")
                .remedy("--scale FACTOR takes any numbers, and rounds their products to the nearest code"),
            Code::Outside(code) if code < 0.0 => problem
                .expected(format_args!("codes from 0 to {}", self.greatest()))
                .remedy("--add CODE lifts all numbers, as a black level does"),
            _ => problem.expected(self.range()).remedy(
                "correct --adc-bits; or --scale FACTOR brings the numbers down: 0.0625 where 12 bits stand at the \
                 upper end of 16",
            ),
        }
    }

    fn range(&self) -> impl Display {
        let why = match self.adc_bits {
            Some(bits) => format!("--adc-bits {bits}"),
            None => format!("{USUAL_BITS} bits; --adc-bits says if there are more"),
        };
        format!("codes from 0 to {} ({why})", self.greatest())
    }
}

/// What becomes of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Code {
    Good { code: u32, rounded: bool },
    Saturated(u32),
    Outside(f64),
    Fraction,
}

#[cfg(test)]
mod tests {
    use super::*;

    const TWELVE: Levels = Levels { adc_bits: Some(12), ..Levels::AS_THEY_ARE };

    #[test]
    fn codes_are_the_numbers_themselves_unless_a_scale_is_given() {
        assert_eq!(Levels::AS_THEY_ARE.code(65_535.0), Code::Good { code: 65_535, rounded: false });
        assert_eq!(Levels::AS_THEY_ARE.code(65_536.0), Code::Outside(65_536.0));
        assert_eq!(Levels::AS_THEY_ARE.code(1.5), Code::Fraction);
        assert!(matches!(Levels::AS_THEY_ARE.code(f64::NAN), Code::Outside(_)));
        assert_eq!(TWELVE.code(4096.0), Code::Outside(4096.0));
        let scaled = Levels { scale: Some(0.0625), add: 3.0, ..TWELVE };
        assert_eq!(scaled.code(16.0 * 4092.0), Code::Good { code: 4095, rounded: false });
        assert_eq!(scaled.code(9.0), Code::Good { code: 4, rounded: true });
        assert_eq!(Levels { add: -1.0, ..TWELVE }.code(0.0), Code::Outside(-1.0));
    }

    #[test]
    fn codes_from_the_saturation_on_are_the_greatest() {
        let levels = Levels { saturation_code: Some(4000), ..TWELVE };
        assert_eq!(levels.code(3999.0), Code::Good { code: 3999, rounded: false });
        assert_eq!(levels.code(4000.0), Code::Saturated(4095));
        assert_eq!(levels.code(4096.0), Code::Outside(4096.0));
    }
}
