//! What is said beside the verdict, the same on a terminal and on a page.

use super::left_out::sentences;
use crate::diagnose::{Answer, Diagnosis, EffectRow, Smallest};

/// Of names that are as sure as this nothing is said.
const RISK: f64 = 0.02;
/// Of so many effects the smallest strengths are told.
const SMALLEST: usize = 3;

/// What is said where no set could be held out.
pub const NOTHING_HELD_OUT: &str = "Of these steps no frame is told by the others: nothing can be held out.";

/// What is not sure of a name.
pub fn risk(effect: &EffectRow) -> Option<String> {
    let percent = 100.0 * effect.alias_risk;
    let words = || format!("weak: with {percent:.0} % it is something unknown that looks like it");
    (effect.alias_risk > RISK).then(words)
}

/// What is to be known of the noise, and of what was left out.
pub fn remarks(diagnosis: &Diagnosis) -> Vec<String> {
    let shared = diagnosis.judgement.shared_noise.iter().map(|shared| {
        format!("Noise beside what the camera states: {shared}. No physics is left out by that.")
    });
    let understated = diagnosis.understated.iter().map(|words| {
        format!("There is more noise than the camera states: {words}. Its read noise or its gain may be stated wrongly.")
    });
    let overstated = diagnosis.overstated.iter().map(|words| {
        format!("The camera states more than there is of {words}. What is weaker than it states is not seen.")
    });
    let left_out = sentences(&diagnosis.left_out).into_iter().map(|sentence| format!("Left out: {sentence}"));
    let own_phases = diagnosis.judgement.fit.pixels.at_frequencies.iter().map(|at| {
        let own = if at.times == 1.0 { "as they are, and" } else { "as delays make them, and" };
        let (hz, rad) = (at.frequency_hz, at.phase_rad);
        format!("At {} MHz the pixels' own phases count {own} {rad:.4} rad besides, for all pixels alike: no recording states that.", hz / 1e6)
    });
    let without_light = diagnosis.without_light.iter().map(|name| {
        format!("No light at all comes in in {name}, neither the camera's nor ambient light: no recording states that.")
    });
    shared
        .chain(understated)
        .chain(overstated)
        .chain(own_phases)
        .chain(without_light)
        .chain(left_out)
        .collect()
}

/// What these recordings would have shown, of the first effects.
pub fn would_show(answer: &Answer) -> Option<String> {
    let mut first: Vec<&Smallest> = Vec::new();
    for row in &answer.smallest_detectable {
        if first.iter().all(|known| known.name != row.name) {
            first.push(row);
        }
    }
    let of = |row: &&Smallest| {
        let unit = if row.unit == "1" { String::new() } else { format!(" {}", row.unit) };
        format!("{} ({} of {:.1e}{unit})", row.name, row.parameter, row.value)
    };
    let more = match first.len().saturating_sub(SMALLEST) {
        0 => String::new(),
        more => format!(", and {more} other effects (--json has them all)"),
    };
    let told: Vec<String> = first.iter().take(SMALLEST).map(of).collect();
    (!told.is_empty()).then(|| format!("They would have shown, with 95 %: {}{more}", told.join(", ")))
}
