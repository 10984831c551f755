//! Searches: with trust in forms or without, beside noise as it shows and errors that frames share.

use crate::diagnose::fitting::finished::unfitted;
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::noise::{Noise, beyond};
use crate::diagnose::locating::location::{LOCATED_NATS, Located, Location, locate};
use crate::diagnose::locating::mismatch::{Place, places};
use crate::diagnose::naming::found::Found;
use crate::diagnose::naming::search::Search;
use crate::diagnose::reading::data::Data;
use crate::diagnose::shared_errors::clusters::Cluster;
use crate::diagnose::shared_errors::levels::Level;
use crate::diagnose::shared_errors::random::{self, is_noisier, jitter, random_effect};

/// Errors of frames are more than the camera includes by this factor, or are found beside those.
const MORE: f64 = 1.1;
/// What a search with trust leaves in any coordinate is small beside what it explains by trust alone.
const SMALL: f64 = 0.25;
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

/// A search that trusts the forms of effects, if that brings the fit to the noise, or [near it](leaves_little); else one that does not. Where all that is left of the simulation looks like a
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
    let located = located(data, &baseline, &before, noise);
    let (mut found, without_trust) =
        Search::new(data, baseline, noise, inflation, of_included, located).with_trust();
    let mut after = end(&found);
    let is_doubted = |found: &Found| found.trusts_forms() && !leaves_little(found, &places(data, &after));
    if let Some(search) = without_trust.filter(|_| is_doubted(&found)) {
        found = search.without_trust();
        after = end(&found);
    }
    Searched { found, locations: [before, after], noise }
}

/// Whether what is left, in the coordinates in which it is, is next to nothing of what each effect explains that is trusted: what the form of a strong one leaves may be as much, and a
/// trusted one that only takes a part of that leaves the rest.
fn leaves_little(found: &Found, left: &[Place]) -> bool {
    let trusted = found.named.iter().filter(|named| named.is_trusted).map(|named| named.score.0);
    let left = left.iter().map(Place::excess).fold(0.0, f64::max);
    left <= SMALL * trusted.fold(f64::INFINITY, f64::min)
}

/// Coordinates of which effects that begin in another shape may say much more than their tangents do, and those in which tangents and columns are much alike.
const UNSURE: [&str; 2] = ["code", "neighbours"];

/// Chi squared, besides chance, that one coordinate explains of what is left `before` a search: by its columns, or by errors that rows, columns or neighbours
/// share. None beside white noise that samples share, or a jitter among the `noise`, which raise all of these; nor far off, where tangents say little of what a
/// fit will, or where no camera is described, and several things are left out at once.
fn located(data: &Data, baseline: &Fit, before: &Location, noise: Noise) -> f64 {
    let are_raised = noise.jitter != [0.0; 2] || random::noise(data, before).is_some();
    if are_raised || data.assumed.camera || baseline.is_far() {
        return 0.0;
    }
    // Nor by waves, of which the search finds its own.
    let is_counted = |located: &&Located| {
        located.ln_bayes > LOCATED_NATS && located.looked == 1.0 && !UNSURE.contains(&located.coordinate)
    };
    let columns = before.columns.iter().filter(is_counted);
    let columns = columns.map(|located| located.chi2.0 - located.chi2.1 as f64);
    let is_of_lines =
        |error: &&Cluster| matches!(error.level, Level::Row | Level::Column | Level::Neighbours);
    let strongest = random::errors(data, before).into_iter().take(1).filter(is_of_lines);
    columns.chain(strongest.map(|error| 2.0 * error.ln_bayes)).fold(0.0, f64::max)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::naming::candidates::candidates;
    use crate::diagnose::naming::pass::Pass;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;
    use crate::physics::effects::FIXED_POINT;
    use crate::physics::{Chance, EFFECTS};

    const SIZE: Geometry = Geometry { width: 16, height: 12 };
    const RECORDINGS: [&str; 3] = ["four-sweep", "four-rail", "wdft-motion"];
    /// Shapes between those from which a search begins.
    const BETWEEN: [&str; 11] = [
        "adc_nonlinearity:cosine_dn=1,period_dn=290",
        "ambient_drift:relative_a_second=0.01,time_constant_s=3.3",
        "ambient_flicker:cosine=0.05,frequency_hz=103.1",
        "encoder_cyclic:cosine_m=0.002,period_m=0.137",
        "encoder_cyclic:cosine_m=0.002,sine_m=0.001,period_m=0.337,controls_carriage=1",
        "illumination_drift:relative=0.02,time_constant_s=7",
        "illumination_droop:relative=0.01,time_constant_s=0.03",
        "image_lag:share=0.02,last_step_before_first=-1",
        "multi_camera_interference:cosine_dn=1,beat_hz=0.83",
        "multipath_interference:relative_amplitude=0.1,wall_distance_m=0.7",
        "phase_drift:drift_rad=0.01,time_constant_s=7",
    ];

    /// What one coordinate explains of a campaign with these effects, and the pass over all candidates.
    fn seen(effects: &[&str]) -> (f64, Pass) {
        let effects: Vec<_> = effects.iter().map(|effect| injection(effect).unwrap()).collect();
        let recordings = taken(SIZE, 3, &effects, &RECORDINGS).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        let candidates = candidates(&data, &baseline.series);
        let pass = Pass::of(&data, &baseline, &candidates, noise, 1.0);
        let before = locate(&data, &baseline, noise);
        (located(&data, &baseline, &before, noise), pass)
    }

    fn is_sought(effect: &str) {
        let (located, pass) = seen(&[effect]);
        assert!(!pass.is_hopeless(located), "{effect}: {located}");
    }

    /// What the registry has is not given up, in whatever shape.
    #[test]
    fn no_line_is_hopeless() {
        let is_line = |effect: &&&str| effect.contains("period") || effect.contains("_hz");
        BETWEEN.iter().filter(is_line).for_each(|effect| is_sought(effect));
    }

    #[test]
    #[ignore = "minutes: make slow"]
    fn no_effect_is_hopeless() {
        // What the camera includes, and what needs a specification.
        let others = ["axial_motion", "inverse_square_falloff", FIXED_POINT];
        let is_seen = |name: &&str| !others.contains(name);
        let usual = EFFECTS.iter().filter(|effect| effect.chance == Chance::None).map(|effect| effect.name);
        usual.filter(is_seen).chain(BETWEEN).for_each(is_sought);
    }

    /// Of a drift its coordinate says a good part, and of noise nothing does.
    #[test]
    fn what_is_located_is_what_columns_explain() {
        let (of_drift, pass) = seen(&["phase_drift:drift_rad=0.03,time_constant_s=7"]);
        assert!(of_drift > 300.0 && pass.is_hopeless(100.0 * of_drift), "{of_drift}");
        assert_eq!(seen(&[]).0, 0.0);
    }
}
