//! What a search found.

use super::alone::Alone;
use super::power::Detectable;
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::statistics::simpler::Simpler;

/// Of a camera that is described so many effects were left out at most: more are what an unknown one looks like. (Campaigns of independent generators had two at most; all answers
/// with four names were to an effect that is in no library, or to one in another form.)
const MOST_NAMES: usize = 3;

/// Whether so many `names` are more than were left out of a camera, if it is described: what one unknown effect does several known ones together may imitate.
pub fn are_many(is_described: bool, names: usize) -> bool {
    is_described && names > MOST_NAMES
}

/// An effect that is asserted.
#[derive(Debug, Clone)]
pub struct Named {
    /// Its name.
    pub name: &'static str,
    /// Evidence when it was found, beside those before it, nats.
    pub ln_bayes: f64,
    /// Score statistic and its degrees of freedom when it was found.
    pub score: (f64, usize),
    /// Other effects that do about as well in the place of one that was found with it.
    pub rivals: Vec<String>,
    /// Whether it was named though the forms of others may leave more than it explains.
    pub is_trusted: bool,
}

impl Named {
    /// Says that `other` is possible too.
    pub fn may_be(&mut self, other: &str) {
        if !self.rivals.iter().any(|rival| rival == other) {
            self.rivals.push(other.to_owned());
        }
    }
}

/// What the search found.
#[derive(Debug)]
pub struct Found {
    /// The baseline's fit.
    pub baseline: Fit,
    /// The fit with what was found; the baseline where nothing was.
    pub fit: Fit,
    /// The effects, in the order in which they were found.
    pub named: Vec<Named>,
    /// Candidates whose every column is absorbed by the pixels' own numbers.
    pub invisible: Vec<&'static str>,
    /// Smallest strengths that would be found.
    pub detectable: Vec<Detectable>,
    /// Each candidate alone at the baseline.
    pub alone: Vec<Alone>,
    /// What simpler methods name at the baseline.
    pub simpler: Simpler,
}

impl Found {
    /// The candidate `name` alone at the baseline; nothing where it is none.
    pub fn alone(&self, name: &str) -> Option<&Alone> {
        Alone::of(&self.alone, name)
    }

    /// Whether an effect is named though the forms of others may leave more than it explains.
    pub fn trusts_forms(&self) -> bool {
        self.named.iter().any(|named| named.is_trusted)
    }
}
