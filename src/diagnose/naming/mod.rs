//! The search for the effects that explain a mismatch.

pub mod alias;
pub mod alone;
pub mod candidates;
pub mod chosen_anew;
pub mod completed;
pub mod contest;
pub mod exchange;
pub mod fittest;
pub mod found;
pub mod needless;
pub mod pass;
pub mod periods;
pub mod power;
pub mod promised;
pub mod resting;
pub mod search;
pub mod sides;
pub mod tolerated;
pub mod tried;
pub mod trust;
