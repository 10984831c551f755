//! The `vuris` program: parse, run, print the error, exit code.

use clap::Parser;
use std::process::ExitCode;
use vuris::cli::Arguments;

fn main() -> ExitCode {
    match Arguments::parse().run() {
        Ok(code) => code,
        Err(problem) => {
            eprintln!("error: {problem}");
            ExitCode::from(2)
        }
    }
}
