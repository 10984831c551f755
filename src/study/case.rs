//! One campaign: made, diagnosed, judged.

use super::campaign::Campaign;
use super::summary::Kind;
use crate::diagnose::{CommonPart, Data, diagnose};
use crate::frames::Geometry;
use crate::physics::{Active, Effect};
use crate::problem::Result;

/// An effect in a campaign.
#[derive(Debug, Clone)]
pub struct Concealed {
    /// It.
    pub effect: &'static Effect,
    /// Which of its numbers is not off.
    pub number: usize,
    /// All its numbers.
    pub values: Vec<f64>,
}

/// A campaign.
#[derive(Debug, Clone)]
pub struct Case {
    /// One effect, or two; nothing in a clean campaign.
    pub effects: Vec<Concealed>,
    /// The coordinates where an effect lives that the registry has not; none of one that it has.
    pub lives: &'static [&'static str],
    /// What is in it.
    pub kind: Kind,
    /// Strength of each effect, in the unit of the kind.
    pub strength: f64,
    /// What is recorded.
    pub campaign: &'static Campaign,
    /// Seed of scene, noise and encoder.
    pub seed: u64,
}

/// In what the strength of an effect is counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unit {
    /// A standard deviation of the number.
    Sigma(f64),
    /// The smallest strength that 95 of 100 campaigns are said to show: of what is random, and what begins with a corner, there is no standard deviation.
    Smallest(f64),
}

impl Unit {
    /// One of it, in the unit of the number.
    pub fn one(self) -> f64 {
        match self {
            Self::Sigma(one) | Self::Smallest(one) => one,
        }
    }
}

/// What a diagnosis made of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The verdict's word.
    pub verdict: &'static str,
    /// The effects that were named.
    pub named: Vec<&'static str>,
    /// What was said to be possible too.
    pub possible: Vec<String>,
    /// The coordinate that leads.
    pub located: Option<&'static str>,
    /// Of effects that were named, and are there: the name, and the error of the number that is not off, in the standard deviations that were stated.
    pub errors_sigma: Vec<(&'static str, f64)>,
}

impl Case {
    /// A campaign without any effect.
    pub fn clean(campaign: &'static Campaign, seed: u64) -> Self {
        Self { effects: Vec::new(), lives: &[], kind: Kind::Clean, strength: 0.0, campaign, seed }
    }

    /// The campaign; with `library` among what a diagnosis knows.
    fn data(&self, size: Geometry, library: Vec<&'static Effect>) -> Result<Data> {
        let active =
            |concealed: &Concealed| Active { effect: concealed.effect, values: concealed.values.clone() };
        let effects: Vec<Active> = self.effects.iter().map(active).collect();
        Data::of(&self.campaign.taken(size, self.seed, &effects)?, library)
    }

    /// What this campaign would show of the registry's effects and those of `library`: of each its first number that is seen, and the unit
    /// of that.
    ///
    /// # Errors
    /// A campaign that cannot be made.
    pub fn detectable(
        &self,
        size: Geometry,
        library: Vec<&'static Effect>,
    ) -> Result<Vec<(&'static str, usize, Unit)>> {
        let diagnosis = diagnose(&self.data(size, library)?);
        let mut units: Vec<(&'static str, usize, Unit)> = Vec::new();
        for row in &diagnosis.judgement.found.detectable {
            if !units.iter().any(|unit| unit.0 == row.name) {
                let unit = row.sigma.map_or(Unit::Smallest(row.value), Unit::Sigma);
                units.push((row.name, row.parameter, unit));
            }
        }
        // What is random is not asked of columns.
        let others = diagnosis.answer.smallest_detectable.iter().map(|row| (row.name, row.value));
        for (name, value) in others {
            if !units.iter().any(|unit| unit.0 == name) {
                units.push((name, 0, Unit::Smallest(value)));
            }
        }
        Ok(units)
    }

    /// Makes and diagnoses it.
    ///
    /// # Errors
    /// A campaign that cannot be made.
    pub fn run(&self, size: Geometry) -> Result<Outcome> {
        let data = self.data(size, Vec::new())?;
        let diagnosis = diagnose(&data);
        let (answer, fit) = (&diagnosis.answer, &diagnosis.judgement.fit);
        let error = |concealed: &Concealed| {
            let Concealed { effect, number, values } = concealed;
            let row = answer.effects.iter().find(|row| row.name == effect.name)?;
            let name = effect.parameters[*number].name;
            let parameter = row.parameters.iter().find(|row| row.name == name)?;
            let common = CommonPart::of(&data, fit, effect.name);
            let truth = common.map_or(values[*number], |common| common.true_without(fit, values, *number));
            (parameter.sigma > 0.0).then(|| (effect.name, (parameter.value - truth) / parameter.sigma))
        };
        Ok(Outcome {
            verdict: answer.verdict,
            named: answer.effects.iter().map(|row| row.name).collect(),
            possible: answer.effects.iter().flat_map(|row| row.also_possible.clone()).collect(),
            located: answer.located.first().map(|row| row.coordinate),
            errors_sigma: self.effects.iter().filter_map(error).collect(),
        })
    }
}
