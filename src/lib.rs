//! placeholder
#![allow(missing_docs)]
pub mod fields;
pub mod frames;
pub mod problem;
pub mod ranging;
pub mod recording;
pub mod reference;
pub mod spec;
pub mod units;
