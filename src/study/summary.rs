//! What the cases say together.

use super::case::{Case, Outcome};
use std::collections::BTreeMap;

/// Cases of one kind.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Cell {
    /// The effect alone was named.
    pub right: usize,
    /// Another was, and the effect was said to be possible too.
    pub possible: usize,
    /// Nothing was named, and no alarm raised.
    pub silent: usize,
    /// An alarm, and no name.
    pub unexplained: usize,
    /// Another effect was named.
    pub wrong: usize,
}

/// Everything that a study found.
#[derive(Debug, Clone, Default)]
pub struct Summary {
    /// Clean campaigns, and alarms among them.
    pub nulls: (usize, usize),
    /// The alarms: seed, and what was said.
    pub alarms: Vec<(u64, String)>,
    /// By effect and strength (in tenths of a standard deviation).
    pub cells: BTreeMap<(&'static str, u32), Cell>,
    /// Numbers whose 95 % interval was stated, those that lie within, and those within three standard deviations.
    pub intervals: (usize, usize, usize),
    /// What was named in place of what: `(effect, named)`, and how often.
    pub confused: BTreeMap<(&'static str, String), usize>,
}

/// Half width of the 95 % interval, in standard deviations.
const INTERVAL_SIGMAS: f64 = 1.96;

impl Summary {
    /// Of cases and their outcomes.
    pub fn of<'a>(outcomes: impl IntoIterator<Item = (&'a Case, &'a Outcome)>) -> Self {
        let mut summary = Self::default();
        for (case, outcome) in outcomes {
            let Some((effect, ..)) = &case.effect else {
                summary.nulls.0 += 1;
                if outcome.verdict != "clean" {
                    summary.nulls.1 += 1;
                    summary
                        .alarms
                        .push((case.seed, format!("{} {}", outcome.verdict, outcome.named.join(" + "))));
                }
                continue;
            };
            let name = effect.name;
            let cell = summary.cells.entry((name, (10.0 * case.rho).round() as u32)).or_default();
            *match outcome.named[..] {
                [named] if named == name => &mut cell.right,
                [] if outcome.verdict == "clean" => &mut cell.silent,
                [] => &mut cell.unexplained,
                _ if outcome.possible.iter().any(|possible| possible == name) => &mut cell.possible,
                _ => &mut cell.wrong,
            } += 1;
            if !outcome.named.is_empty() && outcome.named != [name] {
                *summary.confused.entry((name, outcome.named.join(" + "))).or_default() += 1;
            }
            if let Some(error) = outcome.error_sigma {
                summary.intervals.0 += 1;
                summary.intervals.1 += usize::from(error.abs() < INTERVAL_SIGMAS);
                summary.intervals.2 += usize::from(error.abs() < 3.0);
            }
        }
        summary
    }

    /// All cells of a strength together.
    pub fn at(&self, rho: f64) -> Cell {
        let tenths = (10.0 * rho).round() as u32;
        let mut total = Cell::default();
        for cell in self.cells.iter().filter(|((_, strength), _)| *strength == tenths).map(|(_, cell)| cell) {
            total.right += cell.right;
            total.possible += cell.possible;
            total.silent += cell.silent;
            total.unexplained += cell.unexplained;
            total.wrong += cell.wrong;
        }
        total
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
    use super::*;
    use crate::physics::effects;

    #[test]
    fn outcomes_are_counted_as_what_they_are() {
        let lag = effects::named("image_lag").unwrap();
        let case = Case { effect: Some((lag, 0, vec![0.01])), rho: 10.0, seed: 1 };
        let clean = Case { effect: None, rho: 0.0, seed: 1 };
        let outcome = |verdict, named: &[&'static str], possible: &[&str], error_sigma| Outcome {
            verdict,
            named: named.to_vec(),
            possible: possible.iter().map(|name| (*name).to_owned()).collect(),
            error_sigma,
        };
        let outcomes = [
            (&case, outcome("explained", &["image_lag"], &[], Some(1.0))),
            (&case, outcome("explained", &["image_lag"], &[], Some(-2.5))),
            (&case, outcome("explained", &["saturation"], &["image_lag"], None)),
            (&case, outcome("explained", &["saturation"], &[], None)),
            (&case, outcome("explained", &["image_lag", "saturation"], &[], Some(0.1))),
            (&case, outcome("unexplained", &[], &[], None)),
            (&case, outcome("clean", &[], &[], None)),
            (&clean, outcome("clean", &[], &[], None)),
            (&clean, outcome("unexplained", &[], &[], None)),
        ];
        let summary = Summary::of(outcomes.iter().map(|(case, outcome)| (*case, outcome)));
        assert_eq!(summary.nulls, (2, 1));
        assert_eq!(summary.at(10.0), Cell { right: 2, possible: 1, silent: 1, unexplained: 1, wrong: 2 });
        assert_eq!(summary.intervals, (3, 2, 3));
        assert_eq!(summary.alarms, [(1, "unexplained ".to_owned())]);
        assert_eq!(summary.confused.get(&("image_lag", "saturation".to_owned())), Some(&2));
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
