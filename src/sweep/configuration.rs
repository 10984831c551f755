//! One point of the design space: the fields of an angle unit's specification that a sweep varies.

use crate::problem::{Problem, Result};
use crate::spec::{AngleSpecification, AngleUnit, Atan, Cordic, Rounding, Throughput};
use std::fmt;

/// An angle unit with both words of at most 30 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Configuration {
    /// The angle is that of (x, √metric · y): 1 or 3.
    pub metric: i64,
    /// Bits of the signed word x, 2 to 30.
    pub x_bits: u32,
    /// Bits of the signed word y, 2 to 30.
    pub y_bits: u32,
    /// Bits of the phase, a fraction of a turn, 4 to 24.
    pub phase_bits: u32,
    /// The length is wanted to a relative 2^−this; 0: the phase alone.
    pub length_bits: u32,
    /// CORDIC iterations, 4 to 30, not more than phase bits + vector guard bits.
    pub iterations: u32,
    /// Bits of the vector below the phase's resolution, 0 to 8.
    pub vector_guard_bits: u32,
    /// Bits of the angle below the phase's resolution, 1 to 8.
    pub angle_guard_bits: u32,
    /// How often a vector can come: it decides the architecture, and the arithmetic with it.
    pub throughput: Throughput,
    /// Iterations between two registers of the unrolled architecture.
    pub pipeline_every: u32,
    /// Whether the vector is shifted up by its leading zeros.
    pub normaliser: bool,
    /// What becomes of the bits below a cut.
    pub rounding: Rounding,
}

/// The widest words that exact angles are proved for, see [`super::ExactAngle`].
const WIDEST_WORD: u32 = 30;

/// What a command line and a table call `rounding`.
pub const fn rounding_name(rounding: Rounding) -> &'static str {
    match rounding {
        Rounding::Nearest => "nearest",
        Rounding::Truncate => "truncate",
    }
}

/// Reads [`rounding_name`].
pub fn rounding_named(name: &str) -> Option<Rounding> {
    [Rounding::Nearest, Rounding::Truncate].into_iter().find(|&rounding| rounding_name(rounding) == name)
}

/// What a table calls `throughput`: clocks a pixel, or `iterative`.
pub fn throughput_name(throughput: Throughput) -> String {
    match throughput {
        Throughput::CyclesPerPixel(clocks) => clocks.to_string(),
        Throughput::OneIterationAClock => "iterative".to_owned(),
    }
}

/// Reads [`throughput_name`].
pub fn throughput_named(name: &str) -> Option<Throughput> {
    match name {
        "iterative" => Some(Throughput::OneIterationAClock),
        clocks => clocks.parse().ok().map(Throughput::CyclesPerPixel),
    }
}

impl Configuration {
    /// The configuration of `specification`, a CORDIC's.
    pub fn of(specification: &AngleSpecification) -> Self {
        let &AngleSpecification { x_bits, y_bits, metric, phase_bits, length_bits, ref cordic, .. } =
            specification;
        Self {
            metric,
            x_bits,
            y_bits,
            phase_bits,
            length_bits,
            iterations: cordic.iterations,
            vector_guard_bits: cordic.vector_guard_bits,
            angle_guard_bits: cordic.angle_guard_bits,
            throughput: cordic.throughput,
            pipeline_every: cordic.pipeline_every,
            normaliser: cordic.normalise,
            rounding: cordic.rounding,
        }
    }

    /// The specification of the unit.
    pub fn specification(&self) -> AngleSpecification {
        AngleSpecification {
            x_bits: self.x_bits,
            y_bits: self.y_bits,
            metric: self.metric,
            phase_bits: self.phase_bits,
            length_bits: self.length_bits,
            atan: Atan::Cordic,
            cordic: Cordic {
                iterations: self.iterations,
                vector_guard_bits: self.vector_guard_bits,
                angle_guard_bits: self.angle_guard_bits,
                throughput: self.throughput,
                pipeline_every: self.pipeline_every,
                normalise: self.normaliser,
                rounding: self.rounding,
            },
        }
    }

    /// The unit.
    ///
    /// # Errors
    /// Words of more than 30 bits, and whatever an angle unit's specification refuses.
    pub fn unit(&self) -> Result<AngleUnit> {
        for (field, bits) in [("x bits", self.x_bits), ("y bits", self.y_bits)] {
            if bits > WIDEST_WORD {
                return Err(Problem::at("sweep", format_args!("{field} = {bits}"))
                    .expected(format_args!("at most {WIDEST_WORD}")));
            }
        }
        AngleUnit::new("sweep", self.specification())
    }

    /// Reads what [`Configuration`] prints.
    pub fn parse(text: &str) -> Option<Self> {
        let parts: Vec<&str> = text.split_whitespace().collect();
        let [metric, x, y, phase, length, iterations, vector, angle, clocks, every, normaliser, rounding] =
            parts[..]
        else {
            return None;
        };
        let number = |text: &str, prefix: &str| text.strip_prefix(prefix)?.parse::<u32>().ok();
        Some(Self {
            metric: number(metric, "m")?.into(),
            x_bits: number(x, "x")?,
            y_bits: number(y, "y")?,
            phase_bits: number(phase, "p")?,
            length_bits: number(length, "l")?,
            iterations: number(iterations, "i")?,
            vector_guard_bits: number(vector, "v")?,
            angle_guard_bits: number(angle, "a")?,
            throughput: throughput_named(clocks.strip_prefix("c")?)?,
            pipeline_every: number(every, "r")?,
            normaliser: match normaliser {
                "normalised" => true,
                "plain" => false,
                _ => return None,
            },
            rounding: rounding_named(rounding)?,
        })
    }
}

impl fmt::Display for Configuration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { metric, x_bits, y_bits, phase_bits, length_bits, iterations, pipeline_every, .. } = self;
        write!(
            f,
            "m{metric} x{x_bits} y{y_bits} p{phase_bits} l{length_bits} i{iterations} v{} a{} c{} r{pipeline_every} {} {}",
            self.vector_guard_bits,
            self.angle_guard_bits,
            throughput_name(self.throughput),
            if self.normaliser { "normalised" } else { "plain" },
            rounding_name(self.rounding)
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
            length_bits: 0,
            iterations: phase_bits,
            vector_guard_bits: 3,
            angle_guard_bits: 3,
            throughput: Throughput::CyclesPerPixel(1),
            pipeline_every: 1,
            normaliser: true,
            rounding: Rounding::Nearest,
        }
    }

    #[test]
    fn text_and_back() {
        for configuration in [
            word(16, 16),
            Configuration { metric: 3, normaliser: false, rounding: Rounding::Truncate, ..word(12, 9) },
            Configuration { throughput: Throughput::OneIterationAClock, length_bits: 12, ..word(12, 9) },
            Configuration { throughput: Throughput::CyclesPerPixel(4), pipeline_every: 2, ..word(12, 9) },
        ] {
            assert_eq!(Configuration::parse(&configuration.to_string()), Some(configuration));
            assert_eq!(Configuration::of(&configuration.specification()), configuration);
        }
        for text in [
            "",
            "m1",
            "m1 x8 y8 p8 l0 i8 v0 a1 c1 r1 plain up",
            "m1 x8 y8 p8 l0 i8 v0 a1 r1 c1 plain nearest",
        ] {
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
            let problem = configuration.unit().unwrap_err().to_string();
            assert!(problem.contains(says), "{problem}");
        }
    }
}
