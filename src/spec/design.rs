//! What can be generated: a whole pipeline, or an angle unit by itself.

use super::angle::{ANGLE_FORMAT, AngleCore};
use super::presets::{ANGLE_PRESETS, PRESETS};
use super::{Pipeline, file};
use crate::problem::Result;

/// A specification of either kind.
#[derive(Debug, Clone, PartialEq)]
pub enum Design {
    /// A camera's pipeline.
    Pipeline(Box<Pipeline>),
    /// An angle unit.
    Angle(Box<AngleCore>),
}

impl Design {
    /// Reads the preset or the TOML file called `name`; its `format` says which kind it is.
    pub fn named(name: &str) -> Result<Self> {
        if let Some(preset) = ANGLE_PRESETS.iter().find(|preset| preset.name == name) {
            return Ok(Self::Angle(Box::new(AngleCore::parse(preset.name, preset.text)?)));
        }
        if let Some(preset) = PRESETS.iter().find(|preset| preset.name == name) {
            return Ok(Self::Pipeline(Box::new(Pipeline::parse(preset.name, preset.text)?)));
        }
        let names: Vec<&str> = PRESETS.iter().chain(ANGLE_PRESETS).map(|preset| preset.name).collect();
        let text = file::read(name, &names.join(", "))?;
        let is_angle = text
            .parse::<toml::Table>()
            .is_ok_and(|table| table.get("format").and_then(toml::Value::as_str) == Some(ANGLE_FORMAT));
        Ok(if is_angle {
            Self::Angle(Box::new(AngleCore::parse(name, &text)?))
        } else {
            Self::Pipeline(Box::new(Pipeline::parse(name, &text)?))
        })
    }
}
