//! What a bench found wrong, in the words of the pipeline.

use crate::hdl::{Channel, Golden, STAGES, channels};
use crate::spec::Pipeline;
use std::fmt;

/// One line of a bench that is not its verdict.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The clock at which it was seen, where the bench gave one.
    pub clock: Option<u64>,
    text: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// The value of `key=value` in `line`.
fn field<'a>(line: &'a str, key: &str) -> Option<&'a str> {
    let start = line.find(&format!("{key}="))? + key.len() + 1;
    line[start..].split([' ', ':']).next()
}

impl Finding {
    /// The finding in a bench's line, where it is one.
    pub(super) fn parse(line: &str, pipeline: &Pipeline, golden: &Golden) -> Option<Self> {
        const KINDS: [&str; 9] = [
            "MISMATCH",
            "SURPLUS",
            "MISSING",
            "STUCK",
            "COUNTERS",
            "UNSTABLE",
            "SEQUENCER",
            "REGISTER",
            "BROKEN",
        ];
        let kind = line.split_whitespace().next()?;
        if !KINDS.contains(&kind) {
            return None;
        }
        let clock = field(line, "clock").and_then(|text| text.parse().ok());
        let text = match kind {
            "MISMATCH" => mismatch(line, pipeline, golden).unwrap_or_else(|| line.to_owned()),
            "SURPLUS" | "MISSING" => {
                let stage = field(line, "stage").and_then(|text| text.parse::<usize>().ok());
                let stage = stage.and_then(|number| STAGES.get(number)).map_or("?", |stage| stage.name);
                let what = if kind == "SURPLUS" { "a result that is not due" } else { "results are missing" };
                format!("stage {stage}: {what}, {}", place(line, pipeline, golden))
            }
            _ => line.to_owned(),
        };
        Some(Self { clock, text })
    }
}

/// The set and pixel of a line's record, and its clock.
fn place(line: &str, pipeline: &Pipeline, golden: &Golden) -> String {
    let record: usize = field(line, "record").and_then(|text| text.parse().ok()).unwrap_or(0);
    let geometry = pipeline.geometry();
    let set = record / geometry.pixels();
    let (row, column) = geometry.row_column(record % geometry.pixels());
    let origin = golden
        .sets
        .get(set)
        .map_or_else(|| "after the last".to_owned(), |(segment, number)| format!("{segment}, set {number}"));
    format!(
        "result set {set} ({origin}), pixel row {row} column {column}, clock cycle {}",
        field(line, "clock").unwrap_or("?")
    )
}

fn mismatch(line: &str, pipeline: &Pipeline, golden: &Golden) -> Option<String> {
    let name = field(line, "channel")?;
    let word =
        channels(pipeline).into_iter().find(|channel| channel.name == name).map(|Channel { word, .. }| word);
    let value = |key: &str| {
        let digits = field(line, key)?;
        let Ok(pattern) = u64::from_str_radix(digits, 16) else {
            return Some(format!("{digits} (unknown bits)"));
        };
        Some(match word {
            Some(word) => {
                format!(
                    "{:0width$b} ({})",
                    word.pattern(pattern as i64),
                    word.value(pattern),
                    width = word.bits as usize
                )
            }
            None => format!("{pattern:b} ({pattern})"),
        })
    };
    let (stage, what) = name.split_once('.')?;
    Some(format!(
        "stage {stage}, {what}: {}: expected {}, actual {}",
        place(line, pipeline, golden),
        value("expected")?,
        value("actual")?
    ))
}
