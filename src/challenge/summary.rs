//! The score for other programs.

use super::judge::Outcome;
use super::score::{Calibration, PROBABILITIES, Scored, median, spread};
use super::simpler::METHODS;
use super::tally::{STRENGTHS, Tallies, Tally};
use super::words::{answered, truth};
use crate::study::interval;
use serde_json::{Map, Value, json};

/// The score as JSON.
pub fn summary(scored: &Scored) -> Value {
    let answers = &scored.answers;
    let simpler = METHODS.iter().zip(&scored.simpler);
    let simpler: Map<String, Value> = simpler
        .map(|(method, tallies)| {
            let right = json!(tallies.right);
            let (clean, alarms) = tallies.clean();
            let value = json!({
                "all": outcomes(&tallies.all), "kinds": kinds(tallies), "strengths": strengths(tallies), "exactly_right": right,
                "false_alarms": {"clean": clean, "alarms": alarms},
            });
            (method.1.to_owned(), value)
        })
        .collect();
    let limit = scored.limit.iter().zip(answers.right);
    let limit: Vec<Value> = limit
        .map(|(&(cases, limit), right)| json!({"cases": cases, "limit": limit, "answers": right}))
        .collect();
    let errors = scored.errors.iter().map(|(name, errors)| {
        let (rms, within) = spread(errors);
        (name.clone(), json!({"numbers": errors.len(), "rms": rms, "within_1_96": within}))
    });
    let errors: Map<String, Value> = errors.collect();
    let cases = scored.cases.iter().map(|case| {
        let simpler = METHODS.iter().map(|method| (method.1.to_owned(), json!(method.2(&case.simpler))));
        json!({
            "case": case.label.case, "outcome": case.outcome.name(), "truth": truth(&case.label), "answered": answered(case),
            "simpler": simpler.collect::<Map<String, Value>>(),
        })
    });
    let cases: Vec<Value> = cases.collect();
    let (clean, alarms) = answers.clean();
    let (low, high) = interval(alarms, clean);
    let fits = &scored.held_out;
    json!({
        "format": "vuris-challenge-score/1",
        "all": outcomes(&answers.all),
        "kinds": kinds(answers),
        "strengths": strengths(answers),
        "simpler": simpler,
        "limit": limit,
        "false_alarms": {"clean": clean, "alarms": alarms, "interval_95": [low, high]},
        "held_out": {
            "named": fits.len(),
            "better": fits.iter().filter(|(before, after)| after < before).count(),
            "chi2_median_before": median(fits.iter().map(|fit| fit.0).collect()),
            "chi2_median_after": median(fits.iter().map(|fit| fit.1).collect()),
        },
        "errors_in_sigma": errors,
        "probability_of_names": ranges(&scored.names),
        "probability_of_mismatch": ranges(&scored.mismatch),
        "cases": cases,
    })
}

fn outcomes(tally: &Tally) -> Value {
    let counts = Outcome::ALL.iter().map(|row| (row.1.to_owned(), json!(tally.of(row.0))));
    let mut object: Map<String, Value> = counts.collect();
    object.insert("cases".to_owned(), json!(tally.cases()));
    object.insert("score_a_case".to_owned(), json!(tally.score()));
    Value::Object(object)
}

fn kinds(tallies: &Tallies) -> Value {
    tallies
        .kinds
        .iter()
        .map(|(kind, tally)| (kind.to_string(), outcomes(tally)))
        .collect::<Map<_, _>>()
        .into()
}

fn strengths(tallies: &Tallies) -> Vec<Value> {
    let row = |(from, tally): (&f64, &Tally)| json!({"rho_from": from, "outcomes": outcomes(tally)});
    STRENGTHS.iter().zip(&tallies.strengths).map(row).collect()
}

fn ranges(ranges: &[Calibration]) -> Vec<Value> {
    let cell = |(from, cell): (&f64, &Calibration)| json!({"probability_from": from, "stated": cell.stated, "sum": cell.sum, "true": cell.true_ones});
    PROBABILITIES.iter().zip(ranges).map(cell).collect()
}
