//! The recordings as a fit sees them: which samples, pixels and sets count, and what the encoder says.

pub mod backgrounds;
pub mod data;
pub mod frequencies;
pub mod grid;
pub mod included;
pub mod places;
pub mod signals;
pub mod together;
