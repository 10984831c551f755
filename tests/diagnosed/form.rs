//! The form of a verdict, `vuris-verdict/1`: the fields, what is in them, and what goes with what.

use serde_json::Value;

const VERDICTS: [&str; 4] = ["clean", "explained", "partly_explained", "unexplained"];
const COORDINATES: [&str; 12] = [
    "phase",
    "position_m",
    "velocity_m_s",
    "frame",
    "time_s",
    "row",
    "column",
    "code",
    "amplitude",
    "set",
    "encoder",
    "neighbours",
];
/// All fields, in their order.
const FIELDS: [&str; 12] = [
    "format",
    "verdict",
    "probability_of_mismatch",
    "located",
    "effects",
    "ruled_out",
    "held_out",
    "remainder",
    "next_recording",
    "invisible",
    "smallest_detectable",
    "provenance",
];

/// What a field holds.
#[derive(Debug, Clone, Copy)]
enum Kind {
    Text,
    Coordinate,
    /// A coordinate, or null where nothing stands out.
    Left,
    Share,
    Finite,
    NotNegative,
    /// A number, or null where nothing is known.
    Known,
    Count,
    Truth,
    Texts,
    List,
    Object,
}
use Kind::{Coordinate, Count, Finite, Known, Left, List, NotNegative, Object, Share, Text, Texts, Truth};

impl Kind {
    fn has(self, value: &Value) -> bool {
        let number = value.as_f64().unwrap_or(f64::NAN);
        match self {
            Text => value.as_str().is_some_and(|text| !text.is_empty()),
            Coordinate => value.as_str().is_some_and(|text| COORDINATES.contains(&text)),
            Left => value.is_null() || Coordinate.has(value),
            Share => (0.0..=1.0).contains(&number),
            Finite => number.is_finite(),
            NotNegative => number >= 0.0,
            Known => value.is_null() || number >= 0.0,
            Count => value.is_u64(),
            Truth => value.is_boolean(),
            Texts => value.as_array().is_some_and(|all| all.iter().all(Value::is_string)),
            List => value.is_array(),
            Object => value.is_object(),
        }
    }
}

/// The rows of each list of the answer.
const ROWS: [(&str, &[(&str, Kind)]); 6] = [
    (
        "located",
        &[
            ("coordinate", Coordinate),
            ("recording", Text),
            ("shape", Text),
            ("p", Share),
            ("rms_dn", NotNegative),
        ],
    ),
    (
        "effects",
        &[
            ("name", Text),
            ("sentence", Text),
            ("probability", Share),
            ("alias_risk", Share),
            ("also_possible", Texts),
            ("parameters", List),
            ("evidence", Object),
        ],
    ),
    ("ruled_out", &[("name", Text), ("by", Text), ("share", Share)]),
    ("next_recording", &[("to_separate", Texts), ("what", Text), ("expected_rho", NotNegative)]),
    ("invisible", &[("name", Text), ("why", Text)]),
    ("smallest_detectable", &[("name", Text), ("parameter", Text), ("value", NotNegative), ("unit", Text)]),
];
const PARAMETER: &[(&str, Kind)] =
    &[("name", Text), ("value", Finite), ("sigma", NotNegative), ("unit", Text), ("at_bound", Truth)];
const EVIDENCE: &[(&str, Kind)] = &[
    ("delta_chi2", Finite),
    ("degrees_of_freedom", Count),
    ("ln_bayes_factor", Finite),
    ("detectability_rho", NotNegative),
];
const HELD_OUT: &[(&str, Kind)] = &[
    ("chi2_per_dof_before", Known),
    ("chi2_per_dof_after", Known),
    ("rms_dn_before", Known),
    ("rms_dn_after", Known),
    ("frame_mean_rms_dn_before", Known),
    ("frame_mean_rms_dn_after", Known),
    ("distance_rms_m_before", Known),
    ("distance_rms_m_after", Known),
    ("z", Finite),
    ("sets", Count),
    ("by_frames", List),
];

const REMAINDER: &[(&str, Kind)] = &[("share", Share), ("coordinate", Left)];

fn check_row(what: &str, row: &Value, fields: &[(&str, Kind)]) {
    let known: Vec<&str> = fields.iter().map(|field| field.0).collect();
    let has: Vec<&String> = row.as_object().unwrap_or_else(|| panic!("{what}: {row}")).keys().collect();
    assert_eq!(has, known, "{what}");
    for (name, kind) in fields {
        assert!(kind.has(&row[*name]), "{what}: {name} is {}, not {kind:?}", row[*name]);
    }
}

/// Panics where `verdict` has not the form.
pub fn check(verdict: &Value) {
    let has: Vec<&String> = verdict.as_object().expect("an object").keys().collect();
    assert_eq!(has, FIELDS);
    assert_eq!(verdict["format"], "vuris-verdict/1");
    let word = verdict["verdict"].as_str().unwrap_or_default();
    assert!(VERDICTS.contains(&word), "{word}");
    assert!(Share.has(&verdict["probability_of_mismatch"]), "{verdict}");
    for (list, fields) in ROWS {
        for row in verdict[list].as_array().unwrap_or_else(|| panic!("{list}: {verdict}")) {
            check_row(list, row, fields);
        }
    }
    let effects = verdict["effects"].as_array().expect("checked above");
    for effect in effects {
        let parameters = effect["parameters"].as_array().expect("checked above");
        parameters.iter().for_each(|row| check_row("parameters", row, PARAMETER));
        assert!(!parameters.is_empty(), "{effect}");
        check_row("evidence", &effect["evidence"], EVIDENCE);
    }
    check_row("held_out", &verdict["held_out"], HELD_OUT);
    check_row("remainder", &verdict["remainder"], REMAINDER);
    assert!(verdict["provenance"].is_object());
    // A clean answer has neither place nor name, an unexplained one no name, and the others have names.
    let located = verdict["located"].as_array().expect("checked above");
    assert_eq!(effects.is_empty(), ["clean", "unexplained"].contains(&word), "{word}: {effects:?}");
    assert!(located.is_empty() || word != "clean", "{located:?}");
    // What is asserted, or cannot be told from that, is not ruled out.
    for row in verdict["ruled_out"].as_array().expect("checked above") {
        let is_said = |effect: &Value| {
            let mut also = effect["also_possible"].as_array().into_iter().flatten();
            effect["name"] == row["name"] || also.any(|also| *also == row["name"])
        };
        assert!(!effects.iter().any(is_said), "{row}");
    }
}
