//! Registers: what the register block answers to reads and writes.

use crate::spec::{Content, Counter, Pipeline, register_at};

/// A processor's access over AXI4-Lite; byte addresses, whose two lowest bits do not matter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// A read.
    Read {
        /// The address.
        address: u32,
    },
    /// A write.
    Write {
        /// The address.
        address: u32,
        /// The data.
        data: u32,
        /// Which of the four bytes are written, lowest first in the lowest bit.
        strobes: u32,
    },
}

/// What a read gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReadData {
    /// This value.
    Value(u32),
    /// A count, as it is in the clock in which the address is taken.
    Counter(Counter),
}

/// The answer to an access.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Answer {
    /// OKAY; else SLVERR: there is no such register, or it cannot be written.
    pub okay: bool,
    /// What a read gives, 0 where there is no such register; for a write the frequency factor that it leaves.
    pub data: ReadData,
}

/// The register block's own state. What it counts, others know.
#[derive(Debug, Clone)]
pub struct Registers<'a> {
    pipeline: &'a Pipeline,
    frequency_factor: u32,
}

impl<'a> Registers<'a> {
    /// The block after reset.
    pub fn new(pipeline: &'a Pipeline) -> Self {
        Self { pipeline, frequency_factor: pipeline.registers.frequency_factor }
    }

    /// What drives the modulation hardware.
    pub fn frequency_factor(&self) -> u32 {
        self.frequency_factor
    }

    /// The answer to `access`, which a write has changed the block by.
    pub fn answer(&mut self, access: Access) -> Answer {
        match access {
            Access::Read { address } => {
                let data = match register_at(address).map(|register| register.content) {
                    None => return Answer { okay: false, data: ReadData::Value(0) },
                    Some(Content::Constant(value)) => ReadData::Value(value(self.pipeline)),
                    Some(Content::Counter(counter)) => ReadData::Counter(counter),
                    Some(Content::Setting(_)) => ReadData::Value(self.frequency_factor),
                };
                Answer { okay: true, data }
            }
            Access::Write { address, data, strobes } => {
                let okay = register_at(address).is_some_and(|register| register.writable());
                if okay {
                    let bytes = (0..4).filter(|byte| strobes >> byte & 1 == 1);
                    let mask: u32 = bytes.map(|byte| 0xff << (8 * byte)).sum();
                    self.frequency_factor = self.frequency_factor & !mask | data & mask;
                }
                Answer { okay, data: ReadData::Value(self.frequency_factor) }
            }
        }
    }
}
