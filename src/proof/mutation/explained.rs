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
pub const EXPLAINED: &[Explanation] = &[];

/// The explanation of a trial's survival.
pub(super) fn explanation(trial: &Trial) -> Option<&'static Explanation> {
    EXPLAINED.iter().find(|row| row.noun == trial.mutant.noun && trial.source.starts_with(row.source))
}
