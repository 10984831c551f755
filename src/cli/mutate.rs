//! `vuris mutate`

use super::generate::shown_spec;
use super::print::say;
use super::{agreement, progress};
use crate::artifact::{self, Artifact};
use crate::problem::Result;
use crate::proof::mutation::{self, Campaign, Tally};
use crate::proof::stimulus;
use crate::spec::Pipeline;
use clap::Args;
use std::path::PathBuf;
use std::process::ExitCode;

/// Per cent of the faults that a campaign must kill.
const LEAST_PERCENT: f64 = 98.0;

/// Put faults into the generated core, bit by bit, and count how many of them the test bench sees
#[derive(Debug, Args)]
pub(super) struct Mutate {
    /// Specification: a preset or a TOML file; its sensor is replaced by one of 6 x 5 pixels
    #[arg(long, value_name = "FILE|PRESET")]
    spec: String,
    /// Mutants of each module
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..=1000))]
    per_module: u32,
    /// Seed of the drawing and of the stimulus
    #[arg(long, default_value_t = 1)]
    seed: u32,
    /// Write the page of results to this folder, as mutation-SPEC.md
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Mutate {
    pub(super) fn run(self) -> Result<ExitCode> {
        let pipeline = Pipeline::named(&self.spec)?;
        let spec = shown_spec(&self.spec);
        let campaign = Campaign { per_module: self.per_module as usize, seed: self.seed.into(), prove: true };
        let trials = progress::counted("mutants", |advance| {
            mutation::run(&pipeline, campaign, &|small| stimulus(small, campaign.seed), advance)
        })?;
        let page = mutation::report(&spec, campaign, &trials);
        say!("{}", page.trim_end());
        if let Some(folder) = &self.out {
            artifact::write(folder, &[Artifact::new(format!("mutation-{}.md", pipeline.name), page)])?;
        }
        let percent = Tally::of(&trials).killed_percent();
        say!();
        say!(
            "{}: {percent:.1} % of the faults killed, more than {LEAST_PERCENT} % are required",
            pipeline.name
        );
        Ok(agreement(percent > LEAST_PERCENT))
    }
}
