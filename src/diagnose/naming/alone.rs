//! What a candidate says by itself.

/// A candidate by itself, in its best variant.
#[derive(Debug, Clone, Copy)]
pub struct Alone {
    /// The effect.
    pub name: &'static str,
    /// Score statistic.
    pub chi2: f64,
    /// Its degrees of freedom.
    pub degrees: usize,
    /// Evidence, nats.
    pub ln_bayes: f64,
}

impl Alone {
    /// The one of this `name` among `all`.
    pub fn of<'a>(all: &'a [Self], name: &str) -> Option<&'a Self> {
        all.iter().find(|alone| alone.name == name)
    }
}
