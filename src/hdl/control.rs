//! Template contexts of the modules that move data: stream register, delay, framing.

use super::Source;
use super::text::counter_bits;
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
