//! Sums of angles, by the directions of a few iterations at a time: a table of 16 rows in place of four adders.

use crate::spec::exact::{Real, integer, power_of_two, rounded};

/// The angles of some iterations.
#[derive(Debug, Clone, PartialEq)]
pub struct AngleGroup {
    /// The first of the directions that choose a row: 0 is the direction of the fold, i that of iteration i.
    pub first: u32,
    /// Directions that choose a row; 0 for a constant.
    pub count: u32,
    /// The row for every combination of directions, in 2^−`angle_bits` turns. The first direction is the highest bit of
    /// the row's number; 1 is backwards.
    pub rows: Vec<i64>,
    /// Least and largest error of a row in the same unit.
    pub errors: (f64, f64),
    /// Bits of the largest row.
    pub bits: u32,
}

/// The groups, the most significant first.
///
/// With d_i = ±1 the directions, a_i the angles and a_0 that of iteration 0 (an eighth of a turn, or a sixth), the angle within
/// the sector is Σ d_i a_i. All groups but the first add 2 a_i or nothing, so that they are never negative; the first makes up
/// for it. It also holds half a phase code, so that cutting the sum off rounds it, and the mean error of all other rows.
pub(super) fn groups(
    metric: i64,
    iterations: u32,
    x_iterations: u32,
    together: u32,
    angle_bits: u32,
    guard_bits: u32,
) -> Vec<AngleGroup> {
    let angles: Vec<Real> = (0..=iterations).map(|i| angle(metric, i, x_iterations, angle_bits)).collect();
    // With metric 1 the fold's angle is half a sector: the sector's number holds its direction.
    let folded = u32::from(metric == 1);
    let head = if together == 1 { 1 - folded } else { 4 };
    let mut groups = vec![(folded, head)];
    let mut first = folded + head;
    while first <= iterations {
        let count = together.min(iterations + 1 - first);
        groups.push((first, count));
        first += count;
    }
    let mut tail: Vec<AngleGroup> =
        groups.iter().skip(1).map(|&(first, count)| group(&angles, first, count, None, angle_bits)).collect();
    let mean: f64 = tail.iter().map(|group| (group.errors.0 + group.errors.1) / 2.0).sum();
    let rest = angles.iter().skip((folded + head) as usize).fold(integer(0), |sum, angle| sum + angle);
    // Cutting guard bits off is blind to what lies between two of their values: half a value less than half a code.
    let half = power_of_two(i64::from(guard_bits) - 1) - power_of_two(-1);
    let eighth = if folded == 1 { power_of_two(i64::from(angle_bits) - 3) } else { integer(0) };
    let constant = eighth - rest + half - Real::try_from(mean).unwrap_or_else(|_| integer(0));
    let mut all = vec![group(&angles, folded, head, Some(constant), angle_bits)];
    // The mean error was taken out of the first group on purpose.
    all[0].errors = (all[0].errors.0 - mean, all[0].errors.1 - mean);
    all.append(&mut tail);
    all
}

fn group(angles: &[Real], first: u32, count: u32, constant: Option<Real>, angle_bits: u32) -> AngleGroup {
    let mut errors = (f64::INFINITY, f64::NEG_INFINITY);
    let turn = 1_i64 << angle_bits;
    let rows: Vec<i64> = (0..1_usize << count)
        .map(|row| {
            let exact = (0..count).fold(constant.clone().unwrap_or_else(|| integer(0)), |sum, place| {
                let backwards = row >> (count - 1 - place) & 1 == 1;
                let angle = &angles[(first + place) as usize];
                match (constant.is_some(), backwards) {
                    (true, true) => sum - angle,
                    (true, false) => sum + angle,
                    (false, true) => sum,
                    (false, false) => sum + angle * integer(2),
                }
            });
            let value = rounded(&exact);
            let error = (integer(value) - exact).to_f64().value();
            errors = (errors.0.min(error), errors.1.max(error));
            value.rem_euclid(turn)
        })
        .collect();
    let bits = if constant.is_some() {
        angle_bits
    } else {
        rows.iter().map(|&row| crate::spec::Word::holding(0, row).bits).max().unwrap_or(1)
    };
    AngleGroup { first, count, rows, errors, bits }
}

/// The angle of iteration `i` in 2^−`bits` turns: atan(√metric · 2^−i) where x follows, after it a straight line's share.
fn angle(metric: i64, i: u32, x_iterations: u32, bits: u32) -> Real {
    let turn = Real::pi(super::super::exact::PRECISION_BITS) * integer(2);
    let tangent = integer(metric).sqrt() * power_of_two(-i64::from(i));
    let radians = if i <= x_iterations {
        tangent.atan()
    } else {
        // The line that is nearest to atan t on |t| <= T has the slope 1 - T^2/4 (Chebyshev, for atan t = t - t^3/3).
        let largest_squared = integer(metric) * power_of_two(-2 * i64::from(x_iterations));
        tangent * (integer(1) - largest_squared / integer(4))
    };
    radians / turn * power_of_two(bits.into())
}
