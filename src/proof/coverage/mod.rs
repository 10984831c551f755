//! Coverage: does the scenario of `vuris verify` run every line of the generated core, and move every bit both ways?
//!
//! Verilator counts, over every mixture of pauses and stops. Instances of a module count together. What cannot move is excluded,
//! by a rule that is looked at anew each time: bits that Yosys finds constant, and the rows of [`EXCLUSIONS`].

mod constant;
mod count;
mod exclusion;
mod report;

pub use count::{Kind, Point};
pub use exclusion::{EXCLUSIONS, Exclusion};
pub use report::{Share, needless, report, share};

use crate::artifact;
use crate::cosim::{Traffic, Verilator, output};
use crate::hdl::{Golden, Scenario, Source, all_artifacts};
use crate::problem::{Problem, Result};
use crate::spec::Pipeline;
use std::path::Path;
use std::process::Command;

/// A point, how often it was met, and why it does not count where it does not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Covered {
    /// The point.
    pub point: Point,
    /// How often.
    pub count: u64,
    /// Why it is excluded.
    pub excluded: Option<&'static str>,
}

/// What Yosys finds constant.
pub const CONSTANT: &str = "Yosys finds it constant in every instance";

/// Runs `scenario` on `pipeline`, builds in a temporary folder, and counts.
pub fn measure(pipeline: &Pipeline, scenario: &Scenario) -> Result<Vec<Covered>> {
    let temporary = tempfile::Builder::new()
        .prefix("vuris-coverage-")
        .tempdir()
        .map_err(|error| Problem::io(&std::env::temp_dir(), "write", &error))?;
    let folder = temporary.path();
    let source = Source { pipeline, spec: "coverage" };
    let mut artifacts = all_artifacts(&source, &Golden::new(pipeline, scenario));
    for harness in artifacts.iter_mut().filter(|artifact| artifact.path == "tb/harness.cpp") {
        // What moves from a random start to its reset value has not been moved by the core.
        harness.text = harness.text.replace("randReset(2)", "randReset(0)");
    }
    artifact::write(folder, &artifacts)?;
    build(folder)?;
    let mut points = Vec::new();
    for traffic in Traffic::profiles(1) {
        count::add(&mut points, &run(folder, traffic)?);
    }
    let constants = constant::bits(&source, folder)?;
    let covered = points.into_iter().map(|(point, count)| {
        let excluded = if constants.contains(&point) { Some(CONSTANT) } else { exclusion::reason(&point) }
            .filter(|_| count == 0);
        Covered { point, count, excluded }
    });
    Ok(covered.collect())
}

fn build(folder: &Path) -> Result<()> {
    let mut command = Verilator::find()?.command();
    command.current_dir(folder).args([
        "--coverage-line",
        "--coverage-toggle",
        "--coverage-max-width",
        "65536",
    ]);
    command.args(["--cc", "--exe", "--build", "-j", "2", "-Wno-fatal", "-O3", "--x-assign", "0"]);
    command.args(["--top-module", "bench_taps", "-CFLAGS", "-O1", "-Mdir", "build", "-o", "simulation"]);
    command.args(["-f", "rtl/files.f", "tb/bench_taps.v", "tb/harness.cpp"]);
    let (success, text) = output(&mut command)?;
    if success {
        Ok(())
    } else {
        Err(Problem::in_file(folder, format_args!("verilator cannot build it:\n{text}")))
    }
}

/// One run; the text of its counts.
fn run(folder: &Path, traffic: Traffic) -> Result<String> {
    let Traffic { seed, pause_percent, stop_percent } = traffic;
    let path = folder.join("coverage.dat");
    let mut command = Command::new(folder.join("build/simulation"));
    command.current_dir(folder).args([format!("+seed={seed}"), format!("+pause={pause_percent}")]);
    command.arg(format!("+stop={stop_percent}"));
    let (success, text) = output(&mut command)?;
    if !success {
        return Err(Problem::in_file(folder, format_args!("the bench differs from the model:\n{text}")));
    }
    let bytes = std::fs::read(&path).map_err(|error| Problem::io(&path, "read", &error))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
