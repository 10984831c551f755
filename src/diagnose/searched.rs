//! Searches: with trust in forms or without, beside noise as it shows and errors that frames share.

use super::clusters::Level;
use super::data::Data;
use super::finished::unfitted;
use super::fit::Fit;
use super::found::Found;
use super::location::{LOCATED_NATS, Located, Location, locate};
use super::mismatch::places;
use super::noise::{Noise, beyond};
use super::random::{self, is_noisier, jitter, random_effect};
use super::search::Search;

/// Errors of frames are more than the camera includes by this factor, or are found beside those.
const MORE: f64 = 1.1;
/// How often the noise is corrected.
const NOISE_STEPS: usize = 2;

/// What a search found.
pub struct Searched {
    /// It.
    pub found: Found,
    /// What is left before it and after it.
    pub locations: [Location; 2],
    /// The noise beside which it was made.
    pub noise: Noise,
}

/// What there is more of noise than was stated, of that in proportion to the signal.
#[derive(Default)]
pub struct InProportion {
    /// Evidence, nats.
    pub ln_bayes: f64,
    /// Standard deviation of the relative variance.
    pub square_sigma: f64,
}

/// Searches `data`, to which `baseline` was fitted without any effect, again where single pixels have more noise than was `stated`, and where frames share
/// errors. The forms of effects that the camera includes may leave chi squared `of_included`.
pub fn searched(data: &Data, baseline: Fit, stated: Noise, of_included: f64) -> (Searched, InProportion) {
    let mut searched = search(data, baseline, stated, of_included);
    let mut in_proportion = InProportion::default();
    for _ in 0..NOISE_STEPS {
        if !is_noisier(data, &searched.locations[1]) {
            break;
        }
        let more = beyond(data, &searched.found.fit, searched.noise, stated);
        if more.noise.is_near(searched.noise) {
            break;
        }
        in_proportion = InProportion { ln_bayes: more.in_proportion, square_sigma: more.square_sigma };
        searched = search(data, unfitted(data, more.noise), more.noise, of_included);
    }
    let beside = beside_jitter(data, searched.noise, &searched.locations[1], of_included);
    (beside.unwrap_or(searched), in_proportion)
}

/// A search that trusts the forms of effects, if that brings the fit to the noise; else one that does not. Where all that is left of the simulation looks like a
/// jitter, it is made beside that.
fn search(data: &Data, baseline: Fit, noise: Noise, of_included: f64) -> Searched {
    let before = locate(data, &baseline, noise);
    let is_random = random_effect(data, &before).is_some();
    // Beside what frames share names would be found by the dozen, and fitted, that do not stand.
    if let Some(beside) = is_random.then(|| beside_jitter(data, noise, &before, of_included)).flatten() {
        return beside;
    }
    let inflation = random::noise(data, &before).map_or(1.0, |noise| noise.inflation);
    let end = |found: &Found| match found.named[..] {
        [] => before.clone(),
        _ => locate(data, &found.fit, noise),
    };
    let (mut found, without_trust) =
        Search::new(data, baseline, noise, inflation, of_included, located(data, &before)).with_trust();
    let mut after = end(&found);
    if let Some(search) = without_trust.filter(|_| found.trusts_forms() && !places(data, &after).is_empty()) {
        found = search.without_trust();
        after = end(&found);
    }
    Searched { found, locations: [before, after], noise }
}

/// Chi squared, besides chance, that one coordinate explains of what is left `before` a search: by columns, or by errors that rows, columns or neighbours share
/// and no effect makes.
fn located(data: &Data, before: &Location) -> f64 {
    let is_clear = |located: &&Located| located.ln_bayes > LOCATED_NATS;
    let columns = before.columns.iter().filter(is_clear);
    let columns = columns.map(|located| located.chi2.0 - located.chi2.1 as f64);
    let errors = random::errors(data, before).into_iter();
    let of_lines =
        errors.filter(|error| matches!(error.level, Level::Row | Level::Column | Level::Neighbours));
    columns.chain(of_lines.map(|error| 2.0 * error.ln_bayes)).fold(0.0, f64::max)
}

/// The same beside errors of frames, where the `end` of a search shows such as a jitter makes, and a search that has them among the noise leaves nothing else:
/// what frames share is no evidence for anything that does it in another way.
fn beside_jitter(data: &Data, noise: Noise, end: &Location, of_included: f64) -> Option<Searched> {
    // Once is enough.
    let included = data.unpredicted.jitter;
    if noise.jitter != included {
        return None;
    }
    let found = jitter(data, end)?;
    let is_more = |number: usize| found[number] > MORE * included[number];
    if !is_more(0) && !is_more(1) {
        return None;
    }
    let beside = Noise { jitter: [0, 1].map(|number| found[number].max(included[number])), ..noise };
    let searched = search(data, unfitted(data, beside), beside, of_included);
    let (found, after) = (&searched.found, &searched.locations[1]);
    // What orders the errors must not show, whether they are among the noise or not.
    let is_random = |location: &Location| random_effect(data, location).is_some();
    (is_random(after) && is_random(&locate(data, &found.fit, noise))).then_some(searched)
}
