//! A phase step's angle: a fraction of a turn, exact.

use std::f64::consts::TAU;
use std::fmt;

/// An angle of numerator/denominator turns, in lowest terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StepAngle {
    numerator: i64,
    denominator: i64,
}

/// Largest numerator (either sign) and denominator of an angle.
const MOST: i64 = 1000;

impl StepAngle {
    /// `numerator`/`denominator` turns, which must be in lowest terms with `denominator` ≥ 1.
    pub(super) const fn of(numerator: i64, denominator: i64) -> Self {
        Self { numerator, denominator }
    }

    /// `numerator`/`denominator` turns; `None` where either is beyond 1000, or `denominator` is below 1.
    pub fn new(numerator: i64, denominator: i64) -> Option<Self> {
        ((-MOST..=MOST).contains(&numerator) && (1..=MOST).contains(&denominator))
            .then(|| Self::reduced(numerator, denominator))
    }

    fn reduced(numerator: i64, denominator: i64) -> Self {
        let divisor = greatest_common_divisor(numerator, denominator).max(1);
        Self { numerator: numerator / divisor, denominator: denominator / divisor }
    }

    /// Reads "1/3", "-1/4" or "0".
    pub fn parse(text: &str) -> Option<Self> {
        let number = |text: &str| text.trim().parse().ok();
        match text.split_once('/') {
            Some((numerator, denominator)) => Self::new(number(numerator)?, number(denominator)?),
            None => Self::new(number(text)?, 1),
        }
    }

    /// The numerator.
    pub const fn numerator(self) -> i64 {
        self.numerator
    }

    /// The denominator, at least 1.
    pub const fn denominator(self) -> i64 {
        self.denominator
    }

    /// `times` this angle.
    pub(super) fn times(self, times: i64) -> Self {
        Self::reduced(self.numerator * times, self.denominator)
    }

    /// The angle in turns.
    pub fn turns(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }

    /// The angle in radians.
    pub fn rad(self) -> f64 {
        TAU * self.turns()
    }
}

impl fmt::Display for StepAngle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.denominator {
            1 => write!(f, "{}", self.numerator),
            denominator => write!(f, "{}/{denominator}", self.numerator),
        }
    }
}

/// The greatest common divisor, at least 0.
pub(super) fn greatest_common_divisor(a: i64, b: i64) -> i64 {
    let (mut a, mut b) = (a.abs(), b.abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_are_read_in_lowest_terms_and_written_as_they_are_read() {
        for (text, numerator, denominator, shown) in [
            ("1/3", 1, 3, "1/3"),
            (" 2 / 8", 1, 4, "1/4"),
            ("-3/6", -1, 2, "-1/2"),
            ("0", 0, 1, "0"),
            ("0/7", 0, 1, "0"),
            ("2", 2, 1, "2"),
        ] {
            let angle = StepAngle::parse(text).unwrap();
            assert_eq!((angle.numerator(), angle.denominator()), (numerator, denominator), "{text}");
            assert_eq!(angle.to_string(), shown);
        }
        for text in ["", "1/0", "1/-3", "1.5", "a", "1/3/5", "1001", "1/1001"] {
            assert_eq!(StepAngle::parse(text), None, "{text}");
        }
        let third = StepAngle::of(1, 3);
        assert_eq!((third.times(3), third.times(4)), (StepAngle::of(1, 1), StepAngle::of(4, 3)));
    }
}
