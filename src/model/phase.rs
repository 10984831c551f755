//! Phase: the octant's angle rounded to the phase word, and the octant fold undone.

use super::normaliser::Octant;
use crate::spec::Pipeline;

/// The phase as a fraction of a turn; 0 where there is no vector (`zero`).
pub fn phase(pipeline: &Pipeline, angle: i64, octant: Octant, zero: bool) -> i64 {
    let guard_bits = pipeline.cordic.angle_guard_bits;
    let rounded = ((angle >> (guard_bits - 1)) + 1) >> 1;
    let Octant { x_negative, y_negative, swapped } = octant;
    let backwards = swapped ^ x_negative ^ y_negative;
    // Quarter turns from which the angle is counted.
    let quarters = i64::from(swapped) + 2 * i64::from(if swapped { y_negative } else { x_negative });
    let base = quarters << (pipeline.output.phase_bits - 2);
    if zero { 0 } else { pipeline.derived().phase.wrap(base + if backwards { -rounded } else { rounded }) }
}
