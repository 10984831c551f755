//! The answer: its rows, what these recordings cannot show, and which would.

pub mod answer;
pub mod camera;
pub mod common_part;
pub mod effect_row;
pub mod next;
pub mod power_at_random;
pub mod proposals;
pub mod ruled_out;
pub mod verdict;
