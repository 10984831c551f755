//! Template contexts of the modules that move data: stream register, delay, framing, sum memory, accumulator.

use super::Source;
use super::text::{counter_bits, signed_literal};
use crate::spec::Word;
use askama::Template;

#[derive(Template)]
#[template(path = "stream_register.v", escape = "none")]
struct StreamRegister {
    banner: String,
    prefix: String,
}

pub(super) fn stream_register(source: &Source, banner: String) -> askama::Result<String> {
    StreamRegister { banner, prefix: source.pipeline.prefix() }.render()
}

#[derive(Template)]
#[template(path = "delay.v", escape = "none")]
struct Delay {
    banner: String,
    prefix: String,
}

pub(super) fn delay(source: &Source, banner: String) -> askama::Result<String> {
    Delay { banner, prefix: source.pipeline.prefix() }.render()
}

/// Widths of the counters of a frame, used by several modules.
pub(super) struct Counters {
    pub column_bits: u32,
    pub row_bits: u32,
    pub address_bits: u32,
    pub step_bits: u32,
}

impl Counters {
    pub(super) fn new(source: &Source) -> Self {
        let (geometry, scheme) = (source.pipeline.geometry(), &source.pipeline.modulation.scheme);
        Self {
            column_bits: counter_bits(geometry.width - 1),
            row_bits: counter_bits(geometry.height - 1),
            address_bits: counter_bits(geometry.pixels() - 1),
            step_bits: counter_bits(scheme.steps() - 1),
        }
    }
}

#[derive(Template)]
#[template(path = "framing.v", escape = "none")]
struct Framing {
    banner: String,
    prefix: String,
    sample_bits: u32,
    column_bits: u32,
    row_bits: u32,
    address_bits: u32,
    step_bits: u32,
    repeat_bits: u32,
    silence_bits: u32,
    last_column: usize,
    last_row: usize,
    last_repeat: usize,
    last_step: usize,
    last_silence: u32,
    unwrapping: bool,
}

pub(super) fn framing(source: &Source, banner: String) -> askama::Result<String> {
    let pipeline = source.pipeline;
    let Counters { column_bits, row_bits, address_bits, step_bits } = Counters::new(source);
    let last_repeat = pipeline.modulation.frames_per_step - 1;
    let last_silence = pipeline.sensor.line_blanking_clocks;
    Framing {
        banner,
        prefix: pipeline.prefix(),
        sample_bits: pipeline.derived().sample.bits,
        column_bits,
        row_bits,
        address_bits,
        step_bits,
        repeat_bits: counter_bits(last_repeat),
        silence_bits: counter_bits(last_silence as usize),
        last_column: pipeline.sensor.width - 1,
        last_row: pipeline.sensor.height - 1,
        last_repeat,
        last_step: pipeline.modulation.scheme.steps() - 1,
        last_silence,
        unwrapping: pipeline.derived().unwrapper.is_some(),
    }
    .render()
}

#[derive(Template)]
#[template(path = "sum_memory.v", escape = "none")]
struct SumMemory {
    banner: String,
    prefix: String,
    word_bits: u32,
    address_bits: u32,
    words: usize,
}

pub(super) fn sum_memory(source: &Source, banner: String) -> askama::Result<String> {
    SumMemory {
        banner,
        prefix: source.pipeline.prefix(),
        word_bits: source.pipeline.derived().memory_word_bits,
        address_bits: Counters::new(source).address_bits,
        words: source.pipeline.geometry().pixels(),
    }
    .render()
}

/// One phase step: its weights, and the sample times them.
struct Step {
    number: usize,
    /// The case label.
    label: String,
    /// The weights as literals, for a multiplier.
    in_phase_literal: String,
    quadrature_literal: String,
    offset_literal: String,
    in_phase: i64,
    quadrature: i64,
    offset: i64,
    in_phase_term: String,
    quadrature_term: String,
    offset_term: String,
}

#[derive(Template)]
#[template(path = "accumulator.v", escape = "none")]
struct Accumulator {
    banner: String,
    prefix: String,
    scheme: String,
    steps: Vec<Step>,
    /// The sample is multiplied by a weight from a table, a clock later than by shifts and adds.
    multiplied: bool,
    /// What the port's names end in after that clock: `i`, or `q` where there is one.
    at: &'static str,
    /// The offset's weights are not all 1, and multiplied, too.
    offset_multiplied: bool,
    in_phase_weight_bits: u32,
    quadrature_weight_bits: u32,
    offset_weight_bits: u32,
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
    let Counters { column_bits, address_bits, step_bits, .. } = Counters::new(source);
    let last_step = scheme.steps() - 1;
    let weights = [&scheme.in_phase, &scheme.quadrature, &scheme.offset];
    let multiplied =
        weights.iter().any(|weights| weights.iter().any(|weight| weight.abs() > MOST_SHIFTED_WEIGHT));
    let bits = |weights: &[i64]| {
        let (least, most) = weights.iter().fold((0, 0), |(least, most), &w| (w.min(least), w.max(most)));
        // A sign even where there is none, so that all products are signed.
        Word::holding(least.min(-1), most).bits
    };
    let [in_phase_weight_bits, quadrature_weight_bits, offset_weight_bits] = weights.map(|w| bits(w));
    let steps = (0..scheme.steps())
        .map(|number| Step {
            number,
            label: if number == last_step { "default".to_owned() } else { format!("{step_bits}'d{number}") },
            in_phase_literal: signed_literal(in_phase_weight_bits, scheme.in_phase[number]),
            quadrature_literal: signed_literal(quadrature_weight_bits, scheme.quadrature[number]),
            offset_literal: signed_literal(offset_weight_bits, scheme.offset[number]),
            in_phase: scheme.in_phase[number],
            quadrature: scheme.quadrature[number],
            offset: scheme.offset[number],
            in_phase_term: term("sample_in_phase", scheme.in_phase[number], "{IN_PHASE_BITS{1'b0}}"),
            quadrature_term: term("sample_quadrature", scheme.quadrature[number], "{QUADRATURE_BITS{1'b0}}"),
            offset_term: term("sample_offset", scheme.offset[number], "{OFFSET_BITS{1'b0}}"),
        })
        .collect();
    Accumulator {
        banner,
        prefix: pipeline.prefix(),
        scheme: scheme.name.to_string(),
        steps,
        multiplied,
        at: if multiplied { "q" } else { "i" },
        offset_multiplied: scheme.offset.iter().any(|&weight| weight != 1),
        in_phase_weight_bits,
        quadrature_weight_bits,
        offset_weight_bits,
        sample_bits: derived.sample.bits,
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
