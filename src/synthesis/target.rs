//! What `vuris synth` measures: the presets' whole pipelines, and bare cores.

use super::accuracy::Accuracy;
use super::verilog::Verilog;
use crate::artifact::Artifact;
use crate::hdl::{AngleSource, Source, angle_artifacts, rtl_artifacts};
use crate::problem::Result;
use crate::spec::{ANGLE_PRESETS, AngleCore, Architecture, Design, PRESETS, Pipeline};
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
    pub verilog: Verilog,
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
        let verilog = verilog_of(artifacts);
        let (sensor, scheme) = (&pipeline.sensor, &pipeline.modulation.scheme.name);
        Ok(Self {
            name: pipeline.name.clone(),
            purpose: format!(
                "whole pipeline, {} x {} pixels of {} bits, scheme {scheme}",
                sensor.width, sensor.height, sensor.adc_bits
            ),
            kind: Kind::Pipeline,
            verilog: Verilog::new(&pipeline.top(), "clk_i", verilog)?,
            latency_clocks: Some(pipeline.derived().latency_clocks),
            clocks_per_sample: Some(pipeline.derived().angle.clocks_a_vector(0)),
            accuracy: None,
        })
    }

    /// The bare angle unit of `core`, generated as `spec`, with one bit that travels beside the vector: the least.
    pub fn of_angle(core: &AngleCore, spec: &str) -> Result<Self> {
        let unit = &core.unit;
        let source = AngleSource { prefix: &core.prefix(), unit, meta_bits: 1 };
        let form = match unit.architecture {
            Architecture::Unrolled => "unrolled",
            Architecture::Folded { .. } => "folded",
            Architecture::Iterative => "iterative",
            Architecture::Tables => "tables and multipliers",
        };
        Ok(Self {
            name: core.name.clone(),
            purpose: format!("angle core, {form}"),
            kind: Kind::AngleCore {
                input_bits: unit.x_bits.max(unit.y_bits),
                phase_bits: unit.phase_bits,
                amplitude: unit.with_length(),
            },
            verilog: Verilog::new(&core.top(), "clk_i", verilog_of(angle_artifacts(&source, spec)))?,
            latency_clocks: Some(unit.latency_clocks()),
            clocks_per_sample: Some(unit.clocks_a_vector(0)),
            accuracy: None,
        })
    }

    /// What the preset or TOML file `name` specifies, generated as `spec`.
    pub fn named(name: &str, spec: &str) -> Result<Self> {
        match Design::named(name)? {
            Design::Pipeline(pipeline) => Self::of_pipeline(&pipeline, spec),
            Design::Angle(core) => Self::of_angle(&core, spec),
        }
    }

    /// The table: all presets, pipelines and bare angle cores.
    pub fn all() -> Result<Vec<Self>> {
        PRESETS.iter().chain(ANGLE_PRESETS).map(|preset| Self::named(preset.name, preset.name)).collect()
    }
}

/// Of generated files, the Verilog of the core; benches are none of it.
fn verilog_of(artifacts: Vec<Artifact>) -> Vec<Artifact> {
    let is_core = |artifact: &Artifact| artifact.path.starts_with("rtl/") && artifact.path.ends_with(".v");
    artifacts.into_iter().filter(is_core).collect()
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
