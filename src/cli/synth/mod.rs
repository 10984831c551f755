//! `vuris synth`

mod exactness;

use super::generate::shown_spec;
use super::print::{counted, say};
use super::{agreement, progress};
use crate::artifact::{self, Artifact, Difference};
use crate::problem::{Problem, Result};
use crate::report;
use crate::spec::Design;
use crate::synthesis::{
    Baseline, Change, Effort, Family, Flow, Kind, LIMIT_PERCENT, Measured, Target, Verilog, measure,
};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Synthesise, place and route: look-up tables, registers, block RAM and clock frequency on ECP5 and iCE40
///
/// Without --target, --family, --spec and --top it measures every target on both families, compares their areas with
/// synthesis.json of the folder, and writes that file and synthesis.md anew.
#[derive(Debug, Args)]
pub(super) struct Synth {
    /// Folder of synthesis.json and synthesis.md
    #[arg(long, value_name = "DIR", default_value = "generated")]
    out: PathBuf,
    /// Only these targets: print and compare them, write nothing (may be repeated)
    #[arg(long, value_name = "NAME")]
    target: Vec<String>,
    /// Only this family: print and compare, write nothing
    #[arg(long, value_enum)]
    family: Option<FamilyArgument>,
    /// Seeds of the placement, from 1 to this one
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    seeds: u32,
    /// Tools that run at the same time [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
    /// Take the measured areas for the baseline, however much they changed
    #[arg(long, conflicts_with_all = ["target", "family", "spec", "top", "check"])]
    accept: bool,
    /// Run no tool: say which targets have other Verilog than when they were measured, and whether synthesis.md is of
    /// synthesis.json
    #[arg(long, conflicts_with_all = ["target", "family", "spec", "top"])]
    check: bool,
    /// Measure the pipeline of this specification instead, a preset or a TOML file, and print it
    #[arg(long, value_name = "FILE|PRESET", conflicts_with_all = ["target", "top"])]
    spec: Option<String>,
    /// Measure this module of the Verilog files instead, and print it
    #[arg(long, value_name = "MODULE", requires = "files", conflicts_with = "target")]
    top: Option<String>,
    /// Clock input of --top
    #[arg(long, value_name = "PORT", default_value = "clk_i", requires = "top")]
    clock: String,
    /// Verilog files of --top, and data that they read
    #[arg(value_name = "FILE", requires = "top")]
    files: Vec<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FamilyArgument {
    /// Lattice ECP5, LFE5U-25F-6
    Ecp5,
    /// Lattice iCE40 HX8K
    Ice40,
}

impl From<FamilyArgument> for Family {
    fn from(argument: FamilyArgument) -> Self {
        match argument {
            FamilyArgument::Ecp5 => Self::Ecp5,
            FamilyArgument::Ice40 => Self::Ice40,
        }
    }
}

const JSON: &str = "synthesis.json";
const MARKDOWN: &str = "synthesis.md";

impl Synth {
    pub(super) fn run(self) -> Result<ExitCode> {
        if self.check {
            return self.check();
        }
        let mut targets = self.targets()?;
        let flow = progress::during("starting the tools", Flow::find)?;
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let effort = Effort {
            families: self.family.map_or(Family::ALL.to_vec(), |family| vec![family.into()]),
            seeds: (1..=self.seeds).collect(),
            jobs: self.jobs.map_or(cores, usize::from),
        };
        for target in &mut targets {
            let name = self.spec.as_deref().unwrap_or(&target.name);
            if let Kind::AngleCore { .. } = target.kind
                && let Design::Angle(core) = Design::named(name)?
            {
                let what = format!("{}: errors by the model", target.name);
                target.accuracy = Some(progress::during(what, || exactness::accuracy(&core))?);
            }
        }
        let measured =
            progress::steps(effort.steps(targets.len()), |step| measure(&flow, &targets, &effort, step))?;
        say!("{}", report::measured_table(&measured).trim_end());
        if self.spec.is_some() || self.top.is_some() {
            return Ok(ExitCode::SUCCESS);
        }
        let old = Baseline::read(&self.out.join(JSON))?;
        let mut new = Baseline::new(&flow, &effort.seeds, measured)?;
        let whole = self.target.is_empty() && self.family.is_none();
        let changes = old.as_ref().map_or(Vec::new(), |old| {
            let gone = if whole { old.gone(&new.targets) } else { Vec::new() };
            old.changes(&new.targets).into_iter().chain(gone).collect()
        });
        self.print_changes(old.as_ref(), &new, &changes)?;
        if !whole {
            return Ok(agreement(changes.is_empty()));
        }
        if !changes.is_empty() && !self.accept {
            say!(
                "{}: not written; `vuris synth --accept` takes the new areas for the baseline",
                self.out.display()
            );
            return Ok(agreement(false));
        }
        if let Some(old) = old.filter(|_| !self.accept) {
            new.keep_accepted(&old);
        }
        artifact::write(&self.out, &artifacts(&new)?)?;
        say!("{}: {JSON} and {MARKDOWN} of {}", self.out.display(), counted(new.targets.len(), "target"));
        Ok(ExitCode::SUCCESS)
    }

    fn targets(&self) -> Result<Vec<Target>> {
        if let Some(spec) = &self.spec {
            return Ok(vec![Target::named(spec, &shown_spec(spec))?]);
        }
        if let Some(top) = &self.top {
            return Ok(vec![foreign_target(top, &self.clock, &self.files)?]);
        }
        let mut targets = Target::all()?;
        for name in &self.target {
            if !targets.iter().any(|target| target.name == *name) {
                let names: Vec<&str> = targets.iter().map(|target| target.name.as_str()).collect();
                return Err(Problem::at("--target", name).expected(names.join(", ")));
            }
        }
        targets.retain(|target| self.target.is_empty() || self.target.contains(&target.name));
        Ok(targets)
    }

    fn print_changes(&self, old: Option<&Baseline>, new: &Baseline, changes: &[Change]) -> Result<()> {
        for change in changes {
            say!("CHANGED {change}");
        }
        let Some(old) = old else {
            say!("{}: no baseline to compare with", self.out.join(JSON).display());
            return Ok(());
        };
        if changes.is_empty() {
            say!("no area differs from the accepted one by more than {LIMIT_PERCENT} %");
        }
        for (job, before, now) in old.other_tools(new) {
            say!("the baseline was measured by another tool: {job}: {before}, now {now}");
        }
        Ok(())
    }

    fn check(&self) -> Result<ExitCode> {
        let path = self.out.join(JSON);
        let baseline = Baseline::read(&path)?.ok_or_else(|| {
            Problem::in_file(&path, "is not there").expected("a measurement").remedy("make synth")
        })?;
        let targets = Target::all()?;
        let mut stale: Vec<String> = Vec::new();
        for target in &targets {
            match baseline.targets.iter().find(|measured| measured.name == target.name) {
                None => stale.push(format!("{} has not been measured", target.name)),
                Some(measured) if measured.digest != target.verilog.digest() => {
                    stale.push(format!("{} has other Verilog than when it was measured", target.name));
                }
                Some(_) => {}
            }
        }
        let is_no_target = |measured: &&Measured| targets.iter().all(|target| target.name != measured.name);
        let gone = baseline.targets.iter().filter(is_no_target);
        stale.extend(gone.map(|measured| format!("{} is no target any more", measured.name)));
        let differences = artifact::differences(&self.out, &artifacts(&baseline)?)?;
        stale.extend(differences.iter().map(Difference::to_string));
        for line in &stale {
            say!("{line}");
        }
        if stale.is_empty() {
            say!("{}: {} up to date", self.out.display(), counted(targets.len(), "target"));
        } else {
            say!("{}: `make synth` measures anew", self.out.display());
        }
        Ok(agreement(stale.is_empty()))
    }
}

/// The files of the measurement, without folders.
fn artifacts(baseline: &Baseline) -> Result<[Artifact; 2]> {
    Ok([Artifact::new(JSON, baseline.to_json()?), Artifact::new(MARKDOWN, report::synthesis(baseline))])
}

/// The module `top` of somebody's `files`.
fn foreign_target(top: &str, clock: &str, files: &[PathBuf]) -> Result<Target> {
    let read = |path: &PathBuf| {
        let text = std::fs::read_to_string(path).map_err(|error| Problem::io(path, "read", &error))?;
        let name = path.file_name().unwrap_or(Path::new("").as_os_str());
        Ok(Artifact::new(name.to_string_lossy(), text))
    };
    let files: Result<Vec<Artifact>> = files.iter().map(read).collect();
    Ok(Target {
        name: top.to_owned(),
        purpose: format!("the module {top}"),
        kind: Kind::Other,
        verilog: Verilog::new(top, clock, files?)?,
        latency_clocks: None,
        clocks_per_sample: None,
        accuracy: None,
    })
}
