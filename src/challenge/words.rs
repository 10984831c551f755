//! Labels and answers in words.

use super::label::Label;
use super::score::Judged;

/// What is concealed in a campaign, in words.
pub fn truth(label: &Label) -> String {
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

/// What was answered, in words.
pub fn answered(case: &Judged) -> String {
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
