//! What the answers to a challenge say together.

use super::case::CaseKind;
use super::judge::{Answer, Outcome, judge};
use super::label::Label;
use super::limit::is_right;
use std::collections::BTreeMap;

/// How many cases had which outcome.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Tally(BTreeMap<Outcome, usize>);

impl Tally {
    fn add(&mut self, outcome: Outcome) {
        *self.0.entry(outcome).or_default() += 1;
    }

    /// Cases with this outcome.
    pub fn of(&self, outcome: Outcome) -> usize {
        self.0.get(&outcome).copied().unwrap_or(0)
    }

    /// All cases.
    pub fn cases(&self) -> usize {
        self.0.values().sum()
    }

    /// The score a case, −1 to 1; nothing of no case.
    pub fn score(&self) -> Option<f64> {
        let total: f64 = self.0.iter().map(|(outcome, &count)| outcome.score() * count as f64).sum();
        (self.cases() > 0).then(|| total / self.cases() as f64)
    }
}

/// Statements of about the same probability, and how often they were true.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Calibration {
    /// Statements.
    pub stated: usize,
    /// Their mean probability, times their number.
    pub sum: f64,
    /// Those that were true.
    pub true_ones: usize,
}

/// A case with its answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// The truth.
    pub label: Label,
    /// What was answered.
    pub answer: Answer,
    /// What that is worth.
    pub outcome: Outcome,
}

/// Everything about a challenge.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scored {
    /// Case by case.
    pub cases: Vec<Judged>,
    /// Of all cases.
    pub all: Tally,
    /// By kind.
    pub kinds: BTreeMap<CaseKind, Tally>,
    /// By the lower end of the range of strengths in [`STRENGTHS`], of the weakest effect.
    pub strengths: [Tally; STRENGTHS.len()],
    /// Campaigns without an effect that no library has, by the same ranges, clean ones first: how many there are, in how many an observer
    /// who knows every effect's exact change is right, and in how many the answer is.
    pub limit: [(usize, usize, usize); STRENGTHS.len() + 1],
    /// Clean campaigns, and alarms among them.
    pub clean: (usize, usize),
    /// Campaigns in which a name was asserted, and those of them that it helped on held-out sets.
    pub held_out: (usize, usize),
    /// χ² a degree of freedom on held-out sets, of campaigns in which a name was asserted: sums before and after.
    pub chi2: (f64, f64),
    /// Names by their probability, in the ranges of [`PROBABILITIES`].
    pub names: [Calibration; PROBABILITIES.len()],
    /// Mismatch or none, by its probability.
    pub mismatch: [Calibration; PROBABILITIES.len()],
}

/// Lower ends of the ranges of strength.
pub const STRENGTHS: [f64; 5] = [0.0, 8.0, 15.0, 30.0, 60.0];
/// Lower ends of the ranges of probability.
pub const PROBABILITIES: [f64; 5] = [0.0, 0.5, 0.8, 0.95, 0.99];

/// The range that `value` is in.
fn range(ends: &[f64], value: f64) -> usize {
    ends.iter().rposition(|end| value >= *end).unwrap_or(0)
}

/// Judges every answer by its label.
pub fn scored(cases: Vec<(Label, Answer)>) -> Scored {
    let mut scored = Scored::default();
    for (label, answer) in cases {
        let outcome = judge(&label, &answer);
        scored.all.add(outcome);
        scored.kinds.entry(label.kind).or_default().add(outcome);
        if label.outside.is_none() {
            let range = label.weakest().map_or(0, |rho| 1 + range(&STRENGTHS, rho));
            let (cases, limit, answers) = &mut scored.limit[range];
            *cases += 1;
            *limit += usize::from(is_right(&label));
            *answers += usize::from(outcome == Outcome::Right);
        }
        let alarm = answer.verdict != "clean";
        let mismatch = label.kind != CaseKind::Clean;
        match label.weakest() {
            Some(rho) => scored.strengths[range(&STRENGTHS, rho)].add(outcome),
            None => {
                scored.clean.0 += 1;
                scored.clean.1 += usize::from(alarm);
            }
        }
        let state = |ranges: &mut [Calibration], probability: f64, is_true: bool| {
            let cell = &mut ranges[range(&PROBABILITIES, probability)];
            cell.stated += 1;
            cell.sum += probability;
            cell.true_ones += usize::from(is_true);
        };
        state(&mut scored.mismatch, answer.probability_of_mismatch, mismatch);
        let truths = label.right();
        for effect in &answer.effects {
            let is_true = truths.iter().any(|truth| truth.contains(&effect.name.as_str()));
            state(&mut scored.names, effect.probability, is_true);
        }
        if !answer.effects.is_empty() {
            let (before, after) = (answer.held_out.chi2_per_dof_before, answer.held_out.chi2_per_dof_after);
            scored.held_out.0 += 1;
            scored.held_out.1 += usize::from(after < before);
            scored.chi2.0 += before;
            scored.chi2.1 += after;
        }
        scored.cases.push(Judged { label, answer, outcome });
    }
    scored
}
