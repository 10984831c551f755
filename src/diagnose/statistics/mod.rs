//! How likely a number, a line or a variance is, whatever it is of.

pub mod amplitudes;
pub mod evidence;
pub mod gaps;
pub mod marginal;
pub mod median;
pub mod periodogram;
pub mod shared_variance;
pub mod simpler;
pub mod tamed;
