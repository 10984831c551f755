//! From a search and a location to a judgement: clean, explained, partly explained, unexplained.

use super::clusters::Level;
use super::data::Data;
use super::fit::{Fit, fit, unfitted};
use super::held_out::Predictor;
use super::lines::{FLICKER, FLICKER_HZ};
use super::location::{LOCATED_NATS, Located, Location, locate};
use super::noise::Noise;
use super::noise::beyond;
use super::overtones::{OF_CODES, overtones};
use super::pass::THRESHOLD;
use super::pieces::Piece;
use super::random::{
    self, JITTERS, ORDERED_SHARE, RandomEffect, Strength, coordinate, deflated, errors, inflation,
    is_beyond_forms, is_noisier, jitter, of_name, random_effect, two_jitters, words,
};
use super::search::{Found, Named, Search, form_share, tolerated};
use super::source::{Shown, is_one, shown};
use super::vote::Names;
use crate::physics::effects;

/// Noise in proportion to the signal, by the registry's name.
const EXCESS_NOISE: &str = "excess_noise";
/// How often the noise is corrected.
const NOISE_STEPS: usize = 2;

/// Where a mismatch lives.
#[derive(Debug, Clone)]
pub struct Place {
    /// Coordinate of the verdict.
    pub coordinate: &'static str,
    /// What stands out, in words.
    pub shape: String,
    /// Evidence, nats.
    pub ln_bayes: f64,
    /// Chi squared that it explains, and by how many numbers.
    pub chi2: (f64, usize),
    /// Among how many it is the greatest.
    pub looked: f64,
    /// The recording that shows it most; of columns, the one with the greatest misfit.
    pub take: usize,
    /// Whether samples share it at random.
    pub is_random: bool,
}

/// The judgement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Simulation and recordings agree.
    Clean,
    /// The named effects bring the fit to the noise.
    Explained,
    /// Something named, something left.
    PartlyExplained,
    /// A mismatch, and nothing known that makes it.
    Unexplained,
}

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
        Predictor { fit: &self.found.baseline, noise, jitters: [false; 2] }
    }

    /// The model with everything that is asserted.
    pub fn with(&self) -> Predictor<'_> {
        let jitters = JITTERS.map(|jitter| self.random.iter().any(|(name, _)| *name == jitter));
        Predictor { fit: &self.fit, noise: self.noise, jitters }
    }
}

/// Diagnoses `data`, whose noise is `stated`, and to which `baseline` was fitted without any effect.
pub fn judge(data: &Data, baseline: Fit, stated: Noise) -> Judgement {
    let (mut found, [mut baseline, mut end], mut noise) = searched(data, baseline, stated);
    let (mut in_proportion, mut square_sigma) = (0.0, 0.0);
    for _ in 0..NOISE_STEPS {
        if !is_noisier(data, &end) {
            break;
        }
        let more = beyond(data, &found.fit, noise);
        noise = more.noise;
        in_proportion += more.in_proportion;
        square_sigma = f64::max(square_sigma, more.square_sigma);
        (found, [baseline, end], noise) = searched(data, unfitted(data, noise), noise);
    }
    if let Some(beside) = beside_jitter(data, noise, &end) {
        (found, [baseline, end], noise) = beside;
    }
    let mut places = places(data, &baseline);
    // What random errors let appear among the columns is not asserted.
    let inflation = inflation(data, &end);
    // A line of several sources was found, or a wave that is none, but is not what has its name.
    // Where nothing of the camera is described, overtones may be anything else that is left.
    let waves = || if data.assumed.camera { None } else { no_wave(data, &found, &baseline, noise) };
    let unlike = several(&found, inflation).or_else(waves);
    let is_clear = |line: &&Place| deflated(inflation, line.ln_bayes, line.chi2.0) > LOCATED_NATS;
    let unnamed = unlike.as_ref().map(|(_, place)| place).filter(is_clear);
    let stands = |named: &Named| {
        // Of two that were found together the evidence is that of both.
        let together = found.named.iter().filter(|other| other.ln_bayes == named.ln_bayes);
        let chi2: f64 = together.map(|named| named.score.0).sum();
        let score = (chi2, named.score.1);
        of_name(inflation, named.ln_bayes, score) > THRESHOLD
            && unlike.as_ref().is_none_or(|(name, _)| named.name != *name)
    };
    let mut named: Vec<Named> = found.named.iter().filter(|named| stands(named)).cloned().collect();
    let dropped = named.len() < found.named.len();
    if named.is_empty() {
        // Where nothing is asserted, nothing is fitted: names that noise brought took its whiteness with them.
        end = baseline.clone();
    }
    let mut left = self::places(data, &end);
    if let Some(line) = unnamed {
        for places in [&mut places, &mut left] {
            // Random errors give way to what orders them.
            let share = |place: &Place| if place.is_random { ORDERED_SHARE } else { 1.0 };
            let at = places.iter().position(|place| share(place) * place.ln_bayes < line.ln_bayes);
            places.insert(at.unwrap_or(places.len()), line.clone());
        }
    }
    let of_line = unnamed.map_or(0.0, |line| line.chi2.0);
    let of_names = if named.is_empty() { 0.0 } else { found.baseline.chi2 - found.fit.chi2 };
    let explained = (of_names - of_line).max(0.0);

    // A random effect takes with it what is left at random.
    let of_forms = tolerated(&named);
    let seems = random_effect(data, &end);
    let random = seems.filter(|random| is_beyond_forms(random.ln_bayes, of_forms));
    // Else it is the noise that was stated, and more of it.
    let value = (noise.square - stated.square).max(0.0).sqrt();
    let strength = Strength { value, sigma: if value > 0.0 { 0.5 * square_sigma / value } else { 0.0 } };
    let excess = RandomEffect { name: EXCESS_NOISE, strength, ln_bayes: in_proportion, inflation: 1.0 };
    let excess = (seems.is_none() && in_proportion > 0.0).then_some(excess);
    let is_left = |place: &&Place| {
        random.is_none_or(|random| {
            !place.is_random && deflated(random.inflation, place.ln_bayes, place.chi2.0) > LOCATED_NATS
        })
    };
    let rest = |place: &Place| place.chi2.0 - place.chi2.1 as f64;
    let rest: f64 = left.iter().filter(is_left).map(rest).fold(0.0, f64::max);
    let remainder = if rest > 0.0 { rest / (rest + explained) } else { 0.0 };
    // Far from the baseline columns promise more than there is, and of several effects none is sure. Noise that samples share raises all columns, and
    // so does a random effect.
    let is_far = found.baseline.is_far_from(&found.fit);
    let shared = random::noise(data, &end);
    let are_raised = seems.is_some() || shared.is_some();
    let simpler = !is_far
        && !are_raised
        && Names::of(&found, &named, explained).is_some_and(|names| names.are_outvoted(&baseline));
    let believed = form_share(&named);
    let strongest = random.or(excess);
    let two = strongest.and_then(|strongest| two_jitters(&end, strongest));
    let at_random = two.map_or_else(|| strongest.into_iter().collect(), |two| two.to_vec());
    let mut strengths = Vec::new();
    for &RandomEffect { name, strength, ln_bayes, .. } in &at_random {
        strengths.push((name, strength));
        named.push(Named { name, ln_bayes, score: (2.0 * ln_bayes, 1), rivals: Vec::new() });
        if name == EXCESS_NOISE {
            let shape = format!("noise in proportion to the signal, {:.2} %", 100.0 * strength.value);
            let chi2 = (2.0 * ln_bayes, 1);
            places.push(Place {
                coordinate: "amplitude",
                shape,
                ln_bayes,
                chi2,
                looked: 1.0,
                take: end.take,
                is_random: true,
            });
        }
    }
    // What still lives where the mismatch lived most was not explained.
    let first = |places: &[Place]| places.first().map(|place| place.coordinate);
    let stays = !data.assumed.camera && first(&places).is_some() && first(&places) == first(&left);
    // A simulation of which nothing is described leaves out several things at once: what explains most of them is worth its name.
    let most_left = if data.assumed.camera { 0.5 } else { 0.1 };
    let verdict = if simpler {
        named.clear();
        Verdict::Unexplained
    } else if rest == 0.0
        || !named.is_empty() && unnamed.is_none() && remainder < believed && !(stays && named.len() > 2)
    {
        if named.is_empty() { Verdict::Clean } else { Verdict::Explained }
    } else if random.is_some() && unnamed.is_none() && named.len() == at_random.len() {
        Verdict::Explained
    } else if named.is_empty()
        || remainder > 0.5
        || named.len() == 1 && remainder > most_left
        || dropped
        || is_far
        || stays
    {
        named.clear();
        Verdict::Unexplained
    } else {
        Verdict::PartlyExplained
    };
    // Codes without their low bits need no statistics.
    let verdict = if data.cut_bits > 0 && matches!(verdict, Verdict::Clean | Verdict::Explained) {
        let ln_bayes = found.baseline.samples as f64 * f64::from(data.cut_bits) * std::f64::consts::LN_2;
        strengths.push((effects::FIXED_POINT, Strength { value: f64::from(data.cut_bits), sigma: 0.0 }));
        let score = (2.0 * ln_bayes, 1);
        named.push(Named { name: effects::FIXED_POINT, ln_bayes, score, rivals: Vec::new() });
        Verdict::Explained
    } else {
        verdict
    };
    if verdict == Verdict::Clean {
        places.clear();
    }
    strengths.retain(|(name, _)| named.iter().any(|named| named.name == *name));
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
        random: strengths,
        found,
        fit,
        noise,
        shared_noise,
    }
}

/// Where something repeats with the code that was taken for a wave, but has overtones.
fn no_wave(data: &Data, found: &Found, baseline: &Location, noise: Noise) -> Option<(&'static str, Place)> {
    let named = found.named.iter().find(|named| named.name == OF_CODES)?;
    let period_dn = overtones(data, found, noise)?;
    let shape = format!("a pattern that repeats every {period_dn:.1} DN and is no wave");
    let (ln_bayes, chi2, take) = (named.ln_bayes, named.score, baseline.take);
    Some((OF_CODES, Place { coordinate: "code", shape, ln_bayes, chi2, looked: 1.0, take, is_random: false }))
}

/// Where a line is that was taken for a flicker, but has several sources.
fn several(found: &Found, inflation: f64) -> Option<(&'static str, Place)> {
    let named = found.named.iter().find(|named| named.name == FLICKER)?;
    let shown = shown(&found.fit, inflation);
    if is_one(&shown) {
        return None;
    }
    let clear = |shown: &Shown| shown.size.0 / shown.size.1;
    let clearest = shown.iter().max_by(|a, b| clear(a).total_cmp(&clear(b)))?;
    let shape = format!("offset, a line of {:.2} Hz that differs from recording to recording", clearest.hz);
    let looked = found.baseline.series.in_time(FLICKER_HZ).map_or(1.0, |line| line.looked);
    let (ln_bayes, chi2, take) = (named.ln_bayes, named.score, clearest.take);
    Some((FLICKER, Place { coordinate: "time_s", shape, ln_bayes, chi2, looked, take, is_random: false }))
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
        fit(data, Some(&found.baseline), pieces, noise, &|_| true)
    }
}

/// What a search found, what is left before it and after it, and the noise beside which it was made.
type Searched = (Found, [Location; 2], Noise);

/// A search that trusts the forms of effects, if that brings the fit to the noise; else one that does not. Where all that is left of the simulation looks like a
/// jitter, it is made beside that.
fn searched(data: &Data, baseline: Fit, noise: Noise) -> Searched {
    let before = locate(data, &baseline, noise);
    let is_random = random_effect(data, &before).is_some();
    // Beside what frames share names would be found by the dozen, and fitted, that do not stand.
    if let Some(beside) = is_random.then(|| beside_jitter(data, noise, &before)).flatten() {
        return beside;
    }
    let inflation = random::noise(data, &before).map_or(1.0, |noise| noise.inflation);
    let end = |found: &Found| match found.named[..] {
        [] => before.clone(),
        _ => locate(data, &found.fit, noise),
    };
    let (mut found, without_trust) = Search::new(data, baseline, noise, inflation).with_trust();
    let mut after = end(&found);
    // Far from the baseline no form was trusted.
    let is_far = found.baseline.is_far_from(&found.fit);
    if let Some(search) =
        without_trust.filter(|_| !is_far && found.trusts_forms() && !places(data, &after).is_empty())
    {
        found = search.without_trust();
        after = end(&found);
    }
    (found, [before, after], noise)
}

/// The same beside errors of frames, where the `end` of a search shows such as a jitter makes, and a search that has them among the noise leaves nothing else:
/// what frames share is no evidence for anything that does it in another way.
fn beside_jitter(data: &Data, noise: Noise, end: &Location) -> Option<Searched> {
    if noise.jitter != [0.0; 2] {
        return None;
    }
    let beside = Noise { jitter: jitter(data, end)?, ..noise };
    let searched = searched(data, unfitted(data, beside), beside);
    let (found, [_, after], _) = &searched;
    // What orders the errors must not show, whether they are among the noise or not.
    let is_random = |location: &Location| random_effect(data, location).is_some();
    (is_random(after) && is_random(&locate(data, &found.fit, noise))).then_some(searched)
}

/// Coordinates that stand out, most significant first.
fn places(data: &Data, location: &Location) -> Vec<Place> {
    // What noise shares makes more of columns than noise that nothing shares.
    let inflation = random::noise(data, location).map_or(1.0, |noise| noise.inflation);
    let stands_out = |located: &&Located| {
        // Waves are measured by what noise there is.
        let inflation = if located.looked > 1.0 { 1.0 } else { inflation };
        deflated(inflation, located.ln_bayes, located.chi2.0) > LOCATED_NATS
    };
    let columns = location.columns.iter().filter(stands_out);
    let mut places: Vec<Place> = columns
        .map(|located| Place {
            coordinate: located.coordinate,
            shape: located.shape.clone(),
            ln_bayes: located.ln_bayes,
            chi2: located.chi2,
            looked: located.looked,
            take: location.take,
            is_random: false,
        })
        .collect();
    let clusters = errors(data, location);
    let ordered = places.first().map_or(0.0, |place| place.ln_bayes);
    if let Some(cluster) = clusters.first() {
        let place = Place {
            coordinate: coordinate(cluster),
            shape: words(cluster),
            ln_bayes: cluster.ln_bayes,
            chi2: (2.0 * cluster.ln_bayes, 1),
            looked: 1.0,
            take: cluster.take,
            is_random: true,
        };
        match ordered > ORDERED_SHARE * cluster.ln_bayes {
            true => places.push(place),
            false => places.insert(0, place),
        }
    }
    places
}
