//! Pictures, arrays and flat dumps of other instruments' phase-stepped frames, as recordings.
//!
//! Frames are read into a [`Stack`], in natural order of the files' names ([`natural_order`], so that `f2` comes before
//! `f10`), by [`read_pictures`] or [`read_raw`]. [`recordings`] cuts the stack into sets of N frames, and those into one
//! recording or several, with what [`Taking`] says of them. What a picture cannot tell is never made up: it is said by
//! the user, or stays out of the recording.

mod bitmap;
mod codes;
mod cut;
mod order;
mod pictures;
mod raw;
mod stack;
mod tagged;

pub use codes::Levels;
pub use cut::{Taking, recordings};
pub use order::{each_file_once, natural_order};
pub use pictures::{Channel, read_pictures};
pub use raw::{ByteOrder, Number, RawLayout, read_raw};
pub use stack::{Source, Stack};
