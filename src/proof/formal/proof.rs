//! The proofs: property files, and what each needs to know of a specification.

use super::equal;
use crate::artifact::Artifact;
use crate::hdl::{Source, result_bits, result_fields, rtl_artifacts};
use crate::problem::{Problem, Result};
use crate::spec::{Pipeline, Word};
use std::fmt::Write;

/// A property file with its constants.
#[derive(Debug, Clone, Copy)]
pub struct Proof {
    /// Its name, the file's.
    pub name: &'static str,
    /// What it is about.
    pub purpose: &'static str,
    /// The file.
    pub(super) text: &'static str,
    /// The Verilog around which it stands.
    pub(super) rtl: fn(&Pipeline) -> Result<Vec<Artifact>>,
    /// Macros that come before it.
    pub(super) definitions: fn(&Pipeline) -> String,
    /// Yosys commands that change parameters of modules that the file does not instantiate itself.
    pub(super) setup: fn(&Pipeline) -> String,
    /// Properties that are proved up to so many clocks after power-up; all others are proved for ever.
    pub bounded: &'static [(usize, u32)],
    /// Clocks within which every cover must be reached.
    pub(super) cover_clocks: fn(&Pipeline) -> u32,
}

/// All proofs.
pub const PROOFS: &[Proof] = &[
    Proof {
        name: "stream",
        purpose: "the stream register keeps the rules of AXI4-Stream, loses, repeats and reorders nothing, and holds two words at most",
        text: include_str!("../../../formal/stream.sv"),
        rtl: core,
        definitions: |pipeline| {
            define("STREAM_REGISTER", format_args!("{}_stream_register", pipeline.prefix()))
        },
        setup: nothing,
        bounded: &[],
        cover_clocks: |_| 30,
    },
    Proof {
        name: "framing",
        purpose: "a set that drains is whole and in sequence, whatever came before; counters; no sum is replaced before it has drained",
        text: include_str!("../../../formal/framing.sv"),
        rtl: core,
        definitions: framing,
        setup: nothing,
        bounded: &[],
        cover_clocks: |_| 120,
    },
    sums_of_pixel("sums-0", |pipeline| sums(pipeline, 0)),
    sums_of_pixel("sums-1", |pipeline| sums(pipeline, 1)),
    sums_of_pixel("sums-2", |pipeline| sums(pipeline, 2)),
    sums_of_pixel("sums-3", |pipeline| sums(pipeline, 3)),
    Proof {
        name: "pipeline",
        purpose: "the core's results keep the rules of AXI4-Stream; nothing lies between their fields; stalled clocks are counted",
        text: include_str!("../../../formal/pipeline.sv"),
        rtl: core,
        definitions: whole,
        setup: nothing,
        bounded: &[],
        cover_clocks: cover_of_results,
    },
    equal::PAIRS[0],
    equal::PAIRS[1],
];

/// The proof of one pixel's sums, of four.
const fn sums_of_pixel(name: &'static str, definitions: fn(&Pipeline) -> String) -> Proof {
    Proof {
        name,
        purpose: "what drains for a pixel is the exact sum of weight times sample: no overflow, nothing stale, after sets that broke off too",
        text: include_str!("../../../formal/sums.sv"),
        rtl: |pipeline| {
            provable_sums(pipeline)?;
            core(pipeline)
        },
        definitions,
        setup: small_memory,
        bounded: &[],
        cover_clocks: cover_of_sums,
    }
}

impl Proof {
    /// The bits of the file's list `bad` or `seen` and what they say, from the comments beside them.
    pub fn names(&self, list: &str) -> Vec<(usize, String)> {
        let block =
            self.text.split(&format!("] {list} = {{")).nth(1).and_then(|rest| rest.split("};").next());
        let comments =
            block.unwrap_or("").lines().filter_map(|line| line.split_once("// ")).map(|(_, comment)| comment);
        let mut names: Vec<(usize, String)> = comments
            .filter_map(|comment| comment.trim().split_once(' '))
            .filter_map(|(number, what)| Some((number.parse().ok()?, what.trim().to_owned())))
            .collect();
        names.sort();
        names
    }
}

/// The whole core.
fn core(pipeline: &Pipeline) -> Result<Vec<Artifact>> {
    Ok(rtl_artifacts(&Source { pipeline, spec: "proof" }))
}

pub(super) fn nothing(_: &Pipeline) -> String {
    String::new()
}

/// A memory of four pixels, as the proof's accumulator has; its words are wider than the proof's, and zero there.
fn small_memory(pipeline: &Pipeline) -> String {
    format!("chparam -set WORDS 4 -set ADDRESS_BITS 2 {}_sum_memory\n", pipeline.prefix())
}

pub(super) fn define(name: &str, value: impl std::fmt::Display) -> String {
    format!("`define {name} {value}\n")
}

fn framing(pipeline: &Pipeline) -> String {
    let several = pipeline.modulation.frames_per_step > 1;
    let parameters = if several { define("REPEAT_PARAMETERS", 1) } else { String::new() };
    define("FRAMING", format_args!("{}_framing", pipeline.prefix()))
        + &define("REPEATS", if several { 2 } else { 1 })
        + &parameters
}

/// Bits of a sample in the proof of the sums: the words are derived from it as the specification derives them from the ADC's.
const SAMPLE_BITS: u32 = 1;

/// Least and greatest in-phase, quadrature and offset sum of samples of [`SAMPLE_BITS`].
fn sum_bounds(pipeline: &Pipeline) -> [(i64, i64); 3] {
    let scheme = &pipeline.modulation.scheme;
    let scale = Word::unsigned(SAMPLE_BITS).max() * pipeline.modulation.frames_per_step as i64;
    [&scheme.in_phase, &scheme.quadrature, &scheme.offset].map(|weights| {
        let total = |sign: i64| weights.iter().filter(|&&weight| weight * sign > 0).sum::<i64>() * scale;
        (total(-1), total(1))
    })
}

fn bits((low, high): (i64, i64)) -> u32 {
    Word::holding(low, high).bits
}

/// Raw frames of a set beyond which the proof of its sums is not tried: every question is as deep as a set is long. Five take half a minute
/// a pixel on an idle machine; ten are not decided in five minutes.
const MOST_FRAMES: usize = 8;

/// A set of four pixels, and what it takes to drain and to begin another.
fn cover_of_sums(pipeline: &Pipeline) -> u32 {
    4 * pipeline.derived().frames_per_set as u32 + 60
}

/// A set of eight pixels, the way of its first result through the core, and some clocks in which results wait.
fn cover_of_results(pipeline: &Pipeline) -> u32 {
    let derived = pipeline.derived();
    8 * derived.frames_per_set as u32 + derived.latency_clocks + 120
}

/// Weights beyond which samples are multiplied: the observer would have to prove a multiplier again.
const LARGEST_WEIGHT: i64 = 15;

/// Refuses sums whose proof does not end.
fn provable_sums(pipeline: &Pipeline) -> Result<()> {
    let frames = pipeline.derived().frames_per_set;
    let scheme = &pipeline.modulation.scheme;
    let weights = [&scheme.in_phase, &scheme.quadrature, &scheme.offset];
    let largest = weights.into_iter().flat_map(|weights| weights.iter()).map(|weight| weight.abs()).max();
    let place = "the proof of the sums";
    if frames > MOST_FRAMES {
        return Err(Problem::at(place, format_args!("{frames} raw frames a set"))
            .expected(format_args!("at most {MOST_FRAMES}: beyond, no answer comes within minutes"))
            .remedy("prove the same specification with a smaller modulation.frames_per_step, or choose other proofs by --proof"));
    }
    if largest.is_some_and(|weight| weight > LARGEST_WEIGHT) {
        return Err(Problem::at(place, format_args!("a weight of {}", largest.unwrap_or(0)))
            .expected(format_args!(
                "at most {LARGEST_WEIGHT}: products by weights of a table are not decided within minutes"
            ))
            .remedy("choose other proofs by --proof; `vuris verify` compares these sums bit by bit"));
    }
    Ok(())
}

fn sums(pipeline: &Pipeline, pixel: u32) -> String {
    let scheme = &pipeline.modulation.scheme;
    let [in_phase, quadrature, offset] = sum_bounds(pipeline);
    // What is kept in place of the sums has parameters of its own.
    let storage = &pipeline.derived().storage;
    let scale = Word::unsigned(SAMPLE_BITS).max() * pipeline.modulation.frames_per_step as i64;
    let own = storage.sums.iter().filter(|_| !storage.is_plain());
    let kept: String = own
        .map(|sum| {
            let bits = Word::holding(0, sum.weights.iter().sum::<i64>() * scale).bits;
            format!(" .{}_BITS({bits}),", sum.name.to_uppercase())
        })
        .collect();
    let steps = scheme.steps();
    let frames = pipeline.derived().frames_per_set as i64;
    // The observer's words: signed, and each a bit wider than the widest sum.
    let wide = [in_phase, quadrature, offset].map(bits).into_iter().max().unwrap_or(1) + 1;
    let mut weights = String::new();
    for step in 0..steps {
        let (i, q, o) = (scheme.in_phase[step], scheme.quadrature[step], scheme.offset[step]);
        // Writing into a string cannot fail.
        let _ = write!(
            weights,
            " {step}: begin in_phase_term = {i} * code; quadrature_term = {q} * code; offset_term = {o} * code; end"
        );
    }
    weights += " default: begin in_phase_term = 0; quadrature_term = 0; offset_term = 0; end";
    [
        define("PIXEL", pixel),
        define("ACCUMULATOR", format_args!("{}_accumulator", pipeline.prefix())),
        define("SAMPLE_BITS", SAMPLE_BITS),
        define("IN_PHASE_BITS", bits(in_phase)),
        define("QUADRATURE_BITS", bits(quadrature)),
        define("OFFSET_BITS", bits(offset)),
        define("KEPT_PARAMETERS", kept),
        define("WIDE_BITS", wide),
        define("FRAME_BITS", Word::holding(0, frames - 1).bits),
        define("STEPS", steps),
        define("STEP_BITS", Word::holding(0, steps as i64 - 1).bits),
        define("REPEATS", pipeline.modulation.frames_per_step),
        define("OFFSET_MAX", offset.1),
        define("IN_PHASE_MIN", format_args!("({})", in_phase.0)),
        define("QUADRATURE_MAX", quadrature.1),
        define("WEIGHTS", weights),
    ]
    .concat()
}

/// A literal with a 1 for every bit of the result that no field has.
pub(in crate::proof) fn padding(pipeline: &Pipeline) -> String {
    let bits = result_bits(pipeline);
    let fields = result_fields(pipeline);
    let within = |bit: u32| fields.iter().any(|field| (field.low..field.low + field.bits).contains(&bit));
    let padding: String = (0..bits).rev().map(|bit| if within(bit) { '0' } else { '1' }).collect();
    format!("{bits}'b{padding}")
}

fn whole(pipeline: &Pipeline) -> String {
    define("PIPELINE", pipeline.top())
        + &define("SAMPLE_BUS", pipeline.derived().sample.bits.next_multiple_of(8))
        + &define("RESULT_BITS", result_bits(pipeline))
        + &define("PADDING", padding(pipeline))
}
