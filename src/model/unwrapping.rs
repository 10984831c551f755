//! Unwrapping: a pixel's phases at two modulation frequencies to one over the longer range, and the memory of the phases
//! of the set before.

use crate::spec::{Pipeline, SHARE_BITS, Unwrapper, Word};

/// A pixel's phases at both frequencies, combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unwrapped {
    /// The ambiguity number.
    pub ambiguity: i64,
    /// How far the two phases are from agreeing, phase codes; its magnitude is half a turn or less.
    pub residual: i64,
    /// The unwrapped phase, in turns of f0 over [`Unwrapper::codes_a_turn`].
    pub code: i64,
}

/// Combines `first`, the phase at M f0, and `second`, that at N f0.
pub fn unwrap_phases(unwrapper: &Unwrapper, first: i64, second: i64) -> Unwrapped {
    let [m, n] = unwrapper.ratio;
    let bits = unwrapper.phase_bits;
    let difference = n * first - m * second;
    debug_assert!(unwrapper.difference.contains(difference));
    let residual = Word::signed(bits).wrap(difference);
    let ambiguity = (difference - residual) >> bits;
    let whole_turns = unwrapper.whole_turns[(ambiguity + m) as usize];
    let correction = (((unwrapper.share * residual) >> (SHARE_BITS - 1)) + 1) >> 1;
    let code = n * first + (whole_turns << bits) - correction;
    let code = code.rem_euclid(unwrapper.codes_a_turn);
    debug_assert!(unwrapper.unwrapped.contains(code));
    Unwrapped { ambiguity, residual, code }
}

/// What the memory keeps of a pixel of the set before.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Kept {
    phase: i64,
    usable: bool,
}

/// The memory of the set before, and what it takes to combine it with the present one.
#[derive(Debug, Clone)]
pub struct PhaseMemory<'a> {
    unwrapper: &'a Unwrapper,
    kept: Vec<Kept>,
}

impl<'a> PhaseMemory<'a> {
    /// A memory of all pixels of `pipeline`, where it unwraps. Its contents do not matter until a set has passed.
    pub fn of(pipeline: &'a Pipeline) -> Option<Self> {
        let unwrapper = pipeline.derived().unwrapper.as_ref()?;
        Some(Self { unwrapper, kept: vec![Kept::default(); pipeline.geometry().pixels()] })
    }

    /// The unwrapped phase of pixel `address`, whose phase in the present set, of the second frequency where `second`, is
    /// `phase`; `None` where there is none: where the set before is not the `partner` of this one, where either phase is not
    /// `usable`, or the residual is beyond the limit. Keeps the phase for the next set.
    pub fn unwrap_pixel(
        &mut self,
        address: usize,
        phase: i64,
        usable: bool,
        second: bool,
        partner: bool,
    ) -> Option<i64> {
        let before = std::mem::replace(&mut self.kept[address], Kept { phase, usable });
        let (first_phase, second_phase) = if second { (before.phase, phase) } else { (phase, before.phase) };
        let unwrapped = unwrap_phases(self.unwrapper, first_phase, second_phase);
        let trusted = unwrapped.residual.abs() <= self.unwrapper.residual_limit;
        (partner && usable && before.usable && trusted).then_some(unwrapped.code)
    }
}
