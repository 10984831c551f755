//! Between a camera's specification and its angle unit.

use crate::problem::Result;
use crate::spec::{Pipeline, Rounding, Throughput};
use crate::sweep::Configuration;

/// The angle unit of `pipeline`.
pub(super) fn configuration_of(pipeline: &Pipeline) -> Configuration {
    let (derived, cordic) = (pipeline.derived(), &pipeline.cordic);
    Configuration {
        metric: pipeline.modulation.scheme.irrational.squared(),
        x_bits: derived.in_phase.bits,
        y_bits: derived.quadrature.bits,
        phase_bits: pipeline.output.phase_bits,
        length_bits: 0,
        iterations: cordic.iterations,
        vector_guard_bits: cordic.vector_guard_bits,
        angle_guard_bits: cordic.angle_guard_bits,
        throughput: Throughput::CyclesPerPixel(1),
        pipeline_every: 1,
        normaliser: true,
        rounding: Rounding::Nearest,
    }
}

/// `pipeline` with the angle unit of `configuration`.
pub(super) fn with(pipeline: &Pipeline, configuration: &Configuration) -> Result<Pipeline> {
    pipeline.adapted("the recommended specification", |specification| {
        specification.cordic.iterations = configuration.iterations;
        specification.cordic.vector_guard_bits = configuration.vector_guard_bits;
        specification.cordic.angle_guard_bits = configuration.angle_guard_bits;
        specification.output.phase_bits = configuration.phase_bits;
    })
}
