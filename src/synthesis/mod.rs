//! Real synthesis: what Verilog takes of an FPGA and how fast it is there, by Yosys and nextpnr, on two families.
//!
//! ```text
//! Target ─► Verilog ┬─► Yosys ─────────────────────► Area         the bare core
//!                   └─► wrapper ─► Yosys ─► nextpnr ─► Routed       one for each seed
//!                                                        │
//!               Baseline (synthesis.json) ◄── Measured ◄─┘
//! ```
//! Everything that a tool computed is kept by the content of what it was computed from, so that nothing is computed twice.

mod accuracy;
mod area;
mod baseline;
mod cache;
mod family;
mod flow;
mod measurement;
mod peers;
mod routing;
mod target;
mod tools;
mod verilog;
mod wrapper;

pub use accuracy::{Accuracy, AccuracyMethod, OctaveMean};
pub use area::Area;
pub use baseline::{Baseline, Change, LIMIT_PERCENT};
pub use cache::Cache;
pub use family::Family;
pub use flow::{FREQUENCY_MHZ, Flow, Placement, command_lines};
pub use measurement::{Effort, Mapped, Measured, Speed, measure};
pub use peers::{Peer, peers};
pub use routing::{Routed, Routing, median_and_range};
pub use target::{Kind, Target};
pub use tools::Program;
pub use verilog::Verilog;
pub use wrapper::{Port, ports, wrapper};
