//! What two simpler methods name, as `vuris diagnose --simpler` writes it.

use serde::Deserialize;

/// The names that each method asserts.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize)]
pub struct Simpler {
    /// `vuris-simpler/1`.
    pub format: String,
    /// The single effect with the best BIC, if that is better than none's.
    pub best_single: Vec<String>,
    /// Effects that sparse regression keeps.
    pub sparse_regression: Vec<String>,
}

/// Gives a method's names.
type Names = fn(&Simpler) -> &[String];

/// The methods, each by its name in a table, its name in a file, and its answer.
pub const METHODS: [(&str, &str, Names); 2] = [
    ("one by BIC", "best_single", |simpler| &simpler.best_single),
    ("sparse", "sparse_regression", |simpler| &simpler.sparse_regression),
];
