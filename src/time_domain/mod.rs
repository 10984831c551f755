//! A second generator of raw frames, in the time domain: waveforms in time, light paths with delays, charge, wells, codes.
//!
//! It shares no physics with [`physics`](mod@crate::physics), in which a waveform is a table of harmonics: here the laser and the gate are
//! pulses, and a frame is what the gate lets through of the light that arrives. So a diagnosis that fits the one can be
//! examined on campaigns of the other, and agreement of both on clean frames says something about either.

mod campaign;
mod exposure;
pub mod flaws;
mod plan;
mod scene;
mod strength;
mod waveform;
mod world;

pub use campaign::{camera, recordings};
pub use exposure::{Movie, movie};
pub use flaws::{Flaw, Hook, MECHANISMS, Mechanism};
pub use plan::{Programme, Row, Take};
pub use scene::{Pixel, Scene};
pub use strength::Ruler;
pub use waveform::{Pulse, Waveform};
pub use world::{Known, Moment, Ray, Sensor, World};
