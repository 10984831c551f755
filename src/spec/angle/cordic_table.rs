//! The table [cordic] of a specification.

use super::{Cordic, ONE_ITERATION_A_CLOCK, Rounding, Throughput};
use crate::fields::Fields;
use crate::problem::Result;

/// The table [cordic].
pub(in crate::spec) fn read_cordic(fields: &Fields) -> Result<Cordic> {
    fields.only(&[
        "iterations",
        "vector_guard_bits",
        "angle_guard_bits",
        "cycles_per_pixel",
        "pipeline_every",
        "normalise",
        "rounding",
    ])?;
    let cycles = format!("a whole number from 1 to 64, or \"{ONE_ITERATION_A_CLOCK}\"");
    let throughput = match fields.text("cycles_per_pixel", &cycles) {
        Ok(ONE_ITERATION_A_CLOCK) => Throughput::OneIterationAClock,
        _ if !fields.has("cycles_per_pixel") => Throughput::CyclesPerPixel(1),
        _ => Throughput::CyclesPerPixel(
            fields
                .integer("cycles_per_pixel", 1..=64)
                .map_err(|_| fields.refuse("cycles_per_pixel", &cycles))? as u32,
        ),
    };
    let roundings = ROUNDINGS.map(|(name, _)| name).join(" or ");
    let rounding = if fields.has("rounding") {
        let name = fields.text("rounding", &roundings)?;
        let known = ROUNDINGS.iter().find(|row| row.0 == name);
        known.ok_or_else(|| fields.refuse("rounding", &roundings))?.1
    } else {
        Rounding::Nearest
    };
    Ok(Cordic {
        iterations: fields.integer("iterations", 4..=30)? as u32,
        vector_guard_bits: fields.integer("vector_guard_bits", 0..=8)? as u32,
        angle_guard_bits: fields.integer("angle_guard_bits", 1..=8)? as u32,
        throughput,
        pipeline_every: fields.integer_or("pipeline_every", 1..=30, 1)? as u32,
        normalise: fields.flag_or("normalise", true)?,
        rounding,
    })
}

/// The table [cordic] as text.
pub(in crate::spec) fn write_cordic(cordic: &Cordic) -> String {
    let throughput = match cordic.throughput {
        Throughput::CyclesPerPixel(clocks) => clocks.to_string(),
        Throughput::OneIterationAClock => format!("\"{ONE_ITERATION_A_CLOCK}\""),
    };
    let rounding = ROUNDINGS.iter().find(|row| row.1 == cordic.rounding).map_or("", |row| row.0);
    format!(
        "[cordic]\niterations = {}\nvector_guard_bits = {}\nangle_guard_bits = {}\ncycles_per_pixel = {throughput}\n\
         pipeline_every = {}\nnormalise = {}\nrounding = \"{rounding}\"\n",
        cordic.iterations,
        cordic.vector_guard_bits,
        cordic.angle_guard_bits,
        cordic.pipeline_every,
        cordic.normalise,
    )
}

const ROUNDINGS: [(&str, Rounding); 2] = [("nearest", Rounding::Nearest), ("truncate", Rounding::Truncate)];
