//! From what a search found to what is asserted.

pub mod conclusion;
pub mod gains;
pub mod hops;
pub mod included_forms;
pub mod judge;
pub mod misnamed;
pub mod refused;
pub mod searched;
pub mod steps;
pub mod vote;
