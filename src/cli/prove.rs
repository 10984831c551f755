//! `vuris prove`

use super::print::say;
use super::{agreement, progress};
use crate::problem::{Problem, Result};
use crate::proof::formal::{self, FAULTS, Fault, Finding, PROOFS, Proof, Record, table};
use crate::spec::Pipeline;
use clap::Args;
use std::process::ExitCode;
use std::time::Instant;

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
        let mut records = Vec::new();
        for proof in PROOFS.iter().filter(|proof| chosen(proof.name)) {
            say!("{}: {}", proof.name, proof.purpose);
            let start = Instant::now();
            let findings = progress::during(proof.name, || formal::prove(&pipeline, proof, None))?;
            let seconds = start.elapsed().as_secs_f64();
            for finding in &findings {
                let kind = if finding.cover { "reached" } else { "violated" };
                let verdict = if finding.holds() { "holds" } else { "FAILS" };
                say!("  {verdict}: {}: {kind} {}", finding.what, finding.answer);
                agrees &= finding.holds();
            }
            let start = Instant::now();
            let mut faults = Vec::new();
            for fault in FAULTS.iter().filter(|fault| fault.proof == proof.name && !self.no_faults) {
                if !formal::has_place(&pipeline, proof, fault)? {
                    say!(
                        "  left out: {}: {}: this specification's Verilog has no such place",
                        fault.noun,
                        fault.name
                    );
                    continue;
                }
                let seen = Self::seen(&pipeline, proof, fault)?;
                faults.push((fault.name, seen));
                agrees &= seen;
            }
            let fault_seconds = start.elapsed().as_secs_f64();
            records.push(Record { proof, findings, seconds, faults, fault_seconds });
        }
        say!("\n{}", table(&records).trim_end());
        Ok(agreement(agrees))
    }

    /// Whether `proof` sees `fault`.
    fn seen(pipeline: &Pipeline, proof: &Proof, fault: &Fault) -> Result<bool> {
        let findings = progress::during(fault.name, || formal::prove(pipeline, proof, Some(fault)))?;
        let Fault { noun, name, .. } = fault;
        let seen = findings.iter().find(|finding| finding.shows_fault());
        match seen {
            Some(Finding { what, answer, .. }) => {
                say!("  seen:  {noun}: {name}: {what} violated {answer}");
            }
            None => say!("  MISSED: {noun}: {name}"),
        }
        Ok(seen.is_some())
    }
}
