//! Formal proofs: properties of the generated modules for all inputs, in all states, at all times.
//!
//! The property files in `formal/` are plain SystemVerilog around a module, with an observer that only looks at ports. Yosys makes one
//! circuit of both, and ABC (which comes with Yosys) proves by property-directed reachability that a bad bit is never 1, or
//! finds the clock at which it is. Beside every proof stand covers: bits that must become 1, so that no proof is
//! empty. [`FAULTS`] are designs in which a property must fail.

mod engine;
mod equal;
mod fault;
mod proof;
mod table;

pub use engine::Answer;
pub(super) use engine::never;
pub use fault::{FAULTS, Fault};
pub(super) use proof::padding;
pub use proof::{PROOFS, Proof};
pub use table::{Record, table};

use crate::artifact;
use crate::problem::{Problem, Result};
use crate::spec::Pipeline;
use std::path::Path;

/// What was asked of a design, and the answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The proof's name.
    pub proof: &'static str,
    /// The property or the cover, in words.
    pub what: String,
    /// Whether it is a cover.
    pub cover: bool,
    /// The answer.
    pub answer: Answer,
}

impl Finding {
    /// Whether the answer is what it has to be: a property holds, a cover is reached.
    pub fn holds(&self) -> bool {
        match self.answer {
            Answer::Proved | Answer::NotWithin(_) => !self.cover,
            Answer::Reached(_) => self.cover,
            Answer::Undecided => false,
        }
    }

    /// Whether it shows a fault: a property is violated. One that is not decided shows nothing.
    pub fn shows_fault(&self) -> bool {
        !self.cover && matches!(self.answer, Answer::Reached(_))
    }
}

/// Asks everything of `proof` on `pipeline`, with `fault` seeded where there is one.
pub fn prove(pipeline: &Pipeline, proof: &Proof, fault: Option<&Fault>) -> Result<Vec<Finding>> {
    let temporary = tempfile::Builder::new()
        .prefix("vuris-prove-")
        .tempdir()
        .map_err(|error| Problem::io(&std::env::temp_dir(), "write", &error))?;
    let pipeline = &few_pixels(pipeline)?;
    let mut rtl = (proof.rtl)(pipeline)?;
    if let Some(fault) = fault {
        fault.seed(&pipeline.prefix(), &mut rtl)?;
    }
    artifact::write(temporary.path(), &rtl)?;
    let files: Vec<String> =
        rtl.iter().map(|file| file.path.clone()).filter(|path| path.ends_with(".v")).collect();
    let text = format!("{}{}", (proof.definitions)(pipeline), proof.text);
    let design = engine::Design { files, setup: (proof.setup)(pipeline), text };
    let cover_clocks = (proof.cover_clocks)(pipeline);
    if fault.is_some()
        && let Some(finding) = violated(temporary.path(), &design, proof, cover_clocks)?
    {
        return Ok(vec![finding]);
    }
    let mut findings = Vec::new();
    for (list, cover) in [("bad", false), ("seen", true)] {
        // A design with a fault need not be covered.
        for (number, what) in proof.names(list).into_iter().filter(|_| !cover || fault.is_none()) {
            let watch = format!("{list}[{number}]");
            let bounded = proof.bounded.iter().find(|&&(bounded, _)| bounded == number);
            let bound = if cover { Some(cover_clocks) } else { bounded.map(|&(_, clocks)| clocks) };
            let answer = engine::ask(temporary.path(), &design, &watch, bound)?;
            findings.push(Finding { proof: proof.name, what, cover, answer });
            // One violation is enough.
            if fault.is_some() && findings.last().is_some_and(Finding::shows_fault) {
                return Ok(findings);
            }
        }
    }
    Ok(findings)
}

/// The first property that is violated within `clocks`: all are asked for at once, then the one that it was. What a proof would try in
/// vain for minutes is found in seconds so.
fn violated(folder: &Path, design: &engine::Design, proof: &Proof, clocks: u32) -> Result<Option<Finding>> {
    let Answer::Reached(clock) = engine::ask(folder, design, "|bad", Some(clocks))? else { return Ok(None) };
    for (number, what) in proof.names("bad") {
        let answer = engine::ask(folder, design, &format!("bad[{number}]"), Some(clock + 1))?;
        if matches!(answer, Answer::Reached(_)) {
            return Ok(Some(Finding { proof: proof.name, what, cover: false, answer }));
        }
    }
    Ok(None)
}

/// Whether the Verilog of `pipeline` has the place of `fault`: another scheme has other sums.
pub fn has_place(pipeline: &Pipeline, proof: &Proof, fault: &Fault) -> Result<bool> {
    let pipeline = few_pixels(pipeline)?;
    let mut rtl = (proof.rtl)(&pipeline)?;
    Ok(fault.seed(&pipeline.prefix(), &mut rtl).is_ok())
}

/// The same core with the smallest sensor that a specification may have: a frame is over in eight clocks.
fn few_pixels(pipeline: &Pipeline) -> Result<Pipeline> {
    pipeline.adapted("few pixels", |specification| {
        (specification.sensor.width, specification.sensor.height) = (4, 2);
        specification.sensor.line_blanking_clocks = 16;
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_has_its_place_in_the_verilog_and_its_proof() {
        let pipeline = few_pixels(&Pipeline::named("vuris").unwrap()).unwrap();
        for fault in FAULTS {
            let proof = PROOFS.iter().find(|proof| proof.name == fault.proof).expect(fault.proof);
            let mut rtl = (proof.rtl)(&pipeline).unwrap();
            let before = rtl.clone();
            fault.seed(&pipeline.prefix(), &mut rtl).unwrap();
            assert_ne!(before, rtl, "{}", fault.name);
        }
    }
}
