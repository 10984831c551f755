//! Whether of several effects one is what a simpler one does: alone, beside what was not fitted yet, it may have needed more numbers than it needs now.

use super::candidates::Candidate;
use super::found::Named;
use super::pass::{DISBELIEF, Pass, RIVAL_NATS, SIMPLER_SHARE};
use super::search::UNDESCRIBED;
use super::tolerated::{tolerance, tolerated};
use crate::diagnose::fitting::fit::{Fit, fit_below};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::reading::data::Data;

/// So many are tried in the place of one.
const MOST: usize = 3;

/// In `current` and `named`, of several, the first effect in whose place a simpler one of the `candidates` of the `first` pass leaves no more than forms may,
/// is replaced by that; whether there was one.
pub fn exchange(
    data: &Data,
    noise: Noise,
    (first, candidates): (&Pass, &[Candidate]),
    current: &mut Fit,
    named: &mut [Named],
) -> bool {
    let undescribed = if data.assumed.camera { UNDESCRIBED } else { 1.0 };
    for number in 0..named.len() {
        let Named { name: old, score: (explained, _), .. } = named[number];
        let others = current.pieces_without(old);
        // What the others' forms leave more numbers may say, or the form of either leaves.
        let of_others = tolerated(named) - tolerance(old) * explained;
        let allowed = |block: usize| {
            let own = tolerance(first.name(block, candidates)).min(tolerance(old));
            0.5 * undescribed * of_others.min(DISBELIEF * own * explained)
        };
        let fitted = |block: usize| {
            let pieces = [&others[..], &first.pieces(&[block], candidates)].concat();
            (block, fit_below(data, current, pieces, noise, current.cost() + allowed(block)))
        };
        // What was given up is not chosen from, and neither is what is no number.
        let is_simpler = |(block, fitted): &(usize, Fit)| {
            fitted.cost() < current.cost() + allowed(*block) && fitted.columns.len() < current.columns.len()
        };
        let fits = simpler(first, candidates, named, number).into_iter().map(fitted).filter(is_simpler);
        if let Some((block, fitted)) = fits.min_by(|a, b| a.1.cost().total_cmp(&b.1.cost())) {
            let (name, worse) = (first.name(block, candidates), fitted.cost() - current.cost());
            let less = fitted.counted() - current.counted();
            let named = &mut named[number];
            named.name = name;
            named.ln_bayes -= 0.5 * (fitted.chi2 - current.chi2);
            named.score =
                ((explained - less).max(0.0), first.scores[block].map_or(1, |(_, numbers)| numbers));
            named.rivals.retain(|rival| rival != name);
            if worse > -RIVAL_NATS {
                named.rivals.push(old.to_owned());
            }
            *current = fitted;
            return true;
        }
    }
    false
}

/// The best block each of the candidates that do half of what the effect of this `number` does alone, by fewer numbers, and are not named.
fn simpler(first: &Pass, candidates: &[Candidate], named: &[Named], number: usize) -> Vec<usize> {
    let score = |block: usize| first.scores[block].unwrap_or((0.0, usize::MAX));
    let blocks = 0..first.blocks.len();
    let is_own = |&block: &usize| first.name(block, candidates) == named[number].name;
    let own = blocks.clone().filter(is_own).map(|block| score(block).0).fold(0.0, f64::max);
    let numbers = named[number].score.1;
    let is_simpler = |&block: &usize| {
        let (chi2, degrees) = score(block);
        let name = first.name(block, candidates);
        // Both of two forms at once are no simpler than one.
        let is_simple = degrees < numbers && !first.is_of_both_forms(block);
        is_simple && chi2 > SIMPLER_SHARE * own && named.iter().all(|named| named.name != name)
    };
    let mut simpler: Vec<usize> = blocks.filter(is_simpler).collect();
    simpler.sort_by(|&a, &b| score(b).0.total_cmp(&score(a).0));
    let mut known = Vec::new();
    simpler.retain(|&block| {
        let candidate = first.blocks[block].candidate;
        let is_new = !known.contains(&candidate);
        known.push(candidate);
        is_new
    });
    simpler.truncate(MOST);
    simpler
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::fitting::fit::fit;
    use crate::diagnose::naming::candidates::candidates;
    use crate::diagnose::stated_noise;
    use crate::diagnose::tangents::pieces::Piece;
    use crate::frames::Geometry;

    const SEED: u64 = 5;
    const ERRORS: &str = "phase_step_errors";
    const SCALE: &str = "phase_step_scale";
    const ECHO: &str = "multipath_interference";

    /// A rail of four and of five frames, in which a wall adds to the light, beside effects of the steps.
    fn campaign(steps: &[&str]) -> Data {
        let size = Geometry { width: 16, height: 12 };
        let wall = "multipath_interference:relative_amplitude=0.05,wall_distance_m=1.2";
        let effects: Vec<_> =
            [steps, &[wall]].concat().into_iter().map(|text| injection(text).unwrap()).collect();
        let recordings = taken(size, SEED, &effects, &["four-rail", "wdft-rail"]).unwrap();
        Data::of(&recordings, Vec::new()).unwrap()
    }

    /// What [`exchange`] makes of errors of steps beside the wall, fitted to a [`campaign`]: the names, what comes near the first one, and chi squared
    /// before and after.
    fn exchanged(steps: &[&str]) -> (Vec<&'static str>, Vec<String>, [f64; 2]) {
        let data = campaign(steps);
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        let candidates = candidates(&data, &baseline.series);
        let first = Pass::of(&data, &baseline, &candidates, noise, 1.0);
        let best = |name: &str| {
            let of = (0..first.blocks.len()).filter(|&block| first.name(block, &candidates) == name);
            let score = |block: usize| first.scores[block].map_or(0.0, |(chi2, _)| chi2);
            of.max_by(|&a, &b| score(a).total_cmp(&score(b))).unwrap()
        };
        let blocks = [ERRORS, ECHO].map(best);
        let mut current = fit(&data, Some(&baseline), first.pieces(&blocks, &candidates), noise, &|_| true);
        let named = |&block: &usize| Named {
            name: first.name(block, &candidates),
            ln_bayes: 100.0,
            score: first.scores[block].unwrap(),
            rivals: Vec::new(),
            is_trusted: false,
        };
        let mut named: Vec<Named> = blocks.iter().map(named).collect();
        let before = current.chi2;
        let was = exchange(&data, noise, (&first, &candidates), &mut current, &mut named);
        assert_eq!(was, named[0].name != ERRORS);
        (named.iter().map(|named| named.name).collect(), named[0].rivals.clone(), [before, current.chi2])
    }

    #[test]
    fn errors_that_are_a_scale_are_named_a_scale() {
        let (names, rivals, [before, after]) = exchanged(&["phase_step_scale:relative=0.004"]);
        assert_eq!(names, [SCALE, ECHO]);
        // Nine numbers say by chance what one does not.
        assert!(after - before < 30.0, "{before}, {after}");
        assert!(rivals.is_empty() || rivals == [ERRORS], "{rivals:?}");
    }

    #[test]
    fn a_scale_may_leave_what_forms_may() {
        let trace = "phase_step_errors:setting_1_rad=0.004";
        let (names, rivals, [before, after]) = exchanged(&["phase_step_scale:relative=0.004", trace]);
        assert_eq!(names, [SCALE, ECHO]);
        assert!(after - before > 30.0, "by chance: {before}, {after}");
        assert_eq!(rivals, [ERRORS]);
    }

    #[test]
    fn errors_that_are_none_stay() {
        let errors = "phase_step_errors:setting_1_rad=0.006,setting_2_rad=0.001,setting_3_rad=0.01";
        let (names, rivals, [before, after]) = exchanged(&[errors]);
        assert_eq!(names, [ERRORS, ECHO]);
        assert!(rivals.is_empty() && before == after, "{rivals:?}");
    }

    #[test]
    fn a_fit_that_will_not_come_as_low_is_given_up() {
        let data = campaign(&[]);
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        let candidates = candidates(&data, &baseline.series);
        let pieces = |name: &str| -> Vec<Piece> {
            let of = candidates.iter().find(|candidate| candidate.effect.name == name).unwrap();
            // Of a wall, one that is not far from where it is.
            of.variants[3.min(of.variants.len() - 1)].pieces.clone()
        };
        let whole = |name| fit(&data, Some(&baseline), pieces(name), noise, &|_| true);
        let below = |name, most| fit_below(&data, &baseline, pieces(name), noise, most);
        let wall = whole(ECHO);
        let most = wall.cost() + 1.0;
        assert_eq!(below(ECHO, most).cost(), wall.cost());
        // What a wall does no response does, and that is known before it is fitted.
        let (all, given_up) = (whole("intensity_nonlinearity"), below("intensity_nonlinearity", most));
        assert!(all.cost() > most && given_up.cost() > most, "{most} {} {}", all.cost(), given_up.cost());
        assert!(given_up.unreached > all.unreached, "{} {}", given_up.unreached, all.unreached);
    }
}
