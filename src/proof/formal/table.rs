//! What was proved, as a table.

use super::{Answer, Finding, Proof};

/// A proof that has been run.
#[derive(Debug)]
pub struct Record {
    /// The proof.
    pub proof: &'static Proof,
    /// What it found on the design as it is.
    pub findings: Vec<Finding>,
    /// Time that this took, s.
    pub seconds: f64,
    /// Faults that were seeded, by name, and whether each was seen.
    pub faults: Vec<(&'static str, bool)>,
    /// Time that these took, s.
    pub fault_seconds: f64,
}

impl Record {
    fn row(&self) -> String {
        let Self { proof, findings, seconds, faults, fault_seconds } = self;
        let count = |kind: &dyn Fn(&Finding) -> bool| findings.iter().filter(|finding| kind(finding)).count();
        let for_ever = count(&|finding| !finding.cover && finding.answer == Answer::Proved);
        let covers = count(&|finding| finding.cover && finding.holds());
        let mut what = vec![format!("{for_ever} for ever")];
        let clocks = findings.iter().find_map(|finding| match finding.answer {
            Answer::NotWithin(clocks) if !finding.cover => Some(clocks),
            _ => None,
        });
        if let Some(clocks) = clocks {
            let bounded = count(&|finding| !finding.cover && finding.answer == Answer::NotWithin(clocks));
            what.push(format!("{bounded} in {clocks} clocks"));
        }
        let failed = count(&|finding| !finding.holds());
        if failed > 0 {
            what.push(format!("**{failed} fail**"));
        }
        let seen = faults.iter().filter(|(_, seen)| *seen).count();
        let missed: Vec<&str> = faults.iter().filter(|(_, seen)| !seen).map(|(name, _)| *name).collect();
        let faults = match (faults.len(), &missed[..]) {
            (0, _) => "none tried".to_owned(),
            (all, []) => format!("{seen} of {all}, {fault_seconds:.0} s"),
            (all, missed) => format!("{seen} of {all}, {fault_seconds:.0} s; missed: {}", missed.join(", ")),
        };
        format!(
            "| `{}` | {} | {} | {covers} | {seconds:.0} | {faults} |\n",
            proof.name,
            proof.purpose,
            what.join(", ")
        )
    }
}

/// A row for every one of `records`.
pub fn table(records: &[Record]) -> String {
    let header = "| proof | what it says | properties | covers | time, s | seeded faults seen |\n| --- | --- | --- | ---: | ---: | --- |\n";
    records.iter().fold(header.to_owned(), |text, record| text + &record.row())
}
