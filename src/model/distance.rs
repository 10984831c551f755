//! Distance: the phase times the unambiguous range.

use crate::spec::Pipeline;

/// The distance in the specification's unit, rounded to nearest. It wraps with the phase: 0 to the unambiguous range.
pub fn distance(pipeline: &Pipeline, phase: i64) -> i64 {
    let derived = pipeline.derived();
    let distance = derived.distance_factor.apply(phase, 0);
    debug_assert!(derived.distance.contains(distance), "distance {distance} leaves {}", derived.distance);
    distance
}
