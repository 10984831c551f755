//! What each number that is fitted changes in every sample, by the forward model itself.

pub mod acting;
pub mod arrived;
pub mod charges;
pub mod columns;
pub mod patterns;
pub mod pieces;
