//! What is left out before anything is looked for: pixels and sets that are unlike the others, and recordings without light.

pub mod covered;
pub mod left_out;
pub mod near_full;
pub mod noisy_pixels;
pub mod settle;
pub mod stuck;
