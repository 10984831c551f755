//! Co-simulation of an angle unit by itself.

use super::Simulator;
use super::run::{Outcome, Traffic};
use super::tools::{IVERILOG, VVP, Verilator, find, output};
use crate::artifact::{self, Artifact};
use crate::hdl::angle_core_artifacts;
use crate::problem::{Problem, Result};
use crate::spec::AngleCore;
use std::path::Path;
use std::process::Command;

/// Builds `core` and its bench for `simulator` in `folder`, drives `vectors` with each of `traffics`, and compares.
///
/// `fault` may change the files before they are built: the way in which the bench is shown to fail.
pub fn simulate_angle(
    core: &AngleCore,
    spec: &str,
    vectors: &[(i64, i64)],
    simulator: Simulator,
    traffics: &[Traffic],
    folder: &Path,
    fault: &dyn Fn(&mut Vec<Artifact>),
) -> Result<Vec<Outcome>> {
    let mut artifacts = angle_core_artifacts(core, spec, vectors);
    fault(&mut artifacts);
    artifact::write(folder, &artifacts)?;
    let mut build = match simulator {
        Simulator::Verilator => {
            let mut command = Verilator::find()?.command();
            command.args(["--binary", "--timing", "-j", "2", "-Wno-fatal", "-Wno-lint", "-Wno-style", "-O3"]);
            command.args(["--x-assign", "unique", "--x-initial", "unique", "--top-module", "angle_bench"]);
            command.args(["-Mdir", "build-verilator", "-o", "simulation"]);
            command
        }
        Simulator::Icarus => {
            let mut command = Command::new(find(IVERILOG)?);
            command.args(["-g2005", "-Wall", "-o", "simulation.vvp", "-s", "angle_bench"]);
            command
        }
    };
    build.args(["-f", "rtl/files.f", "tb/angle_bench.v"]);
    let (built, text) = output(build.current_dir(folder))?;
    if !built {
        return Err(Problem::in_file(folder, format_args!("{} cannot build it:\n{text}", simulator.name()))
            .expected("Verilog and bench that build")
            .remedy("`make setup` installs the versions that are known to work"));
    }
    traffics.iter().map(|&traffic| run(simulator, traffic, folder)).collect()
}

fn run(simulator: Simulator, traffic: Traffic, folder: &Path) -> Result<Outcome> {
    let mut command = match simulator {
        Simulator::Verilator => {
            let program = folder.join("build-verilator/simulation");
            Command::new(program.canonicalize().map_err(|error| Problem::io(&program, "run", &error))?)
        }
        Simulator::Icarus => {
            let mut command = Command::new(find(VVP)?);
            command.args(["-N", "simulation.vvp"]);
            command
        }
    };
    let Traffic { seed, pause_percent, stop_percent } = traffic;
    command.args([
        format!("+seed={seed}"),
        format!("+pause={pause_percent}"),
        format!("+stop={stop_percent}"),
    ]);
    let start = std::time::Instant::now();
    let (success, text) = output(command.current_dir(folder))?;
    let simulation_s = start.elapsed().as_secs_f64();
    let verdict = text.lines().find(|line| line.starts_with("PASS ") || line.starts_with("FAIL "));
    let Some(verdict) = verdict.filter(|line| success || line.starts_with("FAIL ")) else {
        return Err(Problem::in_file(
            folder,
            format_args!("{} ended without a verdict:\n{text}", simulator.name()),
        )
        .expected("a last line `PASS …` or `FAIL …`"));
    };
    let number = |key: &str| {
        let value = verdict.split(&format!("{key}=")).nth(1).and_then(|rest| rest.split([' ', ':']).next());
        value.and_then(|value| value.parse::<u64>().ok()).unwrap_or(0)
    };
    let mismatches = number("mismatches");
    // A bench that fails has found something, whatever it counted.
    let mismatches = if verdict.starts_with("FAIL ") { mismatches.max(1) } else { mismatches };
    Ok(Outcome {
        values: number("values"),
        clocks: number("clocks"),
        simulation_s,
        mismatches,
        ..Outcome::default()
    })
}
