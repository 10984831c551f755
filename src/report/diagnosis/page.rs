//! A diagnosis as a page that needs nothing else: the verdict, maps and curves before and after, the evidence.

use super::curves::curve;
use super::paragraph::{chance, counted, paragraph};
use super::proposed::to_separate;
use super::remarks::{NOTHING_HELD_OUT, remarks, risk};
use super::text::{probability, value};
use crate::diagnose::{Agreement, Alone, Diagnosis, Location};
use crate::report::colour_map::ColourMap;
use crate::report::pixel_image::png_data_uri;
use askama::Template;
use std::path::Path;

/// A row of a table: its cells.
type Row = Vec<String>;

#[derive(Template)]
#[template(path = "diagnosis.html")]
struct Page<'a> {
    title: String,
    verdict: String,
    probability: String,
    paragraph: String,
    effects: Vec<Section>,
    located: Vec<Row>,
    held_out: Vec<Row>,
    evidence: Vec<Row>,
    next: Vec<String>,
    invisible: Vec<Row>,
    smallest: Vec<Row>,
    maps: Vec<(&'a str, String)>,
    scale: String,
    curves: Vec<String>,
    remarks: Vec<String>,
    sets: String,
    remainder: String,
    provenance: String,
}

struct Section {
    name: &'static str,
    probability: String,
    sentence: String,
    also: String,
    risk: String,
    parameters: Vec<Row>,
}

/// A self-contained HTML page of what `diagnosis` says of `campaign`.
///
/// # Errors
/// None that a caller can bring about: the template is part of the program.
pub fn diagnosis_page(campaign: &Path, diagnosis: &Diagnosis) -> crate::problem::Result<String> {
    let geometry = diagnosis.geometry;
    let answer = &diagnosis.answer;
    let [before, after] = &diagnosis.judgement.locations;
    let limit = before.map.iter().chain(&after.map).copied().filter(|v| v.is_finite()).fold(1.5, f64::max);
    let map =
        |location: &Location| png_data_uri(geometry, &location.map, (0.0, limit), ColourMap::Sequential);
    let held = &answer.held_out;
    let shown = |value: f64, digits: usize| match value.is_finite() {
        true => format!("{value:.digits$}"),
        false => "not known".to_owned(),
    };
    let of_scheme = |(frames, before, after): &(usize, Agreement, Agreement)| {
        [
            ("chi squared a sample", before.chi2_per_dof, after.chi2_per_dof, 5),
            ("raw frames, DN RMS", before.rms_dn, after.rms_dn, 4),
            ("distance of a set, mm RMS", 1e3 * before.distance_rms_m, 1e3 * after.distance_rms_m, 3),
        ]
        .map(|(what, before, after, digits)| {
            vec![format!("{what}, {frames} frames a set"), shown(before, digits), shown(after, digits)]
        })
    };
    let page = Page {
        title: campaign.display().to_string(),
        verdict: answer.verdict.replace('_', " "),
        probability: chance(answer.probability_of_mismatch),
        paragraph: paragraph(answer),
        effects: answer
            .effects
            .iter()
            .map(|effect| Section {
                name: effect.name,
                probability: chance(effect.probability),
                sentence: effect.sentence.clone(),
                also: effect.also_possible.join(", "),
                risk: risk(effect).unwrap_or_default(),
                parameters: effect
                    .parameters
                    .iter()
                    .map(|row| {
                        vec![
                            row.name.clone(),
                            value(row.value),
                            if row.at_bound {
                                "at its bound".to_owned()
                            } else if row.sigma > 0.0 {
                                format!("{:.2e}", row.sigma)
                            } else {
                                "not fitted".to_owned()
                            },
                            row.unit.to_owned(),
                        ]
                    })
                    .collect(),
            })
            .collect(),
        located: answer
            .located
            .iter()
            .map(|row| {
                vec![
                    row.coordinate.to_owned(),
                    row.shape.clone(),
                    row.recording.clone(),
                    probability(row.p),
                    format!("{:.3}", row.rms_dn),
                ]
            })
            .collect(),
        held_out: vec![
            vec![
                "chi squared a sample".to_owned(),
                shown(held.chi2_per_dof_before, 5),
                shown(held.chi2_per_dof_after, 5),
            ],
            vec!["raw frames, DN RMS".to_owned(), shown(held.rms_dn_before, 4), shown(held.rms_dn_after, 4)],
            vec![
                "means of frames, DN RMS".to_owned(),
                shown(held.frame_mean_rms_dn_before, 4),
                shown(held.frame_mean_rms_dn_after, 4),
            ],
            vec![
                "distance of a set, mm RMS".to_owned(),
                shown(1e3 * held.distance_rms_m_before, 3),
                shown(1e3 * held.distance_rms_m_after, 3),
            ],
        ]
        .into_iter()
        .chain(diagnosis.held_out.of_schemes().iter().flat_map(of_scheme))
        .collect(),
        evidence: evidence(diagnosis),
        next: to_separate(&answer.next_recording),
        invisible: answer.invisible.iter().map(|row| vec![row.name.to_owned(), row.why.clone()]).collect(),
        smallest: answer
            .smallest_detectable
            .iter()
            .map(|row| {
                vec![
                    row.name.to_owned(),
                    row.parameter.to_owned(),
                    format!("{:.3e}", row.value),
                    row.unit.to_owned(),
                ]
            })
            .collect(),
        maps: vec![("before", map(before)), ("after", map(after))],
        scale: format!("{limit:.2}"),
        curves: before.curves.iter().zip(&after.curves).map(|(before, after)| curve(before, after)).collect(),
        remarks: remarks(diagnosis),
        sets: match held.sets {
            0 => NOTHING_HELD_OUT.to_owned(),
            sets => format!(
                "{}; the likelihood improves by {:.1} times its scatter.",
                counted(sets, "set"),
                held.z
            ),
        },
        remainder: match answer.remainder.coordinate {
            Some(coordinate) => format!(
                "{:.2} % of the mismatch is left, most of it over {coordinate}.",
                100.0 * answer.remainder.share
            ),
            None => String::new(),
        },
        provenance: serde_json::to_string_pretty(&answer.provenance).unwrap_or_default(),
    };
    page.render().map_err(|error| crate::problem::Problem::at("the report's template", error))
}

/// Every candidate: what it explains alone, and what became of it.
fn evidence(diagnosis: &Diagnosis) -> Vec<Row> {
    let answer = &diagnosis.answer;
    let mut alone: Vec<_> = diagnosis.judgement.found.alone.iter().collect();
    alone.sort_by(|a, b| b.ln_bayes.total_cmp(&a.ln_bayes));
    let fate = |name: &str| {
        if answer.effects.iter().any(|effect| effect.name == name) {
            return "named".to_owned();
        }
        if answer.effects.iter().any(|effect| effect.also_possible.iter().any(|also| also == name)) {
            return "also possible".to_owned();
        }
        let row = answer.ruled_out.iter().find(|row| row.name == name);
        row.map_or_else(|| "cannot be seen here".to_owned(), |row| row.by.clone())
    };
    let row = |&&Alone { name, chi2, degrees, ln_bayes }: &&Alone| {
        vec![name.to_owned(), format!("{chi2:.1}"), degrees.to_string(), format!("{ln_bayes:.1}"), fate(name)]
    };
    alone.iter().map(row).collect()
}
