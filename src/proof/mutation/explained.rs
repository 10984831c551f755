//! Survivors that are no fault of the bench, each with the reason that no run can show it.

use super::{Mutant, Trial};

/// Why mutants at a place survive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Explanation {
    /// The module's noun.
    pub noun: &'static str,
    /// The Verilog of the place, or how it begins.
    pub source: &'static str,
    /// The fault: port, bit and mode, or nothing for any.
    pub fault: &'static str,
    /// Why no run can show it.
    pub reason: &'static str,
}

/// All of them.
pub const EXPLAINED: &[Explanation] = &[
    Explanation {
        noun: "accumulator",
        source: "drain_busy_q ? drain_read : take_i",
        fault: "",
        reason: "a word read without a sample is not used: a sum is formed in the clock after a sample was taken, or written nowhere",
    },
    Explanation {
        noun: "amplitude",
        source: "zero_q ? {AMPLITUDE_BITS{1'b0}} : rounded",
        fault: "",
        reason: "a vector of 0 leaves the CORDIC with length 0, so that its amplitude is 0 without the choice",
    },
    Explanation {
        noun: "framing",
        source: "in_set && drain_busy_i",
        fault: "A[0] const1",
        reason: "a beat outside of a set then waits while sums drain, and is thrown away later: no result and no count depends on \
                 when. The proof `framing` sees it: what is outside a set waits for no drain",
    },
];

/// The explanation of a trial's survival.
pub(super) fn explanation(trial: &Trial) -> Option<&'static Explanation> {
    let Mutant { noun, port, bit, mode, .. } = &trial.mutant;
    let fault = format!("{port}[{bit}] {mode}");
    let fits = |row: &&Explanation| {
        row.noun == noun && trial.source.starts_with(row.source) && ["", fault.as_str()].contains(&row.fault)
    };
    EXPLAINED.iter().find(fits)
}
