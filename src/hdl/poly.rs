//! Template contexts of the angle by tables and multipliers.

use super::AngleSource;
use super::rom::Rom;
use super::text::{banner, finished, range, table};
use crate::artifact::Artifact;
use crate::model;
use crate::spec::{MULTIPLIER_CLOCKS, Poly, Tables, Word};
use askama::Template;

/// Widest operand of an ECP5's multiplier.
const ECP5_OPERAND_BITS: u32 = 18;

#[derive(Template)]
#[template(path = "poly_multiplier.v", escape = "none")]
struct Multiplier<'a> {
    banner: String,
    prefix: &'a str,
    primitive: bool,
}

struct Stage {
    number: usize,
    before: usize,
    places: u32,
}

#[derive(Template)]
#[template(path = "poly_octant.v", escape = "none")]
struct Octant<'a> {
    banner: String,
    prefix: &'a str,
    x_bits: u32,
    y_bits: u32,
    word_bits: u32,
    coordinate_bits: u32,
    x: String,
    y: String,
    stages: Vec<Stage>,
    shifts: usize,
    major: String,
    minor: String,
    drop_bits: u32,
    dropped: String,
}

#[derive(Template)]
#[template(path = "poly_reciprocal.v", escape = "none")]
struct Reciprocal<'a> {
    banner: String,
    prefix: &'a str,
    entries: usize,
    error: String,
    scale_bits: u32,
    rows: Vec<String>,
    coordinate_bits: u32,
    index_bits: u32,
    factor_bits: u32,
    result_bits: u32,
    clocks: u32,
    memory: bool,
    factor_table: String,
}

#[derive(Template)]
#[template(path = "poly_arctangent.v", escape = "none")]
struct Arctangent<'a> {
    banner: String,
    prefix: &'a str,
    segments: usize,
    curved: bool,
    rows: Vec<String>,
    ratio_bits: u32,
    segment_bits: u32,
    slope_bits: u32,
    slope_shift: u32,
    guard_bits: u32,
    angle_bits: u32,
    phase_bits: u32,
    clocks: u32,
    curve_offset_bits: u32,
    curve_range: String,
    size_range: String,
    bend_range: String,
    group_range: String,
    tables: String,
}

#[derive(Template)]
#[template(path = "angle_poly.v", escape = "none")]
struct Angle<'a> {
    banner: String,
    prefix: &'a str,
    bound: String,
    rows: Vec<String>,
    x_bits: u32,
    y_bits: u32,
    phase_bits: u32,
    coordinate_bits: u32,
    result_bits: u32,
    ratio_bits: u32,
    shift_bits: u32,
    meta_bits: u32,
    latency_clocks: u32,
    octant_clocks: u32,
    reciprocal_clocks: u32,
    arctangent_clocks: u32,
    present_clocks: u32,
}

/// Clocks of the reciprocal: its table and a multiplier.
fn reciprocal_clocks(unit: &Poly) -> u32 {
    unit.tables.clocks() + MULTIPLIER_CLOCKS
}

/// Clocks of the arctangent: its tables, a multiplier, and the sum.
fn arctangent_clocks(unit: &Poly) -> u32 {
    unit.tables.clocks() + MULTIPLIER_CLOCKS + 1
}

/// The Poly of a unit that is one; the module table asks for no other.
fn poly<'a>(source: &AngleSource<'a>) -> askama::Result<&'a Poly> {
    source.unit.poly.as_ref().ok_or(askama::Error::ValueMissing)
}

pub(super) fn multiplier(source: &AngleSource, banner: String) -> askama::Result<String> {
    Multiplier { banner, prefix: source.prefix, primitive: false }.render()
}

/// For an ECP5, a multiplier that can take the place of the portable one.
pub(super) fn ecp5_artifact(source: &AngleSource, spec: &str) -> Option<Artifact> {
    let prefix = source.prefix;
    source.unit.poly.as_ref().filter(|unit| unit.coordinate_bits <= ECP5_OPERAND_BITS).map(|_| {
        let banner = banner(spec, "A multiplier of the ECP5, instead of the portable one.");
        let text = finished(Multiplier { banner, prefix, primitive: true }.render());
        Artifact::new(format!("ecp5/{prefix}_poly_multiplier.v"), text)
    })
}

pub(super) fn octant(source: &AngleSource, banner: String) -> askama::Result<String> {
    let (unit, prefix) = (poly(source)?, source.prefix);
    let last = unit.shifts.len();
    let extended = |name: &str, bits: u32| match unit.word_bits - bits {
        0 => name.to_owned(),
        spare => format!("{{{{{spare}{{{name}[{}]}}}}, {name}}}", bits - 1),
    };
    let fitted = |name: &str| match (unit.word_bits, unit.coordinate_bits) {
        (from, to) if from == to => format!("{name}_{last}"),
        (from, to) if from > to => format!("{name}_{last}[{}:{}]", from - 1, from - to),
        (from, to) => format!("{{{name}_{last}, {{{}{{{name}_{last}[0]}}}}}}", to - from),
    };
    let drop_bits = unit.word_bits.saturating_sub(unit.coordinate_bits);
    Octant {
        banner,
        prefix,
        x_bits: unit.x_bits,
        y_bits: unit.y_bits,
        word_bits: unit.word_bits,
        coordinate_bits: unit.coordinate_bits,
        x: extended("x_i", unit.x_bits),
        y: extended("y_i", unit.y_bits),
        stages: (0..)
            .zip(&unit.shifts)
            .map(|(before, &places)| Stage { number: before + 1, before, places })
            .collect(),
        shifts: last,
        major: fitted("major"),
        minor: fitted("minor"),
        drop_bits,
        dropped: range(drop_bits.max(1)),
    }
    .render()
}

pub(super) fn reciprocal(source: &AngleSource, banner: String) -> askama::Result<String> {
    let (unit, prefix) = (poly(source)?, source.prefix);
    let shape = &unit.reciprocal;
    let one = 1_i64 << (unit.coordinate_bits - 1);
    let rows = [one, one * 3 / 2, 2 * one - 1]
        .map(|major| vec![major.to_string(), model::poly_reciprocal(unit, major).to_string()]);
    let words = patterns(&shape.factors, shape.factor_bits);
    let rom =
        Rom { name: "factor", what: "The factors", index: "index", bits: shape.factor_bits, words: &words };
    Reciprocal {
        banner,
        prefix,
        entries: words.len(),
        error: format!("{:.2e}", shape.relative_error),
        scale_bits: shape.scale_bits,
        rows: table(&rows),
        coordinate_bits: unit.coordinate_bits,
        index_bits: shape.index_bits,
        factor_bits: shape.factor_bits,
        result_bits: shape.result_bits,
        clocks: reciprocal_clocks(unit),
        memory: unit.tables == Tables::Memory,
        factor_table: match unit.tables {
            Tables::Logic => rom.logic(),
            Tables::Memory => rom.memory(),
        },
    }
    .render()
}

/// The words of a table as bit patterns of `bits` bits.
fn patterns(values: &[i64], bits: u32) -> Vec<u64> {
    values.iter().map(|&value| Word::unsigned(bits).pattern(value)).collect()
}

pub(super) fn arctangent(source: &AngleSource, banner: String) -> askama::Result<String> {
    let (unit, prefix) = (poly(source)?, source.prefix);
    let shape = &unit.arctangent;
    let angle_bits = unit.phase_bits - 1;
    let word_bits = angle_bits + shape.guard_bits;
    let (ratio_bits, offset_bits) = (unit.ratio_bits, shape.offset_bits);
    let rows = [(0, false), (0, true), ((1 << ratio_bits) - (1 << (ratio_bits - 8)), false)].map(
        |(ratio, backwards): (i64, bool)| {
            let angle = model::poly_arctangent(unit, ratio, backwards);
            [ratio, backwards.into(), angle].map(|value| value.to_string()).to_vec()
        },
    );
    Arctangent {
        banner,
        prefix,
        segments: shape.bases.len(),
        curved: shape.curve_offset_bits > 0,
        rows: table(&rows),
        ratio_bits,
        segment_bits: shape.segment_bits,
        slope_bits: shape.slope_bits,
        slope_shift: shape.slope_shift,
        guard_bits: shape.guard_bits,
        angle_bits,
        phase_bits: unit.phase_bits,
        clocks: arctangent_clocks(unit),
        curve_offset_bits: shape.curve_offset_bits,
        curve_range: range(shape.curve_offset_bits.max(1)),
        size_range: format!("[{}:{}]", offset_bits - 2, offset_bits - 1 - shape.curve_offset_bits),
        bend_range: range((shape.curve_segment_bits + shape.curve_offset_bits).max(1)),
        group_range: format!("[{}:{}]", ratio_bits - 1, ratio_bits - shape.curve_segment_bits),
        tables: match unit.tables {
            Tables::Logic => line_and_curve(unit, word_bits),
            Tables::Memory => lines(unit, word_bits),
        },
    }
    .render()
}

/// Three tables: bases less half a code, slopes, curves.
fn line_and_curve(unit: &Poly, word_bits: u32) -> String {
    let shape = &unit.arctangent;
    let half = 1 << (shape.guard_bits - 1);
    let bases: Vec<i64> = shape.bases.iter().map(|base| base - half).collect();
    let tables = [
        ("base", "Angles of the middles, less half a code", "segment", word_bits, &bases),
        ("slope", "Slopes", "segment", shape.slope_bits, &shape.slopes),
        ("curve", "Curves", "bend", shape.guard_bits, &shape.curves),
    ]
    .map(|(name, what, index, bits, values)| {
        Rom { name, what, index, bits, words: &patterns(values, bits) }.logic()
    })
    .join("\n");
    let wires = [("base", word_bits), ("slope", shape.slope_bits)]
        .map(|(name, bits)| format!("  wire {} {name} = {name}_q;\n", range(bits)));
    format!("{tables}\n{}", wires.concat())
}

/// One table of base and slope, for either rounding.
fn lines(unit: &Poly, word_bits: u32) -> String {
    let shape = &unit.arctangent;
    let half = 1 << (shape.guard_bits - 1);
    let words: Vec<u64> = [half, -half]
        .into_iter()
        .flat_map(|rounding| {
            shape.bases.iter().zip(&shape.slopes).map(move |(base, &slope)| {
                (Word::unsigned(word_bits).pattern(base + rounding) << shape.slope_bits) | slope as u64
            })
        })
        .collect();
    let bits = word_bits + shape.slope_bits;
    let what = "Angles of the middles, half a code more or less, and slopes";
    let rom = Rom { name: "line", what, index: "line", bits, words: &words };
    format!(
        "{}\n  wire {} base = line_q[{}:{}];\n  wire {} slope = line_q{};\n",
        rom.memory(),
        range(word_bits),
        bits - 1,
        shape.slope_bits,
        range(shape.slope_bits),
        range(shape.slope_bits),
    )
}

pub(super) fn angle(source: &AngleSource, banner: String) -> askama::Result<String> {
    let (unit, prefix) = (poly(source)?, source.prefix);
    let (x, y) = (Word::signed(unit.x_bits), Word::signed(unit.y_bits));
    let rows = [(1, 0), (0, 0), (x.min(), y.min()), (x.max(), -1)].map(|(x, y)| {
        let angle = model::poly(unit, x, y);
        [x, y, angle.phase, angle.zero.into()].map(|value| value.to_string()).to_vec()
    });
    let shifts = unit.shifts.len() as u32;
    Angle {
        banner,
        prefix,
        bound: format!("{:.3}", unit.phase_codes() + 5e-4),
        rows: table(&rows),
        x_bits: unit.x_bits,
        y_bits: unit.y_bits,
        phase_bits: unit.phase_bits,
        coordinate_bits: unit.coordinate_bits,
        result_bits: unit.reciprocal.result_bits,
        ratio_bits: unit.ratio_bits,
        shift_bits: source.unit.shift_bits(),
        meta_bits: source.meta_bits,
        latency_clocks: unit.latency_clocks,
        octant_clocks: shifts + reciprocal_clocks(unit) + MULTIPLIER_CLOCKS,
        reciprocal_clocks: reciprocal_clocks(unit),
        arctangent_clocks: arctangent_clocks(unit),
        present_clocks: reciprocal_clocks(unit) + MULTIPLIER_CLOCKS + arctangent_clocks(unit),
    }
    .render()
}
