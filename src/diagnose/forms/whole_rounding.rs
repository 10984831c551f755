//! Of the numbers of settings that round the same phases alike, but for a factor, the one whose rounding is a whole one: on a grid of phases there are many.

use super::roundings::{Commanded, FINER, MOST_PHASES, Phases, SETTINGS, numbers, settings_of, steps};
use crate::diagnose::fitting::fit::{Fit, fit};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::naming::pass::THRESHOLD;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::effects::phase_step_errors::{A_TURN, ROUNDING, rounded_by};
use rayon::prelude::*;

/// Two roundings may be the same but for their size where, between the steps of the scan, they are so much alike, and are where they are so.
const NEARLY: f64 = 0.8;
const BUT_FOR_SIZE: f64 = 0.995;
/// So many of them are fitted at most.
const MOST_FITTED: usize = 3;

/// By what each phase of `takes` is off when it is rounded, beside a constant error of each recording.
fn pattern(takes: &[Phases], settings: f64, rounds_down: bool) -> Vec<f64> {
    let of = |take: &Phases| {
        let off = |of: &Commanded| rounded_by(of.turns, settings, rounds_down);
        let mean = take.all.iter().map(|of| of.phase.1 * off(of)).sum::<f64>() / take.information;
        take.all.iter().map(|of| off(of) - mean).collect::<Vec<f64>>()
    };
    takes.iter().flat_map(of).collect()
}

/// How alike `one` pattern of these `weights` is to an `other`, from -1 to 1, and by which factor of the other one is most of the one.
fn likeness(weights: &[f64], one: &[f64], other: &[f64]) -> (f64, f64) {
    let product =
        |a: &[f64], b: &[f64]| -> f64 { weights.iter().zip(a).zip(b).map(|((w, a), b)| w * a * b).sum() };
    let (square, both) = (product(other, other), product(one, other));
    (both / (product(one, one) * square).sqrt(), both / square)
}

/// What is `fitted` with another number of settings, which rounds these phases alike but for a factor, where that brings the rounding nearer to a whole one.
pub fn with_whole_rounding(data: &Data, fitted: Fit, noise: Noise) -> Fit {
    let rounding =
        fitted.pieces.iter().find_map(|piece| settings_of(piece).map(|of| (piece.values[ROUNDING], of)));
    let Some((strength, (settings, down))) = rounding else { return fitted };
    let all = fitted.series.commanded();
    let Some(steps) = steps(&all) else { return fitted };
    let takes = Phases::thinned(&all, all.len().div_ceil(MOST_PHASES));
    let weights: Vec<f64> = takes.iter().flat_map(|take| take.all.iter().map(|of| of.phase.1)).collect();
    let own = pattern(&takes, settings, down);
    let of = |other: f64| (other, likeness(&weights, &own, &pattern(&takes, other, down)));
    let off = |factor: f64| (strength * factor - 1.0).abs();
    let finest = |near: f64| {
        let finer = (-FINER..=FINER).map(|n| of(near + f64::from(n) / (steps * f64::from(FINER))));
        finer.max_by(|a, b| a.1.0.total_cmp(&b.1.0))
    };
    let others = (0..numbers(steps)).into_par_iter().map(|n| of(SETTINGS.0 + n as f64 / steps));
    let others = others.filter(|(_, (alike, factor))| *alike > NEARLY && off(*factor) < off(1.0));
    let others = others.filter_map(|(near, _)| finest(near));
    let mut others: Vec<(f64, (f64, f64))> =
        others.filter(|(_, (alike, factor))| *alike > BUT_FOR_SIZE && off(*factor) < off(1.0)).collect();
    others.sort_by(|a, b| off(a.1.1).total_cmp(&off(b.1.1)));
    let with = |other: f64, factor: f64| {
        let anew = |piece: &Piece| {
            let mut piece = piece.clone();
            if settings_of(&piece).is_some() {
                (piece.values[ROUNDING], piece.values[A_TURN]) = (strength * factor, other);
            }
            piece
        };
        fit(data, Some(&fitted), fitted.pieces.iter().map(anew).collect(), noise, &|_| true)
    };
    let fits = others.into_iter().take(MOST_FITTED).map(|(other, (_, factor))| with(other, factor));
    let most = fitted.cost() + THRESHOLD;
    fits.into_iter().find(|fit| fit.cost() < most).unwrap_or(fitted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// At steps of a third of a turn 124 settings round as 100 do, but for a factor: whichever is fitted, the rounding becomes a whole one.
    #[test]
    fn of_numbers_that_round_alike_the_one_with_a_whole_rounding_is_stated() {
        let truth = injection("phase_step_errors:rounding=1,settings_a_turn=100").unwrap();
        let size = Geometry { width: 8, height: 6 };
        let data =
            Data::of(&taken(size, 3, &[truth], &["four-rail", "wdft-rail"]).unwrap(), Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let mut piece = Piece::off("phase_step_errors", &[ROUNDING], &[0, 1]);
        // Steps of a third and a quarter of a turn lie on a grid of twelve.
        piece.values[A_TURN] = 124.0;
        let fitted = fit(&data, Some(&unfitted(&data, noise)), vec![piece], noise, &|_| true);
        let strength = fitted.pieces[0].values[ROUNDING];
        assert!((strength - 1.24).abs() < 0.1, "{strength}");
        let whole = with_whole_rounding(&data, fitted, noise);
        let values = &whole.pieces[0].values;
        assert!((values[ROUNDING] - 1.0).abs() < 0.06, "{}", values[ROUNDING]);
        assert!((values[A_TURN] - 100.0).abs() < 6.5, "{}", values[A_TURN]);
    }
}
