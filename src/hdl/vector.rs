//! Template contexts from the sums to a normalised vector: scaling, shift stage, normaliser.

use super::Source;
use super::meta::Meta;
use super::text::{table, zero_extended};
use crate::model::{self, Sums};
use askama::Template;

#[derive(Template)]
#[template(path = "scaling.v", escape = "none")]
struct Scaling {
    banner: String,
    prefix: String,
    scheme: String,
    in_phase_factor: i64,
    quadrature_factor: i64,
    factor_error: String,
    rows: Vec<String>,
    in_phase_bits: u32,
    quadrature_bits: u32,
    x_bits: u32,
    y_bits: u32,
    meta_bits: u32,
}

pub(super) fn scaling(source: &Source, banner: String) -> askama::Result<String> {
    let (pipeline, derived) = (source.pipeline, source.pipeline.derived());
    let rows = [(1, 1), (derived.in_phase.max(), -1), (0, derived.quadrature.min() + 1)].map(
        |(in_phase, quadrature)| {
            let vector = model::scale(
                pipeline,
                Sums { in_phase: in_phase / 2, quadrature: quadrature / 2, ..Sums::default() },
            );
            [in_phase / 2, quadrature / 2, vector.x, vector.y].map(|value| value.to_string()).to_vec()
        },
    );
    Scaling {
        banner,
        prefix: pipeline.prefix(),
        scheme: pipeline.modulation.scheme.name.to_string(),
        in_phase_factor: derived.in_phase_factor,
        quadrature_factor: derived.quadrature_factor,
        factor_error: format!("{:.2e}", derived.factor_error),
        rows: table(&rows),
        in_phase_bits: derived.in_phase.bits,
        quadrature_bits: derived.quadrature.bits,
        x_bits: derived.x.bits,
        y_bits: derived.y.bits,
        meta_bits: Meta::new(source).vector_bits,
    }
    .render()
}

#[derive(Template)]
#[template(path = "shift_stage.v", escape = "none")]
struct ShiftStage {
    banner: String,
    prefix: String,
    bits: u32,
    shift_bits: u32,
    meta_bits: u32,
}

pub(super) fn shift_stage(source: &Source, banner: String) -> askama::Result<String> {
    let Meta { vector_bits, shift_bits, .. } = Meta::new(source);
    ShiftStage {
        banner,
        prefix: source.pipeline.prefix(),
        bits: source.pipeline.derived().normaliser.magnitude_bits,
        shift_bits,
        meta_bits: vector_bits + 4,
    }
    .render()
}

struct NormaliserStage {
    number: usize,
    before: usize,
    places: u32,
    shift_bit: u32,
}

#[derive(Template)]
#[template(path = "normaliser.v", escape = "none")]
struct Normaliser {
    banner: String,
    prefix: String,
    stages: Vec<NormaliserStage>,
    last: usize,
    clocks: u32,
    x_bits: u32,
    y_bits: u32,
    bits: u32,
    vector_bits: u32,
    fraction_bits: u32,
    shift_bits: u32,
    meta_bits: u32,
    drop_bits: u32,
    x_magnitude: String,
    y_magnitude: String,
    major_padded: String,
    minor_padded: String,
}

pub(super) fn normaliser(source: &Source, banner: String) -> askama::Result<String> {
    let derived = source.pipeline.derived();
    let normaliser = &derived.normaliser;
    let Meta { vector_bits: meta_bits, shift_bits, .. } = Meta::new(source);
    let stages: Vec<NormaliserStage> = (0..)
        .zip(&normaliser.shifts)
        .map(|(before, &places)| NormaliserStage {
            number: before + 1,
            before,
            places,
            shift_bit: places.trailing_zeros(),
        })
        .collect();
    let last = stages.len();
    let padded = |name: &str| match normaliser.pad_bits {
        0 => format!("{{1'b0, {name}_{last}}}"),
        zeros => format!("{{1'b0, {name}_{last}, {zeros}'d0}}"),
    };
    Normaliser {
        banner,
        prefix: source.pipeline.prefix(),
        last,
        clocks: 2 + last as u32 + u32::from(normaliser.drop_bits > 0),
        stages,
        x_bits: derived.x.bits,
        y_bits: derived.y.bits,
        bits: normaliser.magnitude_bits,
        vector_bits: derived.cordic_x.bits,
        fraction_bits: derived.fraction_bits,
        shift_bits,
        meta_bits,
        drop_bits: normaliser.drop_bits,
        x_magnitude: zero_extended("x_magnitude", derived.x.bits - 1, normaliser.magnitude_bits),
        y_magnitude: zero_extended("y_magnitude", derived.y.bits - 1, normaliser.magnitude_bits),
        major_padded: padded("major"),
        minor_padded: padded("minor"),
    }
    .render()
}
