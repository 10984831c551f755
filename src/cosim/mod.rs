//! Building and running the simulators, and comparing stage by stage.

mod accesses;
mod angle;
mod finding;
mod lint;
mod run;
mod scenario;
mod tools;

pub use accesses::register_accesses;
pub use angle::simulate_angle;
pub use finding::Finding;
pub use lint::lint;
pub use run::{Outcome, Simulation, Simulator, Traffic, simulate};
pub use scenario::{aborted_then_good, corner_sets, faulty_stream, random_sets, resets, silences, standard};
pub use tools::{IVERILOG, Tool, VVP, Verilator, YOSYS, find, output};
