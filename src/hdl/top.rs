//! Template context of the top module, and the layout of its result word.

use super::Source;
use super::control::Counters;
use super::text::{literal, range};
use crate::spec::{ADDRESS_BITS, Pipeline};
use askama::Template;

/// One field of the result word; every field starts on a byte.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ResultField {
    /// Its name, and the name of the wire that it carries.
    pub name: &'static str,
    /// Its lowest bit in `m_axis_tdata`.
    pub low: u32,
    /// Its width.
    pub bits: u32,
    /// Its unit.
    pub meaning: String,
}

fn bytes(bits: u32) -> u32 {
    bits.next_multiple_of(8)
}

/// The result word's fields, lowest first.
pub fn result_fields(pipeline: &Pipeline) -> Vec<ResultField> {
    let (derived, output) = (pipeline.derived(), &pipeline.output);
    let unwrapped = derived.unwrapper.as_ref().map(|unwrapper| {
        let meaning =
            format!("unwrapped phase, turns of f0 / {}; 0 where there is none", unwrapper.codes_a_turn);
        ("unwrapped", unwrapper.unwrapped.bits, meaning)
    });
    let unambiguous = unwrapped.as_ref().map(|_| {
        let meaning =
            "flag: there is an unwrapped phase and its distance (both sets usable, the residual small)";
        ("unambiguous", 1, meaning.to_owned())
    });
    let fields = [
        ("phase", derived.phase.bits, format!("phase, turns / 2^{}", output.phase_bits)),
        (
            "amplitude",
            derived.amplitude.bits,
            format!("amplitude, DN / 2^{}", output.amplitude_fraction_bits),
        ),
        ("offset", derived.offset.bits, format!("offset, DN / 2^{}", output.offset_fraction_bits)),
        ("distance", derived.distance.bits, format!("distance, {} m", output.distance_unit_m)),
    ];
    let flags = [
        ("usable", 1, "flag: there is a phase (a vector, and not too weak a one)".to_owned()),
        ("saturated", 1, "flag: a sample of any frame was saturated".to_owned()),
    ];
    let mut low = 0;
    fields
        .into_iter()
        .chain(unwrapped)
        .chain(flags)
        .chain(unambiguous)
        .filter(|field| output.amplitude || field.0 != "amplitude")
        .map(|(name, bits, meaning)| {
            let field = ResultField { name, low, bits, meaning };
            // The flags share a byte.
            low += if bits == 1 { 1 } else { bytes(bits) };
            field
        })
        .collect()
}

/// Width of the result word, a whole number of bytes.
pub fn result_bits(pipeline: &Pipeline) -> u32 {
    let last = result_fields(pipeline).pop().map_or(0, |field| field.low + field.bits);
    bytes(last)
}

struct FieldRow {
    bits: String,
    meaning: String,
}

#[derive(Template)]
#[template(path = "pipeline.v", escape = "none")]
struct Top {
    banner: String,
    prefix: String,
    width: usize,
    height: usize,
    scheme: String,
    frames_per_set: usize,
    latency: u32,
    fields: Vec<FieldRow>,
    sample_bus: String,
    sample_bits: u32,
    spare_sample_bits: bool,
    spare_sample_range: String,
    sample_range: String,
    result_bus: String,
    result_bits: u32,
    packing: Vec<String>,
    result_delay_bits: u32,
    drain_range: String,
    address_range: String,
    step_range: String,
    in_phase_range: String,
    quadrature_range: String,
    offset_sum_range: String,
    with_amplitude: bool,
    length_range: String,
    shift_range: String,
    phase_range: String,
    amplitude_range: String,
    offset_range: String,
    distance_range: String,
    unwrapping: bool,
    /// What the names of a pixel's results begin with, before those of the set before are combined with them.
    single: &'static str,
    unwrapped_range: String,
    unwrapped_bits: u32,
    wait_bits: u32,
    registers: bool,
    register_address_range: String,
    saturated_bit: String,
    phase_step_bits: u32,
    phase_step_range: String,
    minimum_amplitude: i64,
    minimum_amplitude_literal: String,
}

/// The parts of the result word's concatenation, highest first, gaps filled with zeros.
fn packing(pipeline: &Pipeline) -> Vec<String> {
    let mut parts = Vec::new();
    let mut top = result_bits(pipeline);
    for field in result_fields(pipeline).iter().rev() {
        let gap = top - field.low - field.bits;
        if gap > 0 {
            parts.push(format!("{gap}'d0,"));
        }
        parts.push(format!("result_{}{}", field.name, if field.low > 0 { "," } else { "" }));
        top = field.low;
    }
    parts
}

pub(super) fn pipeline(source: &Source, banner: String) -> askama::Result<String> {
    let (pipeline, derived) = (source.pipeline, source.pipeline.derived());
    let counters = Counters::new(source);
    let sample_bits = derived.sample.bits;
    let unwrapped_bits = derived.unwrapper.as_ref().map_or(0, |unwrapper| unwrapper.unwrapped.bits);
    let saturated = result_fields(pipeline).into_iter().find(|field| field.name == "saturated");
    let saturated_bit = saturated.map_or(0, |field| field.low);
    let rows: Vec<FieldRow> = result_fields(pipeline)
        .into_iter()
        .map(|field| FieldRow {
            bits: format!("{:>3}:{:<3}", field.low + field.bits - 1, field.low),
            meaning: field.meaning,
        })
        .collect();
    Top {
        banner,
        prefix: pipeline.prefix(),
        width: pipeline.sensor.width,
        height: pipeline.sensor.height,
        scheme: pipeline.modulation.scheme.name.to_string(),
        frames_per_set: derived.frames_per_set,
        latency: derived.latency_clocks,
        fields: rows,
        sample_bus: range(bytes(sample_bits)),
        sample_bits,
        spare_sample_bits: !sample_bits.is_multiple_of(8),
        spare_sample_range: format!("[{}:{sample_bits}]", bytes(sample_bits) - 1),
        sample_range: range(sample_bits),
        result_bus: range(result_bits(pipeline)),
        result_bits: result_bits(pipeline),
        packing: packing(pipeline),
        result_delay_bits: if unwrapped_bits > 0 { 6 } else { 4 } + derived.phase.bits,
        drain_range: range(counters.address_bits + 1),
        address_range: range(counters.address_bits),
        step_range: range(counters.step_bits),
        in_phase_range: range(derived.in_phase.bits),
        quadrature_range: range(derived.quadrature.bits),
        offset_sum_range: range(derived.offset_sum.bits),
        with_amplitude: pipeline.output.amplitude,
        length_range: range(derived.angle.length_word().bits),
        shift_range: range(derived.angle.shift_bits()),
        phase_range: range(derived.phase.bits),
        amplitude_range: range(derived.amplitude.bits),
        offset_range: range(derived.offset.bits),
        distance_range: range(derived.distance.bits),
        unwrapping: unwrapped_bits > 0,
        single: if unwrapped_bits > 0 { "single" } else { "result" },
        unwrapped_range: range(unwrapped_bits.max(1)),
        unwrapped_bits,
        wait_bits: 4
            + derived.offset.bits
            + if pipeline.output.amplitude { derived.amplitude.bits } else { 0 }
            + derived.phase.bits,
        registers: pipeline.registers.axi4_lite,
        register_address_range: range(ADDRESS_BITS),
        saturated_bit: format!("[{saturated_bit}]"),
        phase_step_bits: pipeline.modulation.phase_step_bits,
        phase_step_range: range(pipeline.modulation.phase_step_bits),
        minimum_amplitude: derived.minimum_amplitude,
        minimum_amplitude_literal: literal(derived.amplitude.bits, derived.minimum_amplitude),
    }
    .render()
}
