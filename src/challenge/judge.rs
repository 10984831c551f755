//! An answer against its label.

use super::label::{Label, are_same};
use serde::Deserialize;

/// What an answer is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// Clean and said so; exactly the effects; unexplained where no library has it, with its place first.
    Right,
    /// A name and those that it cannot be told from here hold the truth; or the name of an effect that would look the same.
    Possible,
    /// Some of the effects, by name or among what a name cannot be told from here, and no other; or unexplained, with another place first.
    Partly,
    /// Nothing asserted of known effects, or no alarm.
    Silent,
    /// A name that is not there, or a false alarm.
    Wrong,
}

impl Outcome {
    /// Every outcome with its name and its score.
    pub const ALL: [(Self, &'static str, f64); 5] = [
        (Self::Right, "right", 1.0),
        (Self::Possible, "possible", 0.5),
        (Self::Partly, "partly", -0.25),
        (Self::Silent, "silent", 0.0),
        (Self::Wrong, "wrong", -1.0),
    ];

    /// Its score.
    pub fn score(self) -> f64 {
        Self::ALL.iter().find(|row| row.0 == self).map_or(0.0, |row| row.2)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|row| row.0 == self).map_or("", |row| row.1)
    }
}

/// An answer of `vuris diagnose --json`, as far as it is judged.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Answer {
    /// `vuris-verdict/1`.
    pub format: String,
    /// The verdict's word.
    pub verdict: String,
    /// That something is wrong at all.
    pub probability_of_mismatch: f64,
    /// Where it lives, most significant first.
    pub located: Vec<Located>,
    /// What is asserted.
    pub effects: Vec<Asserted>,
    /// The fit to sets that were held out.
    pub held_out: HeldOut,
}

/// A place.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Located {
    /// The coordinate.
    pub coordinate: String,
}

/// An effect that is asserted.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Asserted {
    /// Its name.
    pub name: String,
    /// How sure the answer is of it.
    pub probability: f64,
    /// What it cannot be told from.
    pub also_possible: Vec<String>,
    /// Its parameters as they were fitted.
    #[serde(default)]
    pub parameters: Vec<Estimate>,
}

/// A fitted parameter.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Estimate {
    /// Its name, and in brackets the recordings, where it is not that of all.
    pub name: String,
    /// Its value, in `unit`.
    pub value: f64,
    /// The stated standard deviation; 0 where it was not fitted.
    pub sigma: f64,
    /// The unit.
    pub unit: String,
}

/// The fit to sets that were held out.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
pub struct HeldOut {
    /// Without the effects that were found.
    pub chi2_per_dof_before: f64,
    /// With them.
    pub chi2_per_dof_after: f64,
}

/// What `answer` is worth for a campaign of `label`.
pub fn judge(label: &Label, answer: &Answer) -> Outcome {
    let place = answer.located.first().map(|first| &first.coordinate);
    worth(label, answer.verdict != "clean", place, &answer.effects)
}

/// What it is worth to assert `names` and to say nothing else: an alarm where there are any.
pub fn judge_names(label: &Label, names: &[String]) -> Outcome {
    let asserted = |name: &String| Asserted {
        name: name.clone(),
        probability: 1.0,
        also_possible: Vec::new(),
        parameters: Vec::new(),
    };
    let effects: Vec<Asserted> = names.iter().map(asserted).collect();
    worth(label, !names.is_empty(), None, &effects)
}

/// What it is worth to raise an `alarm` or none, to have `place` first, and to assert `effects`.
fn worth(label: &Label, alarm: bool, place: Option<&String>, effects: &[Asserted]) -> Outcome {
    let named: Vec<&str> = effects.iter().map(|effect| effect.name.as_str()).collect();
    if label.outside.is_some() {
        let lives = place.is_some_and(|place| label.lives.contains(place));
        return match (named.is_empty(), alarm, lives) {
            (false, ..) => Outcome::Wrong,
            (true, false, _) => Outcome::Silent,
            (true, true, true) => Outcome::Right,
            (true, true, false) => Outcome::Partly,
        };
    }
    if label.effects.is_empty() {
        return if alarm { Outcome::Wrong } else { Outcome::Right };
    }
    if named.is_empty() {
        return Outcome::Silent;
    }
    let truths = label.right();
    let is_named = |names: &Vec<&str>| are_same(names, &named);
    let held = |truth: &[&str]| are_held(effects, truth);
    if truths.iter().any(is_named) {
        Outcome::Right
    } else if truths.iter().any(|truth| truth.len() == named.len() && held(truth))
        || label.alike().iter().any(is_named)
    {
        Outcome::Possible
    } else if truths.iter().any(|truth| held(truth)) {
        Outcome::Partly
    } else {
        Outcome::Wrong
    }
}

/// Whether each of the `asserted` effects, itself or what it cannot be told from, is another one of `truth`.
fn are_held(asserted: &[Asserted], truth: &[&str]) -> bool {
    let Some((first, others)) = asserted.split_first() else { return true };
    let holds = |name: &str| first.name == name || first.also_possible.iter().any(|rival| rival == name);
    (0..truth.len()).filter(|&place| holds(truth[place])).any(|place| {
        let mut rest = truth.to_vec();
        rest.remove(place);
        are_held(others, &rest)
    })
}
