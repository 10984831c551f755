//! Template context of the folded CORDIC: a ring of stages.

use super::AngleSource;
use crate::hdl::text::{counter_bits, literal, range, slice};
use crate::spec::{AngleUnit, Rounding, exact};
use askama::Template;

struct Stage {
    number: u32,
    before: u32,
    iterations: String,
    /// x as wide as y.
    x_wide: String,
    /// x changes in one of the rounds.
    follows: bool,
    part_range: String,
    part: String,
    shifts: Vec<String>,
    only_shift: String,
    /// Bits of the part that no round looks at.
    unused_part: String,
}

#[derive(Template)]
#[template(path = "cordic_folded.v", escape = "none")]
struct Cordic<'a> {
    banner: String,
    prefix: &'a str,
    metric: i64,
    with_length: bool,
    gain: String,
    x_iterations: u32,
    stage_count: u32,
    rounds: u32,
    round_rows: Vec<String>,
    bits: u32,
    directions: u32,
    x_bits: u32,
    y_bits: u32,
    fraction_bits: u32,
    round_bits: u32,
    meta_bits: u32,
    last_round: String,
    one_round: String,
    no_round: String,
    last_stage: u32,
    nearest: bool,
    x_load: String,
    y_load: String,
    unused_load: String,
    stages: Vec<Stage>,
}

/// x and half of y as they are loaded from the magnitudes `x` and `y`, and the low bits of both that are left out.
///
/// `width` is the word's; the fraction is that of x, a bit less for y.
pub(super) fn loads(unit: &AngleUnit, x: &str, y: &str, x_negative: &str, y_negative: &str) -> [String; 3] {
    let bits = unit.magnitude_bits;
    let load = |name: &str, negative: &str, fraction: u32, width: u32| {
        let wanted = fraction + 1;
        let (kept, text) = if wanted > bits {
            (wanted, format!("{name}, {{{}{{{negative}}}}}", wanted - bits))
        } else {
            (wanted, format!("{name}[{}:{}]", bits - 1, bits - wanted))
        };
        format!("{{{}'d0, {text}}}", width - kept)
    };
    let (x_bits, y_bits) = (unit.stages.x[0].bits, unit.stages.y[0].bits);
    let unused = |name: &str, fraction: u32| match bits.saturating_sub(fraction + 1) {
        0 => None,
        count => Some(format!("{name}[{}:0]", count - 1)),
    };
    let unused = [unused(x, unit.fraction_bits), unused(y, unit.fraction_bits - 1)];
    [
        load(x, x_negative, unit.fraction_bits, x_bits),
        load(y, y_negative, unit.fraction_bits - 1, y_bits),
        unused.into_iter().flatten().collect::<Vec<_>>().join(", "),
    ]
}

/// What x grows by, before its shift: |y|, or three times it. Text and bits.
pub(super) fn growth(unit: &AngleUnit, magnitude: &str) -> (String, u32) {
    let bits = unit.stages.y[0].bits - 1;
    if unit.metric == 1 {
        (magnitude.to_owned(), bits)
    } else {
        let text = format!(
            "{{1'd0, {magnitude}, {magnitude}[0]}} + {{2'd0, {magnitude}}} + {{{}'d0, {magnitude}[0]}}",
            bits + 1
        );
        (text, bits + 2)
    }
}

pub(super) fn cordic(
    source: &AngleSource,
    stages: u32,
    rounds: u32,
    banner: String,
) -> askama::Result<String> {
    let unit = source.unit;
    let (x_bits, y_bits) = (unit.stages.x[0].bits, unit.stages.y[0].bits);
    let round_bits = counter_bits(rounds as usize - 1);
    let [x_load, y_load, unused_load] = loads(unit, "x_i", "y_i", "x_negative_i", "y_negative_i");
    let ring = (0..stages).map(|number| {
        let iterations: Vec<u32> = (0..rounds).map(|round| round * stages + number).collect();
        let name = format!("part_{number}");
        let (part, part_bits) = growth(unit, &format!("magnitude_{number}"));
        // Twice the part, so that the bit below the last is the one that rounds.
        let rows: Vec<(usize, String)> = (0..)
            .zip(&iterations)
            .filter(|&(_, &i)| i <= unit.stages.x_iterations)
            .map(|(round, &i)| (round, shifted(&name, part_bits, i, x_bits + 1)))
            .collect();
        let used = iterations.iter().filter(|&&i| i <= unit.stages.x_iterations);
        let used = used.fold(0, |used, &i| used | looked_at(part_bits, i, x_bits + 1));
        let mut shifts: Vec<String> = rows
            .iter()
            .map(|(round, grown)| {
                format!("{}: grown_{number} = {grown};", literal(round_bits, *round as i64))
            })
            .collect();
        let follows = !shifts.is_empty();
        let only_shift =
            if rounds == 1 { rows.into_iter().map(|row| row.1).collect() } else { String::new() };
        if rounds > 1 {
            shifts.push(format!("default: grown_{number} = {};", literal(x_bits + 1, 0)));
        }
        Stage {
            number,
            before: number.saturating_sub(1),
            iterations: iterations.iter().map(u32::to_string).collect::<Vec<_>>().join(", "),
            x_wide: format!("{{{}'d0, x_{number}}}", y_bits - x_bits),
            follows,
            part_range: range(part_bits),
            part,
            shifts,
            only_shift,
            unused_part: unused_bits(&name, part_bits, used),
        }
    });
    Cordic {
        banner,
        prefix: source.prefix,
        metric: unit.metric,
        with_length: unit.with_length(),
        gain: format!("{:.9}", exact::angle_gain_f64(unit.metric, unit.stages.x_iterations)),
        x_iterations: unit.stages.x_iterations,
        stage_count: stages,
        rounds,
        round_rows: (0..rounds)
            .map(|round| format!("{round}     | {} to {}", round * stages, (round + 1) * stages - 1))
            .collect(),
        bits: unit.magnitude_bits,
        directions: unit.iterations + 1,
        x_bits,
        y_bits,
        fraction_bits: unit.fraction_bits,
        round_bits,
        meta_bits: source.meta_bits,
        last_round: literal(round_bits, i64::from(rounds) - 1),
        one_round: literal(round_bits, 1),
        no_round: literal(round_bits, 0),
        last_stage: stages - 1,
        nearest: unit.cordic.rounding == Rounding::Nearest,
        x_load,
        y_load,
        unused_load,
        stages: ring.collect(),
    }
    .render()
}

/// The bits of a part that iteration `i` looks at: places to the left (2), or to the right, and how many.
fn window(from: u32, i: u32, to: u32) -> (u32, u32, u32) {
    match i {
        0 => (2, 0, from.min(to - 2)),
        _ => (0, 2 * i - 2, from.saturating_sub(2 * i - 2).min(to)),
    }
}

/// Twice the part `name` of `from` bits by iteration `i`, as a word of `to` bits: 4 or 4 / 4^i times the part.
fn shifted(name: &str, from: u32, i: u32, to: u32) -> String {
    let (left, low, kept) = window(from, i, to);
    if kept == 0 {
        return format!("{to}'d0");
    }
    let part = if kept == from { name.to_owned() } else { format!("{name}{}", slice(low + kept - 1, low)) };
    match (to - kept - left, left) {
        (0, 0) => part,
        (spare, 0) => format!("{{{spare}'d0, {part}}}"),
        (0, _) => format!("{{{part}, {left}'d0}}"),
        (spare, _) => format!("{{{spare}'d0, {part}, {left}'d0}}"),
    }
}

/// The same bits as a mask.
fn looked_at(from: u32, i: u32, to: u32) -> u64 {
    let (_, low, kept) = window(from, i, to);
    ((1 << kept) - 1) << low.min(63)
}

/// The bits of `name` that are not in the mask `used`, as a list of slices.
fn unused_bits(name: &str, bits: u32, used: u64) -> String {
    let unused = |bit: u32| used >> bit & 1 == 0;
    let mut slices = Vec::new();
    let mut high = None;
    for bit in (0..bits).rev() {
        high = high.or(unused(bit).then_some(bit));
        if let Some(top) = high.filter(|_| unused(bit) && (bit == 0 || !unused(bit - 1))) {
            slices.push(format!("{name}{}", slice(top, bit)));
            high = None;
        }
    }
    slices.join(", ")
}
