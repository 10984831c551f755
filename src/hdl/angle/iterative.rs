//! Template context of the iterative angle unit.

use super::AngleSource;
use super::folded::{growth, loads};
use crate::hdl::text::{counter_bits, literal, range, slice, zero_extended};
use crate::spec::Rounding;
use askama::Template;

#[derive(Template)]
#[template(path = "angle_iterative.v", escape = "none")]
struct Angle<'a> {
    banner: String,
    prefix: &'a str,
    metric: i64,
    clocks: u32,
    iterations: u32,
    x_iterations: u32,
    done_count: u32,
    normalise: bool,
    nearest: bool,
    quarters: bool,
    with_length: bool,
    x_bits: u32,
    y_bits: u32,
    bits: u32,
    turn_x_bits: u32,
    turn_y_bits: u32,
    fraction_bits: u32,
    angle_bits: u32,
    phase_bits: u32,
    length_bits: u32,
    shift_bits: u32,
    meta_bits: u32,
    sector_bits: u32,
    sector_range: String,
    guard_bits: u32,
    most_shifts: String,
    one_shift: String,
    count_range: String,
    done_literal: String,
    zero_count: String,
    one_count: String,
    x_count: String,
    x_count_high: u32,
    x_raw: String,
    y_raw: String,
    x_shifted: String,
    y_shifted: String,
    part_range: String,
    part: String,
    doubled_range: String,
    grown: String,
    unused_shifted: String,
    x_load: String,
    y_load: String,
    unused_load: String,
    x_wide: String,
    row_range: String,
    row_high: u32,
    rows: Vec<String>,
    row_wide: String,
    first_row: String,
    fold_row: String,
}

pub(super) fn angle(source: &AngleSource, banner: String) -> askama::Result<String> {
    let unit = source.unit;
    let (bits, iterations) = (unit.magnitude_bits, unit.iterations);
    let (turn_x_bits, turn_y_bits) = (unit.stages.x[0].bits, unit.stages.y[0].bits);
    let count_bits = counter_bits(iterations as usize + 1);
    let raw = |name: &str, parameter: &str, own: u32| match bits + 1 - own {
        0 => format!("{name}_i[{parameter}-2:0]"),
        more => format!("{{{{{more}{{{name}_i[{parameter}-1]}}}}, {name}_i[{parameter}-2:0]}}"),
    };
    let shifted = |name: &str| {
        if bits == 1 {
            format!("wait_{name}_negative_q")
        } else {
            format!("{{wait_{name}_q[BITS-2:0], wait_{name}_negative_q}}")
        }
    };
    let (part, part_bits) = growth(unit, "magnitude");
    let doubled_bits = part_bits + 2;
    let nearest = unit.cordic.rounding == Rounding::Nearest;
    let top = doubled_bits - 1;
    let (grown, mut unused_shifted) = if top >= turn_x_bits {
        let unused =
            if top > turn_x_bits { format!("shifted[{top}:{}]", turn_x_bits + 1) } else { String::new() };
        (format!("shifted[{turn_x_bits}:1]"), unused)
    } else {
        (format!("{{{}'d0, shifted[{top}:1]}}", turn_x_bits - top), String::new())
    };
    if !nearest {
        unused_shifted =
            if unused_shifted.is_empty() { "shifted[0]".to_owned() } else { unused_shifted + ", shifted[0]" };
    }
    let [x_load, y_load, unused_load] =
        loads(unit, "wait_x_q", "wait_y_q", "wait_x_negative_q", "wait_y_negative_q");
    // The first group is the constant; the others are one iteration each. The last one's number may wrap to 0, where the
    // row is not looked at.
    let (head, singles) = (&unit.groups[0], &unit.groups[1..]);
    let row_bits = singles.iter().map(|group| group.bits).max().unwrap_or(1);
    let row_count_bits = counter_bits(iterations as usize - 1);
    let modulus = 1_i64 << row_count_bits;
    let mut rows: Vec<String> = singles
        .iter()
        .map(|group| {
            format!(
                "{}: row = {};",
                literal(row_count_bits, i64::from(group.first) % modulus),
                literal(row_bits, group.rows[0])
            )
        })
        .collect();
    rows.push(format!("default: row = {};", literal(row_bits, 0)));
    let constant = |row: usize| head.rows.get(row).map(|&value| literal(unit.angle_bits, value));
    Angle {
        banner,
        prefix: source.prefix,
        metric: unit.metric,
        clocks: unit.clocks_a_vector(0),
        iterations,
        x_iterations: unit.stages.x_iterations,
        done_count: iterations + 1,
        normalise: unit.cordic.normalise,
        nearest,
        quarters: unit.sector_bits == 2,
        with_length: unit.with_length(),
        x_bits: unit.x_bits,
        y_bits: unit.y_bits,
        bits,
        turn_x_bits,
        turn_y_bits,
        fraction_bits: unit.fraction_bits,
        angle_bits: unit.angle_bits,
        phase_bits: unit.phase_bits,
        length_bits: unit.length_word().bits,
        shift_bits: unit.shift_bits(),
        meta_bits: source.meta_bits,
        sector_bits: unit.sector_bits,
        sector_range: range(unit.sector_bits),
        guard_bits: unit.cordic.angle_guard_bits,
        most_shifts: literal(unit.shift_bits(), bits.into()),
        one_shift: literal(unit.shift_bits(), 1),
        count_range: range(count_bits),
        done_literal: literal(count_bits, i64::from(iterations) + 1),
        zero_count: literal(count_bits, 0),
        one_count: literal(count_bits, 1),
        x_count: literal(count_bits, unit.stages.x_iterations.into()),
        x_count_high: counter_bits(unit.stages.x_iterations as usize) - 1,
        x_raw: raw("x", "X_BITS", unit.x_bits),
        y_raw: raw("y", "Y_BITS", unit.y_bits),
        x_shifted: shifted("x"),
        y_shifted: shifted("y"),
        part_range: range(part_bits),
        part,
        doubled_range: range(doubled_bits),
        grown,
        unused_shifted,
        x_load,
        y_load,
        unused_load,
        x_wide: zero_extended("x_q", turn_x_bits, turn_y_bits),
        row_range: range(row_bits),
        row_high: row_count_bits - 1,
        rows,
        row_wide: zero_extended("row", row_bits, unit.angle_bits),
        first_row: constant(0).unwrap_or_default(),
        fold_row: constant(1).unwrap_or_default(),
    }
    .render()
}
