//! `vuris generate`

use super::print::{counted, say};
use super::{agreement, golden_of_preset, progress};
use crate::artifact::{self, Difference};
use crate::hdl::{Source, all_artifacts, angle_core_artifacts, angle_stimulus};
use crate::package::{angle_package_artifacts, package_artifacts};
use crate::problem::Result;
use crate::report::resources;
use crate::spec::{Design, Pipeline};
use crate::synthesis::{Baseline, Target};
use clap::Args;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Write Verilog, test benches, golden vectors, a package and an integration guide from a specification
#[derive(Debug, Args)]
pub(super) struct Generate {
    /// Specification: a preset (vuris, vuris-fast, vuris-four-frame, angle-16, angle-16-folded, angle-16-iterative, angle-16-poly, angle-16-poly-memory) or a TOML file
    #[arg(long, value_name = "FILE|PRESET")]
    spec: String,
    /// Folder to write to, or to check
    #[arg(long, value_name = "DIR", default_value = "generated")]
    out: PathBuf,
    /// Write nothing: compare the folder with what would be written (missing, stale, surplus files)
    #[arg(long)]
    check: bool,
}

/// Seed of the vectors of an angle unit's bench.
const ANGLE_SEED: u64 = 1;

/// What a banner calls the specification: a preset's name, or a file's without its folder, with nothing that could end a
/// comment.
pub(super) fn shown_spec(spec: &str) -> String {
    let name = Path::new(spec).file_name().and_then(|name| name.to_str()).unwrap_or(spec);
    name.chars().map(|c| if c.is_ascii_graphic() && c != '`' && c != '\\' { c } else { '_' }).collect()
}

/// `argument` as a shell takes it for one word.
fn quoted(argument: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./:".contains(c);
    if argument.chars().all(plain) {
        argument.to_owned()
    } else {
        format!("'{}'", argument.replace('\'', "'\\''"))
    }
}

/// The table of what synthesis has found for this very core, where `vuris synth` has written it to `folder`.
fn measured(folder: &Path, pipeline: &Pipeline, spec: &str) -> Result<Vec<String>> {
    let Some(baseline) = Baseline::read(&folder.join("synthesis.json"))? else { return Ok(Vec::new()) };
    let target = Target::of_pipeline(pipeline, spec)?;
    Ok(resources(&baseline, &target.name, &target.verilog.digest()))
}

impl Generate {
    pub(super) fn run(self) -> Result<ExitCode> {
        let spec = shown_spec(&self.spec);
        let (name, artifacts) = match Design::named(&self.spec)? {
            Design::Pipeline(pipeline) => {
                let source = Source { pipeline: &pipeline, spec: &spec };
                let golden = progress::during("running the model", || golden_of_preset(&pipeline))?;
                let mut artifacts = all_artifacts(&source, &golden);
                let resources = measured(&self.out, &pipeline, &spec)?;
                artifacts.extend(package_artifacts(&source, &artifacts, &resources));
                (pipeline.name.clone(), artifacts)
            }
            Design::Angle(core) => {
                let vectors = angle_stimulus(&core.unit, ANGLE_SEED);
                let mut artifacts = angle_core_artifacts(&core, &spec, &vectors);
                artifacts.extend(angle_package_artifacts(&core, &spec, &artifacts));
                (core.name.clone(), artifacts)
            }
        };
        if !self.check {
            artifact::write(&self.out, &artifacts)?;
            say!("{}: {} files of specification {}", self.out.display(), artifacts.len(), name);
            return Ok(ExitCode::SUCCESS);
        }
        let differences = artifact::differences(&self.out, &artifacts)?;
        for difference in &differences {
            say!("{difference}");
        }
        let strangers =
            |difference: &&Difference| matches!(difference, Difference::Surplus { generated: false, .. });
        if differences.is_empty() {
            say!("{}: {} files are up to date", self.out.display(), artifacts.len());
        } else if differences.iter().filter(strangers).count() == differences.len() {
            say!(
                "{}: all {} generated files are up to date, beside files to remove",
                self.out.display(),
                artifacts.len()
            );
        } else {
            say!(
                "{}: {} differ; `vuris generate --spec {} --out {}` writes them",
                self.out.display(),
                counted(differences.len(), "file"),
                quoted(&self.spec),
                quoted(&self.out.to_string_lossy())
            );
        }
        Ok(agreement(differences.is_empty()))
    }
}
