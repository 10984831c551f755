//! A diagnosis in a screenful.

use super::paragraph::{chance, counted, paragraph};
use super::proposed::to_separate;
use super::remarks::{NOTHING_HELD_OUT, remarks, risk, would_show};
use crate::diagnose::{Agreement, Diagnosis, HeldOut, HeldOutRow};
use std::fmt::Write;
use std::path::Path;

/// Lines that a list may take.
const MOST: usize = 4;

/// A probability; of those that are less than numbers know, a bound.
pub fn probability(p: f64) -> String {
    if p < 1e-300 { "< 1e-300".to_owned() } else { format!("{p:.1e}") }
}

/// A parameter's value: six decimals, or, where these would show too little of it, four digits.
pub fn value(value: f64) -> String {
    if value == 0.0 || value.abs() >= 1e-4 { format!("{:.6}", value + 0.0) } else { format!("{value:.3e}") }
}

/// What `diagnosis` says of `campaign`, in a screenful.
pub fn diagnosis_text(campaign: &Path, diagnosis: &Diagnosis) -> String {
    let answer = &diagnosis.answer;
    let verdict = answer.verdict.replace('_', " ");
    let mut text = format!(
        "{}: {verdict} (probability of a mismatch {})\n\n",
        campaign.display(),
        chance(answer.probability_of_mismatch)
    );
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{}\n", paragraph(answer));
    if !answer.located.is_empty() {
        text += "Where:\n";
        for row in answer.located.iter().take(MOST) {
            let _ = writeln!(
                text,
                "  {:<13} {} (p {}, {:.2} DN RMS, most in {})",
                row.coordinate,
                row.shape,
                probability(row.p),
                row.rms_dn,
                row.recording
            );
        }
    }
    for effect in &answer.effects {
        let _ = writeln!(text, "{} (probability {}):", effect.name, chance(effect.probability));
        for row in effect.parameters.iter().take(3 * MOST) {
            let unit = if row.unit == "1" { String::new() } else { format!(" {}", row.unit) };
            let bound = if row.at_bound { ", at its bound" } else { "" };
            // What is a choice, or was not fitted, is not known to some accuracy.
            let known_to = if row.sigma > 0.0 { format!(" \u{b1} {:.2e}", row.sigma) } else { String::new() };
            let _ = writeln!(text, "  {} = {}{known_to}{unit}{bound}", row.name, value(row.value));
        }
        let more = effect.parameters.len().saturating_sub(3 * MOST);
        if more > 0 {
            let _ = writeln!(text, "  and {more} more (--json has them all)");
        }
        if !effect.also_possible.is_empty() {
            let _ = writeln!(text, "  cannot be told apart here from {}", effect.also_possible.join(", "));
        }
        if let Some(risk) = risk(effect) {
            let _ = writeln!(text, "  {risk}");
        }
    }
    for remark in remarks(diagnosis) {
        let _ = writeln!(text, "{remark}");
    }
    text += &of_held_out(&answer.held_out);
    text += &of_schemes(&diagnosis.held_out);
    if let Some(coordinate) = answer.remainder.coordinate {
        let share = 100.0 * answer.remainder.share;
        let _ = writeln!(text, "Left: {share:.1} % of the mismatch, most of it over {coordinate}");
    }
    for line in to_separate(&answer.next_recording).into_iter().take(MOST) {
        let _ = writeln!(text, "{line}");
    }
    if !answer.invisible.is_empty() {
        let names: Vec<&str> = answer.invisible.iter().map(|row| row.name).collect();
        let _ = writeln!(text, "These recordings cannot show: {}", names.join(", "));
    }
    if let Some(would_show) = would_show(answer) {
        let _ = writeln!(text, "{would_show}");
    }
    text
}

/// How the fit fares on what it has not seen.
fn of_held_out(held: &HeldOutRow) -> String {
    if held.sets == 0 {
        return format!("{NOTHING_HELD_OUT}\n");
    }
    format!(
        "On {} that the fit has not seen: chi squared a sample {:.4} -> {:.4} (z {:.1}), raw frames {:.3} -> {:.3} DN RMS,\n  \
         their means {:.3} -> {:.3} DN RMS{}\n",
        counted(held.sets, "set"),
        held.chi2_per_dof_before,
        held.chi2_per_dof_after,
        held.z,
        held.rms_dn_before,
        held.rms_dn_after,
        held.frame_mean_rms_dn_before,
        held.frame_mean_rms_dn_after,
        distance("distance of a set", [held.distance_rms_m_before, held.distance_rms_m_after])
    )
}

/// The same of each scheme, where there are several.
fn of_schemes(held: &HeldOut) -> String {
    let of = |(frames, before, after): &(usize, Agreement, Agreement)| {
        format!(
            "  {frames} frames a set: chi squared {:.4} -> {:.4}, raw frames {:.3} -> {:.3} DN RMS{}\n",
            before.chi2_per_dof,
            after.chi2_per_dof,
            before.rms_dn,
            after.rms_dn,
            distance("distance", [before.distance_rms_m, after.distance_rms_m])
        )
    };
    held.of_schemes().iter().map(of).collect()
}

/// The error of a set's distance before and after, m, where there is one.
fn distance(what: &str, rms_m: [f64; 2]) -> String {
    let [before_mm, after_mm] = rms_m.map(|metres| 1e3 * metres);
    match before_mm.is_finite() {
        true => format!(", {what} {before_mm:.2} -> {after_mm:.2} mm RMS"),
        false => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_values_are_not_written_as_nothing() {
        let all = [0.0, -0.0, -3.21e-9, 4.2e-5, 1e-4, -0.25, 64.0];
        let written = ["0.000000", "0.000000", "-3.210e-9", "4.200e-5", "0.000100", "-0.250000", "64.000000"];
        assert_eq!(all.map(value), written);
    }
}
