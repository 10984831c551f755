//! What a design takes of an FPGA, from the cells that Yosys counts.

use super::family::{Cell, Family};
use crate::problem::{Problem, Result};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What a mapped design occupies, before it is placed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Area {
    /// Look-up tables of 4 inputs in all: on ECP5 LUT4 + 2 CCU2C + 4 TRELLIS_DPR16X4, on iCE40 SB_LUT4.
    pub luts: u64,
    /// Of them, those that are logic: LUT4 or SB_LUT4.
    pub lut4: u64,
    /// Carry cells: CCU2C (two bits each) or SB_CARRY (one bit each).
    pub carries: u64,
    /// Memories made of look-up tables: TRELLIS_DPR16X4.
    pub lut_memories: u64,
    /// Flip-flops.
    pub registers: u64,
    /// Block RAMs: DP16KD or SB_RAM40_4K.
    pub block_rams: u64,
    /// Multipliers: MULT18X18D or SB_MAC16.
    pub multipliers: u64,
}

/// What `stat -json` prints, as far as it is read.
#[derive(Deserialize)]
struct Statistics {
    design: CellCounts,
}

#[derive(Deserialize)]
struct CellCounts {
    num_cells_by_type: BTreeMap<String, u64>,
}

impl Area {
    /// Reads the output of Yosys' `stat -json` on a flat design that is mapped to `family`.
    ///
    /// A cell of a type that is not known is an error: it would be area that nobody counts.
    pub fn parse(statistics: &str, family: Family) -> Result<Self> {
        let unreadable = |found: String| {
            Problem::at("yosys", found)
                .expected("the output of `stat -json` on a mapped design")
                .remedy("use the Yosys of `bash scripts/hdl-tools.sh synth`")
        };
        let statistics: Statistics = serde_json::from_str(statistics)
            .map_err(|error| unreadable(format!("its statistics cannot be read: {error}")))?;
        let mut area = Self::default();
        for (name, count) in statistics.design.num_cells_by_type {
            let Some(cell) = family.cell(&name) else {
                return Err(unreadable(format!(
                    "{count} cells of the type {name}, which is not counted for {}",
                    family.name()
                )));
            };
            area.luts += count * family.luts_of(cell);
            match cell {
                Cell::Lut4 => area.lut4 += count,
                Cell::Carry => area.carries += count,
                Cell::LutMemory => area.lut_memories += count,
                Cell::Register => area.registers += count,
                Cell::BlockRam => area.block_rams += count,
                Cell::Multiplier => area.multipliers += count,
                Cell::Free => {}
            }
        }
        Ok(area)
    }

    /// What is compared with a baseline and with a part, by name.
    pub fn resources(&self) -> [(&'static str, u64); 4] {
        [
            ("LUTs", self.luts),
            ("registers", self.registers),
            ("block RAMs", self.block_rams),
            ("multipliers", self.multipliers),
        ]
    }

    /// Why it does not fit the part of `family`, where that is certain without placing it.
    pub fn excess(&self, family: Family) -> Option<String> {
        let capacity = family.capacity();
        let available = [capacity.luts, capacity.registers, capacity.block_rams, capacity.multipliers];
        let over: Vec<String> = self
            .resources()
            .into_iter()
            .zip(available)
            .filter(|((_, used), available)| used > available)
            .map(|((name, used), available)| format!("{used} of {available} {name}"))
            .collect();
        (!over.is_empty()).then(|| over.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of Yosys 0.70, shortened: a whole pipeline on ECP5.
    const ECP5: &str = r#"{ "creator": "Yosys 0.70", "invocation": "stat -json ",
        "modules": { "\\vuris_pipeline": { "num_cells_by_type": { "LUT4": 1 } } },
        "design": { "num_wires": 7023, "num_cells": 7086, "num_cells_by_type": {
            "$scopeinfo": 39, "CCU2C": 988, "DP16KD": 57, "L6MUX21": 6, "LUT4": 2366, "MULT18X18D": 9, "PFUMX": 77,
            "TRELLIS_DPR16X4": 3, "TRELLIS_FF": 3544 } } }"#;

    /// Of Yosys 0.70, shortened: a CORDIC, and block RAMs of both kinds, on iCE40.
    const ICE40: &str = r#"{ "design": { "num_cells_by_type": { "$scopeinfo": 20, "SB_CARRY": 1312, "SB_DFF": 1900,
            "SB_DFFE": 50, "SB_DFFESR": 3, "SB_LUT4": 1901, "SB_RAM40_4K": 2, "SB_RAM40_4KNR": 1 } } }"#;

    #[test]
    fn cells_are_counted_by_what_they_occupy() {
        let area = Area::parse(ECP5, Family::Ecp5).unwrap();
        assert_eq!(area.luts, 2366 + 2 * 988 + 4 * 3);
        assert_eq!((area.lut4, area.carries, area.lut_memories, area.registers), (2366, 988, 3, 3544));
        assert_eq!((area.block_rams, area.multipliers), (57, 9));
        assert_eq!(area.excess(Family::Ecp5).unwrap(), "57 of 56 block RAMs");
        let area = Area::parse(ICE40, Family::Ice40).unwrap();
        assert_eq!((area.luts, area.registers, area.block_rams), (1901, 1953, 3));
        assert_eq!(area.excess(Family::Ice40), None);
        let beyond = Area { luts: 7681, multipliers: 1, ..area };
        assert_eq!(beyond.excess(Family::Ice40).unwrap(), "7681 of 7680 LUTs, 1 of 0 multipliers");
    }

    #[test]
    fn a_cell_that_nobody_counts_is_an_error_and_so_is_another_text() {
        let latch = ECP5.replace("PFUMX", "$_DLATCH_P_");
        let problem = Area::parse(&latch, Family::Ecp5).unwrap_err().to_string();
        assert!(problem.contains("77 cells of the type $_DLATCH_P_"), "{problem}");
        // The cells of another family.
        assert!(Area::parse(ECP5, Family::Ice40).is_err() && Area::parse(ICE40, Family::Ecp5).is_err());
        assert!(Area::parse("", Family::Ecp5).is_err() && Area::parse("{}", Family::Ecp5).is_err());
    }
}
