//! Precision sweeps: how far the phase of a unit is from the exact angle, over all vectors of a word or a stratified choice of
//! them, for many configurations, and what each costs.
//!
//! ```text
//! Grid ─► Configuration ─► AngleUnit ─┐
//!             │                       ├─► Tally (integers; shards merge exactly) ─► Figures ─► Point ─► Pareto front
//!             └─► Plan (vectors) ─────┤                                                ▲
//!                      ExactAngle ────┘                                     area: fitted or synthesised
//! ```
//! All sums are integers, so a result depends neither on the number of threads or shards nor on their order.

mod area;
mod configuration;
mod evaluate;
mod exact_angle;
mod figures;
mod grid;
mod pareto;
mod phase_of;
mod plan;
mod record;
mod requirement;
mod shard;
mod tally;

pub use area::{Area, AreaModel, AreaSource};
pub use configuration::{Configuration, rounding_name, rounding_named, throughput_name, throughput_named};
pub use evaluate::evaluate;
pub use exact_angle::{BOUND_UNITS, ExactAngle, UNIT_BITS};
pub use figures::{Figures, Row};
pub use grid::Grid;
pub use pareto::{Point, pareto_front};
pub use phase_of::PhaseOf;
pub use plan::{Coverage, Plan};
pub use record::Record;
pub use requirement::{Requirement, SensorNoise};
pub use shard::Shard;
pub use tally::{OctaveTally, Tally, Worst};
