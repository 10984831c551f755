//! `vuris study`

use super::print::say;
use super::progress;
use crate::artifact::write_file;
use crate::frames::Geometry;
use crate::problem::Result;
use crate::study::{Study as Plan, Summary, page};
use clap::Args;
use std::path::PathBuf;
use std::process::ExitCode;

/// Diagnose simulated campaigns (clean, with each effect at several strengths, with two, with unknown ones), and count how often the answer is right
#[derive(Debug, Args)]
pub(super) struct Study {
    /// Campaigns without any effect
    #[arg(long, value_name = "N", default_value_t = 200)]
    nulls: usize,
    /// Campaigns of each effect and strength
    #[arg(long, value_name = "N", default_value_t = 2)]
    repeats: usize,
    /// Campaigns with two effects
    #[arg(long, value_name = "N", default_value_t = 24)]
    pairs: usize,
    /// Campaigns of each effect that the registry has not, and strength
    #[arg(long, value_name = "N", default_value_t = 2)]
    unknowns: usize,
    /// Seed of the first campaign
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write the page to this folder, as study.md
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Small campaigns: what counts is the strength in standard deviations.
const SIZE: Geometry = Geometry { width: 12, height: 10 };

impl Study {
    pub(super) fn run(self) -> Result<ExitCode> {
        let Self { nulls, repeats, pairs, unknowns, seed, out } = self;
        let plan = Plan { size: SIZE, seed, nulls, repeats, pairs, unknowns };
        let cases = plan.cases()?;
        let outcomes = progress::counted("campaigns", |tell| {
            let outcome = |(number, case): (usize, &crate::study::Case)| {
                let outcome = case.run(SIZE);
                tell(number + 1, cases.len());
                outcome
            };
            cases.iter().enumerate().map(outcome).collect::<Result<Vec<_>>>()
        })?;
        let command = format!(
            "vuris study --nulls {nulls} --repeats {repeats} --pairs {pairs} --unknowns {unknowns} --seed {seed} --out docs"
        );
        let text = page(&plan, &Summary::of(cases.iter().zip(&outcomes)), &command);
        match out {
            None => say!("{}", text.trim_end()),
            Some(folder) => {
                let file = folder.join("study.md");
                write_file(&file, &text)?;
                say!("written: {}", file.display());
            }
        }
        Ok(ExitCode::SUCCESS)
    }
}
