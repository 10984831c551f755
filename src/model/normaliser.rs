//! Normaliser: the vector folded into the first octant and shifted left until its larger coordinate's top bit is set,
//! so that a weak pixel's phase is as exact as its bits allow.

use super::scaling::Vector;
use crate::spec::Pipeline;

/// How a vector was folded into the octant 0 ≤ y ≤ x.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Octant {
    /// x was negative.
    pub x_negative: bool,
    /// y was negative.
    pub y_negative: bool,
    /// |y| was larger than |x|, and they were swapped.
    pub swapped: bool,
}

/// A folded and shifted vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Normalised {
    /// The larger coordinate, in units of 2^−fraction: 1.0 to 2.0, or 0 where there is no vector.
    pub major: i64,
    /// The smaller coordinate, same unit, 0 to `major`.
    pub minor: i64,
    /// Places by which both were shifted left.
    pub shift: u32,
    /// The fold.
    pub octant: Octant,
    /// There is no vector: both coordinates are 0.
    pub zero: bool,
}

/// Folds and shifts `vector`.
pub fn normalise(pipeline: &Pipeline, vector: Vector) -> Normalised {
    let normaliser = &pipeline.derived().normaliser;
    let (x, y) = (vector.x.abs(), vector.y.abs());
    let octant = Octant { x_negative: vector.x < 0, y_negative: vector.y < 0, swapped: y > x };
    let (mut major, mut minor) = if octant.swapped { (y, x) } else { (x, y) };
    let zero = major == 0;
    let mut shift = 0;
    for &places in &normaliser.shifts {
        if major >> (normaliser.magnitude_bits - places) == 0 {
            major <<= places;
            minor <<= places;
            shift += places;
        }
    }
    let fit = |value: i64| {
        if normaliser.drop_bits > 0 {
            ((value >> (normaliser.drop_bits - 1)) + 1) >> 1
        } else {
            value << normaliser.pad_bits
        }
    };
    Normalised { major: fit(major), minor: fit(minor), shift, octant, zero }
}
