//! The netlist with every mutant in it, one of them switched on by a plusarg: one build runs all.

use super::mutant::{Mutant, draw};
use crate::artifact::{self, Artifact};
use crate::hdl::{Source, rtl_artifacts};
use crate::problem::{Problem, Result};
use crate::proof::yosys::yosys;
use crate::spec::Pipeline;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::path::Path;

/// The netlist's input that switches a mutant on.
const SWITCH: &str = "mutant_switch";
/// Its width, enough for any campaign.
const SWITCH_BITS: u32 = 16;

/// How a counter of 32 bits is reset.
const RESET_COUNTER: &str = "<= 32'd0;";
/// How it is reset a few counts before its wrap: to 2^32 - 6.
const LATE_COUNTER: &str = "<= -'d06;";
/// What a counter that is reset so is short of.
pub(super) const LATE_COUNTS: u32 = 6;

/// A core as Yosys reads it, flat, in a folder of its own.
pub(super) struct Netlist<'a> {
    pub folder: &'a Path,
    pub top: String,
    pub pipeline: Pipeline,
    prefix: String,
    /// The generated Verilog, for excerpts.
    pub rtl: Vec<Artifact>,
}

impl<'a> Netlist<'a> {
    /// Writes and reads the Verilog of `source` in `folder`; where `late`, with counters that a reset sets to
    /// [`LATE_COUNTER`]: no simulation lasts until the upper bits of a counter move from 0.
    pub(super) fn new(source: &Source, folder: &'a Path, late: bool) -> Result<Self> {
        let mut rtl = rtl_artifacts(source);
        if late {
            // As many characters, so that every place keeps its name.
            for file in &mut rtl {
                file.text = file.text.replace(RESET_COUNTER, LATE_COUNTER);
            }
        }
        artifact::write(folder, &rtl)?;
        let files: Vec<&str> =
            rtl.iter().map(|file| file.path.as_str()).filter(|path| path.ends_with(".v")).collect();
        let top = source.pipeline.top();
        // Cells get the names of their places before the hierarchy goes; a memory is whole, so that it can be mutated.
        let script = format!(
            "read_verilog {}\nhierarchy -check -top {top}\nproc\nopt_clean\nmemory -nomap\nopt_clean\nrename -src\nwrite_rtlil modules.il\nflatten\n\
             opt_clean\nwrite_rtlil flat.il\nmutate -list 100000000 -o mutants.txt\n",
            files.join(" ")
        );
        yosys(folder, &script)?;
        let pipeline = source.pipeline.clone();
        Ok(Self { folder, top, prefix: pipeline.prefix(), pipeline, rtl })
    }

    /// Draws mutants, `per_module` of each module.
    pub(super) fn draw(&self, per_module: usize, seed: u64) -> Result<Vec<Mutant>> {
        let path = self.folder.join("mutants.txt");
        let list = std::fs::read_to_string(&path).map_err(|error| Problem::io(&path, "read", &error))?;
        draw(&list, &self.prefix, per_module, &mut ChaCha8Rng::seed_from_u64(seed))
    }

    /// The whole core in one module, with `mutants` in it: `+mutant=1` switches the first on, 0 none.
    pub(super) fn switchable(&self, mutants: &[Mutant]) -> Result<String> {
        let mut script = "read_rtlil flat.il\n".to_owned();
        for (number, mutant) in (1..).zip(mutants) {
            script += &mutant.command(&self.top, &format!(" -ctrl {SWITCH} {SWITCH_BITS} {number}"));
        }
        script += "write_verilog -noattr mutated.v\n";
        yosys(self.folder, &script)?;
        let path = self.folder.join("mutated.v");
        let text = std::fs::read_to_string(&path).map_err(|error| Problem::io(&path, "read", &error))?;
        // The input becomes a register that a plusarg sets.
        let range = format!("[{}:0]", SWITCH_BITS - 1);
        let register = format!(
            "  reg {range} {SWITCH};\n  initial if (!$value$plusargs(\"mutant=%d\", {SWITCH})) {SWITCH} = {SWITCH_BITS}'d0;\n"
        );
        let mut patched = text;
        for (old, new) in [
            (format!(", {SWITCH});"), ");".to_owned()),
            (format!("  input {range} {SWITCH};\n"), String::new()),
            (format!("  wire {range} {SWITCH};\n"), register),
        ] {
            if patched.matches(&old).count() != 1 {
                return Err(Problem::in_file(&path, format_args!("does not hold {old:?} once"))
                    .expected("a netlist as Yosys 0.23 writes it"));
            }
            patched = patched.replace(&old, &new);
        }
        Ok(patched)
    }

    /// The generated Verilog of the module with `noun`.
    pub(super) fn text(&self, noun: &str) -> &str {
        let path = format!("rtl/{}_{noun}.v", self.prefix);
        self.rtl.iter().find(|file| file.path == path).map_or("", |file| &file.text)
    }
}
