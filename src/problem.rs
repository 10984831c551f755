//! The one error of the program: a refusal that names the place, the value, what is allowed, and the way out.

use std::fmt;
use std::path::Path;

/// What was wrong, where, what would have been right, and what to do about it.
///
/// ```
/// use vuris::problem::Problem;
/// let problem = Problem::at("camera.toml", "sensor.adc_bits = 40")
///     .expected("a whole number from 8 to 16")
///     .remedy("set the width of the converter");
/// assert_eq!(
///     problem.to_string(),
///     "camera.toml: sensor.adc_bits = 40\n  expected: a whole number from 8 to 16\n  way out: set the width of the converter"
/// );
/// ```
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct Problem {
    place: String,
    found: String,
    expected: Option<String>,
    remedy: Option<String>,
}

/// The result of anything that a user's input can make fail.
pub type Result<T> = std::result::Result<T, Problem>;

impl Problem {
    /// A problem at `place` (a file, or a file and line), where `found` is what was met there.
    pub fn at(place: impl fmt::Display, found: impl fmt::Display) -> Self {
        Self { place: place.to_string(), found: found.to_string(), expected: None, remedy: None }
    }

    /// A problem with the file or folder at `path`.
    pub fn in_file(path: &Path, found: impl fmt::Display) -> Self {
        Self::at(path.display(), found)
    }

    /// An operating system's refusal to `action` (a verb: "read", "write") the file at `path`.
    pub fn io(path: &Path, action: &str, error: &std::io::Error) -> Self {
        Self::in_file(path, format_args!("cannot {action}: {error}"))
    }

    /// What was met there.
    pub fn found(&self) -> &str {
        &self.found
    }

    /// What is allowed there.
    #[must_use]
    pub fn expected(mut self, expected: impl fmt::Display) -> Self {
        self.expected = Some(expected.to_string());
        self
    }

    /// What the user can do.
    #[must_use]
    pub fn remedy(mut self, remedy: impl fmt::Display) -> Self {
        self.remedy = Some(remedy.to_string());
        self
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.found)?;
        if let Some(expected) = &self.expected {
            write!(f, "\n  expected: {expected}")?;
        }
        if let Some(remedy) = &self.remedy {
            write!(f, "\n  way out: {remedy}")?;
        }
        Ok(())
    }
}
