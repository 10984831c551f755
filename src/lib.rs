//! placeholder
#![allow(missing_docs)]
pub mod fields;
pub mod frames;
pub mod physics;
pub mod problem;
pub mod report;
pub mod spec;
pub mod units;
