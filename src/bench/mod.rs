//! The bench: recordings and the forward simulator together, which know nothing of each other.
//!
//! A [`Course`] is when and where a recording's frames were or will be taken: from it come the simulator's [`Moment`]s. A [`Plan`] says
//! which courses a campaign has, [`simulate`] takes the frames, [`Atlas`] shows what each effect does to perfect ones.
//!
//! [`Moment`]: crate::physics::Moment

mod atlas;
mod camera;
mod course;
mod injection;
mod library;
mod plan;
mod recorded;
mod simulation;
mod word_length;

pub use atlas::{Atlas, Line, Residuals, phasors};
pub use camera::{chain, practice_camera, sensor};
pub use course::{Course, moments};
pub use injection::{camera_effects, included_without, injection, injection_among};
pub use library::library;
pub use plan::Plan;
pub use recorded::{number_of, recorded, taken, taken_by};
pub use simulation::{Simulation, simulate};
pub use word_length::{injection_for, specification_of};
