//! Template contexts of the CORDIC: one iteration, and all of them.

use super::Source;
use super::meta::Meta;
use super::text::literal;
use crate::spec::exact;
use askama::Template;

#[derive(Template)]
#[template(path = "cordic_stage.v", escape = "none")]
struct CordicStage {
    banner: String,
    prefix: String,
    x_bits: u32,
    angle_bits: u32,
    meta_bits: u32,
    fraction_bits: u32,
    angle_fraction_bits: u32,
}

pub(super) fn cordic_stage(source: &Source, banner: String) -> askama::Result<String> {
    let derived = source.pipeline.derived();
    CordicStage {
        banner,
        prefix: source.pipeline.prefix(),
        x_bits: derived.cordic_x.bits,
        angle_bits: derived.angle.bits,
        meta_bits: Meta::new(source).cordic_bits,
        fraction_bits: derived.fraction_bits,
        angle_fraction_bits: derived.angle.bits + 1,
    }
    .render()
}

struct Iteration {
    iteration: usize,
    before: usize,
    step: String,
    degrees: String,
    /// The wire of y: after the last iteration nobody needs it.
    y: String,
}

#[derive(Template)]
#[template(path = "cordic.v", escape = "none")]
struct Cordic {
    banner: String,
    prefix: String,
    stages: Vec<Iteration>,
    iterations: u32,
    gain: String,
    x_bits: u32,
    angle_bits: u32,
    meta_bits: u32,
    fraction_bits: u32,
    angle_fraction_bits: u32,
}

pub(super) fn cordic(source: &Source, banner: String) -> askama::Result<String> {
    let (pipeline, derived) = (source.pipeline, source.pipeline.derived());
    let iterations = pipeline.cordic.iterations;
    let angle_fraction_bits = derived.angle.bits + 1;
    let stages = (1..)
        .zip(&derived.angle_table)
        .map(|(iteration, &angle)| Iteration {
            iteration,
            before: iteration - 1,
            step: literal(derived.angle.bits, angle),
            degrees: format!("{:.6}", angle as f64 * 360.0 / f64::from(angle_fraction_bits).exp2()),
            y: if iteration == iterations as usize {
                "unused_y".to_owned()
            } else {
                format!("y_{iteration}")
            },
        })
        .collect();
    Cordic {
        banner,
        prefix: pipeline.prefix(),
        stages,
        iterations,
        gain: format!("{:.9}", exact::cordic_gain_f64(iterations)),
        x_bits: derived.cordic_x.bits,
        angle_bits: derived.angle.bits,
        meta_bits: Meta::new(source).cordic_bits,
        fraction_bits: derived.fraction_bits,
        angle_fraction_bits,
    }
    .render()
}
