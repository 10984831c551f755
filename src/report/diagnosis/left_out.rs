//! What was left out before anything was looked for, in words.

use super::paragraph::counted;
use crate::diagnose::LeftOut;

/// So many numbers of sets, or pixels, are told.
const MOST: usize = 8;

/// What is `left_out`, a sentence each.
pub fn sentences(left_out: &LeftOut) -> Vec<String> {
    let LeftOut { sets, pixels, stuck, .. } = left_out;
    let mut sentences = Vec::new();
    let place = |(row, column): &(usize, usize)| format!("row {row} column {column}");
    if !stuck.is_empty() {
        let count = counted(stuck.len(), "pixel");
        sentences.push(format!("{count} of which no frame shows light: {}", told(stuck, place)));
    }
    if !sets.is_empty() {
        let of = |(name, sets): (&String, &Vec<usize>)| format!("{name} {}", told(sets, ToString::to_string));
        let count = counted(sets.values().map(Vec::len).sum(), "set");
        let of: Vec<String> = sets.iter().map(of).collect();
        sentences.push(format!("{count} unlike the neighbours: {}", of.join("; ")));
    }
    if !pixels.is_empty() {
        let of = told(pixels, place);
        sentences.push(format!(
            "{} far noisier, or far quieter, than the others: {of}",
            counted(pixels.len(), "pixel")
        ));
    }
    sentences
}

/// The first of `all`, and how many more there are.
fn told<T>(all: &[T], words: impl Fn(&T) -> String) -> String {
    let first: Vec<String> = all.iter().take(MOST).map(words).collect();
    match all.len().saturating_sub(MOST) {
        0 => first.join(", "),
        more => format!("{} and {more} more", first.join(", ")),
    }
}
