//! What `vuris synth` measures: the presets' whole pipelines, and bare cores.

use super::accuracy::Accuracy;
use super::design::Design;
use crate::hdl::{Source, rtl_artifacts};
use crate::problem::Result;
use crate::spec::{PRESETS, Pipeline};
use serde::{Deserialize, Serialize};

/// A design with a name, and what is known of it without synthesis.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// Its name in tables, files and on the command line.
    pub name: String,
    /// What it is, in a few words.
    pub purpose: String,
    /// What it is compared with.
    pub kind: Kind,
    /// The Verilog.
    pub design: Design,
    /// Clocks from an input that is taken to its result, from the specification.
    pub latency_clocks: Option<u32>,
    /// Clocks from one input to the next, from the specification.
    pub clocks_per_sample: Option<u32>,
    /// How exact it is, where that has been measured.
    pub accuracy: Option<Accuracy>,
}

/// What a target is compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A whole camera pipeline: with nothing.
    Pipeline,
    /// A vector's angle alone: with the public cores.
    AngleCore {
        /// Bits of either coordinate.
        input_bits: u32,
        /// Bits of the phase.
        phase_bits: u32,
        /// Whether it gives the vector's length too.
        amplitude: bool,
    },
    /// Anything else: with nothing.
    Other,
}

impl Target {
    /// The whole pipeline of `pipeline`, generated as `spec`.
    pub fn of_pipeline(pipeline: &Pipeline, spec: &str) -> Result<Self> {
        let artifacts = rtl_artifacts(&Source { pipeline, spec });
        let verilog = artifacts.into_iter().filter(|artifact| artifact.path.ends_with(".v")).collect();
        let (sensor, scheme) = (&pipeline.sensor, &pipeline.modulation.scheme.name);
        Ok(Self {
            name: pipeline.name.clone(),
            purpose: format!(
                "whole pipeline, {} x {} pixels of {} bits, scheme {scheme}",
                sensor.width, sensor.height, sensor.adc_bits
            ),
            kind: Kind::Pipeline,
            design: Design::new(&pipeline.top(), "clk_i", verilog)?,
            latency_clocks: Some(pipeline.derived().latency_clocks),
            clocks_per_sample: Some(1),
            accuracy: None,
        })
    }

    /// The table: all presets' pipelines.
    pub fn all() -> Result<Vec<Self>> {
        PRESETS.iter().map(|preset| Self::of_pipeline(&Pipeline::named(preset.name)?, preset.name)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_have_names_of_their_own() {
        let targets = Target::all().unwrap();
        for (number, target) in targets.iter().enumerate() {
            assert!(targets[..number].iter().all(|other| other.name != target.name), "{}", target.name);
        }
        assert!(targets.iter().any(|target| target.kind == Kind::Pipeline));
    }
}
