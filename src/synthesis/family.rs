//! The families of FPGAs: one part of each, and how its tools are called.

use serde::{Deserialize, Serialize};

/// A family of FPGAs, measured on one part of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// Lattice ECP5: LFE5U-25F, speed grade 6, package CABGA381.
    Ecp5,
    /// Lattice iCE40: HX8K, package CT256.
    Ice40,
}

/// What a cell of the mapped netlist occupies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cell {
    Lut4,
    Carry,
    LutMemory,
    Register,
    BlockRam,
    Multiplier,
    /// Nothing of its own: wiring inside a slice, or a note of the synthesis.
    Free,
}

/// What the part has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Capacity {
    pub luts: u64,
    pub registers: u64,
    pub block_rams: u64,
    pub multipliers: u64,
}

impl Family {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Ecp5, Self::Ice40];

    /// Its name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ecp5 => "ecp5",
            Self::Ice40 => "ice40",
        }
    }

    /// The part that it is measured on.
    pub fn part(self) -> &'static str {
        match self {
            Self::Ecp5 => "LFE5U-25F-6 CABGA381",
            Self::Ice40 => "iCE40 HX8K CT256",
        }
    }

    /// What its block RAM is called, and its size in bits.
    pub fn block_ram(self) -> (&'static str, u64) {
        match self {
            Self::Ecp5 => ("DP16KD", 18 * 1024),
            Self::Ice40 => ("SB_RAM40_4K", 4 * 1024),
        }
    }

    /// The command with which Yosys maps to it.
    pub(super) fn synthesis_command(self) -> &'static str {
        match self {
            Self::Ecp5 => "synth_ecp5",
            Self::Ice40 => "synth_ice40",
        }
    }

    /// What Yosys does to a mapped netlist before it is placed.
    pub(super) fn before_placement(self) -> &'static str {
        match self {
            Self::Ecp5 => "",
            // nextpnr-ice40 0.4 is older than these notes of the hierarchy and looks for a place for them.
            Self::Ice40 => "delete t:$scopeinfo; ",
        }
    }

    /// The part, as place and route is told.
    pub(super) fn part_options(self) -> &'static [&'static str] {
        match self {
            Self::Ecp5 => &["--25k", "--package", "CABGA381", "--speed", "6"],
            Self::Ice40 => &["--hx8k", "--package", "ct256"],
        }
    }

    /// What the part has (data sheets FPGA-DS-02012 and FPGA-DS-02029; nextpnr prints the same).
    pub(super) fn capacity(self) -> Capacity {
        match self {
            Self::Ecp5 => Capacity { luts: 24_288, registers: 24_288, block_rams: 56, multipliers: 28 },
            Self::Ice40 => Capacity { luts: 7_680, registers: 7_680, block_rams: 32, multipliers: 0 },
        }
    }

    /// What a cell of the type `cell` occupies; `None` for one that a core without pins and clock generators cannot hold.
    pub(super) fn cell(self, cell: &str) -> Option<Cell> {
        let cell = match (self, cell) {
            (_, "$scopeinfo") => Cell::Free,
            (Self::Ecp5, "LUT4") | (Self::Ice40, "SB_LUT4") => Cell::Lut4,
            (Self::Ecp5, "CCU2C") | (Self::Ice40, "SB_CARRY") => Cell::Carry,
            (Self::Ecp5, "PFUMX" | "L6MUX21") => Cell::Free,
            (Self::Ecp5, "TRELLIS_DPR16X4") => Cell::LutMemory,
            (Self::Ecp5, "TRELLIS_FF") => Cell::Register,
            (Self::Ecp5, "DP16KD" | "PDPW16KD") => Cell::BlockRam,
            (Self::Ecp5, "MULT18X18D") => Cell::Multiplier,
            (Self::Ice40, "SB_MAC16") => Cell::Multiplier,
            (Self::Ice40, cell) if cell.starts_with("SB_DFF") => Cell::Register,
            (Self::Ice40, cell) if cell.starts_with("SB_RAM40_4K") => Cell::BlockRam,
            _ => return None,
        };
        Some(cell)
    }

    /// Look-up tables of 4 inputs that one cell takes.
    pub(super) fn luts_of(self, cell: Cell) -> u64 {
        match (self, cell) {
            (_, Cell::Lut4) => 1,
            // Two bits of a carry chain are both tables of a slice; an iCE40's carry lies beside its bit's table, which is
            // counted already.
            (Self::Ecp5, Cell::Carry) => 2,
            (Self::Ecp5, Cell::LutMemory) => 4,
            _ => 0,
        }
    }
}
