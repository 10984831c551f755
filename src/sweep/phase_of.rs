//! What is measured: whatever makes a phase from a vector.

use crate::model::turn;
use crate::spec::AngleUnit;

/// Whatever makes a phase from a vector.
pub trait PhaseOf: Sync {
    /// The phase of (x, √metric · y), 0 to 2^[`PhaseOf::phase_bits`] − 1. Not both are 0.
    fn phase(&self, x: i64, y: i64) -> i64;

    /// Bits of the phase.
    fn phase_bits(&self) -> u32;
}

/// The hardware's model.
impl PhaseOf for AngleUnit {
    #[inline]
    fn phase(&self, x: i64, y: i64) -> i64 {
        turn(self, x, y).phase
    }

    fn phase_bits(&self) -> u32 {
        self.phase_bits
    }
}
