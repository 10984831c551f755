//! Where recordings and a model differ: the coordinates of a residual.

pub mod areas;
pub mod codes;
pub mod coordinates;
pub mod line_ways;
pub mod lines_at_signals;
pub mod location;
pub mod mismatch;
pub mod neighbours;
pub mod parts;
pub mod patches;
pub mod profiles;
pub mod ranges;
pub mod read_anew;
pub mod velocities;
