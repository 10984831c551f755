//! One point of the design space.

use crate::problem::{Problem, Result};
use std::fmt;
use std::ops::RangeInclusive;

/// What becomes of the bits below a cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Rounding {
    /// To the nearest value, halves up.
    Nearest,
    /// Dropped: towards minus infinity.
    Truncate,
}

impl Rounding {
    /// What a command line and a table call it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nearest => "nearest",
            Self::Truncate => "truncate",
        }
    }

    /// The one called `name`.
    pub fn named(name: &str) -> Option<Self> {
        [Self::Nearest, Self::Truncate].into_iter().find(|rounding| rounding.name() == name)
    }
}

/// A unit that makes a phase from two signed words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Configuration {
    /// The angle is that of (x, √metric · y): 1 or 3.
    pub metric: i64,
    /// Bits of the signed word x, 2 to 30.
    pub x_bits: u32,
    /// Bits of the signed word y, 2 to 30.
    pub y_bits: u32,
    /// Bits of the phase, a fraction of a turn, 4 to 24.
    pub phase_bits: u32,
    /// CORDIC iterations, 2 to 30, not more than phase bits + vector guard bits.
    pub iterations: u32,
    /// Bits of the vector below the phase's resolution, 0 to 8.
    pub vector_guard_bits: u32,
    /// Bits of the angle below the phase's resolution, 1 to 8.
    pub angle_guard_bits: u32,
    /// Whether the vector is shifted up by its leading zeros. The generated hardware does.
    pub normaliser: bool,
    /// What becomes of the bits below a cut. The generated hardware rounds to nearest.
    pub rounding: Rounding,
}

impl Configuration {
    /// Limits of the fields, in their order.
    const LIMITS: [(&'static str, RangeInclusive<u32>); 6] = [
        ("x bits", 2..=30),
        ("y bits", 2..=30),
        ("phase bits", 4..=24),
        ("iterations", 2..=30),
        ("vector guard bits", 0..=8),
        ("angle guard bits", 1..=8),
    ];

    /// The configuration itself, if it can be built.
    pub fn checked(self) -> Result<Self> {
        let values = [
            self.x_bits,
            self.y_bits,
            self.phase_bits,
            self.iterations,
            self.vector_guard_bits,
            self.angle_guard_bits,
        ];
        for ((field, allowed), value) in Self::LIMITS.into_iter().zip(values) {
            if !allowed.contains(&value) {
                return Err(Problem::at("sweep", format_args!("{field} = {value}")).expected(format_args!(
                    "{} to {}",
                    allowed.start(),
                    allowed.end()
                )));
            }
        }
        if ![1, 3].contains(&self.metric) {
            return Err(Problem::at("sweep", format_args!("metric = {}", self.metric)).expected("1 or 3"));
        }
        if self.iterations > self.fraction_bits() {
            return Err(Problem::at("sweep", format_args!("iterations = {}", self.iterations)).expected(
                format_args!(
                    "at most phase bits + vector guard bits = {}: a later iteration only shifts in zeros",
                    self.fraction_bits()
                ),
            ));
        }
        Ok(self)
    }

    /// Fraction bits of the CORDIC's vector.
    pub const fn fraction_bits(&self) -> u32 {
        self.phase_bits + self.vector_guard_bits
    }

    /// Whether the generator can make this one; the others are there to show what normaliser and rounding are worth.
    pub fn is_generated(&self) -> bool {
        self.normaliser && self.rounding == Rounding::Nearest
    }

    /// Reads what [`Configuration`] prints.
    pub fn parse(text: &str) -> Option<Self> {
        let parts: Vec<&str> = text.split_whitespace().collect();
        let [metric, x, y, phase, iterations, vector, angle, normaliser, rounding] = parts[..] else {
            return None;
        };
        let number = |text: &str, prefix: &str| text.strip_prefix(prefix)?.parse::<u32>().ok();
        Self {
            metric: number(metric, "m")?.into(),
            x_bits: number(x, "x")?,
            y_bits: number(y, "y")?,
            phase_bits: number(phase, "p")?,
            iterations: number(iterations, "i")?,
            vector_guard_bits: number(vector, "v")?,
            angle_guard_bits: number(angle, "a")?,
            normaliser: match normaliser {
                "normalised" => true,
                "plain" => false,
                _ => return None,
            },
            rounding: Rounding::named(rounding)?,
        }
        .checked()
        .ok()
    }
}

impl fmt::Display for Configuration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "m{} x{} y{} p{} i{} v{} a{} {} {}",
            self.metric,
            self.x_bits,
            self.y_bits,
            self.phase_bits,
            self.iterations,
            self.vector_guard_bits,
            self.angle_guard_bits,
            if self.normaliser { "normalised" } else { "plain" },
            self.rounding.name()
        )
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A word of `bits` bits, a phase of `phase_bits`.
    pub(in super::super) fn word(bits: u32, phase_bits: u32) -> Configuration {
        Configuration {
            metric: 1,
            x_bits: bits,
            y_bits: bits,
            phase_bits,
            iterations: phase_bits,
            vector_guard_bits: 3,
            angle_guard_bits: 3,
            normaliser: true,
            rounding: Rounding::Nearest,
        }
    }

    #[test]
    fn text_and_back() {
        for configuration in [
            word(16, 16),
            Configuration { metric: 3, normaliser: false, rounding: Rounding::Truncate, ..word(12, 9) },
        ] {
            assert_eq!(Configuration::parse(&configuration.to_string()), Some(configuration));
        }
        for text in ["", "m1", "m2 x8 y8 p8 i8 v0 a1 plain nearest", "m1 x8 y8 p8 i9 v0 a1 plain nearest"] {
            assert_eq!(Configuration::parse(text), None, "{text}");
        }
    }

    #[test]
    fn what_cannot_be_built_is_refused_with_its_limit() {
        for (configuration, says) in [
            (Configuration { x_bits: 31, ..word(16, 16) }, "x bits = 31"),
            (Configuration { angle_guard_bits: 0, ..word(16, 16) }, "1 to 8"),
            (Configuration { metric: 2, ..word(16, 16) }, "1 or 3"),
            (Configuration { iterations: 20, ..word(16, 16) }, "= 19"),
        ] {
            let problem = configuration.checked().unwrap_err().to_string();
            assert!(problem.contains(says), "{problem}");
        }
    }
}
