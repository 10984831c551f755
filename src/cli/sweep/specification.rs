//! Between a specification, of a camera or of an angle unit by itself, and the configurations that a sweep makes of it.

use crate::problem::{Problem, Result};
use crate::spec::{AngleCore, AngleUnit, Design, Pipeline};
use crate::sweep::Configuration;

/// The modulation frequency at which the errors of a unit without a camera are given in mm, where no option says another.
const USUAL_FREQUENCY_HZ: f64 = 30e6;

/// The angle unit of `design`.
pub(super) fn unit_of(design: &Design) -> &AngleUnit {
    match design {
        Design::Pipeline(pipeline) => &pipeline.derived().angle,
        Design::Angle(core) => &core.unit,
    }
}

/// The modulation frequency of `design`.
pub(super) fn frequency_hz_of(design: &Design) -> f64 {
    match design {
        Design::Pipeline(pipeline) => pipeline.modulation.frequency_hz,
        Design::Angle(_) => USUAL_FREQUENCY_HZ,
    }
}

/// The camera whose noise is meant.
pub(super) fn camera_of(design: &Design) -> Result<&Pipeline> {
    match design {
        Design::Pipeline(pipeline) => Ok(pipeline),
        Design::Angle(core) => {
            Err(Problem::at("--add-noise", format_args!("{} is an angle unit by itself", core.name))
                .expected("the specification of a camera, whose phase steps make the noise")
                .remedy("give one with --spec, or ask for --error"))
        }
    }
}

/// The text of the specification of `design` with the angle unit of `configuration`.
pub(super) fn text_with(design: &Design, configuration: &Configuration) -> Result<String> {
    Ok(match design {
        Design::Pipeline(pipeline) => pipeline
            .adapted("the recommended specification", |specification| {
                specification.cordic = configuration.specification().cordic;
                specification.output.phase_bits = configuration.phase_bits;
            })?
            .to_toml(),
        Design::Angle(core) => AngleCore { name: core.name.clone(), unit: configuration.unit()? }.to_toml(),
    })
}
