//! The score as text.

use super::judge::Outcome;
use super::score::{Calibration, Judged, PROBABILITIES, Scored, median, spread};
use super::simpler::METHODS;
use super::tally::{STRENGTHS, Tally};
use super::words::{answered, truth};
use crate::study::interval;
use std::fmt::Write;

/// The score as lines of text: tables by kind and strength, beside what simpler methods have; alarms, fit, errors of parameters,
/// calibration, and every case that was not right.
pub fn table(scored: &Scored) -> String {
    let mut text = String::new();
    for part in
        [tallies(scored), limits(scored), fits(scored), errors(scored), calibration(scored), failed(scored)]
    {
        for line in part {
            let _ = writeln!(text, "{}", line.trim_end());
        }
    }
    text
}

/// Outcomes by kind and by strength, and the score a case, last that of the simpler methods.
fn tallies(scored: &Scored) -> Vec<String> {
    let outcomes: String = Outcome::ALL.iter().map(|row| format!("{:>9}", row.1)).collect();
    let methods: String = METHODS.iter().map(|method| format!("{:>12}", method.0)).collect();
    let head = |name: &str| format!("{name:<22}{:>6}{outcomes}{:>9}{methods}", "cases", "a case");
    let mut lines = vec![head("")];
    for (kind, tally) in &scored.answers.kinds {
        let simpler = scored.simpler.each_ref().map(|method| method.kinds.get(kind));
        lines.push(row(&kind.to_string(), tally, simpler));
    }
    lines.push(row("all", &scored.answers.all, scored.simpler.each_ref().map(|method| Some(&method.all))));
    lines.extend([String::new(), head("weakest effect")]);
    let ranges = scored.answers.strengths.iter().enumerate();
    for (range, tally) in ranges.filter(|(_, tally)| tally.cases() > 0) {
        let simpler = scored.simpler.each_ref().map(|method| Some(&method.strengths[range]));
        lines.push(row(&between(&STRENGTHS, range, "rho", ""), tally, simpler));
    }
    lines
}

fn row(name: &str, tally: &Tally, simpler: [Option<&Tally>; METHODS.len()]) -> String {
    let score = |tally: &Tally| tally.score().map_or(String::new(), |score| format!("{score:+.3}"));
    let cells: String = Outcome::ALL.iter().map(|row| format!("{:>9}", tally.of(row.0))).collect();
    let simpler: String =
        simpler.into_iter().flatten().map(|tally| format!("{:>12}", score(tally))).collect();
    format!("{name:<22}{:>6}{cells}{:>9}{simpler}", tally.cases(), score(tally))
}

/// How often the limit, the answers and the simpler methods are exactly right.
fn limits(scored: &Scored) -> Vec<String> {
    let methods: String = METHODS.iter().map(|method| format!("{:>12}", method.0)).collect();
    let head = format!("{:<22}{:>6}{:>9}{:>9}{methods}", "exactly right", "cases", "limit", "answers");
    let mut lines = vec![String::new(), head];
    for (place, (cases, limit)) in scored.limit.iter().enumerate().filter(|(_, row)| row.0 > 0) {
        let name =
            place.checked_sub(1).map_or("clean".to_owned(), |range| between(&STRENGTHS, range, "rho", ""));
        let right = scored.answers.right[place];
        let simpler: String =
            scored.simpler.iter().map(|method| format!("{:>12}", method.right[place])).collect();
        lines.push(format!("{name:<22}{cases:>6}{limit:>9}{right:>9}{simpler}"));
    }
    lines.push(String::new());
    let (clean, alarms) = scored.answers.clean();
    let (low, high) = interval(alarms, clean);
    let simpler = scored.simpler.iter().zip(METHODS);
    let simpler: String =
        simpler.map(|(method, (name, ..))| format!("; {name}: {}", method.clean().1)).collect();
    lines.push(format!(
        "false alarms: {alarms} of {clean} clean campaigns (95 % interval {:.1} to {:.1} %){simpler}",
        100.0 * low,
        100.0 * high
    ));
    lines
}

/// The fit to sets that were held out.
fn fits(scored: &Scored) -> Vec<String> {
    let fits = &scored.held_out;
    let median = |of: fn(&(f64, f64)) -> f64| median(fits.iter().map(of).collect());
    let (Some(before), Some(after)) = (median(|fit| fit.0), median(|fit| fit.1)) else { return Vec::new() };
    let better = fits.iter().filter(|(before, after)| after < before).count();
    vec![format!(
        "held-out sets: better in {better} of {} campaigns with a name; median chi2 a degree of freedom {before:.3} before, {after:.3} after",
        fits.len()
    )]
}

/// The errors of fitted parameters, in the standard deviations that are stated.
fn errors(scored: &Scored) -> Vec<String> {
    let all: Vec<f64> = scored.errors.values().flatten().copied().collect();
    let (named, known) = scored.named;
    if named == 0 {
        return Vec::new();
    }
    let mut lines =
        vec![String::new(), format!("{:<27}{:>9}{:>9}{:>9}", "errors in sigma", "numbers", "RMS", "in 1.96")];
    let mut line = |name: &str, errors: &[f64]| {
        if !errors.is_empty() {
            let (rms, within) = spread(errors);
            lines.push(format!("{name:<27}{:>9}{rms:>9.2}{within:>9}", errors.len()));
        }
    };
    scored.errors.iter().for_each(|(name, errors)| line(name, errors));
    line("all", &all);
    lines.push(format!(
        "of {named} effects in answers that are right, the generator tells the parameters of {known} exactly"
    ));
    lines
}

/// Probabilities that were stated, and how often that was true.
fn calibration(scored: &Scored) -> Vec<String> {
    let mut lines = vec![String::new()];
    for (what, ranges) in [("a name", &scored.names), ("a mismatch", &scored.mismatch)] {
        let stated = |(_, cell): &(usize, &Calibration)| cell.stated > 0;
        lines.extend(ranges.iter().enumerate().filter(stated).map(|(number, cell)| {
            format!(
                "{what} with probability {}: {} stated, {:.3} on average, {} true",
                between(&PROBABILITIES, number, "", "1"),
                cell.stated,
                cell.sum / cell.stated as f64,
                cell.true_ones
            )
        }));
    }
    lines
}

/// Every case that was not right.
fn failed(scored: &Scored) -> Vec<String> {
    let failed: Vec<&Judged> = scored.cases.iter().filter(|case| case.outcome != Outcome::Right).collect();
    if failed.is_empty() {
        return Vec::new();
    }
    let case = |case: &Judged| {
        let (outcome, truth) = (case.outcome.name(), truth(&case.label));
        format!("{}  {outcome:<9}{truth}; answered: {}", case.label.case, answered(case))
    };
    [String::new(), "not right:".to_owned()].into_iter().chain(failed.into_iter().map(case)).collect()
}

/// A range of `ends` in words; the last one ends at `last`, or is open.
fn between(ends: &[f64], number: usize, of: &str, last: &str) -> String {
    let upper = ends.get(number + 1).map_or(last.to_owned(), ToString::to_string);
    let range = if upper.is_empty() {
        format!("from {}", ends[number])
    } else {
        format!("{} to {upper}", ends[number])
    };
    format!("{of} {range}").trim_start().to_owned()
}
