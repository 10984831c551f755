//! What was found, in one paragraph: the physics, where it shows, by what evidence, and what comes nearest and is not it.

use crate::diagnose::{Answer, EffectRow, RuledOut};
use crate::physics::Effect;
use crate::physics::effects::named;

/// So many coordinates, and so many effects that come near, are told.
const TOLD: usize = 3;
/// An effect comes near that would explain this share of what there is.
const NEAR: f64 = 0.1;

/// `answer` in one paragraph.
pub fn paragraph(answer: &Answer) -> String {
    let sentences =
        answer.effects.iter().map(|effect| effect.sentence.as_str()).collect::<Vec<_>>().join(" ");
    match answer.verdict {
        "clean" if answer.probability_of_mismatch > 0.5 => {
            "Simulation and recordings agree within the noise, but for a trace of something that is too weak to be named, or placed.".to_owned()
        }
        "clean" => "Simulation and recordings agree within the noise.".to_owned(),
        "unexplained" => format!(
            "The recordings differ from the simulation{}, and no effect that is known here explains it.{}",
            place(answer),
            ruled_out(answer)
        ),
        "partly_explained" => {
            let rows = answer.effects.iter().flat_map(|effect| &effect.parameters);
            let left = match rows.into_iter().any(|row| row.at_bound) {
                true => " A value came to its bound: there is more of it, or something else.",
                false => " Something else is left.",
            };
            format!("{sentences}{}{}{left}", evidence(answer), ruled_out(answer))
        }
        _ => format!("{sentences}{}{}", evidence(answer), ruled_out(answer)),
    }
}

/// Words in a row: `a`, `a and b`, `a, b and c`.
fn listed(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [one] => one.clone(),
        [all @ .., last] => format!("{} and {last}", all.join(", ")),
    }
}

/// Where it lives.
fn place(answer: &Answer) -> String {
    let mut coordinates: Vec<String> = Vec::new();
    for row in &answer.located {
        if coordinates.len() < TOLD && coordinates.iter().all(|known| known != row.coordinate) {
            coordinates.push(row.coordinate.to_owned());
        }
    }
    let most = answer.located.first().filter(|row| !row.recording.is_empty());
    let most = most.map_or_else(String::new, |row| format!(", most in {}", row.recording));
    if coordinates.is_empty() { String::new() } else { format!(" over {}{most}", listed(&coordinates)) }
}

/// What speaks for the effects.
fn evidence(answer: &Answer) -> String {
    let shows = if answer.effects.len() > 1 { "They show" } else { "It shows" };
    let place = place(answer);
    let place = if place.is_empty() { place } else { format!(" {shows}{place}.") };
    let of = |effect: &EffectRow| {
        let row = effect.evidence;
        let numbers = counted(row.degrees_of_freedom, "number");
        // What is random, or is told by the codes alone, predicts no sample, and takes nothing of chi squared.
        match named(effect.name).is_none_or(Effect::is_predicted) {
            true => format!("{:.0} of chi squared by {numbers}", row.delta_chi2),
            false => format!("{:.0} nats", row.ln_bayes_factor),
        }
    };
    let items = listed(&answer.effects.iter().map(of).collect::<Vec<_>>());
    let held = &answer.held_out;
    let unseen = match held.sets > 0 && held.chi2_per_dof_after < held.chi2_per_dof_before {
        true => format!(
            "; of what the fit has not seen, chi squared a sample goes from {:.4} to {:.4}",
            held.chi2_per_dof_before, held.chi2_per_dof_after
        ),
        false => String::new(),
    };
    format!("{place} Evidence: {items}{unseen}.")
}

/// What comes nearest and is not it, and how many others there are.
fn ruled_out(answer: &Answer) -> String {
    let (refused, others): (Vec<&RuledOut>, Vec<&RuledOut>) =
        answer.ruled_out.iter().partition(|row| row.is_refused);
    let near: Vec<&RuledOut> = others.iter().copied().filter(|row| row.share >= NEAR).take(TOLD).collect();
    let shares = near.iter().map(|row| (100.0 * row.share).floor().min(99.0)).enumerate();
    let percent = |(number, share): (usize, f64)| match number {
        0 => format!("{} (takes {share:.0} %)", near[number].name),
        _ => format!("{} ({share:.0} %)", near[number].name),
    };
    let names: Vec<String> = shares.map(percent).collect();
    let others = match others.len() - near.len() {
        0 => String::new(),
        1 => "; one other takes less, or nothing".to_owned(),
        count => format!("; {count} others take less, or nothing"),
    };
    let ruled_out = match names.is_empty() {
        true => String::new(),
        false => format!(" Ruled out, since each alone leaves the rest of it: {}{others}.", listed(&names)),
    };
    let of = |row: &&RuledOut| format!(" Not believed: {}; {}.", row.name, row.by);
    refused.iter().map(of).chain([ruled_out]).collect()
}

/// A probability of something that may be so; none is said to be certain, or impossible.
pub fn chance(probability: f64) -> String {
    match probability {
        ..0.01 => "below 0.01".to_owned(),
        0.99.. => "above 0.99".to_owned(),
        _ => format!("{probability:.2}"),
    }
}

/// `one number`, `2 numbers`.
pub fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("one {noun}") } else { format!("{count} {noun}s") }
}
