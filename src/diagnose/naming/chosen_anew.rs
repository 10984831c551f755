//! What was chosen of an effect before others were named beside it: the one of a few shapes that fitted best alone need not be the one that does among all.

use super::candidates::Candidate;
use super::contest::Entrant;
use super::found::Named;
use super::pass::{Pass, RIVAL_NATS, SIMPLER_SHARE};
use crate::diagnose::fitting::bounds::bounded;
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::forms::other_camera::OTHER_CAMERA;
use crate::diagnose::forms::refined::{UNCHANGED, best_below, is_seldom};
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::Effect;

/// The first choice of an effect, by its number, if it has one.
fn choice_of(effect: &Effect) -> Option<usize> {
    effect.parameters.iter().position(|parameter| parameter.is_choice)
}

/// In `current`, each effect that is `named` takes another value of its first choice where that fits clearly better, if alone, by the `first` pass over the
/// `candidates`, it does half as much as the best one.
pub fn chosen_anew(
    data: &Data,
    noise: Noise,
    (first, candidates): (&Pass, &[Candidate]),
    current: &mut Fit,
    named: &mut [Named],
) {
    for named in named {
        let ways = ways(first, candidates, current, named.name);
        let at_bounds = bounded(current);
        let is_within = |fit: &Fit| bounded(fit).is_subset(&at_bounds);
        let most = current.cost() - RIVAL_NATS;
        if let Some(better) = best_below(data, current, vec![ways], noise, most, &is_within) {
            named.ln_bayes += 0.5 * (current.chi2 - better.chi2);
            named.score.0 = (named.score.0 + current.counted() - better.counted()).max(0.0);
            *current = better;
        }
    }
}

/// The pieces of `current` as they are, and with each other value of the first choice of the effect `name` that comes near by itself.
fn ways(first: &Pass, candidates: &[Candidate], current: &Fit, name: &'static str) -> Vec<Entrant> {
    let entrant = |(number, pieces)| Entrant { block: UNCHANGED + number, name, pieces, led: None };
    let is_of = |piece: &&Piece| piece.effect.name == name;
    let own = current.pieces.iter().find(is_of).and_then(|piece| Some((piece, choice_of(piece.effect)?)));
    let Some((own, choice)) = own else { return Vec::new() };
    // Another camera's light has the part of the image that was found for its choice.
    if name == OTHER_CAMERA {
        return Vec::new();
    }
    let others = near_ones(first, candidates, own.effect, choice)
        .into_iter()
        .filter(|chosen| *chosen != own.values[choice]);
    let with = |chosen: f64| -> Vec<Piece> {
        let mut pieces = current.pieces.clone();
        pieces.iter_mut().filter(|piece| is_of(&&**piece)).for_each(|piece| piece.values[choice] = chosen);
        pieces
    };
    [current.pieces.clone()].into_iter().chain(others.map(with)).enumerate().map(entrant).collect()
}

/// The values of the `choice` of an effect that do alone half of what the best one does.
fn near_ones(first: &Pass, candidates: &[Candidate], effect: &Effect, choice: usize) -> Vec<f64> {
    let score = |block: usize| first.scores[block].map_or(0.0, |(chi2, _)| chi2);
    let blocks = || (0..first.blocks.len()).filter(|&block| first.name(block, candidates) == effect.name);
    let most = blocks().map(score).fold(0.0, f64::max);
    let parameter = &effect.parameters[choice];
    let best_with = |chosen: f64| {
        let has_it = |&block: &usize| {
            first.pieces(&[block], candidates).first().is_some_and(|piece| piece.values[choice] == chosen)
        };
        blocks().filter(has_it).map(score).fold(0.0, f64::max)
    };
    // What is above 1 is a number of strengths, and has others; what is seldom is tried where the effect is named.
    let is_open = |chosen: &f64| *chosen <= 1.0 && !is_seldom(effect.name, parameter.name, *chosen);
    let open = parameter.shapes.iter().copied().filter(is_open);
    open.filter(|&chosen| best_with(chosen) > SIMPLER_SHARE * most).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::fitting::fit::fit;
    use crate::diagnose::naming::candidates::candidates;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    const SCATTER: &str = "lens_scatter";
    const TAPS: &str = "tap_mismatch";

    /// Share and decay length that light has which is scattered with one decay length, and was taken for light of another one beside a tap.
    fn scattered(truth: f64, taken_for: f64) -> [f64; 2] {
        let scatter = format!("{SCATTER}:share=0.03,decay_length_of_width={truth}");
        let effects = [&scatter[..], "tap_mismatch:gain=0.01"].map(|text| injection(text).unwrap());
        let size = Geometry { width: 16, height: 12 };
        let data =
            Data::of(&taken(size, 3, &effects, &["four-rail", "wdft-rail"]).unwrap(), Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        let candidates = candidates(&data, &baseline.series);
        let first = Pass::of(&data, &baseline, &candidates, noise, 1.0);
        let mut scatter = Piece::off(SCATTER, &[0], &[0, 1]);
        scatter.values[1] = taken_for;
        let pieces = vec![Piece::off(TAPS, &[0, 1], &[0, 1]), scatter];
        let mut current = fit(&data, Some(&baseline), pieces, noise, &|_| true);
        let named =
            |name| Named { name, ln_bayes: 50.0, score: (1e3, 1), rivals: Vec::new(), is_trusted: false };
        let mut names = vec![named(SCATTER), named(TAPS)];
        let before = current.counted();
        chosen_anew(&data, noise, (&first, &candidates), &mut current, &mut names);
        let more = before - current.counted();
        assert!((names[0].score.0 - 1e3 - more).abs() < 1e-6, "{:?} {more}", names[0].score);
        let piece = current.pieces.iter().find(|piece| piece.effect.name == SCATTER).unwrap();
        assert_eq!(current.pieces.len(), 2);
        [piece.values[0], piece.values[1]]
    }

    #[test]
    fn the_shape_that_fits_among_all_is_taken() {
        for (truth, taken_for) in [(0.0, 0.4), (0.4, 0.0), (0.2, 0.2)] {
            let [share, decay] = scattered(truth, taken_for);
            assert_eq!(decay, truth);
            assert!((share / 0.03 - 1.0).abs() < 0.1, "{share}");
        }
    }
}
