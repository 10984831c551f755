//! The command line: one file a command, each with its arguments, one call, and its printing.

mod algorithms;
mod atlas;
mod campaign;
mod challenge;
mod coverage;
mod demo;
mod diagnose;
mod explain;
mod fingerprint;
mod generate;
mod import;
mod library;
mod mutate;
mod option;
mod paper;
mod place;
mod print;
mod process;
mod progress;
mod prove;
mod scene;
mod simulate;
mod stimulus;
mod study;
mod sweep;
mod synth;
mod verify;

pub use stimulus::{golden_of_preset, scene_sets};

use crate::problem::Result;
use crate::recording::matching::SchemeChoice;
use clap::{Parser, Subcommand, ValueEnum};
use std::process::ExitCode;

/// Phase pipelines for time-of-flight cameras: Verilog from a specification, a bit-accurate model, and the proof that
/// they agree.
#[derive(Debug, Parser)]
#[command(version, about, arg_required_else_help = true)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Generate(generate::Generate),
    Verify(verify::Verify),
    Process(process::Process),
    Explain(explain::Explain),
    Scene(scene::Scene),
    Simulate(Box<simulate::Simulate>),
    Import(import::Import),
    Atlas(atlas::Atlas),
    Paper(paper::Paper),
    Sweep(Box<sweep::Sweep>),
    Study(study::Study),
    Challenge(challenge::Challenge),
    Demo(demo::Demo),
    Diagnose(diagnose::Diagnose),
    Synth(synth::Synth),
    Mutate(mutate::Mutate),
    Coverage(coverage::Coverage),
    Prove(prove::Prove),
    Algorithms(algorithms::Algorithms),
}

impl Arguments {
    /// Runs the command. Exit code 0: done, and everything agrees; 1: something differs; an error (exit code 2) says what
    /// could not be done.
    pub fn run(self) -> Result<ExitCode> {
        match self.command {
            Command::Generate(command) => command.run(),
            Command::Verify(command) => command.run(),
            Command::Process(command) => command.run(),
            Command::Explain(command) => command.run(),
            Command::Scene(command) => command.run(),
            Command::Simulate(command) => command.run(),
            Command::Import(command) => command.run(),
            Command::Atlas(command) => command.run(),
            Command::Paper(command) => command.run(),
            Command::Sweep(command) => command.run(),
            Command::Study(command) => command.run(),
            Command::Challenge(command) => command.run(),
            Command::Demo(command) => command.run(),
            Command::Diagnose(command) => command.run(),
            Command::Synth(command) => command.run(),
            Command::Mutate(command) => command.run(),
            Command::Coverage(command) => command.run(),
            Command::Prove(command) => command.run(),
            Command::Algorithms(command) => command.run(),
        }
    }
}

/// Which scheme a recording is processed with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum SchemeArgument {
    /// The specification's; a recording with other phase steps is refused.
    #[default]
    Specified,
    /// The one whose phase steps the recording has.
    Auto,
}

impl From<SchemeArgument> for SchemeChoice {
    fn from(argument: SchemeArgument) -> Self {
        match argument {
            SchemeArgument::Specified => Self::Specified,
            SchemeArgument::Auto => Self::Auto,
        }
    }
}

/// The exit code for "everything agrees" or "something differs".
fn agreement(agrees: bool) -> ExitCode {
    if agrees { ExitCode::SUCCESS } else { ExitCode::from(1) }
}
