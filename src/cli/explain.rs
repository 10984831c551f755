//! `vuris explain`

use super::generate::shown_spec;
use super::print::say;
use crate::package::numbers;
use crate::problem::Result;
use crate::report::explanation;
use crate::spec::Pipeline;
use clap::Args;
use std::process::ExitCode;

/// Print every derived number of a pipeline: word widths and why, latency, memory, worst-case errors
#[derive(Debug, Args)]
pub(super) struct Explain {
    /// Specification: a preset (vuris, vuris-four-frame) or a TOML file
    #[arg(long, value_name = "FILE|PRESET")]
    spec: String,
    /// Print the specification instead, as a TOML file with every default written out
    #[arg(long)]
    toml: bool,
    /// Print the numbers for programs, as JSON
    #[arg(long, conflicts_with = "toml")]
    json: bool,
}

impl Explain {
    pub(super) fn run(self) -> Result<ExitCode> {
        let pipeline = Pipeline::named(&self.spec)?;
        if self.toml {
            say!("{}", pipeline.to_toml().trim_end());
        } else if self.json {
            let made_by = format!("vuris explain --spec {} --json", shown_spec(&self.spec));
            say!("{}", numbers(&pipeline, &made_by).trim_end());
        } else {
            say!("{}", explanation(&pipeline).trim_end());
        }
        Ok(ExitCode::SUCCESS)
    }
}
