//! Template contexts of the accumulator and its memory.

use super::Source;
use super::control::Counters;
use super::text::{bit, literal, range, signed_literal, slice, table, zero_extended};
use crate::spec::{StoredSum, Word};
use askama::Template;

struct Column {
    number: usize,
    high: u32,
    low: u32,
    range: String,
}

#[derive(Template)]
#[template(path = "sum_memory.v", escape = "none")]
struct SumMemory {
    banner: String,
    prefix: String,
    word_bits: u32,
    address_bits: u32,
    words: usize,
    columns: Vec<Column>,
}

pub(super) fn sum_memory(source: &Source, banner: String) -> askama::Result<String> {
    let derived = source.pipeline.derived();
    let mut low = 0;
    let columns = derived.memory_columns.iter().enumerate().map(|(number, &bits)| {
        let column = Column { number, high: low + bits - 1, low, range: range(bits) };
        low += bits;
        column
    });
    SumMemory {
        banner,
        prefix: source.pipeline.prefix(),
        columns: columns.collect(),
        word_bits: derived.memory_word_bits,
        address_bits: Counters::new(source).address_bits,
        words: source.pipeline.geometry().pixels(),
    }
    .render()
}

/// What a sample adds to a sum that is kept.
struct Term {
    name: &'static str,
    /// As shifts and adds.
    text: String,
    /// The weight, for a multiplier.
    literal: String,
}

/// One phase step.
struct Step {
    title: String,
    /// The case label.
    label: String,
    terms: Vec<Term>,
}

/// A sum that is kept.
struct Sum {
    name: &'static str,
    bits: u32,
    /// The parameter that holds its bits.
    bits_name: String,
    top: String,
    /// Its lowest bit in a pixel's word.
    low: String,
    lowest: bool,
    range: String,
    zero: String,
    /// The sample, as wide as the sum; zeros above the sample of a product; the sum, as wide as a combination.
    sample: String,
    sample_zeros: String,
    mixed: String,
    product_range: String,
    weight_range: String,
    weight_top: u32,
    weight_signs: u32,
}

#[derive(Template)]
#[template(path = "accumulator.v", escape = "none")]
struct Accumulator {
    banner: String,
    prefix: String,
    scheme: String,
    kept: &'static str,
    heading: String,
    steps: Vec<Step>,
    /// The sample is multiplied by a weight from a table, a clock later than by shifts and adds.
    multiplied: bool,
    /// What the port's names end in after that clock: `i`, or `q` where there is one.
    at: &'static str,
    /// The sums are kept as they are.
    plain: bool,
    sums: Vec<Sum>,
    sums_from_top: Vec<Sum>,
    /// Those whose bits are not a parameter already.
    own_sums: Vec<Sum>,
    mixed_range: String,
    mixed_top: u32,
    in_phase_mix: String,
    quadrature_mix: String,
    offset_mix: String,
    sample_bits: u32,
    in_phase_bits: u32,
    quadrature_bits: u32,
    offset_bits: u32,
    address_bits: u32,
    column_bits: u32,
    step_bits: u32,
    pixels: usize,
    last_column: usize,
    saturation: i64,
}

pub(super) fn accumulator(source: &Source, banner: String) -> askama::Result<String> {
    let (pipeline, derived) = (source.pipeline, source.pipeline.derived());
    let scheme = &pipeline.modulation.scheme;
    let storage = &derived.storage;
    let Counters { column_bits, address_bits, step_bits, .. } = Counters::new(source);
    let stored = &storage.sums;
    let multiplied =
        stored.iter().any(|sum| sum.weights.iter().any(|weight| weight.abs() > MOST_SHIFTED_WEIGHT));
    let (sample_bits, last_step) = (derived.sample.bits, scheme.steps() - 1);
    // Wide enough for every combination on the way: twice the widest result.
    let mixed_bits = derived.in_phase.bits.max(derived.quadrature.bits).max(derived.offset_sum.bits) + 1;
    let titles = table(
        &(0..scheme.steps())
            .map(|step| {
                let weights = stored.iter().map(|sum| sum.weights[step].to_string());
                std::iter::once(step.to_string()).chain(weights).collect()
            })
            .collect::<Vec<Vec<String>>>(),
    );
    let steps = titles
        .into_iter()
        .enumerate()
        .map(|(number, title)| Step {
            title,
            label: if number == last_step { "default".to_owned() } else { format!("{step_bits}'d{number}") },
            terms: stored
                .iter()
                .map(|sum| Term {
                    name: sum.name,
                    text: term(
                        &format!("{}_sample", sum.name),
                        sum.weights[number],
                        &literal(sum.word.bits, 0),
                    ),
                    literal: signed_literal(weight_bits(&sum.weights), sum.weights[number]),
                })
                .collect(),
        })
        .collect();
    let sums = || {
        let mut below: Vec<String> = Vec::new();
        stored
            .iter()
            .map(|StoredSum { name, weights, word }| {
                let (bits, weight_bits) = (word.bits, weight_bits(weights));
                let bits_name = format!("{}_BITS", name.to_uppercase());
                let sum = Sum {
                    name,
                    bits,
                    top: format!("{bits_name}-1"),
                    low: if below.is_empty() { "0".to_owned() } else { below.join("+") },
                    lowest: below.is_empty(),
                    range: format!("[{bits_name}-1:0]"),
                    zero: format!("{{{bits_name}{{1'b0}}}}"),
                    // A replication must not be of nothing.
                    sample: match bits - sample_bits {
                        0 => "sample_i".to_owned(),
                        _ => format!("{{{{({bits_name}-SAMPLE_BITS){{1'b0}}}}, sample_i}}"),
                    },
                    bits_name: bits_name.clone(),
                    sample_zeros: literal(bits + 1 - sample_bits, 0),
                    mixed: zero_extended(&format!("{name}_before"), bits, mixed_bits),
                    product_range: range(bits + 1),
                    weight_range: range(weight_bits),
                    weight_top: weight_bits - 1,
                    weight_signs: bits + 1 - weight_bits,
                };
                below.push(bits_name);
                sum
            })
            .collect::<Vec<Sum>>()
    };
    let mix = |row: usize| {
        let parts = stored.iter().zip(storage.combination[row]).filter(|(_, times)| *times != 0);
        parts
            .map(|(sum, times)| term(&format!("{}_wide", sum.name), times, "0"))
            .collect::<Vec<_>>()
            .join(" + ")
            .replace("+ -", "- ")
    };
    Accumulator {
        banner,
        prefix: pipeline.prefix(),
        scheme: scheme.name.to_string(),
        kept: if storage.is_plain() {
            "its pixel's in-phase, quadrature and offset sums"
        } else {
            "one of its pixel's three groups of frames whose weights are multiples of one another"
        },
        heading: stored.iter().map(|sum| sum.name).collect::<Vec<_>>().join(" | "),
        steps,
        multiplied,
        at: if multiplied { "q" } else { "i" },
        plain: storage.is_plain(),
        sums: sums(),
        sums_from_top: sums().into_iter().rev().collect(),
        own_sums: if storage.is_plain() { Vec::new() } else { sums() },
        mixed_range: range(mixed_bits),
        mixed_top: mixed_bits - 1,
        in_phase_mix: mix(0),
        quadrature_mix: mix(1),
        offset_mix: mix(2),
        sample_bits,
        in_phase_bits: derived.in_phase.bits,
        quadrature_bits: derived.quadrature.bits,
        offset_bits: derived.offset_sum.bits,
        address_bits,
        column_bits,
        step_bits,
        pixels: pipeline.geometry().pixels(),
        last_column: pipeline.sensor.width - 1,
        saturation: pipeline.sensor.saturation_dn,
    }
    .render()
}

/// Bits of the weights of a sum. A sign even where there is none, so that all products are signed.
fn weight_bits(weights: &[i64]) -> u32 {
    let (least, most) = weights.iter().fold((0, 0), |(least, most), &w| (w.min(least), w.max(most)));
    Word::holding(least.min(-1), most).bits
}

/// A scheme with a larger weight, either sign, multiplies; up to it, a weight is three additions or fewer.
const MOST_SHIFTED_WEIGHT: i64 = 15;

/// `sample` times `weight` as shifts and adds, one a set bit of the weight.
fn term(sample: &str, weight: i64, zero: &str) -> String {
    let shifts: Vec<String> = (0..u64::BITS)
        .filter(|bit| weight.unsigned_abs() >> bit & 1 == 1)
        .map(|bit| if bit == 0 { sample.to_owned() } else { format!("({sample} << {bit})") })
        .collect();
    match (shifts.as_slice(), weight < 0) {
        ([], _) => zero.to_owned(),
        ([one], false) => one.clone(),
        ([one], true) => format!("-{one}"),
        (many, false) => many.join(" + "),
        (many, true) => format!("-({})", many.join(" + ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_become_shifts_and_adds() {
        assert_eq!(term("s", 0, "0"), "0");
        assert_eq!(term("s", 1, "0"), "s");
        assert_eq!(term("s", -3, "0"), "-(s + (s << 1))");
        assert_eq!(term("s", 4, "0"), "(s << 2)");
    }
}
