//! Template contexts of the modules that compute: scaling, normaliser, CORDIC, phase, amplitude, offset, distance.

use super::Source;
use super::text::{counter_bits, literal, range, table, zero_extended};
use crate::model::{self, Sums};
use crate::spec::{ScaledConstant, Word, exact};
use askama::Template;

/// Widths of what travels beside the data.
pub(super) struct Meta {
    /// First, last, saturated and the offset sum, up to the normaliser.
    pub vector_bits: u32,
    /// With zero, octant and shift, through the CORDIC.
    pub cordic_bits: u32,
    /// The shift count.
    pub shift_bits: u32,
}

impl Meta {
    pub(super) fn new(source: &Source) -> Self {
        let derived = source.pipeline.derived();
        let vector_bits = 3 + derived.offset_sum.bits;
        let shift_bits = derived.normaliser.shifts.len() as u32;
        Self { vector_bits, cordic_bits: vector_bits + 4 + shift_bits, shift_bits }
    }
}

#[derive(Template)]
#[template(path = "scaling.v", escape = "none")]
struct Scaling {
    banner: String,
    prefix: String,
    scheme: &'static str,
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
        scheme: pipeline.modulation.scheme.name,
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

#[derive(Template)]
#[template(path = "phase.v", escape = "none")]
struct Phase {
    banner: String,
    prefix: String,
    angle_bits: u32,
    guard_bits: u32,
    phase_bits: u32,
}

pub(super) fn phase(source: &Source, banner: String) -> askama::Result<String> {
    let (pipeline, derived) = (source.pipeline, source.pipeline.derived());
    Phase {
        banner,
        prefix: pipeline.prefix(),
        angle_bits: derived.angle.bits,
        guard_bits: pipeline.cordic.angle_guard_bits,
        phase_bits: derived.phase.bits,
    }
    .render()
}

/// Bits of a constant's multiplier.
fn factor_bits(factor: ScaledConstant) -> u32 {
    Word::holding(0, factor.multiplier).bits
}

#[derive(Template)]
#[template(path = "amplitude.v", escape = "none")]
struct Amplitude {
    banner: String,
    prefix: String,
    fraction_bits: u32,
    multiplier: i64,
    factor_shift: u32,
    exponent: i64,
    gain: String,
    divisor: i64,
    rows: Vec<String>,
    x_bits: u32,
    shift_bits: u32,
    factor_bits: u32,
    amplitude_bits: u32,
    places_range: String,
    spare_bits: bool,
    factor: String,
    places: String,
}

pub(super) fn amplitude(source: &Source, banner: String) -> askama::Result<String> {
    let (pipeline, derived) = (source.pipeline, source.pipeline.derived());
    let factor = derived.amplitude_factor;
    let shift_bits = Meta::new(source).shift_bits;
    let factor_bits = factor_bits(factor);
    let product_bits = derived.cordic_x.bits + factor_bits;
    let least_places = factor.shift - 1;
    let places_bits = counter_bits(least_places as usize + (1 << shift_bits) - 1);
    let rows = [(1.2, 0), (2.0, 3), (1.0, derived.normaliser.magnitude_bits - 1)].map(|(x, shift)| {
        let x = (x * f64::from(derived.fraction_bits).exp2()) as i64;
        let amplitude = model::amplitude(pipeline, x, shift, false);
        vec![x.to_string(), shift.to_string(), amplitude.to_string()]
    });
    Amplitude {
        banner,
        prefix: pipeline.prefix(),
        fraction_bits: pipeline.output.amplitude_fraction_bits,
        multiplier: factor.multiplier,
        factor_shift: factor.shift,
        exponent: i64::from(pipeline.output.amplitude_fraction_bits)
            + i64::from(derived.normaliser.magnitude_bits)
            - 1
            - i64::from(derived.fraction_bits),
        gain: format!("{:.9}", exact::cordic_gain_f64(pipeline.cordic.iterations)),
        divisor: pipeline.modulation.scheme.gain
            * derived.in_phase_factor
            * pipeline.modulation.frames_per_step as i64,
        rows: table(&rows),
        x_bits: derived.cordic_x.bits,
        shift_bits,
        factor_bits,
        amplitude_bits: derived.amplitude.bits,
        places_range: range(places_bits),
        spare_bits: product_bits > derived.amplitude.bits + 1,
        factor: literal(product_bits, factor.multiplier),
        places: format!(
            "{} + {}",
            zero_extended("shift_i", shift_bits, places_bits),
            literal(places_bits, least_places.into())
        ),
    }
    .render()
}

#[derive(Template)]
#[template(path = "offset.v", escape = "none")]
struct Offset {
    banner: String,
    prefix: String,
    fraction_bits: u32,
    divisor: i64,
    multiplier: i64,
    factor_shift: u32,
    rows: Vec<String>,
    sum_bits: u32,
    offset_bits: u32,
    sum: String,
    factor: String,
}

pub(super) fn offset(source: &Source, banner: String) -> askama::Result<String> {
    let (pipeline, derived) = (source.pipeline, source.pipeline.derived());
    let factor = derived.offset_factor;
    let product_bits = derived.offset.bits + factor.shift;
    let divisor = pipeline.modulation.scheme.offset_gain() * pipeline.modulation.frames_per_step as i64;
    let rows = [divisor, 100 * divisor + 1, derived.sample.max() * divisor]
        .map(|sum| vec![sum.to_string(), model::offset(pipeline, sum).to_string()]);
    Offset {
        banner,
        prefix: pipeline.prefix(),
        fraction_bits: pipeline.output.offset_fraction_bits,
        divisor,
        multiplier: factor.multiplier,
        factor_shift: factor.shift,
        rows: table(&rows),
        sum_bits: derived.offset_sum.bits,
        offset_bits: derived.offset.bits,
        sum: zero_extended("sum_i", derived.offset_sum.bits, product_bits),
        factor: literal(product_bits, factor.multiplier),
    }
    .render()
}

#[derive(Template)]
#[template(path = "distance.v", escape = "none")]
struct Distance {
    banner: String,
    prefix: String,
    range_m: String,
    frequency_hz: f64,
    unit_m: f64,
    multiplier: i64,
    factor_shift: u32,
    rows: Vec<String>,
    phase_bits: u32,
    distance_bits: u32,
    phase: String,
    factor: String,
}

pub(super) fn distance(source: &Source, banner: String) -> askama::Result<String> {
    let (pipeline, derived) = (source.pipeline, source.pipeline.derived());
    let factor = derived.distance_factor;
    let product_bits = derived.distance.bits + factor.shift;
    let quarter = 1 << (derived.phase.bits - 2);
    let rows = [1, quarter, derived.phase.max()]
        .map(|phase| vec![phase.to_string(), model::distance(pipeline, phase).to_string()]);
    Distance {
        banner,
        prefix: pipeline.prefix(),
        range_m: format!("{:.6}", crate::units::unambiguous_range_m(pipeline.modulation.frequency_hz)),
        frequency_hz: pipeline.modulation.frequency_hz,
        unit_m: pipeline.output.distance_unit_m,
        multiplier: factor.multiplier,
        factor_shift: factor.shift,
        rows: table(&rows),
        phase_bits: derived.phase.bits,
        distance_bits: derived.distance.bits,
        phase: zero_extended("phase_i", derived.phase.bits, product_bits),
        factor: literal(product_bits, factor.multiplier),
    }
    .render()
}
