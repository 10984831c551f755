//! Template context of the normaliser.

use super::AngleSource;
use crate::hdl::text::{literal, range, slice};
use askama::Template;

struct Level {
    number: usize,
    before: usize,
    places: u32,
    /// Its emptiness was found on the first clock.
    first: bool,
    /// Nothing of the coordinate is left.
    whole: bool,
    top_low: u32,
    kept_high: u32,
    shift_bit: String,
    registered: bool,
}

#[derive(Template)]
#[template(path = "normaliser.v", escape = "none")]
struct Normaliser<'a> {
    banner: String,
    prefix: &'a str,
    levels: Vec<Level>,
    last: usize,
    clocks: u32,
    x_bits: u32,
    y_bits: u32,
    bits: u32,
    shift_bits: u32,
    meta_bits: u32,
    x_raw: String,
    y_raw: String,
    first_flag: &'static str,
    first_flag_value: &'static str,
    /// The bits that the first shift looks at.
    first_top: u32,
    first_bits: u32,
    first_range: String,
}

pub(super) fn normaliser(source: &AngleSource, banner: String) -> askama::Result<String> {
    let unit = source.unit;
    let bits = unit.magnitude_bits;
    let every = unit.cordic.pipeline_every as usize;
    let last = unit.shifts.len();
    let shift_bits = unit.shift_bits();
    let levels: Vec<Level> = (1..)
        .zip(&unit.shifts)
        .map(|(number, &places)| Level {
            number,
            before: number - 1,
            places,
            first: number == 1,
            whole: places >= bits,
            top_low: bits.saturating_sub(places),
            kept_high: bits.saturating_sub(places + 1),
            shift_bit: match shift_bits - number as u32 {
                0 => format!(
                    "{}empty_{number}",
                    if shift_bits > 1 { format!("{}'d0, ", shift_bits - 1) } else { String::new() }
                ),
                low if low + 1 == shift_bits => format!("empty_{number}, {}", literal(low, 0)),
                low => format!("{}, empty_{number}, {}", literal(shift_bits - 1 - low, 0), literal(low, 0)),
            },
            registered: number % every == 0 || number == last,
        })
        .collect();
    let raw = |name: &str, parameter: &str, own: u32| match bits + 1 - own {
        0 => format!("{name}_i[{parameter}-2:0]"),
        more => format!("{{{{{more}{{{name}_i[{parameter}-1]}}}}, {name}_i[{parameter}-2:0]}}"),
    };
    let first_top = levels.first().map_or(0, |level| level.top_low);
    Normaliser {
        banner,
        prefix: source.prefix,
        last,
        clocks: 1 + (last as u32).div_ceil(unit.cordic.pipeline_every),
        x_bits: unit.x_bits,
        y_bits: unit.y_bits,
        bits,
        shift_bits,
        meta_bits: source.meta_bits,
        x_raw: raw("x", "X_BITS", unit.x_bits),
        y_raw: raw("y", "Y_BITS", unit.y_bits),
        first_flag: if last == 0 { "zero_0" } else { "empty_1" },
        first_flag_value: if last == 0 { "~|x_i && ~|y_i" } else { "~|(x_top | y_top)" },
        first_top,
        first_bits: bits - first_top,
        first_range: range(bits - first_top),
        levels,
    }
    .render()
}
