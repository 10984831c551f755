//! The plain DFT of a recording whose phase steps are equal parts of a turn.

use super::matching::matched;
use crate::spec::{COEFFICIENT_BITS, DFT_FRAMES, Pipeline, Scheme};
use std::f64::consts::TAU;

/// Part of a phase code that rounding a DFT's cosines and sines may cost, where nobody has said with how many bits.
pub(super) const COEFFICIENT_SHARE: f64 = 1.0 / 4.0;

/// The plain DFT whose steps `steps_rad` are, in any order, with as few bits a coefficient as keep their rounding below
/// [`COEFFICIENT_SHARE`] of a phase code of `base` (or all, where none do).
pub(super) fn dft_of(steps_rad: &[f64], base: &Pipeline) -> Option<Scheme> {
    let code_rad = TAU / f64::from(base.output.phase_bits).exp2();
    let all_bits = *COEFFICIENT_BITS.end();
    let steps = DFT_FRAMES.filter(|&steps| steps_rad.len().is_multiple_of(steps)).find(|&steps| {
        Scheme::dft(steps, all_bits).is_some_and(|dft| matched(&dft, &base.modulation, steps_rad).is_some())
    })?;
    let dft = |coefficient_bits| Scheme::dft(steps, coefficient_bits);
    let exact = |scheme: &Scheme| scheme.weight_error_rad <= COEFFICIENT_SHARE * code_rad;
    COEFFICIENT_BITS.filter_map(dft).find(exact).or_else(|| dft(all_bits))
}
