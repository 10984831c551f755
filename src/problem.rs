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

/// From this likeness on (Jaro and Winkler's; 1 for equals) a name may be meant by another: a slip of the keyboard, or a beginning.
const ALIKE: f64 = 0.8;

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

    /// The same problem at another `place`: in a file, of what stands there as it would stand on the command line.
    #[must_use]
    pub fn moved_to(self, place: impl fmt::Display) -> Self {
        Self { place: place.to_string(), ..self }
    }

    /// As the way out, that one of the names `known` that `name` looks most like.
    #[must_use]
    pub fn nearest<'a>(self, name: &str, known: impl IntoIterator<Item = &'a str>) -> Self {
        let likeness = |known: &str| strsim::jaro_winkler(name, known);
        let nearest = known.into_iter().max_by(|one, other| likeness(one).total_cmp(&likeness(other)));
        match nearest.filter(|known| likeness(known) > ALIKE) {
            Some(known) => self.remedy(format_args!("did you mean {known}?")),
            None => self.remedy("correct the spelling, or remove it"),
        }
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
