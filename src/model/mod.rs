//! The bit-accurate model: what every register of the hardware holds, in integers.
//!
//! One file a hardware module, by the same noun. No floating point, no I/O, nothing that can fail: values stay within
//! the words of [`Derived`](crate::spec::Derived) by the bounds proved there, and debug builds check it.

mod accumulator;
mod amplitude;
mod cordic;
mod distance;
mod framing;
mod normaliser;
mod offset;
mod phase;
mod pipeline;
mod poly;
mod scaling;
mod stream;

pub use accumulator::{Accumulator, Sums};
pub use amplitude::amplitude;
pub use cordic::{Rotated, cordic};
pub use distance::distance;
pub use framing::{Framing, FramingEvent, PixelSlot};
pub use normaliser::{Normalised, Octant, normalise};
pub use offset::offset;
pub use phase::phase;
pub use pipeline::{PipelineModel, PixelRecord, pixel};
pub use poly::{Angle, poly, poly_arctangent, poly_reciprocal};
pub use scaling::{Vector, scale};
pub use stream::{Beat, StreamEvent, beats_of_set};
