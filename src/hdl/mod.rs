//! Specification and model to text: Verilog from templates, golden vectors, test benches, file lists.
//!
//! One template a module, in `hdl-templates/`; values arrive there finished.

mod accumulator;
mod angle;
mod bench;
mod compared;
mod control;
mod golden;
mod polar;
mod poly;
mod registers;
mod rom;
mod sequencer;
mod text;
mod top;
mod unwrapping;

pub use angle::{AngleSource, angle_core_artifacts, angle_stimulus};
pub use bench::{bench_artifacts, vector_artifacts};
pub use compared::{Channel, STAGES, VECTORS, channels};
pub use golden::{Epoch, Golden, GoldenAccess, Rest, Scenario, Segment, StimulusWord};
pub use top::{ResultField, result_bits, result_fields};

use crate::artifact::Artifact;
use crate::spec::Pipeline;
use angle::ANGLE_MODULES;

/// What every template is rendered from.
#[derive(Debug, Clone, Copy)]
pub struct Source<'a> {
    /// The pipeline.
    pub pipeline: &'a Pipeline,
    /// What `--spec` was given, for the banner.
    pub spec: &'a str,
}

/// A hardware module: one template, one file.
struct Module {
    /// Its noun: name of the template, of the model's function, and of the Verilog module after the prefix.
    noun: &'static str,
    /// One sentence, the first line of its file.
    purpose: &'static str,
    /// Whether a pipeline has it.
    belongs: fn(&Pipeline) -> bool,
    render: fn(&Source, String) -> askama::Result<String>,
}

const fn always(_: &Pipeline) -> bool {
    true
}

/// All modules around the angle unit, in the order in which the data meets them.
const MODULES: &[Module] = &[
    Module {
        noun: "stream_register",
        purpose: "A stream's register that can stop.",
        belongs: always,
        render: control::stream_register,
    },
    Module {
        noun: "delay",
        purpose: "A word's way beside a computation.",
        belongs: always,
        render: control::delay,
    },
    Module {
        noun: "framing",
        purpose: "Which pixel of which phase step a beat is, and whether its set can be trusted.",
        belongs: always,
        render: control::framing,
    },
    Module {
        noun: "sequencer",
        purpose: "The order of the phase steps, and which of them the next raw frame must have.",
        belongs: always,
        render: sequencer::sequencer,
    },
    Module {
        noun: "sum_memory",
        purpose: "The sums of all pixels.",
        belongs: always,
        render: accumulator::sum_memory,
    },
    Module {
        noun: "accumulator",
        purpose: "In-phase, quadrature and offset sums of every pixel, added while frames arrive.",
        belongs: always,
        render: accumulator::accumulator,
    },
    Module {
        noun: "amplitude",
        purpose: "The amplitude of a turned vector, its gains undone.",
        belongs: |pipeline| pipeline.output.amplitude,
        render: polar::amplitude,
    },
    Module { noun: "offset", purpose: "The offset of a pixel.", belongs: always, render: polar::offset },
    Module {
        noun: "unwrapping",
        purpose: "The phases of two modulation frequencies combined to one over a longer range.",
        belongs: |pipeline| pipeline.derived().unwrapper.is_some(),
        render: unwrapping::unwrapping,
    },
    Module {
        noun: "distance",
        purpose: "The distance of a phase.",
        belongs: always,
        render: polar::distance,
    },
    Module {
        noun: "registers",
        purpose: "Registers for a processor, over AXI4-Lite.",
        belongs: |pipeline| pipeline.registers.axi4_lite,
        render: registers::registers,
    },
];

/// What travels beside a pixel's vector through the angle unit: first, last, saturated and the offset sum; where the pipeline
/// unwraps, also the set's frequency and whether it has a partner.
fn beside_bits(pipeline: &Pipeline) -> u32 {
    let unwrapping_bits = if pipeline.derived().unwrapper.is_some() { 2 } else { 0 };
    unwrapping_bits + 3 + pipeline.derived().offset_sum.bits
}

/// The modules below the top of `pipeline`: noun and purpose, in the order in which they are listed.
pub fn modules(pipeline: &Pipeline) -> Vec<(&'static str, &'static str)> {
    let own = MODULES.iter().filter(|module| (module.belongs)(pipeline));
    let architecture = pipeline.derived().angle.architecture;
    let angle = ANGLE_MODULES.iter().filter(|module| (module.belongs)(architecture));
    own.map(|module| (module.noun, module.purpose))
        .chain(angle.map(|module| (module.noun, module.purpose)))
        .collect()
}

/// The nouns of all modules that any pipeline has, in the order in which they are listed.
pub fn module_nouns() -> impl Iterator<Item = &'static str> {
    let mut nouns: Vec<&'static str> = MODULES.iter().map(|module| module.noun).collect();
    // Another architecture's module of the same noun is the same row.
    for module in ANGLE_MODULES {
        if !nouns.contains(&module.noun) {
            nouns.push(module.noun);
        }
    }
    nouns.into_iter()
}

/// The Verilog files of the angle unit alone, its top module `<prefix>_angle` last, and the file list; for tables
/// and multipliers the ECP5's own, with a list of its own.
pub fn angle_artifacts(source: &AngleSource, spec: &str) -> Vec<Artifact> {
    let mut artifacts = angle_files(source, spec);
    let top = format!("{}_angle", source.prefix);
    let list = file_list(&artifacts, &top, spec);
    if let Some(multiplier) = poly::ecp5_artifact(source, spec) {
        // The same core with the ECP5's own multiplier.
        let text = list.text.replace(&multiplier.path.replace("ecp5/", "rtl/"), &multiplier.path);
        artifacts.extend([Artifact::new("ecp5/files.f", text), multiplier]);
    }
    artifacts.push(list);
    artifacts
}

fn angle_files(source: &AngleSource, spec: &str) -> Vec<Artifact> {
    let belong = ANGLE_MODULES.iter().filter(|module| (module.belongs)(source.unit.architecture));
    belong
        .map(|module| {
            let text = (module.render)(source, text::banner(spec, module.purpose));
            Artifact::new(format!("rtl/{}_{}.v", source.prefix, module.noun), text::finished(text))
        })
        .collect()
}

fn file_list(artifacts: &[Artifact], top: &str, spec: &str) -> Artifact {
    let list: String = artifacts.iter().map(|artifact| format!("{}\n", artifact.path)).collect();
    let note = format!(
        "// Generated by `vuris generate --spec {spec}`: the core's Verilog-2005 files, the top module {top} last.\n"
    );
    Artifact::new("rtl/files.f", note + &list)
}

/// The Verilog files, the top module last, and the file list.
pub fn rtl_artifacts(source: &Source) -> Vec<Artifact> {
    let pipeline = source.pipeline;
    let prefix = pipeline.prefix();
    let mut artifacts: Vec<Artifact> = MODULES
        .iter()
        .filter(|module| (module.belongs)(pipeline))
        .map(|module| {
            let text = (module.render)(source, text::banner(source.spec, module.purpose));
            Artifact::new(format!("rtl/{prefix}_{}.v", module.noun), text::finished(text))
        })
        .collect();
    let angle =
        AngleSource { prefix: &prefix, unit: &pipeline.derived().angle, meta_bits: beside_bits(pipeline) };
    artifacts.extend(angle_files(&angle, source.spec));
    let banner = text::banner(source.spec, "The whole pipeline.");
    let top = pipeline.top();
    artifacts.push(Artifact::new(format!("rtl/{top}.v"), text::finished(top::pipeline(source, banner))));
    artifacts.push(file_list(&artifacts, &top, source.spec));
    artifacts
}

/// The specification as it was used, all defaults written out.
fn specification_artifact(source: &Source) -> Artifact {
    let note = format!(
        "# Generated by `vuris generate --spec {}`: the specification, defaults written out.\n",
        source.spec
    );
    Artifact::new("rtl/specification.toml", note + &source.pipeline.to_toml())
}

/// Everything that `vuris generate` writes.
pub fn all_artifacts(source: &Source, golden: &Golden) -> Vec<Artifact> {
    let mut artifacts = rtl_artifacts(source);
    artifacts.push(specification_artifact(source));
    artifacts.extend(registers::map_artifacts(source));
    artifacts.extend(bench_artifacts(source, golden));
    artifacts.extend(vector_artifacts(source, golden));
    artifacts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::PRESETS;

    #[test]
    fn every_module_of_a_pipeline_is_instantiated() {
        for name in PRESETS {
            let pipeline = Pipeline::named(name.name).unwrap();
            let artifacts = rtl_artifacts(&Source { pipeline: &pipeline, spec: name.name });
            let prefix = pipeline.prefix();
            for (noun, _) in modules(&pipeline) {
                let instance = format!("  {prefix}_{noun} ");
                assert!(artifacts.iter().any(|artifact| artifact.text.contains(&instance)), "{noun}");
            }
        }
    }

    #[test]
    fn the_text_is_clean() {
        for name in ["vuris", "vuris-four-frame"] {
            let pipeline = Pipeline::named(name).unwrap();
            for artifact in rtl_artifacts(&Source { pipeline: &pipeline, spec: name }) {
                assert!(
                    artifact.text.ends_with('\n') && !artifact.text.ends_with("\n\n"),
                    "{}",
                    artifact.path
                );
                for (number, line) in artifact.text.lines().enumerate() {
                    assert_eq!(line, line.trim_end(), "{}:{}", artifact.path, number + 1);
                    assert!(line.is_ascii() && !line.contains('\t'), "{}:{}", artifact.path, number + 1);
                }
            }
        }
    }
}
