//! What is periodic in time or in the encoder's reading, and which source it has.

pub mod beats;
pub mod images;
pub mod lamps;
pub mod lines;
pub mod source;
