//! A diagnosis, from the recordings to the answer.

use super::answer::{Answer, Invisible, LocatedRow, NextRecording, Remainder, Smallest, rounded};
use super::effect_row::effect_row;
use super::next::next;
use super::power_at_random::detectable_at_random;
use super::ruled_out::ruled_out;
use crate::diagnose::fitting::bounds::is_bounded;
use crate::diagnose::fitting::finished::unfitted;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::fitting::noise::measured;
use crate::diagnose::judging::conclusion::Verdict;
use crate::diagnose::judging::judge::{Judgement, judge};
use crate::diagnose::locating::mismatch::Place;
use crate::diagnose::naming::alone::Alone;
use crate::diagnose::naming::candidates::{OF_NEIGHBOURS, OF_ONE_PLACE};
use crate::diagnose::naming::found::are_many;
use crate::diagnose::naming::found::{Found, Named};
use crate::diagnose::naming::pass::THRESHOLD;
use crate::diagnose::reading::backgrounds::counts_at_hz;
use crate::diagnose::reading::data::Data;
use crate::diagnose::set_aside::covered::{covered, without_light};
use crate::diagnose::set_aside::left_out::{LeftOut, without_outliers, without_pixels};
use crate::diagnose::set_aside::near_full::below_full;
use crate::diagnose::set_aside::settle::with_mask;
use crate::diagnose::set_aside::stuck::stuck_pixels;
use crate::diagnose::shared_errors::random::{EXCESS_NOISE, JITTERS};
use crate::diagnose::stated_noise;
use crate::diagnose::statistics::evidence::tail;
use crate::diagnose::unseen::held_out::{HeldOut, held_out};
use crate::diagnose::unseen::held_out_row::HeldOutRow;
use crate::frames::Geometry;
use crate::physics::effects::FIXED_POINT;
use serde_json::json;

/// A diagnosis: the judgement, and how it fares on sets that it has not seen.
#[derive(Debug)]
pub struct Diagnosis {
    /// The judgement.
    pub judgement: Judgement,
    /// The prediction of sets that were held out.
    pub held_out: HeldOut,
    /// What the camera states or includes of noise and errors at random that is not there, in words.
    pub overstated: Vec<String>,
    /// What pixels have of noise beyond what the camera states, in words.
    pub understated: Option<String>,
    /// The names of dark recordings in which there is no ambient light either.
    pub without_light: Vec<String>,
    /// What was left out before anything was looked for.
    pub left_out: LeftOut,
    /// The answer.
    pub answer: Answer,
    /// The pixels that were looked at, as a sensor of their own.
    pub geometry: Geometry,
}

impl Remainder {
    /// What the answer leaves: where nothing is asserted that would explain a part of the mismatch, all of it, where it lives.
    fn of(judgement: &Judgement) -> Self {
        let (share, places) = match judgement.verdict {
            Verdict::Clean => (judgement.remainder, &[][..]),
            Verdict::Unexplained => (1.0, &judgement.places[..]),
            Verdict::Explained | Verdict::PartlyExplained => (judgement.remainder, &judgement.left[..]),
        };
        Self { share, coordinate: places.first().map(|place| place.coordinate) }
    }
}

/// Diagnoses `data`.
///
/// What the recordings themselves say of mask and sets comes first: pixels that see something else than the mask has, and sets that
/// are unlike their neighbours.
pub fn diagnose(data: &Data) -> Diagnosis {
    let diagnosis = diagnose_pixels(data);
    let is_explained = matches!(diagnosis.judgement.verdict, Verdict::Clean | Verdict::Explained);
    let Some(close) = data.close.as_deref().filter(|_| !is_explained) else { return diagnosis };
    // What a pixel's neighbours make is no candidate where there are gaps between them.
    let near = diagnose_pixels(close);
    let is_of_neighbours = |named: &Named| OF_NEIGHBOURS.contains(&named.name);
    if near.judgement.named.iter().any(is_of_neighbours) { near } else { diagnosis }
}

fn diagnose_pixels(data: &Data) -> Diagnosis {
    let noise = noise_of(data);
    let stuck = stuck_pixels(data, noise);
    let speaking = without_pixels(data, &stuck);
    let data = speaking.as_ref().unwrap_or(data);
    // A scene that stands still has no mask.
    let masked = if data.assumed.still_scene { None } else { with_mask(data, noise) };
    let (data, moved) = masked.as_ref().map_or((data, 0), |(data, moved)| (data, *moved));
    let baseline = unfitted(data, noise);
    let (covered, mut baseline) = match covered(data, &baseline, noise) {
        Some((covered, fitted)) => (Some(covered), fitted),
        None => (None, baseline),
    };
    let data = covered.as_ref().unwrap_or(data);
    let below = below_full(data, &baseline, noise);
    if let Some(below) = &below {
        baseline = unfitted(below, noise);
    }
    let data = below.as_ref().unwrap_or(data);
    let (mut fewer, baseline, mut left_out) = without_outliers(data, baseline, noise);
    let mut judgement = judge(fewer.as_ref().unwrap_or(data), baseline, noise);
    // Sets that random errors make unlike others are no outliers.
    let is_random = !judgement.random.is_empty();
    // Nor do a few sets more make known what only more effects together than were left out come near.
    let is_taken_apart = are_many(!data.assumed.camera, judgement.found.named.len());
    let is_settled = judgement.verdict == Verdict::Clean || is_random || is_taken_apart;
    let is_explained = judgement.verdict == Verdict::Explained;
    let beside = || left_out.beside(data, &judgement.fit, noise, is_explained);
    if let Some((beside, left)) = (!is_settled).then(beside).flatten() {
        let second = judge(&beside, unfitted(&beside, noise), noise);
        // What explained without these sets is not given up for something else.
        let is_known = |named: &Named| judgement.named.iter().any(|other| other.name == named.name);
        let are_known = !is_explained || second.named.iter().all(is_known);
        if second.verdict == Verdict::Explained && are_known && !is_bounded(&second.fit) {
            (judgement, fewer, left_out) = (second, Some(beside), left);
        }
    }
    // What lasts is no outlier: where nothing else is there, it is what the recordings show.
    if judgement.verdict == Verdict::Clean && !left_out.lasting.is_empty() {
        (judgement.verdict, judgement.places) = (Verdict::Unexplained, left_out.lasting.clone());
    }
    let data = fewer.as_ref().unwrap_or(data);
    let held_out = held_out(data, judgement.without(), judgement.with());
    // What is predicted is predicted better.
    let is_no_better = !judgement.fit.pieces.is_empty() && held_out.sets > 0 && held_out.z < BETTER;
    let is_more = held_out.after.chi2_per_dof > EXPLAINED || is_no_better || is_bounded(&judgement.fit);
    if judgement.verdict == Verdict::Explained && is_more {
        judgement.verdict = Verdict::PartlyExplained;
    }
    let mut answer = answer(data, &judgement, &held_out);
    let overstated = overstated(data, &judgement, held_out.after.chi2_per_dof);
    let understated = understated(data, &judgement);
    answer.provenance["sets_left_out"] = json!(left_out.sets.values().map(Vec::len).sum::<usize>());
    answer.provenance["sets_left_out_of"] = json!(left_out.sets);
    answer.provenance["pixels_left_out"] = json!(left_out.pixels);
    let left_out = left_out.with_stuck(data, &stuck);
    answer.provenance["pixels_stuck"] = json!(left_out.stuck);
    answer.provenance["pixels_unlike_the_mask"] = json!(moved);
    answer.provenance["overstated"] = json!(overstated);
    answer.provenance["understated"] = json!(understated);
    answer.provenance["background_counts_at_hz"] = json!(counts_at_hz(&data.takes));
    let without_light = without_light(data);
    answer.provenance["recordings_without_any_light"] = json!(without_light);
    answer.provenance["own_phases"] = json!(judgement.fit.pixels.at_frequencies);
    let geometry = data.geometry();
    Diagnosis { judgement, held_out, overstated, understated, without_light, left_out, answer, geometry }
}

/// Sets that were not seen are explained where they have no more chi squared a sample: noise alone has 1.
const EXPLAINED: f64 = 2.0;
/// They are explained better where the likelihood improves by so many times its scatter.
const BETTER: f64 = 2.0;

/// Sets that were not seen have no less chi squared a sample, where the noise is what the camera states.
const LEAST_CHI2: f64 = 0.9;
/// An included jitter is more than is there by so many times.
const TOO_MUCH: f64 = 1.5;

/// What the camera states or includes of noise and errors at random that these recordings do not have, in words: what is weaker than that is not seen.
fn overstated(data: &Data, judgement: &Judgement, chi2_per_dof: f64) -> Vec<String> {
    let mut words = Vec::new();
    if !data.assumed.camera && chi2_per_dof < LEAST_CHI2 {
        words.push(format!("noise: of its variance {:.0} % are there", 100.0 * chi2_per_dof));
    }
    let included = data.unpredicted.jitter;
    let (phase_rad, time_s) = judgement.locations[1].jitters.likeliest(included.map(|sigma| sigma > 0.0));
    for (number, (found, unit)) in [(phase_rad, "rad"), (time_s, "s")].into_iter().enumerate() {
        if included[number] > TOO_MUCH * found {
            words.push(format!("{}: {found:.1e} {unit} are there", JITTERS[number]));
        }
    }
    words
}

/// Of what is told the variance is so many times what is stated, at least.
const MORE_NOISE: f64 = 1.05;

/// How much more noise pixels have than a camera that is described states, in words; nothing where that has a name.
fn understated(data: &Data, judgement: &Judgement) -> Option<String> {
    let is_named = judgement.random.iter().any(|(name, _)| *name == EXCESS_NOISE);
    let (found, stated, signal_dn) = (judgement.noise, stated_noise(data), data.typical_signal_dn());
    let times = |signal_dn: f64| found.variance(signal_dn) / stated.variance(signal_dn);
    (!data.assumed.camera && !is_named && times(signal_dn) > MORE_NOISE).then(|| {
        let (there, dark) = (times(signal_dn), times(0.0));
        format!("{there:.2} times its variance at a signal of {signal_dn:.0} DN, {dark:.2} times in the dark")
    })
}

/// The noise that the camera's description gives, or, without one, what the recordings show.
fn noise_of(data: &Data) -> Noise {
    if data.assumed.camera { measured(data, &unfitted(data, stated_noise(data))) } else { stated_noise(data) }
}

/// The verdict's word.
fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Clean => "clean",
        Verdict::Explained => "explained",
        Verdict::PartlyExplained => "partly_explained",
        Verdict::Unexplained => "unexplained",
    }
}

fn answer(data: &Data, judgement: &Judgement, held_out: &HeldOut) -> Answer {
    let Judgement { verdict, found, named, .. } = judgement;
    let nats = judgement.places.iter().map(|place| place.ln_bayes).fold(of_any(&found.alone), f64::max);
    let nats = named.iter().map(|named| named.ln_bayes).fold(nats, f64::max);
    let is_clean = *verdict == Verdict::Clean;
    // What tangents promised and no fit kept is none.
    let nats = if is_clean { nats.min(THRESHOLD) } else { nats };
    // What tangents at the baseline did not show may show where other effects are.
    let is_named = |name: &str| named.iter().any(|named| named.name == name);
    let seen = |place: &Place| located(data, judgement, place);
    let at_random = detectable_at_random(data, &judgement.locations[0], judgement.noise);
    let rows = found.detectable.iter().map(|row| (row.name, row.parameter, row.value));
    let rows = rows.chain(at_random.iter().filter_map(|&(name, value)| Some((name, 0, value?))));
    // Of the camera's own arithmetic every bit is seen.
    let rows = rows.chain([(FIXED_POINT, 0, f64::from(data.unpredicted.bits_cut) + 1.0)]);
    let smallest = rows.filter_map(|(name, parameter, value)| {
        let parameter = data.effect(name)?.parameters.get(parameter)?;
        Some(Smallest { name, parameter: parameter.name, value: rounded(value), unit: parameter.unit })
    });
    Answer {
        format: "vuris-verdict/1",
        verdict: word(*verdict),
        probability_of_mismatch: 1.0 / (1.0 + (-nats).exp()),
        located: if is_clean { Vec::new() } else { judgement.places.iter().map(seen).collect() },
        effects: named.iter().map(|named| effect_row(data, judgement, named)).collect(),
        ruled_out: ruled_out(judgement),
        held_out: HeldOutRow::of(held_out),
        remainder: Remainder::of(judgement),
        next_recording: next(data, judgement)
            .into_iter()
            .map(|next| NextRecording {
                to_separate: next.between.to_vec(),
                what: next.what,
                expected_rho: rounded(next.rho),
            })
            .collect(),
        invisible: invisible(data, found, &at_random).into_iter().filter(|row| !is_named(row.name)).collect(),
        smallest_detectable: smallest.collect(),
        provenance: json!({
            "program": concat!("vuris ", env!("CARGO_PKG_VERSION")),
            "recordings": data.takes.iter().map(|take| take.name.clone()).collect::<Vec<_>>(),
            "search": found.named.iter().map(|named| json!({
                "name": named.name,
                "ln_bayes_factor": named.ln_bayes,
                "chi2": named.score.0,
                "values": found.fit.pieces.iter().filter(|piece| piece.effect.name == named.name)
                    .map(|piece| piece.values.clone()).collect::<Vec<_>>(),
            })).collect::<Vec<_>>(),
            "left": judgement.left.iter().map(|place| json!({
                "coordinate": place.coordinate, "shape": place.shape, "ln_bayes_factor": place.ln_bayes, "chi2": place.chi2.0,
            })).collect::<Vec<_>>(),
            "samples": found.baseline.samples,
            "assumed": data.assumed,
            "every_so_many_rows_and_columns": data.grid.every,
            "noise": {"floor_dn2": judgement.noise.floor, "slope_dn": judgement.noise.slope,
                      "relative_squared": judgement.noise.square, "shared": judgement.shared_noise},
            "encoder_sigma_m": judgement.fit.jitter_m2.sqrt(),
        }),
    }
}

/// Evidence that one of these effects is there, whichever, nats: effects of which none stands out may say something together.
fn of_any(alone: &[Alone]) -> f64 {
    alone.iter().map(|alone| alone.ln_bayes.exp()).sum::<f64>().ln()
}

/// What these recordings cannot show, and why.
fn invisible(data: &Data, found: &Found, at_random: &[(&'static str, Option<f64>)]) -> Vec<Invisible> {
    let rows = |names: &[&'static str], why: &str| -> Vec<Invisible> {
        names.iter().map(|&name| Invisible { name, why: why.to_owned() }).collect()
    };
    let absorbed = "on these recordings it changes nothing that the pixels' own amplitude, phase, constant and ambient light do not absorb";
    let mut invisible = rows(&found.invisible, absorbed);
    if !data.stands_still() {
        invisible.extend(rows(&OF_ONE_PLACE, "where the target moves, light that follows the rail says nearly the same: it is looked for only in the place of a drift that was named"));
    }
    let unseen: Vec<&str> = at_random.iter().filter(|row| row.1.is_none()).map(|row| row.0).collect();
    invisible.extend(rows(&unseen, "no frame shows it, or too few do"));
    if data.grid.every > 1 {
        let why = "only some rows and columns are looked at, and a pixel's neighbours make it: it is looked for in a window of the sensor where something is not explained";
        invisible.extend(rows(&OF_NEIGHBOURS, why));
    }
    invisible
}

fn located(data: &Data, judgement: &Judgement, place: &Place) -> LocatedRow {
    let (chi2, columns) = place.chi2;
    let samples = judgement.found.baseline.samples.max(1) as f64;
    let variance = judgement.noise.floor + judgement.noise.slope * data.typical_signal_dn();
    LocatedRow {
        coordinate: place.coordinate,
        recording: data.takes.get(place.take).map_or_else(String::new, |take| take.name.clone()),
        shape: place.shape.clone(),
        p: (place.looked * tail(chi2, columns)).min(1.0),
        rms_dn: rounded(((chi2 - columns as f64).max(0.0) / samples * variance).sqrt()),
    }
}
