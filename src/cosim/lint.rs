//! Lint of the core, with no waiver.

use super::tools::{Verilator, output};
use crate::problem::Result;
use std::path::Path;

/// What `verilator` says against the core in `folder`/rtl with all warnings on; empty where it says nothing.
pub fn lint(verilator: &Verilator, folder: &Path, top: &str) -> Result<String> {
    let mut command = verilator.command();
    command.current_dir(folder).args([
        "--lint-only",
        "-Wall",
        "--language",
        "1364-2005",
        "--top-module",
        top,
    ]);
    command.args(["-f", "rtl/files.f"]);
    let (success, text) = output(&mut command)?;
    // Newer versions end with statistics, in lines that begin with a dash.
    let said: String =
        text.lines().filter(|line| line.starts_with('%')).map(|line| format!("{line}\n")).collect();
    Ok(if success { said } else { text })
}
