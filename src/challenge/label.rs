//! What is concealed in a campaign.

use super::case::CaseKind;
use super::truth::Truth;
use serde::{Deserialize, Serialize};

/// Of an effect's change, what another effect may leave for both to be called alike in a campaign, in standard deviations.
pub const NEAR: f64 = 2.5;

/// An effect of a campaign.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Hidden {
    /// The effect's name; of one that no library has, the generator's own.
    pub name: String,
    /// Its size, in `unit`.
    pub size: f64,
    /// The size's unit; empty where it has none.
    pub unit: String,
    /// Its strength alone, in standard deviations of the whole campaign with each pixel's own numbers projected out.
    pub rho: f64,
    /// What is left of that where any multiple of the other effect's change is taken away, too.
    pub rho_beside: f64,
    /// Its parameters in the registry's words, where the generator's numbers say exactly what they are.
    #[serde(default)]
    pub parameters: Vec<Truth>,
}

/// The truth about a campaign.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Label {
    /// The campaign's folder.
    pub case: String,
    /// How it was drawn.
    pub kind: CaseKind,
    /// Its effects, of those that a library has.
    pub effects: Vec<Hidden>,
    /// Sets of names that cannot be told from these by any recording of the campaign, and are as right.
    #[serde(default)]
    pub or: Vec<Vec<String>>,
    /// Sets of names in which one effect is another that would change these frames in the same way but for less than 2.5 standard
    /// deviations: to name them instead is possible.
    #[serde(default)]
    pub near: Vec<Vec<String>>,
    /// What an observer who knows each effect's exact change says.
    #[serde(default)]
    pub limit: Vec<String>,
    /// The effect that no library has.
    #[serde(default)]
    pub outside: Option<Hidden>,
    /// The coordinates where that lives; any of them is right.
    #[serde(default)]
    pub lives: Vec<String>,
    /// Strength of everything together; 0 of a clean campaign.
    pub rho: f64,
}

impl Label {
    /// Strength of the weakest effect, beside the other one; nothing of a clean campaign.
    pub fn weakest(&self) -> Option<f64> {
        self.effects.iter().chain(&self.outside).map(|hidden| hidden.rho_beside).min_by(f64::total_cmp)
    }

    /// Every set of names that is right.
    pub fn right(&self) -> Vec<Vec<&str>> {
        let own = self.effects.iter().map(|hidden| hidden.name.as_str()).collect();
        std::iter::once(own).chain(self.or.iter().map(|names| texts(names))).collect()
    }

    /// Every set of names that is possible, as [`Label::near`] has them.
    pub fn alike(&self) -> Vec<Vec<&str>> {
        self.near.iter().map(|names| texts(names)).collect()
    }
}

/// `names` as they are compared.
pub fn texts(names: &[String]) -> Vec<&str> {
    names.iter().map(String::as_str).collect()
}

/// Whether the sets of names are the same, in whatever order.
pub fn are_same(one: &[&str], other: &[&str]) -> bool {
    one.len() == other.len() && one.iter().all(|name| other.contains(name))
}
