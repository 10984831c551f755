//! Errors that samples of a set, a frame, a row or a column share at random.

pub mod again;
pub mod clusters;
pub mod described;
pub mod in_time;
pub mod jitters;
pub mod levels;
pub mod random;
pub mod ripples;
pub mod steady;
pub mod swings;
pub mod tones;
pub mod waves;
pub mod white;
