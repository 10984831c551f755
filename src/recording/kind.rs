//! What a recording was taken for.

use std::fmt;

/// The kinds of recording that the format knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A still target, the phase offset stepped over 2π.
    PhaseSweep,
    /// A still target at stepped positions.
    Rail,
    /// Runs at constant velocity, sets back to back.
    Motion,
    /// No illumination.
    Dark,
    /// Many frames a set.
    Harmonics,
    /// Anything else.
    Other,
}

/// Every kind with its name in `recording.toml`.
const KINDS: &[(Kind, &str)] = &[
    (Kind::PhaseSweep, "phase_sweep"),
    (Kind::Rail, "rail"),
    (Kind::Motion, "motion"),
    (Kind::Dark, "dark"),
    (Kind::Harmonics, "harmonics"),
    (Kind::Other, "other"),
];

impl Kind {
    /// The kind called `name`.
    pub fn named(name: &str) -> Option<Self> {
        KINDS.iter().find(|(_, known)| *known == name).map(|(kind, _)| *kind)
    }

    /// The names of all kinds, for a refusal.
    pub fn names() -> String {
        KINDS.iter().map(|(_, name)| *name).collect::<Vec<_>>().join(", ")
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = KINDS.iter().find(|(kind, _)| kind == self).map_or("other", |(_, name)| name);
        f.write_str(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_one_name() {
        for (kind, name) in KINDS {
            assert_eq!(Kind::named(name), Some(*kind));
            assert_eq!(kind.to_string(), *name);
        }
        assert_eq!(Kind::named("Rail"), None);
    }
}
