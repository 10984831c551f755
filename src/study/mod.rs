//! How often the diagnosis is right: campaigns without any effect, and with each effect at strengths in units of its detectability.
//!
//! The campaigns are made by the simulator that the diagnosis fits: what comes out is how well it decides, not how well its physics is that
//! of a camera.

mod case;
mod page;
mod summary;

pub use case::{Case, Outcome};
pub use page::page;
pub use summary::{Cell, Summary, interval};

use crate::frames::Geometry;
use crate::physics::{Chance, EFFECTS, Effect, effects};
use crate::problem::Result;

/// Strengths at which effects are tried, in standard deviations of the whole campaign.
pub const STRENGTHS: [f64; 3] = [6.0, 10.0, 20.0];

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
}

impl Study {
    /// All cases, in an order of their own.
    ///
    /// # Errors
    /// A campaign that cannot be made.
    pub fn cases(&self) -> Result<Vec<Case>> {
        let mut seed = self.seed;
        let mut next = || {
            seed += 1;
            seed
        };
        let mut cases: Vec<Case> =
            (0..self.nulls).map(|_| Case { effect: None, rho: 0.0, seed: next() }).collect();
        if self.repeats == 0 {
            return Ok(cases);
        }
        // What a clean campaign says of the strength that it would show.
        let units = Case { effect: None, rho: 0.0, seed: self.seed }.detectable(self.size)?;
        for effect in EFFECTS.iter().filter(|effect| is_tried(effect)) {
            let Some(unit) = units.iter().find(|unit| unit.0 == effect.name) else { continue };
            for rho in STRENGTHS {
                for _ in 0..self.repeats {
                    let values = at(effect, unit.1, rho * unit.2);
                    // What the campaign shows only beyond the effect's bounds is not tried.
                    if let Some(values) = values {
                        cases.push(Case { effect: Some((effect, unit.1, values)), rho, seed: next() });
                    }
                }
            }
        }
        Ok(cases)
    }
}

/// Effects with a strength that a number says, without chance.
fn is_tried(effect: &Effect) -> bool {
    effect.chance == Chance::None && effect.name != effects::FIXED_POINT
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
