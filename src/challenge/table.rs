//! The score as text and as JSON.

use super::judge::Outcome;
use super::label::Label;
use super::score::{Calibration, Judged, PROBABILITIES, STRENGTHS, Scored, Tally};
use crate::study::interval;
use serde_json::{Value, json};
use std::fmt::Write;

/// The score as lines of text: tables by kind and strength, alarms, calibration, and every case that was not right.
pub fn table(scored: &Scored) -> String {
    let mut text = String::new();
    let mut line = |cells: String| {
        let _ = writeln!(text, "{}", cells.trim_end());
    };
    let heads: String = Outcome::ALL.iter().map(|row| format!("{:>9}", row.1)).collect();
    line(format!("{:<22}{:>6}{heads}{:>9}", "", "cases", "a case"));
    for (kind, tally) in &scored.kinds {
        line(row(&kind.to_string(), tally));
    }
    line(row("all", &scored.all));
    line(String::new());
    line(format!("{:<22}{:>6}{heads}{:>9}", "weakest effect", "cases", "a case"));
    for (range, tally) in scored.strengths.iter().enumerate().filter(|(_, tally)| tally.cases() > 0) {
        line(row(&between(&STRENGTHS, range, "rho", ""), tally));
    }
    line(String::new());
    line(format!("{:<22}{:>6}{:>9}{:>9}", "exactly right", "cases", "limit", "answers"));
    for (place, (cases, limit, right)) in scored.limit.iter().enumerate().filter(|(_, row)| row.0 > 0) {
        let name =
            place.checked_sub(1).map_or("clean".to_owned(), |range| between(&STRENGTHS, range, "rho", ""));
        line(format!("{name:<22}{cases:>6}{limit:>9}{right:>9}"));
    }
    line(String::new());
    let (clean, alarms) = scored.clean;
    let (low, high) = interval(alarms, clean);
    line(format!(
        "false alarms: {alarms} of {clean} clean campaigns (95 % interval {:.1} to {:.1} %)",
        100.0 * low,
        100.0 * high
    ));
    let (named, better) = scored.held_out;
    if named > 0 {
        line(format!(
            "held-out sets: better in {better} of {named} campaigns with a name; mean chi2 a degree of freedom {:.3} before, {:.3} after",
            scored.chi2.0 / named as f64,
            scored.chi2.1 / named as f64
        ));
    }
    for (what, ranges) in [("a name", &scored.names), ("a mismatch", &scored.mismatch)] {
        for (number, cell) in ranges.iter().enumerate().filter(|(_, cell)| cell.stated > 0) {
            line(format!(
                "{what} with probability {}: {} stated, {:.3} on average, {} true",
                between(&PROBABILITIES, number, "", "1"),
                cell.stated,
                cell.sum / cell.stated as f64,
                cell.true_ones
            ));
        }
    }
    let failed: Vec<&Judged> = scored.cases.iter().filter(|case| case.outcome != Outcome::Right).collect();
    if !failed.is_empty() {
        line(String::new());
        line("not right:".to_owned());
    }
    for case in failed {
        line(format!(
            "{}  {:<9}{}; answered: {}",
            case.label.case,
            case.outcome.name(),
            truth(&case.label),
            answered(case)
        ));
    }
    text
}

fn row(name: &str, tally: &Tally) -> String {
    let cells: String = Outcome::ALL.iter().map(|row| format!("{:>9}", tally.of(row.0))).collect();
    let score = tally.score().map_or(String::new(), |score| format!("{score:+.3}"));
    format!("{name:<22}{:>6}{cells}{score:>9}", tally.cases())
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

fn truth(label: &Label) -> String {
    let all: Vec<String> = label
        .effects
        .iter()
        .chain(&label.outside)
        .map(|hidden| {
            let beside = match hidden.rho_beside < 0.95 * hidden.rho {
                true => format!(", beside the other {:.1}", hidden.rho_beside),
                false => String::new(),
            };
            format!("{} ({:.3e} {}, rho {:.1}{beside})", hidden.name, hidden.size, hidden.unit, hidden.rho)
                .replace(" ,", ",")
        })
        .collect();
    let lives =
        if label.lives.is_empty() { String::new() } else { format!(" in {}", label.lives.join(" or ")) };
    if all.is_empty() { "clean".to_owned() } else { all.join(" + ") + &lives }
}

fn answered(case: &Judged) -> String {
    let answer = &case.answer;
    let names: Vec<String> = answer
        .effects
        .iter()
        .map(|effect| match effect.also_possible.is_empty() {
            true => effect.name.clone(),
            false => format!("{} (or {})", effect.name, effect.also_possible.join(", ")),
        })
        .collect();
    let place = answer.located.first().map_or(String::new(), |first| format!(", in {}", first.coordinate));
    format!("{} {}{place}", answer.verdict, names.join(" + ")).replace(" ,", ",").trim().to_owned()
}

/// The score for other programs.
pub fn summary(scored: &Scored) -> Value {
    let tally = |tally: &Tally| {
        let counts = Outcome::ALL.iter().map(|row| (row.1.to_owned(), json!(tally.of(row.0))));
        let mut object: serde_json::Map<String, Value> = counts.collect();
        object.insert("cases".to_owned(), json!(tally.cases()));
        object.insert("score_a_case".to_owned(), json!(tally.score()));
        Value::Object(object)
    };
    let kinds: serde_json::Map<String, Value> =
        scored.kinds.iter().map(|(kind, cases)| (kind.to_string(), tally(cases))).collect();
    let strengths: Vec<Value> = STRENGTHS
        .iter()
        .zip(&scored.strengths)
        .map(|(from, cases)| json!({"rho_from": from, "outcomes": tally(cases)}))
        .collect();
    let ranges = |ranges: &[Calibration]| -> Vec<Value> {
        let cell = |(from, cell): (&f64, &Calibration)| json!({"probability_from": from, "stated": cell.stated, "sum": cell.sum, "true": cell.true_ones});
        PROBABILITIES.iter().zip(ranges).map(cell).collect()
    };
    let cases: Vec<Value> = scored
        .cases
        .iter()
        .map(|case| json!({"case": case.label.case, "outcome": case.outcome.name(), "truth": truth(&case.label), "answered": answered(case)}))
        .collect();
    let (low, high) = interval(scored.clean.1, scored.clean.0);
    json!({
        "format": "vuris-challenge-score/1",
        "all": tally(&scored.all),
        "kinds": kinds,
        "strengths": strengths,
        "limit": scored.limit.map(|(cases, limit, right)| json!({"cases": cases, "limit": limit, "answers": right})),
        "false_alarms": {"clean": scored.clean.0, "alarms": scored.clean.1, "interval_95": [low, high]},
        "held_out": {"named": scored.held_out.0, "better": scored.held_out.1, "chi2_sum_before": scored.chi2.0, "chi2_sum_after": scored.chi2.1},
        "probability_of_names": ranges(&scored.names),
        "probability_of_mismatch": ranges(&scored.mismatch),
        "cases": cases,
    })
}
