//! The angle unit: what turns a vector into its phase. Specified by itself, so that it can be generated, checked and
//! measured without a camera around it.

mod budget;
mod cordic_table;
mod core;
mod reach;
mod stages;
mod table;

pub use budget::AngleBudget;
pub(super) use cordic_table::{read_cordic, write_cordic};
pub(super) use core::ANGLE_FORMAT;
pub use core::AngleCore;
pub use stages::{StageWord, Stages};
pub use table::AngleGroup;

use super::{Poly, PolySpecification, Tables, Word, refused};
use crate::problem::Result;

/// How often a new vector can come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Throughput {
    /// One in so many clocks, 1 to 64.
    CyclesPerPixel(u32),
    /// One CORDIC iteration a clock, whatever that comes to: the smallest hardware.
    OneIterationAClock,
}

/// The text for [`Throughput::OneIterationAClock`] in a specification.
pub const ONE_ITERATION_A_CLOCK: &str = "one iteration a clock";

/// What becomes of the bits below a shifted operand's last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rounding {
    /// Rounded to nearest: the bit below is the adder's carry.
    Nearest,
    /// Cut off.
    Truncate,
}

/// The CORDIC.
#[derive(Debug, Clone, PartialEq)]
pub struct Cordic {
    /// Iterations, 4 to 30, by the angles atan(√metric · 2^−1) … atan(√metric · 2^−iterations).
    pub iterations: u32,
    /// Bits of x and y below 2^−(phase bits), 0 to 8; 1.0 is the least normalised coordinate.
    pub vector_guard_bits: u32,
    /// Bits of the angle below the phase's resolution, 1 to 8.
    pub angle_guard_bits: u32,
    /// How often a new vector can come; it decides the architecture.
    pub throughput: Throughput,
    /// Iterations between two registers of the unrolled architecture, 1 to 30.
    pub pipeline_every: u32,
    /// Whether weak vectors are shifted up first. Without, only strong ones have the stated exactness.
    pub normalise: bool,
    /// Rounding of shifted operands.
    pub rounding: Rounding,
}

impl Cordic {
    /// Iterations and guard bits; all the rest as a specification leaves it by default.
    pub const fn new(iterations: u32, vector_guard_bits: u32, angle_guard_bits: u32) -> Self {
        Self {
            iterations,
            vector_guard_bits,
            angle_guard_bits,
            throughput: Throughput::CyclesPerPixel(1),
            pipeline_every: 1,
            normalise: true,
            rounding: Rounding::Nearest,
        }
    }
}

/// How the arctangent is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Atan {
    /// By the CORDIC's iterations.
    Cordic,
    /// By tables and multipliers: the phase alone, of metric 1.
    Poly(Tables),
}

/// What an angle unit is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct AngleSpecification {
    /// Bits of x, signed, 2 to 56.
    pub x_bits: u32,
    /// Bits of y, signed, 2 to 56.
    pub y_bits: u32,
    /// 1 or 3: the angle is that of the vector (x, √metric · y).
    pub metric: i64,
    /// Bits of the phase, a fraction of a turn, 4 to 24.
    pub phase_bits: u32,
    /// The vector's length is wanted, to a relative 2^−this; 0: the phase alone.
    pub length_bits: u32,
    /// How the arctangent is found.
    pub atan: Atan,
    /// The CORDIC, where it is that.
    pub cordic: Cordic,
}

/// The hardware that a throughput is met by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Architecture {
    /// One stage an iteration: a vector a clock.
    Unrolled,
    /// A ring of `stages` stages, through which every vector goes `rounds` times.
    Folded {
        /// Stages of the ring.
        stages: u32,
        /// Rounds, and clocks a vector.
        rounds: u32,
    },
    /// One stage, its shift counted up by one a clock; the next vector is normalised meanwhile, a place a clock.
    Iterative,
    /// Tables and multipliers: a vector a clock.
    Tables,
}

/// An angle unit that works, and every number that follows from its specification.
#[derive(Debug, Clone, PartialEq)]
pub struct AngleUnit {
    specification: AngleSpecification,
    /// The hardware's shape.
    pub architecture: Architecture,
    /// Iterations that are done: those asked for, rounded up to whole rounds.
    pub iterations: u32,
    /// Bits of a coordinate's magnitude. A negative one is complemented bit by bit; the one that lacks comes as ones from
    /// the right when it is shifted, so that −2^(bits − 1) needs no further bit.
    pub magnitude_bits: u32,
    /// Places of the normaliser's shifts, largest first; together they reach every number of leading zeros.
    pub shifts: Vec<u32>,
    /// Fraction bits of a normalised coordinate's x as it enters the iterations.
    pub fraction_bits: u32,
    /// Words of x and y after every iteration.
    pub stages: Stages,
    /// Bits of the angle: phase bits + angle guard bits.
    pub angle_bits: u32,
    /// Sums of angles by the directions of some iterations each.
    pub groups: Vec<AngleGroup>,
    /// Bits of the sector from which the angle is counted: quarter turns (2) or half turns (1).
    pub sector_bits: u32,
    /// Tables and multipliers instead of all iterations: then only the widths of input and output above hold.
    pub poly: Option<Poly>,
}

impl std::ops::Deref for AngleUnit {
    type Target = AngleSpecification;

    fn deref(&self) -> &AngleSpecification {
        &self.specification
    }
}

impl AngleUnit {
    /// Checks `specification` and derives the rest; `source` is the file that a refusal names.
    pub fn new(source: &str, specification: AngleSpecification) -> Result<Self> {
        check(source, &specification)?;
        let AngleSpecification { metric, phase_bits, cordic, .. } = &specification;
        let poly = poly(source, &specification)?;
        let magnitude_bits = specification.x_bits.max(specification.y_bits) - 1;
        let architecture = match specification.atan {
            Atan::Cordic => architecture(cordic, magnitude_bits),
            Atan::Poly(_) => Architecture::Tables,
        };
        let iterations = match architecture {
            Architecture::Folded { stages, rounds } => stages * rounds,
            Architecture::Unrolled | Architecture::Iterative | Architecture::Tables => cordic.iterations,
        };
        let levels = u32::BITS - magnitude_bits.leading_zeros();
        let shifts =
            if cordic.normalise { (0..levels).rev().map(|level| 1 << level).collect() } else { Vec::new() };
        let fraction_bits = phase_bits + cordic.vector_guard_bits;
        let stages = Stages::new(&specification, architecture, iterations);
        let angle_bits = phase_bits + cordic.angle_guard_bits;
        let together = if architecture == Architecture::Iterative { 1 } else { 4 };
        let groups = table::groups(
            *metric,
            iterations,
            stages.x_iterations,
            together,
            angle_bits,
            cordic.angle_guard_bits,
        );
        Ok(Self {
            architecture,
            iterations,
            magnitude_bits,
            shifts,
            fraction_bits,
            stages,
            angle_bits,
            groups,
            sector_bits: if *metric == 1 { 2 } else { 1 },
            poly,
            specification,
        })
    }

    /// The worst-case error of the phase.
    pub fn budget(&self) -> AngleBudget {
        AngleBudget::new(self)
    }

    /// Zeros (or ones) appended below a magnitude, where it is narrower than the fraction asks for.
    pub fn pad_bits(&self) -> u32 {
        (self.fraction_bits + 1).saturating_sub(self.magnitude_bits)
    }

    /// Bits cut off below a magnitude, where it is wider.
    pub fn drop_bits(&self) -> u32 {
        self.magnitude_bits.saturating_sub(self.fraction_bits + 1)
    }

    /// Bits of the normaliser's shift count.
    pub fn shift_bits(&self) -> u32 {
        (self.shifts.len() as u32).max(1)
    }

    /// The word of the length: x after the last iteration, in 2^−`fraction_bits` of the normalised vector times the gain.
    pub fn length_word(&self) -> Word {
        let iterated = self.stages.x.last().filter(|_| self.poly.is_none());
        Word::unsigned(iterated.map_or(1, |word| word.bits))
    }

    /// Whether the unit gives the length.
    pub fn with_length(&self) -> bool {
        self.length_bits > 0
    }

    /// The last iteration that changes x in unrolled hardware: where no length is asked for, nobody looks at x after the
    /// last iteration but one.
    pub fn last_x_iteration(&self) -> u32 {
        let needed = if self.with_length() { self.iterations - 1 } else { self.iterations - 2 };
        self.stages.x_iterations.min(needed)
    }

    /// Steps of the unrolled iterations between which a register can stand: one an iteration, one more where y is tripled first.
    pub fn moves(&self) -> u32 {
        let tripled = if self.metric == 3 { self.last_x_iteration() + 1 } else { 0 };
        self.iterations + tripled
    }

    /// Clocks of the sum of angles: the tables, then an adder a group.
    pub fn sum_clocks(&self) -> u32 {
        (self.groups.len() as u32).max(2)
    }

    /// Clocks from an accepted vector to its phase, where nothing waits and (iterative) nothing has to be shifted.
    pub fn latency_clocks(&self) -> u32 {
        let levels = self.shifts.len() as u32;
        let registers = |moves: u32| moves.div_ceil(self.cordic.pipeline_every);
        if let Some(poly) = &self.poly {
            return poly.latency_clocks;
        }
        match self.architecture {
            // Input, shifts, iterations, last direction, sum.
            Architecture::Unrolled | Architecture::Tables => {
                1 + registers(levels) + registers(self.moves()) + 1 + self.sum_clocks()
            }
            // Input, shifts, entry, rounds, sum.
            Architecture::Folded { rounds, stages } => 1 + levels + 1 + rounds * stages + self.sum_clocks(),
            // Input, start, iterations 0 to n - 1 and the last direction's, result.
            Architecture::Iterative => 2 + self.iterations + 1 + 1,
        }
    }

    /// Clocks between two vectors at full load; for the iterative unit, of vectors that need `shift` places.
    pub fn clocks_a_vector(&self, shift: u32) -> u32 {
        match self.architecture {
            Architecture::Unrolled | Architecture::Tables => 1,
            Architecture::Folded { rounds, .. } => rounds,
            Architecture::Iterative => (self.iterations + 2).max(shift + 1),
        }
    }
}

/// The least hardware that meets the throughput.
fn architecture(cordic: &Cordic, magnitude_bits: u32) -> Architecture {
    let iterative_clocks = (cordic.iterations + 2).max(if cordic.normalise { magnitude_bits + 1 } else { 0 });
    match cordic.throughput {
        Throughput::CyclesPerPixel(1) => Architecture::Unrolled,
        Throughput::CyclesPerPixel(clocks) if clocks < iterative_clocks => {
            let stages = cordic.iterations.div_ceil(clocks);
            Architecture::Folded { stages, rounds: cordic.iterations.div_ceil(stages) }
        }
        Throughput::CyclesPerPixel(_) | Throughput::OneIterationAClock => Architecture::Iterative,
    }
}

/// The unit by tables and multipliers, where it is that.
fn poly(source: &str, specification: &AngleSpecification) -> Result<Option<Poly>> {
    let AngleSpecification { x_bits, y_bits, metric, phase_bits, length_bits, .. } = *specification;
    let Atan::Poly(tables) = specification.atan else { return Ok(None) };
    let other = "choose atan = \"cordic\"";
    if metric != 1 {
        return Err(refused(source, "vector.metric", metric)
            .expected("1 where atan = \"poly\"")
            .remedy(other));
    }
    if length_bits != 0 {
        let problem = refused(source, "output.length_bits", length_bits);
        return Err(problem.expected("0 where atan = \"poly\": the phase alone").remedy(other));
    }
    Poly::new(source, PolySpecification { x_bits, y_bits, phase_bits, tables }).map(Some)
}

fn check(source: &str, specification: &AngleSpecification) -> Result<()> {
    let AngleSpecification { x_bits, y_bits, metric, phase_bits, length_bits, cordic, .. } = specification;
    let cycles = match cordic.throughput {
        Throughput::CyclesPerPixel(clocks) => clocks,
        Throughput::OneIterationAClock => 1,
    };
    let limits: [(&str, u32, std::ops::RangeInclusive<u32>); 9] = [
        ("vector.x_bits", *x_bits, 2..=56),
        ("vector.y_bits", *y_bits, 2..=56),
        ("output.phase_bits", *phase_bits, 4..=24),
        ("output.length_bits", *length_bits, 0..=32),
        ("cordic.iterations", cordic.iterations, 4..=30),
        ("cordic.vector_guard_bits", cordic.vector_guard_bits, 0..=8),
        ("cordic.angle_guard_bits", cordic.angle_guard_bits, 1..=8),
        ("cordic.cycles_per_pixel", cycles, 1..=64),
        ("cordic.pipeline_every", cordic.pipeline_every, 1..=30),
    ];
    for (field, value, allowed) in limits {
        if !allowed.contains(&value) {
            return Err(refused(source, field, value).expected(format_args!(
                "a whole number from {} to {}",
                allowed.start(),
                allowed.end()
            )));
        }
    }
    if ![1, 3].contains(metric) {
        return Err(refused(source, "vector.metric", metric).expected("1 or 3"));
    }
    let fraction_bits = phase_bits + cordic.vector_guard_bits;
    if cordic.iterations > fraction_bits {
        return Err(refused(source, "cordic.iterations", cordic.iterations).expected(format_args!(
            "at most phase_bits + vector_guard_bits = {fraction_bits}: a later iteration only shifts in zeros"
        )));
    }
    Ok(())
}
