//! From a search and a location to a judgement: clean, explained, partly explained, unexplained.

use super::conclusion::{Case, Verdict};
use super::gains::{self, gain_of_recordings};
use super::included_forms::Forms;
use super::misnamed::{Misnamed, misnamed};
use super::refused::{Refused, refused};
use super::searched::{InProportion, Searched, searched};
use super::vote::Names;
use crate::diagnose::fitting::finished::finished;
use crate::diagnose::fitting::fit::{Fit, fit};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::forms::other_camera::{OTHER_CAMERA, without_steps};
use crate::diagnose::locating::location::{LOCATED_NATS, Location};
use crate::diagnose::locating::mismatch::{Place, places};
use crate::diagnose::naming::found::{Found, Named};
use crate::diagnose::naming::pass::{DISBELIEF, THRESHOLD};
use crate::diagnose::naming::resting::goes_on;
use crate::diagnose::naming::tolerated::{tolerated, tolerated_as_new};
use crate::diagnose::periodic::lamps::FLICKER;
use crate::diagnose::reading::data::Data;
use crate::diagnose::shared_errors::described::words;
use crate::diagnose::shared_errors::levels::Level;
use crate::diagnose::shared_errors::random::{
    self, CLUSTER_NATS, EXCESS_NOISE, JITTERS, RandomEffect, Strength, deflated, inflation, is_beyond_forms,
    may_be_of_light, new_each_time, of_name, random_effect, two_jitters,
};
use crate::diagnose::tangents::pieces::Piece;
use crate::diagnose::unseen::held_out::Predictor;
use crate::physics::effects;

/// Everything that a diagnosis finds.
#[derive(Debug)]
pub struct Judgement {
    /// In one word.
    pub verdict: Verdict,
    /// Where the recordings differ from the simulation that the camera describes, most significant first.
    pub places: Vec<Place>,
    /// Where they still differ from the fitted model.
    pub left: Vec<Place>,
    /// The effects that are asserted.
    pub named: Vec<Named>,
    /// Of the mismatch, the share that the named effects leave.
    pub remainder: f64,
    /// What is left by the simulation that the camera describes, and by the fit that is asserted.
    pub locations: [Location; 2],
    /// Random effects, and how strong they are.
    pub random: Vec<(&'static str, Strength)>,
    /// The search behind it.
    pub found: Found,
    /// What it found and is not asserted.
    pub refused: Vec<Refused>,
    /// The fit that is asserted: the baseline where nothing is.
    pub fit: Fit,
    /// The noise, corrected where the camera's description has it too small.
    pub noise: Noise,
    /// Noise that rows, columns or frames share besides, in words.
    pub shared_noise: Option<String>,
}

impl Judgement {
    /// The simulation that the camera describes.
    pub fn without(&self) -> Predictor<'_> {
        let excess = self.random.iter().find(|(name, _)| *name == EXCESS_NOISE);
        let square = excess.map_or(0.0, |(_, strength)| strength.value.powi(2));
        let noise = Noise { square: (self.noise.square - square).max(0.0), ..self.noise };
        Predictor { fit: &self.found.baseline, noise, reference: self.noise, jitters: [false; 2] }
    }

    /// The model with everything that is asserted.
    pub fn with(&self) -> Predictor<'_> {
        let jitters = JITTERS.map(|jitter| self.random.iter().any(|(name, _)| *name == jitter));
        Predictor { fit: &self.fit, noise: self.noise, reference: self.noise, jitters }
    }
}

/// Diagnoses `data`, whose noise is `stated`, and to which `baseline` was fitted without any effect.
pub fn judge(data: &Data, baseline: Fit, stated: Noise) -> Judgement {
    let forms = Forms::of(data, &baseline, stated);
    let (Searched { found, locations: [baseline, end], noise }, in_proportion) =
        searched(data, baseline, stated, forms.tolerated);
    // What random errors let appear among the columns is not asserted.
    let inflation = inflation(data, &end);
    let unlike = misnamed(data, &found, &baseline, noise, inflation);
    let is_clear = |place: &&Place| deflated(inflation, place.ln_bayes, place.chi2.0) > LOCATED_NATS;
    let unnamed = unlike.as_ref().map(|unlike| &unlike.place).filter(is_clear);
    let mut named = standing(&found, inflation);
    // What follows no phase steps may be any light that comes and goes on a part of the scene.
    let is_still =
        found.fit.pieces.iter().any(|piece| piece.effect.name == OTHER_CAMERA && without_steps(piece));
    let of_light = named.iter_mut().filter(|named| is_still && named.name == OTHER_CAMERA);
    of_light.for_each(|named| named.may_be(FLICKER));
    let standing: Vec<&str> = named.iter().map(|named| named.name).collect();
    let no_drift = gain_of_recordings(data, &found, noise);
    named.retain(|named| no_drift != Some(named.name));
    let are_dropped = named.len() < found.named.len();
    named.retain(|named| unlike.as_ref().is_none_or(|unlike| !unlike.names.contains(&named.name)));
    // Where nothing is asserted, nothing is fitted: names that noise brought took its whiteness with them.
    let end = if named.is_empty() { baseline.clone() } else { end };
    let [mut places, mut left] = [&baseline, &end].map(|location| self::places(data, location));
    if let Some(unnamed) = unnamed {
        [&mut places, &mut left].into_iter().for_each(|places| unnamed.clone().join(places));
    }
    let of_names = if named.is_empty() { 0.0 } else { found.baseline.counted() - found.fit.counted() };
    let explained = (of_names - unnamed.map_or(0.0, |unnamed| unnamed.chi2.0)).max(0.0);

    let seems = random_effect(data, &end);
    // A random effect takes with it what is left at random.
    let is_more = |random: &RandomEffect| {
        // What a form leaves is nearly the same where the target is again, if the effect is.
        let is_steady = |name: &str| !goes_on(&found.fit.pieces, name);
        let as_new = tolerated_as_new(&named, may_be_of_light(&end, random), &is_steady);
        let new = || new_each_time(&end, random.name) - CLUSTER_NATS;
        is_beyond_forms(random.ln_bayes, tolerated(&named)) || is_beyond_forms(new(), as_new)
    };
    let random = seems.filter(is_more);
    let excess = excess(stated, noise, in_proportion).filter(|_| seems.is_none());
    let mut at_random = at_random(&end, random.or(excess));
    let found_at_random = at_random.len();
    at_random.retain(|random| !data.unpredicted.includes(random));
    // Errors that the camera includes are no mismatch.
    if at_random.is_empty() && found_at_random > 0 {
        [&mut places, &mut left].into_iter().for_each(|places| places.retain(|place| !place.is_random));
    }
    let is_left = |place: &&Place| {
        !forms.may_leave(place)
            && random.is_none_or(|random| {
                !place.is_random && deflated(random.inflation, place.ln_bayes, place.chi2.0) > LOCATED_NATS
            })
    };
    let most_left = left.iter().filter(is_left).max_by(|a, b| a.excess().total_cmp(&b.excess()));
    // Codes without many bits are off by what repeats with these, and stands out over nothing else, but for lines that see few of the codes.
    let over_codes = left.iter().filter(is_left).filter(|place| place.coordinate == "code");
    let of_codes = over_codes.map(Place::excess).fold(0.0, f64::max);
    let is_of_codes = |place: &Place| {
        place.coordinate == "code"
            || end.is_of_lines_at_signals(place) && place.excess() < OF_FEW_CODES * of_codes
    };
    let is_cut = data.cut_bits > data.unpredicted.bits_cut;
    let is_of_cut = is_cut
        && named.is_empty()
        && !are_dropped
        && baseline.period_dn.is_some_and(|period_dn| is_part_of(data.unit_dn(), period_dn))
        && left.iter().filter(is_left).all(is_of_codes);
    let rest = most_left.map_or(0.0, |place| place.excess().max(0.0));
    let left_there = most_left.map_or(0.0, |place| left_of(&places, place));
    let remainder = if rest > 0.0 { rest / (rest + explained) } else { 0.0 };
    // Far from the baseline columns promise more than there is, and of several effects none is sure. Noise that samples share raises all columns, and
    // so does a random effect.
    let is_far = found.baseline.is_far_from(&found.fit);
    let shared = random::noise(data, &end);
    let are_raised = seems.is_some() || shared.is_some();
    // Where nothing of the camera is described, several things are left out at once, and a coordinate shows a part of each.
    let many = if data.assumed.camera { DISBELIEF } else { 1.0 };
    let names = if is_far || are_raised { None } else { Names::of(&found, &named, explained, many) };
    // What the end leaves says something of names only where all that was fitted is asserted.
    let all_stand = !are_dropped && unnamed.is_none();
    places.extend(excess.map(|excess| of_excess(&excess, end.take)));
    let case = Case {
        named: &named,
        are_dropped,
        at_random: (at_random.len(), random.is_some()),
        are_outvoted: names
            .is_some_and(|names| names.are_outvoted(&baseline.columns, all_stand.then_some(&end.columns))),
        is_misnamed: unnamed.is_some(),
        is_far,
        remainder,
        stays: !data.assumed.camera && stays(&places, &left),
        left_there,
        is_described: !data.assumed.camera,
    };
    let mut verdict = case.verdict();
    let against = case.against();
    let as_named = |&RandomEffect { name, ln_bayes, .. }: &RandomEffect| Named {
        name,
        ln_bayes,
        score: (2.0 * ln_bayes, 1),
        rivals: Vec::new(),
        is_trusted: false,
    };
    named.extend(at_random.iter().map(as_named));
    let mut random: Vec<_> = at_random.iter().map(|random| (random.name, random.strength)).collect();
    if verdict == Verdict::Unexplained {
        named.clear();
        random.clear();
    }
    let of_place = |Misnamed { names, place }: &Misnamed| -> Vec<_> {
        names.iter().map(|name| (*name, format!("what looks like it is {}", place.shape))).collect()
    };
    let unlike = unlike.iter().flat_map(of_place);
    let others: Vec<_> = unlike.chain(no_drift.map(|name| (name, gains::WHY.to_owned()))).collect();
    let refused = refused(&found, &named, &standing, &others, &against);
    // Codes without their low bits need no statistics.
    let mut remainder = remainder;
    if is_cut {
        (verdict, remainder) = match verdict {
            Verdict::Clean | Verdict::Explained => (Verdict::Explained, remainder),
            Verdict::Unexplained if is_of_cut => (Verdict::Explained, 0.0),
            Verdict::Unexplained => (Verdict::PartlyExplained, 1.0),
            Verdict::PartlyExplained => (verdict, remainder),
        };
        if remainder == 1.0 {
            left.clone_from(&places);
        } else if is_of_cut {
            left.clear();
        }
        let cut = cut_bits(&found, data.cut_bits);
        named.push(as_named(&cut));
        random.push((cut.name, cut.strength));
    }
    if verdict == Verdict::Clean {
        places.clear();
    }
    let fit = asserted(data, &found, &named, noise);
    let shared_noise = shared.filter(|noise| noise.level != Level::Pixel).map(words);
    let after = if fit.pieces.is_empty() { baseline.clone() } else { end };
    let locations = [baseline, after];
    Judgement {
        verdict,
        places,
        left,
        named,
        remainder,
        locations,
        random,
        found,
        refused,
        fit,
        noise,
        shared_noise,
    }
}

/// How exactly a wave over the codes shows its period, of the periods in the other one.
const PERIOD_TO: f64 = 0.03;

/// Whether `whole` is once, twice or more the period `part`.
fn is_part_of(whole: f64, part: f64) -> bool {
    let times = whole / part;
    times > 1.0 - PERIOD_TO && (times - times.round()).abs() < PERIOD_TO
}

/// Lines show less than this share of what their few codes are off by.
const OF_FEW_CODES: f64 = 0.1;

/// A coordinate in which a mismatch says this share of what it says where it lives most may be where it lives.
const LEADING: f64 = 0.9;

/// Whether what is `left` leads where the mismatch lived most, in one of the first `places` or in one that said about as much: it was not explained.
fn stays(places: &[Place], left: &[Place]) -> bool {
    let (Some(most), Some(left)) = (places.first(), left.first()) else { return false };
    let is_leading = |place: &&Place| place.ln_bayes >= LEADING * most.ln_bayes;
    places.iter().filter(is_leading).any(|place| place.coordinate == left.coordinate)
}

/// Of what the coordinate of the place `left` showed of the mismatch, of which these are the `places`, the share that is left.
fn left_of(places: &[Place], left: &Place) -> f64 {
    let is_there = |place: &&Place| place.coordinate == left.coordinate && place.is_random == left.is_random;
    let showed = places.iter().filter(is_there).map(Place::excess).fold(0.0, f64::max);
    left.excess() / showed.max(left.excess()).max(f64::MIN_POSITIVE)
}

/// The names of what was `found` that stand beside random errors which raise the variance of columns by `inflation`.
fn standing(found: &Found, inflation: f64) -> Vec<Named> {
    let stands = |named: &&Named| {
        // Of two that were found together the evidence is that of both.
        let together = found.named.iter().filter(|other| other.ln_bayes == named.ln_bayes);
        let chi2: f64 = together.map(|named| named.score.0).sum();
        of_name(inflation, named.ln_bayes, (chi2, named.score.1)) > THRESHOLD
    };
    found.named.iter().filter(stands).cloned().collect()
}

/// The noise in proportion to the signal that is there beyond what was `stated`, where that is clear.
fn excess(
    stated: Noise,
    noise: Noise,
    InProportion { ln_bayes, square_sigma }: InProportion,
) -> Option<RandomEffect> {
    let value = (noise.square - stated.square).max(0.0).sqrt();
    let strength = Strength { value, sigma: if value > 0.0 { 0.5 * square_sigma / value } else { 0.0 } };
    let excess = RandomEffect { name: EXCESS_NOISE, strength, ln_bayes, inflation: 1.0 };
    (ln_bayes > 0.0).then_some(excess)
}

/// Where that shows.
fn of_excess(RandomEffect { strength, ln_bayes, .. }: &RandomEffect, take: usize) -> Place {
    Place {
        coordinate: "amplitude",
        shape: format!("noise in proportion to the signal, {:.2} %", 100.0 * strength.value),
        ln_bayes: *ln_bayes,
        chi2: (2.0 * ln_bayes, 1),
        looked: 1.0,
        take,
        is_random: true,
    }
}

/// The `strongest` random effect, or the two jitters that it is.
fn at_random(end: &Location, strongest: Option<RandomEffect>) -> Vec<RandomEffect> {
    let two = strongest.and_then(|strongest| two_jitters(end, strongest));
    two.map_or_else(|| strongest.into_iter().collect(), Vec::from)
}

/// The camera's own arithmetic, which never sets so many low `bits`.
fn cut_bits(found: &Found, bits: u32) -> RandomEffect {
    let ln_bayes = found.baseline.samples as f64 * f64::from(bits) * std::f64::consts::LN_2;
    let strength = Strength { value: f64::from(bits), sigma: 0.0 };
    RandomEffect { name: effects::FIXED_POINT, strength, ln_bayes, inflation: 1.0 }
}

/// The fit of what is `named` alone: the search may have found more than stands.
fn asserted(data: &Data, found: &Found, named: &[Named], noise: Noise) -> Fit {
    let stands = |piece: &&Piece| named.iter().any(|named| named.name == piece.effect.name);
    let pieces: Vec<Piece> = found.fit.pieces.iter().filter(stands).cloned().collect();
    if pieces.len() == found.fit.pieces.len() {
        found.fit.clone()
    } else if pieces.is_empty() {
        found.baseline.clone()
    } else {
        finished(data, fit(data, Some(&found.baseline), pieces, noise, &|_| true), noise)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left leads in a coordinate that said about as much as the first one.
    #[test]
    fn a_mismatch_stays_where_it_might_have_led() {
        let place = |(coordinate, ln_bayes): (&'static str, f64)| Place {
            coordinate,
            shape: String::new(),
            ln_bayes,
            chi2: (2.0 * ln_bayes, 1),
            looked: 1.0,
            take: 0,
            is_random: false,
        };
        let of = |places: &[(&'static str, f64)]| places.iter().copied().map(place).collect::<Vec<_>>();
        let before = of(&[("amplitude", 300.0), ("column", 280.0), ("phase", 260.0)]);
        let stays = |left| super::stays(&before, &of(&[(left, 50.0), ("time_s", 20.0)]));
        assert!(stays("amplitude") && stays("column") && !stays("phase") && !stays("time_s"));
        assert!(!super::stays(&before, &[]) && !super::stays(&[], &before));
        // One that random errors lead, with less evidence than columns.
        let random = of(&[("set", 40.0), ("phase", 60.0)]);
        assert!(super::stays(&random, &of(&[("set", 9.0)])) && super::stays(&random, &of(&[("phase", 9.0)])));
    }
}
