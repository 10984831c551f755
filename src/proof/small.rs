//! The specification and the stimulus of mutants and proofs: the preset's words, on a sensor of a few pixels.

use crate::cosim::{random_sets, standard};
use crate::frames::RawSets;
use crate::hdl::{Scenario, Segment};
use crate::problem::Result;
use crate::spec::Pipeline;

/// Columns of the small sensor: not a power of two, so that a column's counter wraps before its word does.
const COLUMNS: usize = 6;
/// Lines of the small sensor.
const LINES: usize = 5;
/// The shortest blanking that a specification may have is 16 clocks; it is not a power of two either.
const BLANKING_CLOCKS: u32 = 20;

/// `pipeline` with all its words and a sensor of 6 x 5 pixels.
pub fn small(pipeline: &Pipeline) -> Result<Pipeline> {
    pipeline.adapted("small", |specification| {
        specification.sensor.width = COLUMNS;
        specification.sensor.height = LINES;
        specification.sensor.line_blanking_clocks = BLANKING_CLOCKS;
    })
}

/// Sets whose pixels lie in every octave of amplitude: pixel and set choose how many bits the codes spread over, around any
/// mean. What only a weak vector or a certain shift shows, shows here.
pub fn octaves(pipeline: &Pipeline, seed: u64, sets: usize) -> RawSets {
    let base = random_sets(pipeline, seed, sets);
    let bits = pipeline.sensor.adc_bits as usize;
    let (pixels, frames) = (pipeline.geometry().pixels(), pipeline.derived().frames_per_set);
    let full_scale = (1_u32 << bits) - 1;
    let means = random_sets(pipeline, seed + 1, sets);
    let codes = base.codes().iter().enumerate().map(|(number, &code)| {
        let (set, pixel) = (number / (pixels * frames), number % pixels);
        let spread = (1_u32 << ((set * 7 + pixel) % bits + 1)) - 1;
        // All frames of a pixel share one mean.
        let mean = means.codes()[set * pixels * frames + pixel];
        (mean.min(full_scale - spread)) + (code & spread)
    });
    RawSets::new(base.geometry(), frames, codes.collect()).expect("as many codes as there were before")
}

/// What mutants are driven with: everything that `vuris verify` uses without a scene, sets of every octave of amplitude, and
/// codes that the stream's bytes can carry and the converter cannot make.
pub fn stimulus(pipeline: &Pipeline, seed: u64) -> Scenario {
    let mut scenario = standard(pipeline, seed);
    scenario.segments.push(Segment::of_sets("every octave", &octaves(pipeline, seed + 200, OCTAVE_SETS)));
    let raw = random_sets(pipeline, seed + 100, 2);
    let largest = (1_u32 << pipeline.sensor.adc_bits.next_multiple_of(8)) - 1;
    let full_scale = (1_u32 << pipeline.sensor.adc_bits) - 1;
    let beyond = raw.codes().iter().enumerate().map(|(number, &code)| match number % 3 {
        0 => code,
        // One bit above the converter's, and nothing else.
        1 => ((full_scale + 1) << (number % 5)).min(largest) & !full_scale,
        _ => largest - code,
    });
    let beyond = RawSets::new(raw.geometry(), raw.frames_per_set(), beyond.collect())
        .expect("as many codes as there were before");
    scenario.segments.push(Segment::of_sets("codes beyond full scale", &beyond));
    scenario
}

/// Enough for every octave to meet every pixel a few times.
const OCTAVE_SETS: usize = 36;
