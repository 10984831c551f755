//! Yosys makes a circuit of a design and the bit that is watched; ABC decides whether the bit can become 1.

use crate::cosim::{Tool, find, output};
use crate::problem::{Problem, Result};
use crate::proof::yosys::yosys;
use std::path::Path;
use std::process::Command;

/// ABC, as Yosys brings it.
const ABC: Tool = Tool { name: "yosys-abc", remedy: "apt-get install yosys, or `make setup`" };

/// Seconds that a question may take.
const PATIENCE_S: u32 = 300;

/// Whether a bit can become 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// Never, whatever happens.
    Proved,
    /// Not within so many clocks after power-up.
    NotWithin(u32),
    /// It is 1 in this clock after power-up.
    Reached(u32),
    /// No answer in the time given.
    Undecided,
}

impl std::fmt::Display for Answer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Proved => write!(f, "never, proved"),
            Self::NotWithin(clocks) => write!(f, "not within {clocks} clocks"),
            Self::Reached(clock) => write!(f, "in clock {clock}"),
            Self::Undecided => write!(f, "undecided after {PATIENCE_S} s"),
        }
    }
}

/// A property file around a core.
pub(super) struct Design {
    /// The core's Verilog files.
    pub files: Vec<String>,
    /// Yosys commands that change parameters of their modules.
    pub setup: String,
    /// The property file.
    pub text: String,
}

/// Asks for `watch`, a bit or an expression of the `design` in `folder`: at any time, or within `bound` clocks.
pub(super) fn ask(folder: &Path, design: &Design, watch: &str, bound: Option<u32>) -> Result<Answer> {
    let Design { files, setup, text } = design;
    let properties = folder.join("properties.sv");
    std::fs::write(&properties, format!("`define WATCH {watch}\n{text}"))
        .map_err(|error| Problem::io(&properties, "write", &error))?;
    // Registers without a reset start with anything; so does what nobody drives.
    let script = format!(
        "read_verilog {}\n{setup}read_verilog -formal -sv properties.sv\nhierarchy -check -top properties\nproc\n\
         flatten\nopt_clean\nmemory_map\nopt -full\nopt_clean -purge\ntechmap\nopt -fast\ndffunmap\nsimplemap\n\
         setundef -undriven -anyseq\naigmap\nopt_clean\nwrite_aiger -zinit circuit.aig\n",
        files.join(" ")
    );
    yosys(folder, &script)?;
    let question = match bound {
        // Registers that are always equal first become one.
        None => format!("scorr; pdr -T {PATIENCE_S}"),
        Some(clocks) => format!("bmc3 -F {clocks} -T {PATIENCE_S}"),
    };
    let said = abc(folder, &question)?;
    let reached = said.split("was asserted in frame ").nth(1);
    let reached = reached.and_then(|rest| rest.split(['.', ' ']).next()?.parse().ok());
    if let Some(clock) = reached {
        Ok(Answer::Reached(clock))
    } else if said.contains("Property proved") {
        Ok(Answer::Proved)
    } else if said.contains("combinational networks") {
        // Nothing is left of the design but the watched bit: a constant 0 is never reached.
        Ok(Answer::Proved)
    } else if let (Some(clocks), true) = (bound, said.contains("No output asserted in")) {
        Ok(Answer::NotWithin(clocks))
    } else {
        Ok(Answer::Undecided)
    }
}

/// What ABC says to `question` about the circuit in `folder`.
fn abc(folder: &Path, question: &str) -> Result<String> {
    let mut command = Command::new(find(ABC)?);
    command.current_dir(folder).args(["-q", &format!("read circuit.aig; strash; {question}")]);
    Ok(output(&mut command)?.1)
}

/// Whether ABC proves in so many seconds that the only output of `circuit.aig` in `folder` is never 1.
pub(in crate::proof) fn never(folder: &Path, patience_s: u32) -> Result<bool> {
    let said = abc(folder, &format!("scorr; pdr -T {patience_s}"))?;
    Ok(said.contains("Property proved"))
}
