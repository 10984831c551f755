//! Scaling: both sums brought to one scale, √3 (where the scheme has it) as a ratio of two integers.

use super::accumulator::Sums;
use crate::spec::Pipeline;

/// The vector whose angle is the phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Vector {
    /// In-phase sum × in-phase factor.
    pub x: i64,
    /// Quadrature sum × quadrature factor.
    pub y: i64,
}

/// The vector of a pixel's sums: exact products, nothing is rounded.
pub fn scale(pipeline: &Pipeline, sums: Sums) -> Vector {
    let derived = pipeline.derived();
    let vector =
        Vector { x: sums.in_phase * derived.in_phase_factor, y: sums.quadrature * derived.quadrature_factor };
    debug_assert!(derived.x.contains(vector.x) && derived.y.contains(vector.y));
    vector
}
