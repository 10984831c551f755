//! The search for rows of small integers whose polynomial has the roots that are asked for.

mod candidates;
mod request;
mod rows;

pub use request::{DESIGN_FRAMES, Request, usual_steps};
pub use rows::{Design, design};
