//! How often the diagnosis is right: campaigns without any effect, with each effect at strengths in units of its detectability, with two, and
//! with effects that it does not know.
//!
//! The campaigns are made by the simulator that the diagnosis fits: what comes out is how well it decides, not how well its physics is that
//! of a camera.

mod campaign;
mod case;
mod outside;
mod page;
mod summary;

pub use campaign::Campaign;
pub use case::{Case, Concealed, Outcome, Unit};
pub use page::page;
pub use summary::{Cell, Kind, Summary, interval};

use crate::frames::Geometry;
use crate::physics::{EFFECTS, Effect};
use crate::problem::Result;
use campaign::{OTHERS, USUAL};
use outside::outside;
use rand::SeedableRng;
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;

/// Strengths at which effects are tried, in standard deviations of the whole campaign.
pub const STRENGTHS: [f64; 3] = [6.0, 10.0, 20.0];
/// The same of effects of which there is no standard deviation, in what 95 of 100 campaigns are said to show, at least.
pub const MULTIPLES: [f64; 3] = [1.0, 2.0, 3.0];
/// Strength of each of two.
pub const STRENGTH_OF_PAIRS: f64 = 15.0;
/// Strengths of effects that no diagnosis knows.
pub const STRENGTHS_OF_UNKNOWNS: [f64; 2] = [12.0, 30.0];

/// What is studied.
#[derive(Debug, Clone)]
pub struct Study {
    /// Pixels of the campaigns.
    pub size: Geometry,
    /// Seed of the first campaign; each has its own.
    pub seed: u64,
    /// Campaigns without any effect.
    pub nulls: usize,
    /// Campaigns of each effect and strength.
    pub repeats: usize,
    /// Campaigns with two effects.
    pub pairs: usize,
    /// Campaigns of each effect that the registry has not, and strength.
    pub unknowns: usize,
}

impl Study {
    /// All cases, in an order of their own.
    ///
    /// # Errors
    /// A campaign that cannot be made.
    pub fn cases(&self) -> Result<Vec<Case>> {
        let mut seed = self.seed;
        let mut next = || {
            let this = seed;
            seed = seed.wrapping_add(1);
            this
        };
        let mut cases: Vec<Case> = (0..self.nulls).map(|_| Case::clean(&USUAL, next())).collect();
        if self.repeats + self.pairs + self.unknowns == 0 {
            return Ok(cases);
        }
        let outside = outside()?;
        // What a clean campaign says of the strength that it would show.
        let mut units = Vec::new();
        for campaign in [&USUAL].into_iter().chain(&OTHERS) {
            let library = outside.iter().map(|(effect, _)| *effect).collect();
            let shown = Case::clean(campaign, self.seed).detectable(self.size, library)?;
            units.extend(shown.into_iter().filter(|(name, ..)| Campaign::of(name) == campaign));
        }
        let unit_of = |effect: &Effect| units.iter().find(|unit| unit.0 == effect.name).map(|unit| unit.2);
        // What the campaign shows only beyond an effect's bounds is not tried.
        let concealed = |effect: &'static Effect, strength: f64| {
            let &(_, number, unit) = units.iter().find(|unit| unit.0 == effect.name)?;
            Some(Concealed { effect, number, values: at(effect, number, strength * unit.one())? })
        };
        for &effect in EFFECTS {
            let (kind, strengths) = match unit_of(effect) {
                Some(Unit::Sigma(_)) => (Kind::Single, STRENGTHS),
                Some(Unit::Smallest(_)) => (Kind::Multiple, MULTIPLES),
                None => continue,
            };
            for strength in strengths {
                let Some(alone) = concealed(effect, strength) else { continue };
                for _ in 0..self.repeats {
                    let (effects, campaign) = (vec![alone.clone()], Campaign::of(effect.name));
                    cases.push(Case { effects, lives: &[], kind, strength, campaign, seed: next() });
                }
            }
        }
        let strength = STRENGTH_OF_PAIRS;
        let may_be_of_pair = |effect: &&&'static Effect| {
            Campaign::of(effect.name) == &USUAL && matches!(unit_of(effect), Some(Unit::Sigma(_)))
        };
        let strong: Vec<Concealed> =
            EFFECTS.iter().filter(may_be_of_pair).filter_map(|effect| concealed(effect, strength)).collect();
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        for _ in 0..self.pairs {
            let effects = strong.sample(&mut rng, 2).cloned().collect();
            let (kind, campaign) = (Kind::Pair, &USUAL);
            cases.push(Case { effects, lives: &[], kind, strength, campaign, seed: next() });
        }
        for &(effect, lives) in &outside {
            for strength in STRENGTHS_OF_UNKNOWNS {
                let Some(alone) = concealed(effect, strength) else { continue };
                for _ in 0..self.unknowns {
                    let (kind, campaign) = (Kind::Unknown, &USUAL);
                    let effects = vec![alone.clone()];
                    cases.push(Case { effects, lives, kind, strength, campaign, seed: next() });
                }
            }
        }
        Ok(cases)
    }
}

/// The effect's numbers with one of them at `value` and its shapes as usual; nothing beyond the bounds.
fn at(effect: &Effect, parameter: usize, value: f64) -> Option<Vec<f64>> {
    let mut values = effect.off();
    for (number, row) in
        effect.parameters.iter().enumerate().filter(|(_, row)| row.is_shape() && !row.is_choice)
    {
        values[number] = row.typical;
    }
    let row = &effect.parameters[parameter];
    // Where the off value is a bound, the other side.
    let value = if row.off + value <= row.bounds.1 { row.off + value } else { row.off - value };
    values[parameter] = value;
    (row.bounds.0..=row.bounds.1).contains(&value).then_some(values)
}
