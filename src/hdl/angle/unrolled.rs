//! Template context of the unrolled CORDIC: a list of moves, between which registers can stand.

use super::AngleSource;
use crate::hdl::text::{bit, range, slice, table};
use crate::spec::{AngleUnit, Rounding, exact};
use askama::Template;

/// One step; the fields that its kind has no use for stay empty.
#[derive(Default)]
struct Move {
    kind: &'static str,
    number: usize,
    before: usize,
    iteration: u32,
    registered: bool,
    nearest: bool,
    has_x: bool,
    has_y: bool,
    triple_bits: u32,
    x_range: String,
    y_range: String,
    triple_range: String,
    directions_range: String,
    /// Bits of y before the move, without the sign.
    magnitude_bits: u32,
    magnitude_range: String,
    magnitude_top: u32,
    y_top: u32,
    /// The magnitude and the part of x, as wide as the next y.
    magnitude: String,
    x_part: String,
    x_half: u32,
    difference_range: String,
    difference_top: u32,
    /// The magnitude and its double, as wide as the triple.
    single: String,
    double: String,
    x_next: String,
    unused_x: String,
    sum: String,
    wide_x: String,
    wide_y: String,
    double_y: String,
    y_carry: String,
}

#[derive(Template)]
#[template(path = "cordic_unrolled.v", escape = "none")]
struct Cordic<'a> {
    banner: String,
    prefix: &'a str,
    metric: i64,
    with_length: bool,
    gain: String,
    x_iterations: u32,
    words: Vec<String>,
    bits: u32,
    directions: u32,
    x_bits: u32,
    x_fraction_bits: u32,
    meta_bits: u32,
    clocks: u32,
    drop_bits: u32,
    pad_bits: u32,
    kept_range: String,
    difference_range: String,
    difference_top: String,
    moves: Vec<Move>,
    last: usize,
}

/// `name` of `from` bits as one of `to`: zeros above, or its top cut off.
fn resized(name: &str, from: u32, to: u32) -> String {
    match from.cmp(&to) {
        std::cmp::Ordering::Less => format!("{{{}'d0, {name}}}", to - from),
        std::cmp::Ordering::Equal => name.to_owned(),
        std::cmp::Ordering::Greater => format!("{name}[{}:0]", to - 1),
    }
}

/// What the moves so far have left.
struct Live {
    number: usize,
    x_bits: u32,
    /// Low bits of the model's x that no later iteration needs and the hardware no longer carries.
    x_cut: u32,
    directions: u32,
}

pub(super) fn cordic(source: &AngleSource, banner: String) -> askama::Result<String> {
    let unit = source.unit;
    let kept = unit.magnitude_bits - unit.drop_bits();
    let (moves, last) = moves(unit, kept);
    let words: Vec<Vec<String>> = (0..)
        .zip(unit.stages.x.iter().zip(&unit.stages.y))
        .map(|(i, (x, y))| {
            vec![
                format!("{i}"),
                format!("{} . {}", x.bits.saturating_sub(x.fraction_bits), x.fraction_bits),
                format!("{} . {}", i64::from(y.bits) - i64::from(y.fraction_bits), y.fraction_bits),
            ]
        })
        .collect();
    Cordic {
        banner,
        prefix: source.prefix,
        metric: unit.metric,
        with_length: unit.with_length(),
        gain: format!("{:.9}", exact::angle_gain_f64(unit.metric, unit.stages.x_iterations)),
        x_iterations: unit.last_x_iteration(),
        words: table(&words),
        bits: unit.magnitude_bits,
        directions: unit.iterations + 1,
        x_bits: unit.length_word().bits,
        x_fraction_bits: unit.stages.x.last().map_or(0, |word| word.fraction_bits),
        meta_bits: source.meta_bits,
        clocks: unit.moves().div_ceil(unit.cordic.pipeline_every) + 1,
        drop_bits: unit.drop_bits(),
        pad_bits: unit.pad_bits(),
        kept_range: range(kept),
        difference_range: range(kept + 2),
        difference_top: format!("[{}:1]", kept + 1),
        moves,
        last,
    }
    .render()
}

fn moves(unit: &AngleUnit, kept: u32) -> (Vec<Move>, usize) {
    let mut moves = Vec::new();
    let mut live = Live { number: 0, x_bits: unit.stages.x[0].bits, x_cut: 0, directions: 1 };
    fold(unit, kept, &mut moves, &mut live);
    for i in 1..unit.iterations {
        turn(unit, i, &mut moves, &mut live);
    }
    let y = unit.stages.y[unit.iterations as usize - 1];
    moves.push(Move {
        kind: "last",
        number: live.number,
        before: live.number.saturating_sub(1),
        has_x: unit.with_length(),
        x_range: range(live.x_bits),
        directions_range: range(live.directions + 1),
        y_top: y.bits - 1,
        magnitude_top: y.bits - 2,
        ..Move::default()
    });
    let last = moves.len() - 1;
    for (place, step) in moves.iter_mut().enumerate() {
        step.registered = (place + 1) % unit.cordic.pipeline_every as usize == 0 || place + 1 >= last;
    }
    (moves, last)
}

/// Iteration 0: one move, or two where y is tripled.
fn fold(unit: &AngleUnit, kept: u32, moves: &mut Vec<Move>, live: &mut Live) {
    let (x, y) = (unit.stages.x[0], unit.stages.y[0]);
    let pad = unit.pad_bits();
    if unit.metric == 1 {
        let bits = x.bits - pad;
        let sum = format!(
            "{} + {} + {}",
            resized("x_kept", kept, bits),
            resized("y_kept", kept, bits),
            resized("x_negative_i", 1, bits)
        );
        moves.push(Move {
            kind: "fold",
            has_x: true,
            has_y: true,
            x_range: range(x.bits),
            y_range: range(y.bits),
            directions_range: range(1),
            sum,
            ..Move::default()
        });
        live.number = 1;
        return;
    }
    let filled = |name: &str, negative: &str| match pad {
        0 => name.to_owned(),
        _ => format!("{{{name}, {{{pad}{{{negative}}}}}}}"),
    };
    let (wide, triple) = (kept + pad, kept + pad + 2);
    moves.push(Move {
        kind: "fold triple",
        has_x: true,
        has_y: true,
        x_range: range(wide),
        y_range: range(y.bits),
        triple_bits: triple,
        triple_range: range(triple),
        directions_range: range(2),
        wide_x: filled("x_kept", "x_negative_i"),
        wide_y: format!("{{2'd0, {}}}", filled("y_kept", "y_negative_i")),
        double_y: format!("{{wide_y_0[{}:0], y_negative_i}}", triple - 2),
        y_carry: resized("y_negative_i", 1, triple),
        ..Move::default()
    });
    moves.push(Move {
        kind: "fold sum",
        number: 1,
        has_x: true,
        has_y: true,
        x_range: range(x.bits),
        y_range: range(y.bits),
        directions_range: range(1),
        sum: format!(
            "{} + {} + {}",
            resized("x_0", wide, x.bits),
            resized("triple_0", triple, x.bits),
            resized("directions_0[1]", 1, x.bits)
        ),
        ..Move::default()
    });
    live.number = 2;
}

/// Iteration `i`: one move, or two where y is tripled.
fn turn(unit: &AngleUnit, i: u32, moves: &mut Vec<Move>, live: &mut Live) {
    let (before, after) = (unit.stages.x[i as usize - 1], unit.stages.x[i as usize]);
    let (y_before, y) = (unit.stages.y[i as usize - 1], unit.stages.y[i as usize]);
    let nearest = unit.cordic.rounding == Rounding::Nearest;
    let follows = i <= unit.last_x_iteration();
    let (n, b) = (live.number, live.number - 1);
    let magnitude_bits = y_before.bits - 1;
    // The model's places, less those that are no longer there.
    let places = i + before.fraction_bits - y.fraction_bits - live.x_cut;
    let x_part = if live.x_bits > places {
        let high = (live.x_bits - 1).min(places + y.bits - 1);
        resized(&format!("x_{b}[{high}:{places}]"), high + 1 - places, y.bits)
    } else {
        format!("{}'d0", y.bits)
    };
    let tripled = unit.metric == 3 && follows;
    let mut step = Move {
        kind: "turn",
        number: n,
        before: b,
        iteration: i,
        nearest,
        has_y: true,
        y_range: range(y.bits),
        magnitude_bits,
        magnitude_range: range(magnitude_bits),
        magnitude_top: magnitude_bits - 1,
        y_top: y_before.bits - 1,
        magnitude: resized(&format!("magnitude_{n}"), magnitude_bits, y.bits),
        x_part,
        x_half: places.saturating_sub(1),
        difference_range: range(y.bits + 1),
        difference_top: y.bits,
        directions_range: range(live.directions + 1),
        ..Move::default()
    };
    live.directions += 1;
    let shift = i + y.fraction_bits - after.fraction_bits;
    let narrower = before.fraction_bits - after.fraction_bits;
    // x + a part of the magnitude or of its triple.
    let grown = |part: usize, base: usize, name: &str, bits: u32| {
        let base = resized_part(&format!("x_{base}"), live.x_bits, narrower, after.bits);
        let name = format!("{name}_{part}");
        let part = if bits > shift {
            resized(&format!("{name}[{}:{shift}]", bits - 1), bits - shift, after.bits)
        } else {
            format!("{}'d0", after.bits)
        };
        let carry = if nearest && shift >= 1 && bits >= shift {
            format!(" + {{{}'d0, {name}[{}]}}", after.bits - 1, shift - 1)
        } else {
            String::new()
        };
        let unused = if nearest { shift.saturating_sub(1) } else { shift }.min(bits);
        (format!("{base} + {part}{carry}"), low_bits(&name, unused))
    };
    if !follows {
        if !unit.with_length() {
            step.unused_x = low_bits(&format!("x_{b}"), places - u32::from(nearest));
        }
        // Bits below what the next iteration looks at are left behind.
        let next_places = places + 1;
        let cut = if unit.with_length() { 0 } else { next_places.saturating_sub(u32::from(nearest)) };
        step.has_x = i + 1 < unit.iterations || unit.with_length();
        if step.has_x {
            let bits = live.x_bits.saturating_sub(cut).max(1);
            step.x_next = if live.x_bits > cut {
                resized_part(&format!("x_{b}"), live.x_bits, cut, bits)
            } else {
                "1'd0".to_owned()
            };
            step.x_range = range(bits);
            live.x_bits = bits;
            live.x_cut += cut;
        }
        moves.push(step);
        live.number += 1;
        return;
    }
    if tripled {
        let triple_bits = magnitude_bits + 2;
        step.triple_bits = triple_bits;
        step.triple_range = range(triple_bits);
        step.single = format!("{{2'd0, magnitude_{n}}}");
        step.double = format!("{{1'd0, magnitude_{n}, 1'd0}}");
        step.has_x = true;
        step.x_next = format!("x_{b}");
        step.x_range = range(live.x_bits);
        let (x_next, unused_triple) = grown(n, n, "triple", triple_bits);
        moves.push(step);
        moves.push(Move {
            kind: "sum",
            number: n + 1,
            before: n,
            has_x: true,
            has_y: true,
            x_range: range(after.bits),
            y_range: range(y.bits),
            directions_range: range(live.directions),
            x_next,
            unused_x: [unused_triple, low_bits(&format!("x_{n}"), narrower)]
                .into_iter()
                .filter(|bits| !bits.is_empty())
                .collect::<Vec<_>>()
                .join(", "),
            ..Move::default()
        });
        live.number += 2;
    } else {
        let (x_next, _) = grown(n, b, "magnitude", magnitude_bits);
        step.unused_x = if nearest { String::new() } else { low_bits(&format!("x_{b}"), narrower) };
        step.has_x = true;
        step.x_next = x_next;
        step.x_range = range(after.bits);
        moves.push(step);
        live.number += 1;
    }
    live.x_bits = after.bits;
}

/// `name` without its lowest `cut` bits, as one of `to` bits.
fn resized_part(name: &str, from: u32, cut: u32, to: u32) -> String {
    let kept = from - cut;
    let part = if cut == 0 { name.to_owned() } else { format!("{name}[{}:{cut}]", from - 1) };
    match kept.cmp(&to) {
        std::cmp::Ordering::Less => format!("{{{}'d0, {part}}}", to - kept),
        std::cmp::Ordering::Equal => part,
        std::cmp::Ordering::Greater => format!("{name}[{}:{cut}]", cut + to - 1),
    }
}

/// The lowest `count` bits of `name`, or nothing.
fn low_bits(name: &str, count: u32) -> String {
    if count == 0 { String::new() } else { format!("{name}[{}:0]", count - 1) }
}
