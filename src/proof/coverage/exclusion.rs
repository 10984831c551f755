//! What no run of a bench can move, and why.

use super::{Kind, Point};

/// A signal whose bits from some place on cannot be moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Exclusion {
    /// The signal's name in any module, before `_q`, `_o`, `_d`, `_i` or nothing.
    pub signal: &'static str,
    /// The lowest bit that is excluded.
    pub from_bit: usize,
    /// Why.
    pub reason: &'static str,
}

const LONG: &str =
    "a counter of 32 bits: a simulation ends long before (`vuris mutate` starts it shortly before its wrap)";

/// All of them. A row that excludes nothing any more fails the measurement.
pub const EXCLUSIONS: &[Exclusion] = &[
    Exclusion { signal: "sets_done", from_bit: 4, reason: LONG },
    Exclusion { signal: "sets_discarded", from_bit: 4, reason: LONG },
    Exclusion { signal: "stall_clocks", from_bit: 8, reason: LONG },
    Exclusion { signal: "saturated_pixels", from_bit: 5, reason: LONG },
    Exclusion { signal: "set_number", from_bit: 4, reason: LONG },
    Exclusion {
        signal: "unused_bits",
        from_bit: 0,
        reason: "takes the bits that nobody reads, so that lint finds them used: an and with 0",
    },
];

impl Exclusion {
    /// Whether it excludes `point`.
    pub fn covers(&self, point: &Point) -> bool {
        let name = point.signal();
        let stem =
            ["_q", "_o", "_d", "_i"].iter().find_map(|ending| name.strip_suffix(ending)).unwrap_or(name);
        point.kind == Kind::Toggle && stem == self.signal && point.bit() >= self.from_bit
    }
}

/// Why `point` is excluded.
pub(super) fn reason(point: &Point) -> Option<&'static str> {
    EXCLUSIONS.iter().find(|row| row.covers(point)).map(|row| row.reason)
}
