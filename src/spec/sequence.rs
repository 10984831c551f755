//! The order in which the phase steps of a set are taken, and each step's phase in the word that the modulation hardware gets.

use super::{Modulation, Scheme, Specification, refused};
use crate::problem::Result;

/// Bits that a phase step's phase may have.
pub(super) const PHASE_STEP_BITS: std::ops::RangeInclusive<u32> = 2..=24;

/// Bits of a phase step's phase where the specification does not say: a third of a turn is then off by 2^-17.6 turn.
pub(super) const DEFAULT_PHASE_STEP_BITS: u32 = 16;

impl Modulation {
    /// The phase steps of a set in the order in which they are taken: place p of a set has the scheme's step `steps_in_order()[p]`.
    pub fn steps_in_order(&self) -> Vec<usize> {
        self.order.clone().unwrap_or_else(|| (0..self.scheme.steps()).collect())
    }

    /// The scheme's step at `place` of a set, counted in steps from 0.
    pub fn step_at(&self, place: usize) -> usize {
        match &self.order {
            Some(order) => order[place],
            None => place,
        }
    }

    /// The phase of the scheme's step number `step`, in 2^−`phase_step_bits` of a turn, rounded to nearest (halves up), whole
    /// turns left out.
    pub fn step_phase_code(&self, step: usize) -> i64 {
        let angle = self.scheme.angles[step];
        let (turns, denominator) = (angle.numerator(), angle.denominator());
        let code =
            ((turns.rem_euclid(denominator) << (self.phase_step_bits + 1)) + denominator) / (2 * denominator);
        code & ((1 << self.phase_step_bits) - 1)
    }
}

/// `order` as a specification of `scheme` keeps it: `None` where it is the ascending order of all its steps.
pub fn normalised_order(scheme: &Scheme, order: Vec<usize>) -> Option<Vec<usize>> {
    let ascending = order.iter().copied().eq(0..scheme.steps());
    (!ascending).then_some(order)
}

/// Refuses an order that leaves out a step of the scheme or has one twice, and a phase word that is too short or too long.
pub(super) fn check(source: &str, specification: &Specification) -> Result<()> {
    let modulation = &specification.modulation;
    let steps = modulation.scheme.steps();
    if let Some(order) = &modulation.order {
        let mut sorted = order.clone();
        sorted.sort_unstable();
        if !sorted.iter().copied().eq(0..steps) {
            return Err(refused(source, "modulation.order", format_args!("{order:?}"))
                .expected(format_args!(
                    "every step of {} once: the numbers 0 to {}",
                    modulation.scheme.name,
                    steps - 1
                ))
                .remedy("leave the line out for the ascending order"));
        }
    }
    if !PHASE_STEP_BITS.contains(&modulation.phase_step_bits) {
        return Err(refused(source, "modulation.phase_step_bits", modulation.phase_step_bits)
            .expected(format_args!("{} to {} bits", PHASE_STEP_BITS.start(), PHASE_STEP_BITS.end())));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::Pipeline;

    fn modulation(preset: &str, bits: u32) -> Modulation {
        let preset = Pipeline::named(preset).unwrap();
        Modulation { phase_step_bits: bits, ..preset.modulation.clone() }
    }

    /// By hand: 2^16 / 3 = 21845.33 and 2^17 / 3 = 43690.67; a fourth step is a whole turn, which is none.
    #[test]
    fn phases_are_rounded_fractions_of_a_turn() {
        let codes = |modulation: &Modulation| -> Vec<i64> {
            (0..modulation.scheme.steps()).map(|step| modulation.step_phase_code(step)).collect()
        };
        assert_eq!(codes(&modulation("vuris", 16)), [0, 21845, 43691, 0, 21845]);
        assert_eq!(codes(&modulation("vuris", 2)), [0, 1, 3, 0, 1]);
        assert_eq!(codes(&modulation("vuris-four-frame", 16)), [0, 1 << 14, 2 << 14, 3 << 14]);
        assert_eq!(codes(&modulation("vuris-four-frame", 2)), [0, 1, 2, 3]);
    }

    #[test]
    fn an_order_is_kept_only_where_it_is_not_ascending() {
        let wdft = modulation("vuris", 16).scheme;
        assert_eq!(normalised_order(&wdft, vec![0, 1, 2, 3, 4]), None);
        for order in [vec![0, 2, 1, 3, 4], vec![0, 1, 2], vec![0, 1, 2, 3, 4, 5], vec![]] {
            assert_eq!(normalised_order(&wdft, order.clone()), Some(order));
        }
        let permuted = Modulation { order: Some(vec![0, 3, 1, 4, 2]), ..modulation("vuris", 16) };
        assert_eq!((0..5).map(|place| permuted.step_at(place)).collect::<Vec<_>>(), [0, 3, 1, 4, 2]);
        assert_eq!(modulation("vuris", 16).steps_in_order(), [0, 1, 2, 3, 4]);
    }
}
