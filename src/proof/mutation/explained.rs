//! Survivors that are no fault of the bench, each with the reason that no run can show it.

use super::Trial;

/// Why mutants at a place survive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Explanation {
    /// The module's noun.
    pub noun: &'static str,
    /// The Verilog of the place, or how it begins.
    pub source: &'static str,
    /// Why no run can show it.
    pub reason: &'static str,
}

/// All of them.
pub const EXPLAINED: &[Explanation] = &[
    Explanation {
        noun: "accumulator",
        source: "drain_busy_q ? drain_read : take_i",
        reason: "a word read without a sample is not used: a sum is formed in the clock after a sample was taken, or written nowhere",
    },
    Explanation {
        noun: "amplitude",
        source: "zero_q ? {AMPLITUDE_BITS{1'b0}} : rounded",
        reason: "a vector of 0 leaves the CORDIC with length 0, so that its amplitude is 0 without the choice",
    },
];

/// The explanation of a trial's survival.
pub(super) fn explanation(trial: &Trial) -> Option<&'static Explanation> {
    EXPLAINED.iter().find(|row| row.noun == trial.mutant.noun && trial.source.starts_with(row.source))
}
