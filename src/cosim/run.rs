//! One co-simulation: files, build, run, findings, and a waveform of the clocks around the first mismatch.

use super::finding::Finding;
use super::tools::{IVERILOG, VVP, Verilator, find, output};
use crate::artifact;
use crate::hdl::{Golden, Source, all_artifacts};
use crate::problem::{Problem, Result};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A simulator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Simulator {
    /// Verilator, with `tb/harness.cpp`.
    Verilator,
    /// Icarus Verilog, with `tb/testbench.v`.
    Icarus,
}

impl Simulator {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Verilator, Self::Icarus];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Verilator => "verilator",
            Self::Icarus => "icarus",
        }
    }
}

/// Pauses on the input and stops on the output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Traffic {
    /// Seed of both.
    pub seed: u32,
    /// Percent of clocks without input.
    pub pause_percent: u32,
    /// Percent of clocks without output, in bursts.
    pub stop_percent: u32,
}

impl Default for Traffic {
    fn default() -> Self {
        Self { seed: 1, pause_percent: 25, stop_percent: 25 }
    }
}

impl Traffic {
    /// Mixed; as fast as it goes; results that are hardly taken, so that drains fall behind the next set; samples that
    /// hardly come.
    pub fn profiles(seed: u32) -> [Self; 4] {
        [(25, 25), (0, 0), (0, 80), (70, 0)].map(|(pause_percent, stop_percent)| Self {
            seed,
            pause_percent,
            stop_percent,
        })
    }
}

/// What a run showed.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Outcome {
    /// Values that were compared.
    pub values: u64,
    /// Clocks that were simulated.
    pub clocks: u64,
    /// Time that the simulation took, without building, s.
    pub simulation_s: f64,
    /// Mismatches; 0 where model and Verilog agree.
    pub mismatches: u64,
    /// The first of them.
    pub findings: Vec<Finding>,
    /// Clocks in which a sample was offered and not taken (Verilator only).
    pub stalled_clocks: u64,
    /// First clock at which a pixel passed each stage (Verilator only).
    pub first_clocks: Vec<u64>,
    /// A waveform of the clocks around the first mismatch.
    pub waveform: Option<PathBuf>,
}

/// Clocks of the waveform before and after a mismatch.
const WAVEFORM_CLOCKS: u64 = 200;

/// Files in a folder, built for one simulator.
#[derive(Debug)]
pub struct Simulation<'a> {
    source: Source<'a>,
    golden: &'a Golden,
    simulator: Simulator,
    folder: &'a Path,
    program: PathBuf,
}

/// Builds the simulation, runs it once with `traffic`, and compares.
///
/// `fault` may change the files before they are built: the way in which the benches are shown to fail.
pub fn simulate(
    source: &Source,
    golden: &Golden,
    simulator: Simulator,
    traffic: Traffic,
    folder: &Path,
    fault: &dyn Fn(&mut Vec<artifact::Artifact>),
) -> Result<Outcome> {
    Simulation::build(*source, golden, simulator, folder, fault)?.run(traffic)
}

impl<'a> Simulation<'a> {
    /// Writes everything to `folder` and builds it for `simulator`.
    pub fn build(
        source: Source<'a>,
        golden: &'a Golden,
        simulator: Simulator,
        folder: &'a Path,
        fault: &dyn Fn(&mut Vec<artifact::Artifact>),
    ) -> Result<Self> {
        if folder.to_string_lossy().contains(char::is_whitespace) {
            return Err(Problem::in_file(folder, "has a space in its path")
                .expected("a folder in whose path the simulators' makefiles can build")
                .remedy("choose another with --work, or set TMPDIR"));
        }
        let mut artifacts = all_artifacts(&source, golden);
        fault(&mut artifacts);
        artifact::write(folder, &artifacts)?;
        let mut simulation = Self { source, golden, simulator, folder, program: PathBuf::new() };
        simulation.program = simulation.compile(false)?;
        Ok(simulation)
    }

    /// What was built: Verilator's program, or Icarus' file for vvp. It runs in the folder, and takes what the bench's first lines say.
    pub fn program(&self) -> &Path {
        &self.program
    }

    /// Runs it and compares; after a mismatch again, with a waveform of the clocks around the first.
    pub fn run(&self, traffic: Traffic) -> Result<Outcome> {
        let mut outcome = self.start(&self.program, traffic, None)?;
        if let Some(clock) = outcome.findings.iter().filter_map(|finding| finding.clock).min() {
            // The same seeds give the same clocks: only now a waveform is worth its time.
            let (from, to) = (clock.saturating_sub(WAVEFORM_CLOCKS), clock + WAVEFORM_CLOCKS);
            let waveform = self.folder.join(format!("mismatch-{}.fst", self.simulator.name()));
            let program = self.compile(true)?;
            self.start(&program, traffic, Some((&waveform, from, to)))?;
            outcome.waveform = waveform.is_file().then_some(waveform);
        }
        Ok(outcome)
    }

    /// Builds the program, with waveforms where `traced`.
    fn compile(&self, traced: bool) -> Result<PathBuf> {
        let (mut command, program) = match self.simulator {
            Simulator::Verilator => {
                let build = if traced { "build-verilator-traced" } else { "build-verilator" };
                let mut command = Verilator::find()?.command();
                command.args(["--cc", "--exe", "--build", "-j", "2", "-Wall", "-Wno-fatal", "-O3"]);
                command.args(["--x-assign", "unique", "--x-initial", "unique", "--top-module", "bench_taps"]);
                command.args(["-CFLAGS", "-O1", "-Mdir", build, "-o", "simulation"]);
                if traced {
                    command.arg("--trace-fst");
                }
                command.args(["-f", "rtl/files.f", "tb/bench_taps.v", "tb/harness.cpp"]);
                (command, self.folder.join(build).join("simulation"))
            }
            Simulator::Icarus => {
                let mut command = Command::new(find(IVERILOG)?);
                command.args([
                    "-g2005",
                    "-Wall",
                    "-o",
                    "simulation.vvp",
                    "-s",
                    "testbench",
                    "-f",
                    "rtl/files.f",
                ]);
                command.arg("tb/testbench.v");
                (command, self.folder.join("simulation.vvp"))
            }
        };
        let (success, text) = output(command.current_dir(self.folder))?;
        if success {
            Ok(program)
        } else {
            Err(Problem::in_file(
                self.folder,
                format_args!("{} cannot build it:\n{text}", self.simulator.name()),
            )
            .expected("Verilog and bench that build")
            .remedy("`make setup` installs the versions that are known to work"))
        }
    }

    /// Runs the program.
    fn start(
        &self,
        program: &Path,
        traffic: Traffic,
        waveform: Option<(&Path, u64, u64)>,
    ) -> Result<Outcome> {
        let program = program.canonicalize().map_err(|error| Problem::io(program, "run", &error))?;
        let mut command = match self.simulator {
            Simulator::Verilator => Command::new(program),
            Simulator::Icarus => {
                let mut command = Command::new(find(VVP)?);
                command.arg("-N").arg(program);
                if waveform.is_some() {
                    command.arg("-fst");
                }
                command
            }
        };
        let Traffic { seed, pause_percent, stop_percent } = traffic;
        command.args([
            format!("+seed={seed}"),
            format!("+pause={pause_percent}"),
            format!("+stop={stop_percent}"),
        ]);
        if let Some((path, from, to)) = waveform {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            command.args([format!("+dump={name}"), format!("+dump_from={from}"), format!("+dump_to={to}")]);
        }
        let start = std::time::Instant::now();
        let (success, text) = output(command.current_dir(self.folder))?;
        let simulation_s = start.elapsed().as_secs_f64();
        Ok(Outcome { simulation_s, ..self.outcome(&text, success)? })
    }

    fn outcome(&self, text: &str, success: bool) -> Result<Outcome> {
        let mut outcome = Outcome::default();
        let mut verdict = false;
        for line in text.lines() {
            let number = |key: &str| {
                line.split(&format!("{key}=")).nth(1)?.split_whitespace().next()?.parse::<u64>().ok()
            };
            if line.starts_with("PASS ") || line.starts_with("FAIL ") {
                // A program that passes and then ends badly has not passed.
                verdict = success || line.starts_with("FAIL ");
                outcome.values = number("values").unwrap_or(0);
                outcome.clocks = number("clocks").unwrap_or(0);
                outcome.mismatches = number("mismatches").unwrap_or(0);
            } else if line.starts_with("STALLED ") {
                outcome.stalled_clocks = number("clocks").unwrap_or(0);
            } else if let Some(clocks) = line.strip_prefix("FIRST clock of each stage:") {
                outcome.first_clocks =
                    clocks.split_whitespace().filter_map(|clock| clock.parse().ok()).collect();
            }
            outcome.findings.extend(Finding::parse(line, self.source.pipeline, self.golden));
        }
        if verdict {
            Ok(outcome)
        } else {
            Err(Problem::in_file(
                self.folder,
                format_args!("{} ended without a verdict:\n{text}", self.simulator.name()),
            )
            .expected("a last line `PASS …` or `FAIL …`"))
        }
    }
}
