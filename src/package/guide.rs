//! The integration guide: what an engineer needs on one page.

use super::lists::{Packaged, file};
use super::ports::{Direction, ports};
use super::timing::{Timing, diagrams};
use super::wave::Diagram;
use crate::artifact::Artifact;
use crate::hdl::{result_bits, result_fields};
use crate::report::escaped;
use crate::spec::Pipeline;
use crate::units::unambiguous_range_m;
use askama::Template;

struct PortRow {
    name: String,
    direction: &'static str,
    bits: u32,
    meaning: String,
    at_reset: String,
}

struct FieldRow {
    name: &'static str,
    bits: String,
    meaning: String,
}

#[derive(Template)]
#[template(path = "integration.md", escape = "none")]
struct Guide {
    mark: String,
    top: String,
    core: String,
    width: usize,
    height: usize,
    pixels: usize,
    adc_bits: u32,
    saturation: i64,
    scheme: String,
    steps: String,
    frames_per_step: usize,
    frames_per_set: usize,
    frequency_mhz: f64,
    range_m: String,
    silence: u32,
    ports: Vec<PortRow>,
    result_bits: u32,
    fields: Vec<FieldRow>,
    minimum_amplitude: i64,
    diagrams: Vec<Diagram>,
    latency: u32,
    timing: Timing,
    with_amplitude: bool,
    normalised: bool,
    phase_codes: String,
    phase_mrad: String,
    amplitude: String,
    offset: String,
    distance: String,
    memory_word_bits: u32,
    memory_bits: usize,
    resources: Vec<String>,
}

/// The guide's file; `resources`: the lines of a table of what synthesis has found, or none.
pub(super) fn artifact(of: &Packaged, pipeline: &Pipeline, resources: &[String]) -> Artifact {
    let (derived, sensor, modulation) = (pipeline.derived(), &pipeline.sensor, &pipeline.modulation);
    let (timing, budget) = (Timing::new(pipeline), pipeline.budget());
    let bound = |relative: f64| format!("0.5 codes + {relative:.1e} of it");
    let ports = ports(pipeline).into_iter().map(|port| PortRow {
        name: port.name,
        direction: match port.direction {
            Direction::Input => "in",
            Direction::Output => "out",
        },
        bits: port.bits,
        meaning: port.meaning,
        at_reset: match (port.at_reset, port.direction) {
            (Some(value), _) => value.to_string(),
            (None, Direction::Output) => "–".to_owned(),
            (None, Direction::Input) => String::new(),
        },
    });
    let fields = result_fields(pipeline).into_iter().map(|field| FieldRow {
        name: field.name,
        bits: match field.bits {
            1 => field.low.to_string(),
            bits => format!("{}:{}", field.low + bits - 1, field.low),
        },
        meaning: field.meaning,
    });
    let guide = Guide {
        mark: escaped(&of.mark()),
        top: pipeline.top(),
        core: of.core(),
        width: sensor.width,
        height: sensor.height,
        pixels: pipeline.geometry().pixels(),
        adc_bits: sensor.adc_bits,
        saturation: sensor.saturation_dn,
        scheme: modulation.scheme.name.to_string(),
        steps: modulation.scheme.steps_in_words(),
        frames_per_step: modulation.frames_per_step,
        frames_per_set: derived.frames_per_set,
        frequency_mhz: modulation.frequency_hz / 1e6,
        range_m: format!("{:.3}", unambiguous_range_m(modulation.frequency_hz)),
        silence: sensor.line_blanking_clocks,
        ports: ports.collect(),
        result_bits: result_bits(pipeline),
        fields: fields.collect(),
        minimum_amplitude: derived.minimum_amplitude,
        diagrams: diagrams(pipeline),
        latency: derived.latency_clocks,
        timing,
        with_amplitude: pipeline.output.amplitude,
        normalised: derived.angle.cordic.normalise,
        phase_codes: format!("{:.3}", budget.phase_codes()),
        phase_mrad: format!("{:.4}", 1e3 * budget.phase_rad()),
        amplitude: bound(budget.amplitude_relative),
        offset: bound(budget.offset_relative),
        distance: bound(budget.distance_relative),
        memory_word_bits: derived.memory_word_bits,
        memory_bits: derived.memory_bits,
        resources: resources.to_vec(),
    };
    file("integration.md", guide.render())
}
