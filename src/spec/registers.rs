//! The map of the register block: one table, from which the hardware, its model, the C header, the Rust constants and the
//! documentation are made.

use super::Pipeline;

/// The register block.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RegisterBlock {
    /// Whether the core has one, with an AXI4-Lite slave port.
    pub axi4_lite: bool,
    /// What the frequency factor is after a reset.
    pub frequency_factor: u32,
}

/// A count that the hardware keeps while it runs; all of them since the last reset, modulo 2^32.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Counter {
    /// Complete sets.
    SetsDone,
    /// Discarded sets.
    SetsDiscarded,
    /// Clocks in which a raw sample was offered and not taken.
    StallClocks,
    /// Saturated pixels among the results that were taken.
    SaturatedPixels,
    /// Result frames of which a pixel was taken.
    SetNumber,
}

impl Counter {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::SetsDone, Self::SetsDiscarded, Self::StallClocks, Self::SaturatedPixels, Self::SetNumber];

    /// Its number, the same in vectors and benches.
    pub fn number(self) -> usize {
        self as usize
    }
}

/// What a register holds.
#[derive(Debug, Clone, Copy)]
pub enum Content {
    /// A number that follows from the specification.
    Constant(fn(&Pipeline) -> u32),
    /// A count.
    Counter(Counter),
    /// A value that can be written, and that a port of its name brings out; here its value after a reset.
    Setting(fn(&Pipeline) -> u32),
}

/// A register of 32 bits.
#[derive(Debug, Clone, Copy)]
pub struct Register {
    /// Its name; upper case in the C header.
    pub name: &'static str,
    /// What it holds.
    pub content: Content,
    /// What it says, in one line.
    pub meaning: &'static str,
}

/// Bits of a byte address.
pub const ADDRESS_BITS: u32 = 8;

/// Bytes of a register.
pub const REGISTER_BYTES: u32 = 4;

/// "VURS": what the first register of every block of this kind holds.
pub const IDENTIFICATION: u32 = u32::from_be_bytes(*b"VURS");

/// All registers: number n is at byte address 4 n.
pub const REGISTERS: &[Register] = &[
    Register {
        name: "identification",
        content: Content::Constant(|_| IDENTIFICATION),
        meaning: "\"VURS\" in ASCII, first letter highest: this is a phase pipeline",
    },
    Register {
        name: "version",
        content: Content::Constant(|_| version()),
        meaning: "version of the generator: major in bits 31:16, minor in 15:8, patch in 7:0",
    },
    Register {
        name: "hash_low",
        content: Content::Constant(|pipeline| pipeline.hash() as u32),
        meaning: "specification hash, bits 31:0",
    },
    Register {
        name: "hash_high",
        content: Content::Constant(|pipeline| (pipeline.hash() >> 32) as u32),
        meaning: "specification hash, bits 63:32",
    },
    Register {
        name: "width",
        content: Content::Constant(|pipeline| pipeline.sensor.width as u32),
        meaning: "pixels a line",
    },
    Register {
        name: "height",
        content: Content::Constant(|pipeline| pipeline.sensor.height as u32),
        meaning: "lines a frame",
    },
    Register {
        name: "frames",
        content: Content::Constant(|pipeline| pipeline.derived().frames_per_set as u32),
        meaning: "raw frames a set",
    },
    Register {
        name: "sets_done",
        content: Content::Counter(Counter::SetsDone),
        meaning: "complete sets since reset, modulo 2^32",
    },
    Register {
        name: "sets_discarded",
        content: Content::Counter(Counter::SetsDiscarded),
        meaning: "discarded sets since reset, modulo 2^32: a frame missing, too short or too long",
    },
    Register {
        name: "stall_clocks",
        content: Content::Counter(Counter::StallClocks),
        meaning: "clocks since reset in which a raw sample was offered and not taken, modulo 2^32",
    },
    Register {
        name: "saturated_pixels",
        content: Content::Counter(Counter::SaturatedPixels),
        meaning: "saturated pixels among the results taken since reset, modulo 2^32",
    },
    Register {
        name: "set_number",
        content: Content::Counter(Counter::SetNumber),
        meaning: "number of the set that the last taken result belongs to: 1 for the first since reset, 0 before",
    },
    Register {
        name: "frequency_factor",
        content: Content::Setting(|pipeline| pipeline.registers.frequency_factor),
        meaning: "modulation frequency as a multiple of the modulation hardware's unit; drives frequency_factor_o",
    },
];

impl Register {
    /// Whether it can be written.
    pub fn writable(&self) -> bool {
        matches!(self.content, Content::Setting(_))
    }
}

/// The register at `address`, whose two lowest bits do not matter.
pub fn register_at(address: u32) -> Option<&'static Register> {
    REGISTERS.get((address / REGISTER_BYTES) as usize)
}

/// The crate's version, as the register has it.
fn version() -> u32 {
    // The build has checked that these are numbers.
    let part = |text: &str| text.parse::<u32>().unwrap_or(0);
    part(env!("CARGO_PKG_VERSION_MAJOR")) << 16
        | part(env!("CARGO_PKG_VERSION_MINOR")) << 8
        | part(env!("CARGO_PKG_VERSION_PATCH"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_register_has_its_own_name_and_an_address() {
        for (number, register) in REGISTERS.iter().enumerate() {
            assert_eq!(REGISTERS.iter().filter(|other| other.name == register.name).count(), 1);
            assert!(register.name.chars().all(|c| c.is_ascii_lowercase() || c == '_'), "{}", register.name);
            let address = REGISTER_BYTES * number as u32;
            assert!(address < 1 << ADDRESS_BITS, "{}", register.name);
            assert_eq!(register_at(address + 3).map(|found| found.name), Some(register.name));
        }
        assert!(register_at(REGISTER_BYTES * REGISTERS.len() as u32).is_none());
        for counter in Counter::ALL {
            let holds =
                |register: &&Register| matches!(register.content, Content::Counter(c) if c == counter);
            assert_eq!(REGISTERS.iter().filter(holds).count(), 1, "{counter:?}");
            assert_eq!(Counter::ALL[counter.number()], counter);
        }
    }
}
