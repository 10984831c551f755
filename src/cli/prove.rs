//! `vuris prove`

use super::print::say;
use super::{agreement, progress};
use crate::problem::{Problem, Result};
use crate::proof::formal::{self, FAULTS, Finding, PROOFS};
use crate::spec::Pipeline;
use clap::Args;
use std::process::ExitCode;

/// Prove properties of the generated modules for all inputs, and show that each proof fails on designs with a fault
#[derive(Debug, Args)]
pub(super) struct Prove {
    /// Specification: a preset or a TOML file; its sensor is replaced by one of a few pixels
    #[arg(long, value_name = "FILE|PRESET")]
    spec: String,
    /// Only proofs whose names begin so: stream, framing, sums-0 to sums-3, pipeline, folded, iterative
    #[arg(long, value_name = "NAME")]
    proof: Option<String>,
    /// Leave out the designs with a fault
    #[arg(long)]
    no_faults: bool,
}

impl Prove {
    pub(super) fn run(self) -> Result<ExitCode> {
        let pipeline = Pipeline::named(&self.spec)?;
        let chosen = |name: &str| self.proof.as_deref().is_none_or(|proof| name.starts_with(proof));
        if !PROOFS.iter().any(|proof| chosen(proof.name)) {
            let names: Vec<&str> = PROOFS.iter().map(|proof| proof.name).collect();
            return Err(Problem::at("--proof", self.proof.unwrap_or_default()).expected(names.join(", ")));
        }
        let mut agrees = true;
        for proof in PROOFS.iter().filter(|proof| chosen(proof.name)) {
            say!("{}: {}", proof.name, proof.purpose);
            let findings = progress::during(proof.name, || formal::prove(&pipeline, proof, None))?;
            for finding in &findings {
                let kind = if finding.cover { "reached" } else { "violated" };
                let verdict = if finding.holds() { "holds" } else { "FAILS" };
                say!("  {verdict}: {}: {kind} {}", finding.what, finding.answer);
                agrees &= finding.holds();
            }
            for fault in FAULTS.iter().filter(|fault| fault.proof == proof.name && !self.no_faults) {
                let findings = progress::during(fault.name, || formal::prove(&pipeline, proof, Some(fault)))?;
                match findings.iter().find(|finding| finding.shows_fault()) {
                    Some(seen) => say!(
                        "  seen:  {}: {}: {} violated {}",
                        fault.noun,
                        fault.name,
                        seen.what,
                        seen.answer
                    ),
                    None => say!("  MISSED: {}: {}", fault.noun, fault.name),
                }
                agrees &= findings.iter().any(Finding::shows_fault);
            }
        }
        Ok(agreement(agrees))
    }
}
