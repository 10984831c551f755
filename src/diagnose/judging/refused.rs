//! Names that the search found and that are not asserted, and why.

use crate::diagnose::naming::found::{Found, Named};

/// A name that was found, and is not believed.
#[derive(Debug, Clone, PartialEq)]
pub struct Refused {
    /// The name.
    pub name: &'static str,
    /// What speaks against it, in words.
    pub why: String,
}

/// Why names do not stand beside what samples share at random.
const BESIDE_RANDOM: &str = "beside the errors that samples share at random its evidence does not stand";

/// Of what was `found` all that is not `asserted`, where these names stand beside random errors, some are other things, and why, and this speaks
/// `against` the rest.
pub fn refused(
    found: &Found,
    asserted: &[Named],
    standing: &[&'static str],
    others: &[(&'static str, String)],
    against: &str,
) -> Vec<Refused> {
    let is_asserted = |named: &&Named| asserted.iter().any(|asserted| asserted.name == named.name);
    let refused = found.named.iter().filter(|named| !is_asserted(named));
    let why = |name: &'static str| match others.iter().find(|other| other.0 == name) {
        Some((_, why)) => why.clone(),
        None if standing.contains(&name) => against.to_owned(),
        None => BESIDE_RANDOM.to_owned(),
    };
    refused.map(|&Named { name, .. }| Refused { name, why: why(name) }).collect()
}
