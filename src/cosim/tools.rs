//! Finding the simulators.

use crate::problem::{Problem, Result};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A program that a check needs.
#[derive(Debug, Clone, Copy)]
pub struct Tool {
    /// Its name on the search path.
    pub name: &'static str,
    /// How a user gets it.
    pub remedy: &'static str,
}

/// Icarus Verilog's compiler.
pub const IVERILOG: Tool = Tool { name: "iverilog", remedy: "apt-get install iverilog, or `make setup`" };
/// Icarus Verilog's runtime.
pub const VVP: Tool = Tool { name: "vvp", remedy: "apt-get install iverilog, or `make setup`" };
/// Yosys: netlists, mutants and proofs.
pub const YOSYS: Tool = Tool { name: "yosys", remedy: "apt-get install yosys, or `make setup`" };
/// A cache of compiled files. No simulation needs it, but the most that Verilator has compiled is its own library, the same in every build.
const CCACHE: Tool = Tool { name: "ccache", remedy: "apt-get install ccache, or `make setup`" };
const VERILATOR: Tool = Tool {
    name: "verilator",
    remedy: "`make setup` in the repository; or set VURIS_VERILATOR to the program; or apt-get install verilator",
};

/// The program of `tool` on the search path.
pub fn find(tool: Tool) -> Result<PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path)
        .map(|folder| folder.join(tool.name))
        .find(|program| program.is_file())
        .ok_or_else(|| {
            Problem::at(tool.name, "is not on this machine")
                .expected("a program on the search path")
                .remedy(tool.remedy)
        })
}

/// A Verilator: its program, and the folder of its library where it does not know it itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Verilator {
    /// The program.
    pub program: PathBuf,
    root: Option<PathBuf>,
}

impl Verilator {
    /// The one to simulate with: `VURIS_VERILATOR`, else `.tools/verilator` of this folder or one above it (where
    /// `make setup` puts it), else the search path.
    pub fn find() -> Result<Self> {
        if let Some(program) = std::env::var_os("VURIS_VERILATOR").map(PathBuf::from) {
            return if program.is_file() {
                Ok(Self::at(program))
            } else {
                Err(Problem::at("VURIS_VERILATOR", program.display())
                    .expected("the path of a verilator program"))
            };
        }
        let here = std::env::current_dir().unwrap_or_default();
        let local = here
            .ancestors()
            .map(|folder| folder.join(".tools/verilator/verilator/bin/verilator"))
            .find(|program| program.is_file());
        match local {
            Some(program) => Ok(Self::at(program)),
            None => find(VERILATOR).map(Self::at),
        }
    }

    /// Every Verilator that the core must lint clean in: the one of [`Verilator::find`], and the search path's where it is
    /// another.
    pub fn all() -> Result<Vec<Self>> {
        let mut all = vec![Self::find()?];
        if let Ok(program) = find(VERILATOR)
            && program != all[0].program
        {
            all.push(Self::at(program));
        }
        Ok(all)
    }

    fn at(program: PathBuf) -> Self {
        // A wheel's folder holds bin/ and include/ side by side; a system's Verilator knows its own place.
        let root = program
            .parent()
            .and_then(Path::parent)
            .filter(|root| root.join("include/verilated.h").is_file())
            .map(Path::to_owned);
        Self { program, root }
    }

    /// A command of this Verilator, with only its own root in the environment.
    pub fn command(&self) -> Command {
        let mut command = Command::new(&self.program);
        match &self.root {
            Some(root) => command.env("VERILATOR_ROOT", root),
            None => command.env_remove("VERILATOR_ROOT"),
        };
        // A make that runs us has its own flags and job server.
        command.env_remove("MAKEFLAGS").env_remove("MFLAGS");
        // Verilator's makefiles take the cache from here; a user's own choice, or none, stays.
        if std::env::var_os("OBJCACHE").is_none() && find(CCACHE).is_ok() {
            command.env("OBJCACHE", CCACHE.name);
        }
        command
    }
}

/// Runs `command`; its output, standard error after standard output, and whether it succeeded.
pub fn output(command: &mut Command) -> Result<(bool, String)> {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command
        .stdin(std::process::Stdio::null())
        .output()
        .map_err(|error| Problem::at(&program, format_args!("cannot be started: {error}")))?;
    let text =
        String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    Ok((output.status.success(), text))
}
