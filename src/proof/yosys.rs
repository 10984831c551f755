//! Running Yosys on a folder.

use crate::cosim::{YOSYS, find, output};
use crate::problem::{Problem, Result};
use std::path::Path;
use std::process::Command;

/// Runs `script` in `folder`; its output.
pub(super) fn yosys(folder: &Path, script: &str) -> Result<String> {
    let (success, text) = attempt(folder, script)?;
    if success {
        Ok(text)
    } else {
        let last: Vec<&str> = text.lines().rev().take(3).collect();
        Err(Problem::in_file(folder, format_args!("yosys: {}", last.join("; "))))
    }
}

/// Runs `script` in `folder`; whether it succeeded, and its output.
pub(super) fn attempt(folder: &Path, script: &str) -> Result<(bool, String)> {
    let name = script_name(script);
    let path = folder.join(&name);
    std::fs::write(&path, script).map_err(|error| Problem::io(&path, "write", &error))?;
    output(Command::new(find(YOSYS)?).current_dir(folder).args(["-q", "-s", &name]))
}

/// A name of its own for each script, so that two may run in one folder at a time.
fn script_name(script: &str) -> String {
    use std::hash::{DefaultHasher, Hash, Hasher};
    let mut hasher = DefaultHasher::new();
    script.hash(&mut hasher);
    format!("{:016x}.ys", hasher.finish())
}
