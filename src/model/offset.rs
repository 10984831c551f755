//! Offset: the weighted mean of the frames.

use crate::spec::Pipeline;

/// The offset in 2^−fraction DN, rounded to nearest.
pub fn offset(pipeline: &Pipeline, sum: i64) -> i64 {
    let derived = pipeline.derived();
    let offset = derived.offset_factor.apply(sum, 0);
    debug_assert!(derived.offset.contains(offset), "offset {offset} leaves {}", derived.offset);
    offset
}
