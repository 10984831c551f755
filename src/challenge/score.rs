//! What the answers to a challenge say together.

use super::judge::{Answer, Asserted, Estimate, Outcome, judge, judge_names};
use super::label::{Hidden, Label};
use super::limit::is_right;
use super::simpler::{METHODS, Simpler};
use super::tally::{STRENGTHS, Tallies, place, range};
use std::collections::BTreeMap;

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
    /// What simpler methods say.
    pub simpler: Simpler,
}

/// Everything about a challenge.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scored {
    /// Case by case.
    pub cases: Vec<Judged>,
    /// How the answers fared.
    pub answers: Tallies,
    /// How the simpler methods fared, in the order of [`METHODS`].
    pub simpler: [Tallies; METHODS.len()],
    /// Campaigns without an effect that no library has, clean ones first, then by the ranges of [`STRENGTHS`] of the weakest effect: how
    /// many there are, and in how many an observer who knows every effect's exact change is right.
    pub limit: [(usize, usize); STRENGTHS.len() + 1],
    /// Of campaigns in which a name was asserted: χ² a degree of freedom on held-out sets, before and after.
    pub held_out: Vec<(f64, f64)>,
    /// Effects in answers that are right, and those of them whose parameters the generator tells exactly.
    pub named: (usize, usize),
    /// Of the latter, by name: errors of their fitted parameters in stated standard deviations.
    pub errors: BTreeMap<String, Vec<f64>>,
    /// Names by their probability, in the ranges of [`PROBABILITIES`].
    pub names: [Calibration; PROBABILITIES.len()],
    /// Mismatch or none, by its probability.
    pub mismatch: [Calibration; PROBABILITIES.len()],
}

/// Lower ends of the ranges of probability.
pub const PROBABILITIES: [f64; 5] = [0.0, 0.5, 0.8, 0.95, 0.99];

/// Judges every answer, and what simpler methods say, by its label.
pub fn scored(cases: Vec<(Label, Answer, Simpler)>) -> Scored {
    let mut scored = Scored::default();
    for (label, answer, simpler) in cases {
        let outcome = judge(&label, &answer);
        scored.answers.add(&label, outcome);
        for (tallies, method) in scored.simpler.iter_mut().zip(METHODS) {
            tallies.add(&label, judge_names(&label, method.2(&simpler)));
        }
        if label.outside.is_none() {
            let (cases, limit) = &mut scored.limit[place(&label)];
            *cases += 1;
            *limit += usize::from(is_right(&label));
        }
        scored.state(&label, &answer);
        if !answer.effects.is_empty() {
            let held_out = answer.held_out;
            scored.held_out.push((held_out.chi2_per_dof_before, held_out.chi2_per_dof_after));
        }
        if outcome == Outcome::Right {
            scored.measure(&label, &answer);
        }
        scored.cases.push(Judged { label, answer, outcome, simpler });
    }
    scored
}

impl Scored {
    /// Counts the probabilities that `answer` states.
    fn state(&mut self, label: &Label, answer: &Answer) {
        let state = |ranges: &mut [Calibration], probability: f64, is_true: bool| {
            let cell = &mut ranges[range(&PROBABILITIES, probability)];
            cell.stated += 1;
            cell.sum += probability;
            cell.true_ones += usize::from(is_true);
        };
        state(&mut self.mismatch, answer.probability_of_mismatch, label.weakest().is_some());
        let truths = label.right();
        for effect in &answer.effects {
            let is_true = truths.iter().any(|truth| truth.contains(&effect.name.as_str()));
            state(&mut self.names, effect.probability, is_true);
        }
    }

    /// Takes in the errors of the parameters in an `answer` that is right.
    fn measure(&mut self, label: &Label, answer: &Answer) {
        self.named.0 += answer.effects.len();
        for effect in &answer.effects {
            let hidden = label.effects.iter().find(|hidden| hidden.name == effect.name);
            let Some(hidden) = hidden.filter(|hidden| !hidden.parameters.is_empty()) else { continue };
            self.named.1 += 1;
            self.errors.entry(effect.name.clone()).or_default().extend(errors(hidden, effect));
        }
    }
}

/// The errors of an effect's fitted parameters whose truth is known, in stated standard deviations.
fn errors(hidden: &Hidden, effect: &Asserted) -> Vec<f64> {
    let error = |estimate: &Estimate| {
        // Of values that are fitted to some of the recordings, these follow in brackets.
        let name = estimate.name.split(" (").next().unwrap_or("");
        let truth = hidden.parameters.iter().find(|t| t.name == name && t.unit == estimate.unit)?;
        (estimate.sigma > 0.0).then(|| (estimate.value - truth.value) / estimate.sigma)
    };
    effect.parameters.iter().filter_map(error).collect()
}

/// The middle of `values`; of an even number the mean of the two in the middle.
pub fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = values.get(values.len() / 2)?;
    let lower = values.get((values.len() - 1) / 2)?;
    Some(0.5 * (lower + upper))
}

/// Standard deviations within which 95 % of normal errors are.
const USUAL: f64 = 1.96;

/// Of `errors` in standard deviations: the root of their mean square, and how many are within 1.96.
pub fn spread(errors: &[f64]) -> (f64, usize) {
    let square: f64 = errors.iter().map(|error| error * error).sum();
    let within = errors.iter().filter(|error| error.abs() <= USUAL).count();
    ((square / errors.len().max(1) as f64).sqrt(), within)
}
