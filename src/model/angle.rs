//! The angle unit: from a vector to its phase, and its length where it is wanted.

use crate::spec::{AngleUnit, Rounding};

/// A folded and shifted vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Normalised {
    /// |x|, complemented bit by bit where x was negative; its top bit or y's is set.
    pub x: i64,
    /// |y|, likewise.
    pub y: i64,
    /// Places by which both were shifted left.
    pub shift: u32,
    /// x was negative.
    pub x_negative: bool,
    /// y was negative.
    pub y_negative: bool,
    /// There is no vector: both coordinates were 0.
    pub zero: bool,
}

/// What the iterations leave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rotated {
    /// x after the last iteration: the length times the gain.
    pub x: i64,
    /// The directions, iteration 0's (the fold's) in the highest of `iterations` + 1 bits; 1 is backwards.
    pub directions: u64,
}

/// A vector's phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Turned {
    /// The phase, a fraction of a turn; 0 where there is no vector.
    pub phase: i64,
    /// The length times the gain, normalised.
    pub length: i64,
    /// Places by which the vector was shifted left.
    pub shift: u32,
    /// There is no vector.
    pub zero: bool,
}

/// The phase of (x, √metric · y).
pub fn turn(unit: &AngleUnit, x: i64, y: i64) -> Turned {
    if let Some(poly) = &unit.poly {
        return super::poly(poly, x, y);
    }
    let normalised = normalise(unit, x, y);
    let rotated = rotate(unit, normalised);
    let phase = phase(unit, normalised, rotated.directions);
    let Normalised { shift, zero, .. } = normalised;
    Turned { phase: if zero { 0 } else { phase }, length: rotated.x, shift, zero }
}

/// Folds the vector into the first quadrant and shifts it left until the larger coordinate's top bit is set.
///
/// A negative coordinate's magnitude is its complement and one. The one is not added: ones follow the complement's last bit
/// when it is shifted, and ones without end are a one before them.
pub fn normalise(unit: &AngleUnit, x: i64, y: i64) -> Normalised {
    let bits = unit.magnitude_bits;
    let (x_sign, y_sign) = (x >> 63, y >> 63);
    let (mut x_magnitude, mut y_magnitude) = (x ^ x_sign, y ^ y_sign);
    let mut shift = 0;
    for &places in &unit.shifts {
        if (x_magnitude | y_magnitude) >> (bits - places.min(bits)) == 0 {
            x_magnitude = filled(x_magnitude, x_sign, places) & ((1 << bits) - 1);
            y_magnitude = filled(y_magnitude, y_sign, places) & ((1 << bits) - 1);
            shift += places;
        }
    }
    let zero = if unit.shifts.is_empty() {
        x == 0 && y == 0
    } else {
        (x_magnitude | y_magnitude) >> (bits - 1) == 0
    };
    Normalised { x: x_magnitude, y: y_magnitude, shift, x_negative: x < 0, y_negative: y < 0, zero }
}

/// `value` shifted left, the bits of `sign` (0 or −1) following.
const fn filled(value: i64, sign: i64, places: u32) -> i64 {
    (value << places) | (sign & ((1 << places) - 1))
}

/// `value` / 2^`places`, rounded as the specification says.
fn shifted(value: i64, places: u32, rounding: Rounding) -> i64 {
    match rounding {
        _ if places == 0 => value,
        Rounding::Nearest => ((value >> (places - 1)) + 1) >> 1,
        Rounding::Truncate => value >> places,
    }
}

/// CORDIC in vectoring mode (Volder 1959): turns the vector onto the x axis and notes the directions.
///
/// y stands for its integer and a half (see [`crate::spec::Stages`]), so its magnitude is an exclusive or with its sign, and a
/// direction is the sign's exclusive or with all before it. With metric 3 the coordinates are x and √3 y and the tangents
/// √3 · 2^−i, so that x gets 3 · 2^−i y and y 2^−i x: the five-frame algorithm's √3 costs no multiplier.
pub fn rotate(unit: &AngleUnit, vector: Normalised) -> Rotated {
    rotate_seen(unit, vector, |i, x, y| check(unit, i, x, y))
}

/// The same, showing `see` every iteration's number, and x and y after it.
pub fn rotate_seen(unit: &AngleUnit, vector: Normalised, see: impl FnMut(u32, i64, i64)) -> Rotated {
    if unit.stages.scaled { rotate_scaled(unit, vector, see) } else { rotate_narrowing(unit, vector, see) }
}

/// Every iteration's y a bit narrower than the last one's: the unrolled hardware.
fn rotate_narrowing(unit: &AngleUnit, vector: Normalised, mut see: impl FnMut(u32, i64, i64)) -> Rotated {
    let Normalised { x: vx, y: vy, x_negative, y_negative, .. } = vector;
    let (x_one, y_one) = (i64::from(x_negative), i64::from(y_negative));
    let (pad, drop) = (unit.pad_bits(), unit.drop_bits());
    // Iteration 0.
    let ones = |one: i64| if one == 1 { (1_i64 << pad) - 1 } else { 0 };
    let (mut x, mut y) = if unit.metric == 1 {
        let (vx, vy) = (vx >> drop, vy >> drop);
        (((vx + vy + x_one) << pad) | ones(y_one), ((vy - vx - 1 + y_one) << pad) | ones(1 - x_one))
    } else {
        let (wide_x, wide_y) = (filled(vx >> drop, -x_one, pad), filled(vy >> drop, -y_one, pad));
        let difference = (vy >> drop) - (vx >> drop) - 1 + y_one;
        (wide_x + 3 * wide_y + 2 * y_one + x_one, (difference << pad) | ones(1 - x_one))
    };
    see(0, x, y);
    let mut direction = u64::from(x_negative != y_negative);
    let mut directions = direction;
    for i in 1..=unit.iterations {
        let sign = y >> 63;
        direction ^= sign as u64 & 1;
        directions = directions << 1 | direction;
        if i == unit.iterations {
            break;
        }
        let magnitude = y ^ sign;
        let (before, after) = (unit.stages.x[i as usize - 1], unit.stages.x[i as usize]);
        let y_fraction = unit.stages.y[i as usize].fraction_bits;
        y = magnitude - shifted(x, i + before.fraction_bits - y_fraction, unit.cordic.rounding);
        if i <= unit.stages.x_iterations {
            let part =
                shifted(unit.metric * magnitude, i + y_fraction - after.fraction_bits, unit.cordic.rounding);
            x = (x >> (before.fraction_bits - after.fraction_bits)) + part;
        }
        see(i, x, y);
    }
    Rotated { x, directions }
}

/// y doubled at every iteration: the folded and the iterative hardware. Nothing is cut off y.
fn rotate_scaled(unit: &AngleUnit, vector: Normalised, mut see: impl FnMut(u32, i64, i64)) -> Rotated {
    let (mut x, mut y) = scaled_start(unit, vector);
    let mut direction = u64::from(vector.x_negative != vector.y_negative);
    let mut directions = direction;
    let mut sign = 0;
    for i in 0..unit.iterations {
        let magnitude = y ^ sign;
        let low = magnitude & 1;
        let part = if unit.metric == 1 { magnitude } else { 3 * magnitude + 2 * low };
        let next = 2 * magnitude + low - x;
        if i <= unit.stages.x_iterations {
            x += if i == 0 { 2 * part } else { shifted(part, 2 * i - 1, unit.cordic.rounding) };
        }
        y = next;
        see(i, x, y);
        sign = y >> 63;
        direction ^= sign as u64 & 1;
        directions = directions << 1 | direction;
    }
    Rotated { x, directions }
}

/// x and half of y as they are loaded.
pub fn scaled_start(unit: &AngleUnit, vector: Normalised) -> (i64, i64) {
    let aligned = |value: i64, negative: bool, fraction_bits: u32| {
        let wanted = fraction_bits + 1;
        if wanted >= unit.magnitude_bits {
            filled(value, -i64::from(negative), wanted - unit.magnitude_bits)
        } else {
            value >> (unit.magnitude_bits - wanted)
        }
    };
    let fraction_bits = unit.fraction_bits;
    (
        aligned(vector.x, vector.x_negative, fraction_bits),
        aligned(vector.y, vector.y_negative, fraction_bits - 1),
    )
}

fn check(unit: &AngleUnit, i: u32, x: i64, y: i64) {
    let (x_word, y_word) = (unit.stages.x[i as usize], unit.stages.y[i as usize]);
    debug_assert!(x >> x_word.bits == 0, "iteration {i}: x = {x} leaves {x_word:?}");
    debug_assert!((y ^ y >> 63) >> (y_word.bits - 1) == 0, "iteration {i}: y = {y} leaves {y_word:?}");
}

/// The phase word: the sector's angle, and the sum of all groups' rows; the guard bits are cut off (half a code is in the sum).
fn phase(unit: &AngleUnit, vector: Normalised, directions: u64) -> i64 {
    let mut angle = unit.groups.iter().fold(0, |sum, group| {
        let below = unit.iterations + 1 - group.first - group.count;
        sum + group.rows[(directions >> below) as usize & ((1 << group.count) - 1)]
    });
    angle += sector(unit, vector) << (unit.angle_bits - unit.sector_bits);
    (angle & ((1 << unit.angle_bits) - 1)) >> unit.cordic.angle_guard_bits
}

/// The sector from which the angle is counted: the quarter that holds the vector, or the half turn of the x axis.
fn sector(unit: &AngleUnit, vector: Normalised) -> i64 {
    let (x, y) = (i64::from(vector.x_negative), i64::from(vector.y_negative));
    if unit.sector_bits == 2 { 2 * y + (x ^ y) } else { x }
}
