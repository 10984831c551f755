//! One campaign: made, diagnosed, judged.

use crate::bench::taken;
use crate::diagnose::{Data, diagnose};
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
    /// Strength of each effect, in standard deviations of the whole campaign.
    pub rho: f64,
    /// Seed of scene, noise and encoder.
    pub seed: u64,
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

/// Recordings of a campaign.
const RECORDINGS: [&str; 6] =
    ["four-sweep", "four-rail", "four-motion", "wdft-sweep", "wdft-rail", "wdft-motion"];

impl Case {
    /// A campaign without any effect.
    pub fn clean(seed: u64) -> Self {
        Self { effects: Vec::new(), lives: &[], rho: 0.0, seed }
    }

    /// The campaign; with `library` among what a diagnosis knows.
    fn data(&self, size: Geometry, library: Vec<&'static Effect>) -> Result<Data> {
        let active =
            |concealed: &Concealed| Active { effect: concealed.effect, values: concealed.values.clone() };
        let effects: Vec<Active> = self.effects.iter().map(active).collect();
        Data::of(&taken(size, self.seed, &effects, &RECORDINGS)?, library)
    }

    /// What this campaign would show of the registry's effects and those of `library`: `(effect, its first number that is seen, a standard
    /// deviation of it)`.
    ///
    /// # Errors
    /// A campaign that cannot be made.
    pub fn detectable(
        &self,
        size: Geometry,
        library: Vec<&'static Effect>,
    ) -> Result<Vec<(&'static str, usize, f64)>> {
        let found = diagnose(&self.data(size, library)?).judgement.found;
        let mut units: Vec<(&'static str, usize, f64)> = Vec::new();
        for row in found.detectable {
            if !units.iter().any(|unit| unit.0 == row.name) {
                units.extend(row.sigma.map(|sigma| (row.name, row.parameter, sigma)));
            }
        }
        Ok(units)
    }

    /// Makes and diagnoses it.
    ///
    /// # Errors
    /// A campaign that cannot be made.
    pub fn run(&self, size: Geometry) -> Result<Outcome> {
        let answer = diagnose(&self.data(size, Vec::new())?).answer;
        let error = |concealed: &Concealed| {
            let Concealed { effect, number, values } = concealed;
            let row = answer.effects.iter().find(|row| row.name == effect.name)?;
            let parameter = row.parameters.iter().find(|row| row.name == effect.parameters[*number].name)?;
            (parameter.sigma > 0.0)
                .then(|| (effect.name, (parameter.value - values[*number]) / parameter.sigma))
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
