//! What the cases say together.

use super::case::{Case, Outcome};
use std::collections::BTreeMap;

/// What is in a campaign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Nothing.
    Clean,
    /// An effect of the registry, of which a strength has a standard deviation.
    Single,
    /// One of which it has none: its strength is a multiple of the smallest one that is said to show.
    Multiple,
    /// Two.
    Pair,
    /// One that the registry has not.
    Unknown,
}

/// Cases of one kind.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Cell {
    /// The effects were named, and no other; of an unknown one: none was, and it was located where it lives.
    pub right: usize,
    /// Others were, and what was said to be possible too completes them.
    pub possible: usize,
    /// One of two, and no other.
    pub part: usize,
    /// Nothing was named, and no alarm raised.
    pub silent: usize,
    /// An alarm, and no name; of an unknown effect: located elsewhere.
    pub unexplained: usize,
    /// Another effect was named.
    pub wrong: usize,
}

impl Cell {
    /// How many there are.
    pub fn cases(&self) -> usize {
        self.right + self.possible + self.part + self.silent + self.unexplained + self.wrong
    }
}

/// Everything that a study found.
#[derive(Debug, Clone, Default)]
pub struct Summary {
    /// Clean campaigns.
    pub nulls: usize,
    /// Alarms among them: seed, and what was said.
    pub alarms: Vec<(u64, String)>,
    /// By kind, effects and strength (in tenths).
    pub cells: BTreeMap<(Kind, String, u32), Cell>,
    /// Numbers whose 95 % interval was stated, those that lie within, and those within three standard deviations.
    pub intervals: (usize, usize, usize),
    /// Those that lie outside: the effect, kind and strength (in tenths), and by how many standard deviations its number is off.
    pub missed: Vec<(&'static str, (Kind, u32), f64)>,
    /// What was named in place of what: `(effects, named)`, and how often.
    pub confused: BTreeMap<(String, String), usize>,
}

/// Half width of the 95 % interval, in standard deviations.
const INTERVAL_SIGMAS: f64 = 1.96;

impl Summary {
    /// Of cases and their outcomes.
    pub fn of<'a>(outcomes: impl IntoIterator<Item = (&'a Case, &'a Outcome)>) -> Self {
        let mut summary = Self::default();
        for (case, outcome) in outcomes {
            let names: Vec<&str> = case.effects.iter().map(|concealed| concealed.effect.name).collect();
            if case.kind == Kind::Clean {
                summary.nulls += 1;
                if outcome.verdict != "clean" {
                    let said = format!("{} {}", outcome.verdict, outcome.named.join(" + "));
                    summary.alarms.push((case.seed, said));
                }
                continue;
            }
            let at = (case.kind, tenths(case.strength));
            let key = (at.0, names.join(" + "), at.1);
            let count = judged(case, &names, outcome);
            *count(summary.cells.entry(key).or_default()) += 1;
            let is_other = outcome.named.iter().any(|named| !names.contains(named));
            if is_other {
                *summary.confused.entry((names.join(" + "), outcome.named.join(" + "))).or_default() += 1;
            }
            for &(name, error) in &outcome.errors_sigma {
                let is_within = error.abs() < INTERVAL_SIGMAS;
                summary.intervals.0 += 1;
                summary.intervals.1 += usize::from(is_within);
                summary.intervals.2 += usize::from(error.abs() < 3.0);
                if !is_within {
                    summary.missed.push((name, at, error));
                }
            }
        }
        summary
    }

    /// All cells of a kind and strength together.
    pub fn at(&self, of: Kind, at: f64) -> Cell {
        let mut total = Cell::default();
        for ((kind, _, strength), cell) in &self.cells {
            if *kind == of && *strength == tenths(at) {
                total.right += cell.right;
                total.possible += cell.possible;
                total.part += cell.part;
                total.silent += cell.silent;
                total.unexplained += cell.unexplained;
                total.wrong += cell.wrong;
            }
        }
        total
    }
}

/// A strength in tenths, by which cells are found.
pub fn tenths(strength: f64) -> u32 {
    (10.0 * strength).round() as u32
}

/// Where a case is counted.
fn judged(case: &Case, names: &[&str], outcome: &Outcome) -> fn(&mut Cell) -> &mut usize {
    let missed: Vec<&str> = names.iter().copied().filter(|name| !outcome.named.contains(name)).collect();
    let hits = names.len() - missed.len();
    let others = outcome.named.len() - hits;
    let is_said = |name: &&str| outcome.possible.iter().any(|possible| possible == name);
    let is_alarm = outcome.verdict != "clean";
    let lives = outcome.located.is_some_and(|located| case.lives.contains(&located));
    match (hits, others) {
        (0, 0) if !is_alarm => |cell| &mut cell.silent,
        (0, 0) if case.kind == Kind::Unknown && lives => |cell| &mut cell.right,
        (0, 0) => |cell| &mut cell.unexplained,
        (_, 0) if missed.is_empty() => |cell| &mut cell.right,
        (_, others) if missed.len() == others && missed.iter().all(is_said) => |cell| &mut cell.possible,
        (_, 0) => |cell| &mut cell.part,
        _ => |cell| &mut cell.wrong,
    }
}

/// The 95 % interval of a share of which `some` of `all` were seen (Wilson 1927).
pub fn interval(some: usize, all: usize) -> (f64, f64) {
    if all == 0 {
        return (0.0, 1.0);
    }
    let (n, z) = (all as f64, INTERVAL_SIGMAS);
    let share = some as f64 / n;
    let middle = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
    let half = z / (1.0 + z * z / n) * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
    ((middle - half).max(0.0), (middle + half).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::super::Concealed;
    use super::super::campaign::USUAL;
    use super::*;
    use crate::physics::effects;

    #[test]
    fn outcomes_are_counted_as_what_they_are() {
        let concealed = |name: &str| {
            let effect = effects::named(name).unwrap();
            Concealed { effect, number: 0, values: effect.off() }
        };
        let case = |names: &[&str], lives: &'static [&'static str]| {
            let effects = names.iter().map(|name| concealed(name)).collect();
            let kind = match (names.len(), lives) {
                (1, []) => Kind::Single,
                (_, []) => Kind::Pair,
                _ => Kind::Unknown,
            };
            Case { effects, lives, kind, strength: 10.0, campaign: &USUAL, seed: 1 }
        };
        let (lag, clean) = (case(&["image_lag"], &[]), Case::clean(&USUAL, 1));
        let (pair, unknown) = (case(&["image_lag", "frame_gain"], &[]), case(&["lens_scatter"], &["set"]));
        let outcome = |verdict, named: &[&'static str], possible: &[&str], errors_sigma: &[f64]| Outcome {
            verdict,
            named: named.to_vec(),
            possible: possible.iter().map(|name| (*name).to_owned()).collect(),
            located: Some("set"),
            errors_sigma: errors_sigma.iter().map(|&error| ("image_lag", error)).collect(),
        };
        let outcomes = [
            (&lag, outcome("explained", &["image_lag"], &[], &[1.0])),
            (&lag, outcome("explained", &["image_lag"], &[], &[-2.5])),
            (&lag, outcome("explained", &["saturation"], &["image_lag"], &[])),
            (&lag, outcome("explained", &["saturation"], &[], &[])),
            (&lag, outcome("explained", &["image_lag", "saturation"], &[], &[0.1])),
            (&lag, outcome("unexplained", &[], &[], &[])),
            (&lag, outcome("clean", &[], &[], &[])),
            (&clean, outcome("clean", &[], &[], &[])),
            (&clean, outcome("unexplained", &[], &[], &[])),
            (&pair, outcome("explained", &["frame_gain", "image_lag"], &[], &[1.0, 2.0])),
            (&pair, outcome("explained", &["frame_gain"], &["image_lag"], &[])),
            (&pair, outcome("explained", &["frame_gain", "saturation"], &["image_lag"], &[])),
            (&pair, outcome("explained", &["frame_gain", "image_lag", "saturation"], &[], &[])),
            (&unknown, outcome("unexplained", &[], &[], &[])),
            (&unknown, Outcome { located: Some("frame"), ..outcome("unexplained", &[], &[], &[]) }),
            (&unknown, outcome("explained", &["saturation"], &[], &[])),
        ];
        let summary = Summary::of(outcomes.iter().map(|(case, outcome)| (*case, outcome)));
        assert_eq!((summary.nulls, &summary.alarms[..]), (2, &[(1, "unexplained ".to_owned())][..]));
        let none = Cell::default();
        let singles = Cell { right: 2, possible: 1, silent: 1, unexplained: 1, wrong: 2, ..none };
        assert_eq!(summary.at(Kind::Single, 10.0), singles);
        assert_eq!(summary.at(Kind::Pair, 10.0), Cell { right: 1, possible: 1, part: 1, wrong: 1, ..none });
        assert_eq!(summary.at(Kind::Unknown, 10.0), Cell { right: 1, unexplained: 1, wrong: 1, ..none });
        assert_eq!(summary.intervals, (5, 3, 5));
        assert_eq!(
            summary.missed,
            [("image_lag", (Kind::Single, 100), -2.5), ("image_lag", (Kind::Pair, 100), 2.0)]
        );
        let (of, named) = ("image_lag".to_owned(), "saturation".to_owned());
        assert_eq!(summary.confused.get(&(of, named)), Some(&2));
    }

    /// Wilson's interval for 0 of 200 and 10 of 20, as published tables have it.
    #[test]
    fn the_interval_is_wilsons() {
        let (low, high) = interval(0, 200);
        assert!(low == 0.0 && (high - 0.0188).abs() < 1e-4, "{high}");
        let (low, high) = interval(10, 20);
        assert!((low - 0.2993).abs() < 1e-4 && (high - 0.7007).abs() < 1e-4, "{low} {high}");
    }
}
