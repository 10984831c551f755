//! What sets show to a fit that has not seen them.

pub mod held_frames;
pub mod held_out;
pub mod held_out_row;
pub mod improvement;
pub mod seen;
pub mod untold;
