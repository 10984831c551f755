//! The bit-accurate model: what every register of the hardware holds, in integers.
//!
//! One file a hardware module, by the same noun. No floating point, no I/O, nothing that can fail: values stay within
//! the words of [`Derived`](crate::spec::Derived) by the bounds proved there, and debug builds check it.

mod accumulator;
mod amplitude;
mod angle;
mod distance;
mod framing;
mod offset;
mod pipeline;
mod poly;
mod registers;
mod sequencer;
mod stream;
mod unwrapping;

pub use accumulator::{Accumulator, Sums};
pub use amplitude::amplitude;
pub use angle::{Normalised, Rotated, Turned, normalise, rotate, rotate_seen, scaled_start, turn};
pub use distance::distance;
pub use framing::{Framing, FramingEvent, PixelSlot};
pub use offset::offset;
pub use pipeline::{PipelineModel, PixelRecord, pixel};
pub use poly::{poly, poly_arctangent, poly_reciprocal};
pub use registers::{Access, Answer, ReadData, Registers};
pub use sequencer::{NextFrame, next_frame};
pub use stream::{Beat, StreamEvent, beats_of_set};
pub use unwrapping::{PhaseMemory, Unwrapped, unwrap_phases};
