//! `vuris coverage`

use super::generate::shown_spec;
use super::print::say;
use super::{agreement, progress, scene_sets};
use crate::artifact::{self, Artifact};
use crate::cosim::standard;
use crate::hdl::Segment;
use crate::problem::{Problem, Result};
use crate::proof::coverage::{self, Kind};
use crate::proof::small;
use crate::spec::Pipeline;
use clap::Args;
use std::path::PathBuf;
use std::process::ExitCode;

/// Per cent of the lines, and of the bits, that the scenario must meet.
const LEAST_PERCENT: f64 = 98.0;

/// Count which lines of the generated core run, and which of its bits move, in what `vuris verify` drives it with
#[derive(Debug, Args)]
pub(super) struct Coverage {
    /// Specification: a preset or a TOML file; its sensor is replaced by one of 6 x 5 pixels
    #[arg(long, value_name = "FILE|PRESET")]
    spec: String,
    /// Seed of random frames, pauses and stops
    #[arg(long, default_value_t = 1)]
    seed: u32,
    /// Write the page of results to this folder, as coverage-SPEC.md
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Coverage {
    pub(super) fn run(self) -> Result<ExitCode> {
        let whole = Pipeline::named(&self.spec)?;
        // Every bit of a full-size memory is a point of its own: counting them takes the build more than ten minutes.
        let pipeline = small(&whole)?;
        let seed = u64::from(self.seed);
        let mut scenario = standard(&pipeline, seed);
        let (raw, _) = scene_sets(&pipeline, 1, Some(seed))?;
        scenario.segments.push(Segment::of_sets("simulated scene", &raw));
        let points = progress::during("verilator: counting lines and bits", || {
            coverage::measure(&pipeline, &scenario)
        })?;
        let page = coverage::report(&format!("--spec {} --seed {seed}", shown_spec(&self.spec)), &points);
        say!("{}", page.trim_end());
        if let Some(folder) = &self.out {
            artifact::write(folder, &[Artifact::new(format!("coverage-{}.md", whole.name), page)])?;
        }
        let needless = coverage::needless(&points);
        if !needless.is_empty() {
            return Err(Problem::at(
                "src/proof/coverage/exclusion.rs",
                format_args!("{needless:?} exclude nothing"),
            )
            .expected("only exclusions that are needed")
            .remedy("take the rows out of EXCLUSIONS"));
        }
        let [lines, bits] = [Kind::Line, Kind::Toggle].map(|kind| coverage::share(&points, kind).percent());
        say!();
        say!(
            "{}: {lines:.1} % of lines, {bits:.1} % of bits; more than {LEAST_PERCENT} % of each are required",
            whole.name
        );
        Ok(agreement(lines > LEAST_PERCENT && bits > LEAST_PERCENT))
    }
}
