//! placeholder
#![allow(missing_docs)]
pub mod artifact;
pub mod cosim;
pub mod fields;
pub mod frames;
pub mod hdl;
pub mod model;
pub mod problem;
pub mod ranging;
pub mod recording;
pub mod reference;
pub mod spec;
pub mod units;
