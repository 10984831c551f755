//! The pipeline specification: the one source of truth of everything that the hardware is.
//!
//! A [`Pipeline`] is a specification that has been checked, with every number that follows from it
//! ([`Derived`]). It can only be made by [`Pipeline::new`], so one that exists can be built.

mod angle;
mod budget;
mod derived;
mod design;
mod dft;
pub mod exact;
mod file;
mod poly;
mod presets;
mod registers;
mod response;
mod row;
mod scheme;
mod scheme_file;
mod sequence;
mod step_angle;
mod storage;
mod unwrapping;
mod word;

pub use angle::{
    AngleBudget, AngleCore, AngleGroup, AngleSpecification, AngleUnit, Architecture, Atan, Cordic,
    ONE_ITERATION_A_CLOCK, Rounding, StageWord, Stages, Throughput,
};
pub use budget::{Contribution, ErrorBudget};
pub use derived::Derived;
pub use design::Design;
pub use dft::{COEFFICIENT_BITS, DFT_FRAMES};
pub use exact::ScaledConstant;
pub use poly::{Arctangent, MULTIPLIER_CLOCKS, Poly, PolySpecification, Reciprocal, Tables};
pub use presets::{ANGLE_PRESETS, PRESETS, Preset};
pub use registers::{
    ADDRESS_BITS, Content, Counter, IDENTIFICATION, REGISTER_BYTES, REGISTERS, Register, RegisterBlock,
    register_at,
};
pub use row::{Row, offset_weights};
pub use scheme::{Irrational, SCHEMES, Scheme, SchemeOrigin, scheme, scheme_names};
pub use sequence::normalised_order;
pub use step_angle::StepAngle;
pub use storage::{Storage, StoredSum};
pub use unwrapping::{SHARE_BITS, Unwrapper, Unwrapping};
pub use word::Word;

use crate::frames::Geometry;
use crate::problem::{Problem, Result};
use sha2::{Digest, Sha256};
use std::ops::RangeInclusive;

/// Bits of a raw code that the hardware takes.
pub const ADC_BITS: RangeInclusive<i64> = 8..=16;

/// The sensor and its raw stream.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Pixels a line, 2 to 4096.
    pub width: usize,
    /// Lines a frame, 1 to 4096.
    pub height: usize,
    /// Bits of a raw code, of [`ADC_BITS`].
    pub adc_bits: u32,
    /// Least code that counts as saturated, DN; 1 to full scale.
    pub saturation_dn: i64,
    /// Longest pause inside a frame, clocks, 16 to 60000; a longer silence ends the frame.
    pub line_blanking_clocks: u32,
}

/// Modulation and phase stepping.
#[derive(Debug, Clone, PartialEq)]
pub struct Modulation {
    /// How a phase is made of the raw frames: a row of [`SCHEMES`], a DFT, or a row of the specification's own.
    pub scheme: Scheme,
    /// Modulation frequency, Hz, 10 kHz to 10 GHz.
    pub frequency_hz: f64,
    /// Raw frames accumulated for one phase step, 1 to 256.
    pub frames_per_step: usize,
    /// The phase steps in the order in which a set has them, each once; `None` where it is ascending.
    pub order: Option<Vec<usize>>,
    /// Bits of a phase step as a fraction of a turn, for the modulation hardware, 2 to 24.
    pub phase_step_bits: u32,
}

/// The output words.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Phase, as a fraction of a turn, 8 to 24 bits.
    pub phase_bits: u32,
    /// Whether the amplitude is wanted; without it the hardware is smaller.
    pub amplitude: bool,
    /// Bits of the amplitude below 1 DN, 0 to 8.
    pub amplitude_fraction_bits: u32,
    /// Bits of the offset below 1 DN, 0 to 8.
    pub offset_fraction_bits: u32,
    /// Distance a code, m.
    pub distance_unit_m: f64,
    /// A pixel of less amplitude is marked invalid, DN.
    pub minimum_amplitude_dn: f64,
    /// What the constant factors of amplitude, offset and distance are made of.
    pub multipliers: Multipliers,
}

/// What a multiplication by a constant is made of. The products are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Multipliers {
    /// Left to synthesis as a product: DSP blocks, where the device has them.
    Dsp,
    /// Shifts and adds, one for each digit of the factor's canonical signed-digit form that is not 0: no DSP block.
    ShiftAdd,
}

/// What a user specifies.
#[derive(Debug, Clone, PartialEq)]
pub struct Specification {
    /// Prefix of the Verilog modules, lower case letters, digits, `-` and `_`.
    pub name: String,
    /// The sensor.
    pub sensor: Sensor,
    /// Modulation and phase stepping.
    pub modulation: Modulation,
    /// The CORDIC.
    pub cordic: Cordic,
    /// The output words.
    pub output: Output,
    /// The register block.
    pub registers: RegisterBlock,
    /// Unwrapping with a second modulation frequency, where there is one.
    pub unwrapping: Option<Unwrapping>,
}

/// A specification that works, and all that follows from it.
#[derive(Debug, Clone, PartialEq)]
pub struct Pipeline {
    specification: Specification,
    derived: Derived,
}

impl std::ops::Deref for Pipeline {
    type Target = Specification;

    fn deref(&self) -> &Specification {
        &self.specification
    }
}

impl Pipeline {
    /// Checks `specification` (every limit of its fields, then what only shows when widths are derived).
    ///
    /// `source` is the file or preset that a refusal names.
    pub fn new(source: &str, specification: Specification) -> Result<Self> {
        file::check(source, &specification)?;
        let derived = Derived::new(source, &specification)?;
        Ok(Self { specification, derived })
    }

    /// Reads the preset or the TOML file called `name`.
    pub fn named(name: &str) -> Result<Self> {
        match PRESETS.iter().find(|preset| preset.name == name) {
            Some(preset) => Self::parse(preset.name, preset.text),
            None => {
                let names: Vec<&str> = PRESETS.iter().map(|preset| preset.name).collect();
                Self::parse(name, &file::read(name, &names.join(", "))?)
            }
        }
    }

    /// Reads the text of a specification; `source` is the name that a refusal gives.
    pub fn parse(source: &str, text: &str) -> Result<Self> {
        Self::new(source, file::parse(source, text)?)
    }

    /// The same hardware for another sensor, ADC, frame count, scheme or frequency: what a recording brings.
    pub fn adapted(&self, source: &str, change: impl FnOnce(&mut Specification)) -> Result<Self> {
        let mut specification = self.specification.clone();
        change(&mut specification);
        // Full scale stays full scale when the converter changes, unless the change says otherwise.
        let full_scale = |sensor: &Sensor| Word::unsigned(sensor.adc_bits).max();
        let follows = self.sensor.saturation_dn == full_scale(&self.sensor);
        if follows && specification.sensor.saturation_dn == self.sensor.saturation_dn {
            specification.sensor.saturation_dn = full_scale(&specification.sensor);
        }
        Self::new(source, specification)
    }

    /// Every number that follows from the specification.
    pub fn derived(&self) -> &Derived {
        &self.derived
    }

    /// The worst-case errors.
    pub fn budget(&self) -> ErrorBudget {
        ErrorBudget::new(self)
    }

    /// The specification as the text of a TOML file, from which it can be read again.
    pub fn to_toml(&self) -> String {
        file::write(&self.specification)
    }

    /// The specification's hash: the first 64 bits of the SHA-256 of [`Pipeline::to_toml`]'s text, which is what
    /// `vuris explain --spec … --toml` prints, highest bit first.
    pub fn hash(&self) -> u64 {
        let digest = Sha256::digest(self.to_toml().as_bytes());
        digest.iter().take(8).fold(0, |hash, &byte| hash << 8 | u64::from(byte))
    }

    /// The sensor's pixels.
    pub fn geometry(&self) -> Geometry {
        Geometry { width: self.sensor.width, height: self.sensor.height }
    }

    /// What the names of all Verilog modules begin with.
    pub fn prefix(&self) -> String {
        self.name.replace('-', "_")
    }

    /// Name of the top Verilog module. Like every module's it ends in a noun of ours, so that no specification's name can
    /// make it a keyword.
    pub fn top(&self) -> String {
        format!("{}_pipeline", self.prefix())
    }
}

/// A refusal of the specification `source` as a whole.
fn refused(source: &str, field: &str, value: impl std::fmt::Display) -> Problem {
    Problem::at(source, format_args!("{field} = {value}"))
}
