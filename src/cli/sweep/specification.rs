//! Between a camera's specification and its angle unit.

use crate::problem::Result;
use crate::spec::Pipeline;
use crate::sweep::Configuration;

/// The angle unit of `pipeline`.
pub(super) fn configuration_of(pipeline: &Pipeline) -> Configuration {
    Configuration::of(&pipeline.derived().angle)
}

/// `pipeline` with the angle unit of `configuration`.
pub(super) fn with(pipeline: &Pipeline, configuration: &Configuration) -> Result<Pipeline> {
    pipeline.adapted("the recommended specification", |specification| {
        specification.cordic = configuration.specification().cordic;
        specification.output.phase_bits = configuration.phase_bits;
    })
}
