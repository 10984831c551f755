//! The fit of the full forward model, with the noise of its samples.

pub mod block;
pub mod bounds;
pub mod common_phase;
pub mod coupled;
pub mod encoder_noise;
pub mod finished;
pub mod fit;
pub mod gram;
pub mod in_order;
pub mod inverse;
pub mod noise;
pub mod own_phases;
pub mod panels;
pub mod products;
pub mod projected;
pub mod set_errors;
pub mod settling;
pub mod split;
pub mod start;
pub mod stride;
pub mod watchdog;
pub mod whiten;
