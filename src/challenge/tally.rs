//! Outcomes counted: of all cases, by kind, by strength.

use super::case::CaseKind;
use super::judge::Outcome;
use super::label::Label;
use std::collections::BTreeMap;

/// Lower ends of the ranges of strength.
pub const STRENGTHS: [f64; 5] = [0.0, 8.0, 15.0, 30.0, 60.0];

/// The range that `value` is in.
pub fn range(ends: &[f64], value: f64) -> usize {
    ends.iter().rposition(|end| value >= *end).unwrap_or(0)
}

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

/// How one method fared.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Tallies {
    /// In all cases.
    pub all: Tally,
    /// By kind.
    pub kinds: BTreeMap<CaseKind, Tally>,
    /// By the range of [`STRENGTHS`] of the weakest effect.
    pub strengths: [Tally; STRENGTHS.len()],
    /// Campaigns without an effect that no library has in which it is exactly right, clean ones first, then by the same ranges.
    pub right: [usize; STRENGTHS.len() + 1],
}

impl Tallies {
    /// Counts the `outcome` of a case of `label`.
    pub fn add(&mut self, label: &Label, outcome: Outcome) {
        self.all.add(outcome);
        self.kinds.entry(label.kind).or_default().add(outcome);
        if let Some(rho) = label.weakest() {
            self.strengths[range(&STRENGTHS, rho)].add(outcome);
        }
        if label.outside.is_none() {
            self.right[place(label)] += usize::from(outcome == Outcome::Right);
        }
    }

    /// Clean campaigns, and alarms among them.
    pub fn clean(&self) -> (usize, usize) {
        self.kinds.get(&CaseKind::Clean).map_or((0, 0), |tally| (tally.cases(), tally.of(Outcome::Wrong)))
    }
}

/// Where a campaign stands in [`Tallies::right`].
pub fn place(label: &Label) -> usize {
    label.weakest().map_or(0, |rho| 1 + range(&STRENGTHS, rho))
}
