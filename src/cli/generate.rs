//! `vuris generate`

use super::{agreement, golden_of_preset, progress};
use crate::artifact;
use crate::hdl::{Source, all_artifacts};
use crate::problem::Result;
use crate::spec::Pipeline;
use clap::Args;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Write Verilog, test benches, golden vectors and a file list from a specification
#[derive(Debug, Args)]
pub(super) struct Generate {
    /// Specification: a preset (vuris, vuris-four-frame) or a TOML file
    #[arg(long, value_name = "FILE|PRESET")]
    spec: String,
    /// Folder to write to, or to check
    #[arg(long, value_name = "DIR", default_value = "generated")]
    out: PathBuf,
    /// Write nothing: compare the folder with what would be written (missing, stale, surplus files)
    #[arg(long)]
    check: bool,
}

/// What a banner calls the specification: a preset's name, or a file's without its folder.
pub(super) fn shown_spec(spec: &str) -> &str {
    Path::new(spec).file_name().and_then(|name| name.to_str()).unwrap_or(spec)
}

impl Generate {
    pub(super) fn run(self) -> Result<ExitCode> {
        let pipeline = Pipeline::named(&self.spec)?;
        let source = Source { pipeline: &pipeline, spec: shown_spec(&self.spec) };
        let golden = progress::during("running the model", || golden_of_preset(&pipeline))?;
        let artifacts = all_artifacts(&source, &golden);
        if !self.check {
            artifact::write(&self.out, &artifacts)?;
            println!("{}: {} files of specification {}", self.out.display(), artifacts.len(), pipeline.name);
            return Ok(ExitCode::SUCCESS);
        }
        let differences = artifact::differences(&self.out, &artifacts)?;
        for difference in &differences {
            println!("{difference}");
        }
        if differences.is_empty() {
            println!("{}: {} files are up to date", self.out.display(), artifacts.len());
        } else {
            println!(
                "{}: {} files differ; `vuris generate --spec {} --out {}` writes them",
                self.out.display(),
                differences.len(),
                self.spec,
                self.out.display()
            );
        }
        Ok(agreement(differences.is_empty()))
    }
}
