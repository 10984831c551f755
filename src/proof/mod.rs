//! What the checks are worth: mutants that the benches must kill, lines and bits that they must move, and formal proofs.
//!
//! Everything here works on the generated Verilog of a preset with a small sensor ([`small`]), so that a campaign takes minutes.
//! A change of the list of modules changes nothing here: mutants and coverage are drawn from whatever is emitted.

pub mod coverage;
pub mod formal;
pub mod mutation;
mod small;
mod yosys;

pub use small::{octaves, small, stimulus};
