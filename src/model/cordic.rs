//! CORDIC in vectoring mode (Volder 1959): turns the vector onto the x axis and adds up the angle.
//!
//! After the octant fold the angle is at most 45°, so iteration 0 is not needed. Shifted operands are rounded to nearest:
//! in hardware the bit below the cut is the adder's carry-in, which costs nothing and leaves no bias.

use super::normaliser::Normalised;
use crate::spec::Pipeline;

/// What the iterations leave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rotated {
    /// The vector's length times the CORDIC's gain, in units of 2^−fraction.
    pub x: i64,
    /// The angle within the octant, in the angle's unit; rounding can take it slightly below 0.
    pub angle: i64,
}

/// `value` / 2^`places`, rounded to nearest, halves up.
const fn shifted(value: i64, places: u32) -> i64 {
    ((value >> (places - 1)) + 1) >> 1
}

/// Runs all iterations.
pub fn cordic(pipeline: &Pipeline, vector: Normalised) -> Rotated {
    let derived = pipeline.derived();
    let (mut x, mut y, mut angle) = (vector.major, vector.minor, 0);
    for (places, &step) in (1..).zip(&derived.angle_table) {
        let (dx, dy) = (shifted(y, places), shifted(x, places));
        (x, y, angle) = if y < 0 { (x - dx, y + dy, angle - step) } else { (x + dx, y - dy, angle + step) };
        debug_assert!(derived.cordic_x.contains(x), "x = {x} leaves {}", derived.cordic_x);
        debug_assert!(derived.cordic_y.contains(y), "y = {y} leaves {}", derived.cordic_y);
        debug_assert!(derived.angle.contains(angle), "angle = {angle} leaves {}", derived.angle);
    }
    Rotated { x, angle }
}
