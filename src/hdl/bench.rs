//! Test benches and vector files, from the tables of what is compared.

use super::Source;
use super::compared::{STAGES, TAP_BITS, channels, unwraps, vectors};
use super::control::Counters;
use super::golden::{Golden, GoldenAccess, StimulusWord};
use super::text::{banner, finished};
use super::top::{result_bits, result_fields};
use crate::artifact::Artifact;
use crate::model::{NextFrame, next_frame};
use crate::spec::Pipeline;
use askama::Template;
use std::fmt::Write;

/// A vector, as the bench's template takes it.
struct VectorRow {
    name: &'static str,
    bits: u32,
}

/// A channel, as the benches' templates take it.
struct ChannelRow {
    name: String,
    stage: usize,
    vector: &'static str,
    vector_number: usize,
    bits: u32,
    spare_bits: u32,
    probe: String,
    low: usize,
}

struct StageRow {
    name: &'static str,
    number: usize,
    strobe: &'static str,
    channels: Vec<ChannelRow>,
}

/// What all three bench files are rendered from.
struct Bench {
    banner: String,
    top: String,
    stages: Vec<StageRow>,
    vectors: Vec<VectorRow>,
    stage_count: usize,
    channel_bits: usize,
    records: usize,
    stimulus: usize,
    epochs: usize,
    rests: usize,
    announcements: usize,
    announcement_lines: usize,
    announcement_bits: u32,
    step_bits: u32,
    phase_step_bits: u32,
    /// What the sequencer tells after a reset, as Verilog and as C++ have it.
    first_announcement: String,
    first_announcement_value: u64,
    registers: bool,
    accesses: usize,
    access_lines: usize,
    frequency_factor: String,
    frequency_factor_value: u32,
    pixels: usize,
    width: usize,
    silence: u32,
    /// Bits of `s_axis_tuser`, and of a line of the stimulus.
    user_bits: u32,
    stimulus_bits: u32,
    sample_bus: u32,
    /// Ones for every bit of `s_axis_tdata` and of `s_axis_tuser`.
    sample_mask: u32,
    user_mask: u32,
    result_bits: u32,
    padding: String,
    refused: String,
}

#[derive(Template)]
#[template(path = "taps.v", escape = "none")]
struct Taps<'a> {
    bench: &'a Bench,
}

#[derive(Template)]
#[template(path = "testbench.v", escape = "none")]
struct Testbench<'a> {
    bench: &'a Bench,
}

#[derive(Template)]
#[template(path = "harness.cpp", escape = "none")]
struct Harness<'a> {
    bench: &'a Bench,
}

/// A literal with ones where the result word has no field.
fn padding(pipeline: &Pipeline) -> String {
    let bits = result_bits(pipeline);
    let fields = result_fields(pipeline);
    let within = |bit: u32| fields.iter().any(|field| (field.low..field.low + field.bits).contains(&bit));
    let digit =
        |digit: u32| (0..4).filter(|&bit| !within(4 * digit + bit)).map(|bit| 1_u32 << bit).sum::<u32>();
    let digits: String = (0..bits.div_ceil(4)).rev().map(|number| format!("{:x}", digit(number))).collect();
    format!("{bits}'h{digits}")
}

/// Where a register that holds nothing does not take what comes before it.
fn refused(pipeline: &Pipeline) -> String {
    let mut registers = vec![("dut.sums_valid", "dut.sums_taken"), ("dut.result_valid", "dut.advance")];
    // An angle unit that takes a vector a clock moves as one, unless its last word waits.
    if pipeline.derived().angle.clocks_a_vector(0) == 1 {
        registers.push(("dut.angle_valid", "dut.angle_ready"));
    }
    let terms = registers.iter().map(|(full, takes)| format!("(!{full} && !{takes})"));
    terms.collect::<Vec<_>>().join("\n      || ")
}

fn bench(source: &Source, golden: &Golden) -> Bench {
    let pipeline = source.pipeline;
    let channels = channels(pipeline);
    let stages = STAGES
        .iter()
        .enumerate()
        .map(|(number, stage)| StageRow {
            name: stage.name,
            number,
            strobe: stage.strobe,
            channels: channels
                .iter()
                .filter(|channel| channel.stage == number)
                .map(|channel| ChannelRow {
                    name: channel.name.clone(),
                    stage: channel.stage,
                    vector: channel.vector,
                    vector_number: vectors(pipeline).position(|row| row.name == channel.vector).unwrap_or(0),
                    bits: channel.word.bits,
                    spare_bits: TAP_BITS as u32 - channel.word.bits,
                    probe: channel.probe.clone(),
                    low: channel.low,
                })
                .collect(),
        })
        .collect();
    let vectors = vectors(pipeline)
        .map(|vector| {
            let word = (vector.word)(pipeline);
            VectorRow { name: vector.name, bits: word.bits }
        })
        .collect();
    let (step_bits, phase_step_bits) = (Counters::new(source).step_bits, pipeline.modulation.phase_step_bits);
    let user_bits = if unwraps(pipeline) { 3 } else { 2 };
    let sample_bus = pipeline.derived().sample.bits.next_multiple_of(8);
    let first_announcement = announcement_word(source, next_frame(pipeline, 0));
    Bench {
        banner: String::new(),
        top: pipeline.top(),
        stages,
        vectors,
        stage_count: STAGES.len(),
        channel_bits: channels.len() * TAP_BITS,
        records: golden.records.len(),
        stimulus: golden.stimulus.len(),
        epochs: golden.epochs.len(),
        rests: golden.rests.len(),
        announcements: golden.announcements.len(),
        announcement_lines: golden.announcements.len().max(1),
        announcement_bits: 1 + step_bits + phase_step_bits,
        step_bits,
        phase_step_bits,
        first_announcement: format!("{}'h{first_announcement:x}", 1 + step_bits + phase_step_bits),
        first_announcement_value: first_announcement,
        registers: pipeline.registers.axi4_lite,
        accesses: golden.accesses.len(),
        access_lines: golden.accesses.len().max(1),
        frequency_factor: format!("32'd{}", pipeline.registers.frequency_factor),
        frequency_factor_value: pipeline.registers.frequency_factor,
        pixels: pipeline.geometry().pixels(),
        width: pipeline.sensor.width,
        silence: pipeline.sensor.line_blanking_clocks,
        user_bits,
        stimulus_bits: stimulus_bits(pipeline),
        sample_bus,
        sample_mask: (1 << sample_bus) - 1,
        user_mask: (1 << user_bits) - 1,
        result_bits: result_bits(pipeline),
        padding: padding(pipeline),
        refused: refused(pipeline),
    }
}

/// Bits of a line of the stimulus: one more where a set has one of two frequencies.
fn stimulus_bits(pipeline: &Pipeline) -> u32 {
    if unwraps(pipeline) { 21 } else { 20 }
}

/// `{first of a set, phase step, its phase}`, as the benches have it.
fn announcement_word(source: &Source, next: NextFrame) -> u64 {
    let phase_bits = source.pipeline.modulation.phase_step_bits;
    let above = u64::from(next.first) << Counters::new(source).step_bits | next.step as u64;
    above << phase_bits | next.phase as u64
}

/// The benches' files, for the vectors of `golden`.
pub fn bench_artifacts(source: &Source, golden: &Golden) -> Vec<Artifact> {
    let mut bench = bench(source, golden);
    let mut file = |path: &str, purpose: &str, render: fn(&Bench) -> askama::Result<String>| {
        bench.banner = banner(source.spec, purpose);
        Artifact::new(path, finished(render(&bench)))
    };
    vec![
        file(
            "tb/bench_taps.v",
            "The core with its stages' values led out, for the Verilator bench.",
            |bench| Taps { bench }.render(),
        ),
        file("tb/testbench.v", "Self-checking test bench for any Verilog simulator.", |bench| {
            Testbench { bench }.render()
        }),
        file("tb/harness.cpp", "Self-checking test bench for Verilator.", |bench| Harness { bench }.render()),
    ]
}

/// One value a line, in hexadecimal, as `$readmemh` reads it.
pub(super) fn hex(note: &str, bits: u32, values: impl Iterator<Item = u64>) -> String {
    let digits = bits.div_ceil(4) as usize;
    let mut text = format!("// {note}\n");
    for value in values {
        // Writing into a string cannot fail.
        let _ = writeln!(text, "{value:0digits$x}");
    }
    text
}

/// `values`, or `count` zeros where there are none: a file without a line makes simulators warn.
fn padded(values: impl Iterator<Item = u64>, count: usize) -> impl Iterator<Item = u64> {
    let mut values = values.peekable();
    let zeros = if values.peek().is_some() { 0 } else { count };
    values.chain(std::iter::repeat_n(0, zeros))
}

/// The vectors' files.
pub fn vector_artifacts(source: &Source, golden: &Golden) -> Vec<Artifact> {
    let pipeline = source.pipeline;
    let note = |what: String| format!("Generated by `vuris generate --spec {}`: {what}", source.spec);
    let frequency = if unwraps(pipeline) { "second frequency, " } else { "" };
    let stimulus_note = note(format!(
        "{{{frequency}operation, end of line, start of set, start of frame, code[15:0]}}; 9nnnn a pause of n clocks, a0000 reset, b0000 rest, c0000 access"
    ));
    let stimulus = golden.stimulus.iter().map(|&StimulusWord(word)| u64::from(word));
    let epochs = golden.epochs.iter().flat_map(|epoch| [epoch.records as u64, epoch.announcements as u64]);
    let mut artifacts = vec![
        Artifact::new("vectors/stimulus.hex", hex(&stimulus_note, stimulus_bits(pipeline), stimulus)),
        Artifact::new(
            "vectors/epochs.hex",
            hex(
                &note("results and announcements due before each reset, and at the end".to_owned()),
                32,
                epochs,
            ),
        ),
    ];
    let rests =
        golden.rests.iter().flat_map(|rest| [rest.due as u64, rest.done.into(), rest.discarded.into()]);
    artifacts.push(Artifact::new(
        "vectors/rests.hex",
        hex(&note("at each rest: results due so far, sets done, sets discarded".to_owned()), 32, rests),
    ));
    let announcement_bits = 1 + Counters::new(source).step_bits + pipeline.modulation.phase_step_bits;
    let announcements = golden.announcements.iter().map(|&next| announcement_word(source, next));
    artifacts.push(Artifact::new(
        "vectors/announcements.hex",
        hex(
            &note("what the sequencer tells, in order: {first of a set, phase step, its phase}".to_owned()),
            announcement_bits,
            padded(announcements, 1),
        ),
    ));
    if pipeline.registers.axi4_lite {
        let note = note(
            "each access to a register: {write, okay, counter[3:0], strobes[3:0], address[7:0]}, written, read (or the frequency factor then)"
                .to_owned(),
        );
        let words = golden.accesses.iter().flat_map(|access| access.words());
        artifacts
            .push(Artifact::new("vectors/accesses.hex", hex(&note, 32, padded(words, GoldenAccess::WORDS))));
    }
    for vector in vectors(pipeline) {
        let word = (vector.word)(pipeline);
        let kind = if word.signed { "signed" } else { "unsigned" };
        let text = hex(
            &note(format!(
                "{}, {} bits {kind}, a line a pixel in the order of the results",
                vector.name, word.bits
            )),
            word.bits,
            golden.records.iter().map(|record| word.pattern((vector.value)(record))),
        );
        artifacts.push(Artifact::new(format!("vectors/{}.hex", vector.name), text));
    }
    artifacts
}
