//! Of several fits the one that is believed.

use super::candidates::Candidate;
use super::completed::NEEDED_NATS;
use super::pass::{DISBELIEF, Pass, RIVAL_NATS};
use super::tolerated::tolerance;
use crate::diagnose::fitting::bounds::is_bounded;
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::statistics::evidence::Model;
use crate::diagnose::tangents::pieces::Piece;

/// A shape that was fitted explains something by chance, too.
const SHAPE_NATS: f64 = 1.0;

impl Pass {
    /// Evidence of a block of the effect `name` by its `fit` to data whose chi squared was `before`, nats.
    pub fn fitted_ln_bayes(&self, block: usize, name: &str, before: f64, fit: &Fit) -> f64 {
        let score = self.scores[block].map_or(0.0, |(chi2, _)| chi2);
        let own = fit.pieces.iter().filter(|piece| piece.effect.name == name);
        let by_chance = SHAPE_NATS * own.map(Piece::shapes).sum::<usize>() as f64;
        self.singles[block] + 0.5 * (before - fit.chi2 - fit.unreached - score) - by_chance
    }

    /// Of blocks and their fits, to data of which `before` was the fit: the best one, with its fit, and the effects that come as near as
    /// its form can be trusted; nothing where there are none. Where another fit `may_stand_for` the best one, as simpler, and explains about as much, it is taken.
    pub fn fittest(
        &self,
        before: &Fit,
        fits: Vec<(usize, Fit)>,
        candidates: &[Candidate],
        may_stand_for: &dyn Fn(&Fit, &Fit) -> bool,
    ) -> Option<(Model, Fit, Vec<String>)> {
        // Of residuals as they count, and of all that they have beyond.
        let explained =
            |fit: &Fit| [before.counted() - fit.counted() - fit.unreached, before.chi2 - fit.left()];
        let judged = |(block, fit): (usize, Fit)| {
            (self.fitted_ln_bayes(block, self.name(block, candidates), before.chi2, &fit), block, fit)
        };
        let mut judged: Vec<(f64, usize, Fit)> = fits.into_iter().map(judged).collect();
        // A model that is no number anywhere fits nothing.
        judged.retain(|fitted| fitted.0.is_finite());
        judged.sort_by(|a, b| b.0.total_cmp(&a.0));
        // Where no form is exact: of those that explain about as much as the best one, the simplest.
        let best = &judged.first()?.2;
        let most = explained(best);
        let is_believed = |&place: &usize| {
            let (_, block, fit) = &judged[place];
            let left = DISBELIEF * tolerance(self.name(*block, candidates));
            let is_as_good =
                || explained(fit).iter().zip(most).all(|(explained, most)| *explained > (1.0 - left) * most);
            place == 0 || may_stand_for(fit, best) && is_as_good()
        };
        let believed = (0..judged.len()).filter(is_believed);
        let simplest = believed.min_by_key(|&place| judged[place].2.columns.len()).unwrap_or(0);
        let (ln_bayes, block, fit) = judged.remove(self.form_enough(&judged, simplest));
        // What its form may leave does not tell it from others either, nor what theirs may.
        let own = tolerance(self.name(block, candidates));
        let is_near = |(nats, other, _): &&(f64, usize, Fit)| {
            let form = own.max(tolerance(self.name(*other, candidates)));
            *nats > ln_bayes - (0.5 * form * (before.counted() - fit.counted())).max(RIVAL_NATS)
        };
        let near =
            judged.iter().filter(is_near).map(|other| self.name(other.1, candidates).to_owned()).collect();
        Some((Model { blocks: vec![block], ln_bayes }, fit, near))
    }

    /// Of an effect that is there in both of two forms at once at `place` among the fits that are `judged`, the place of the form that is enough alone; else `place`
    /// itself.
    fn form_enough(&self, judged: &[(f64, usize, Fit)], place: usize) -> usize {
        let (_, whole, of_both) = &judged[place];
        if !self.is_of_both_forms(*whole) {
            return place;
        }
        // With numbers enough one bends to what is not its own, as far as it may.
        let least = if is_bounded(of_both) { f64::INFINITY } else { NEEDED_NATS };
        let is_enough = |&other: &usize| {
            let (_, block, fit) = &judged[other];
            let more = of_both.columns.len().saturating_sub(fit.columns.len());
            let needed = 0.5 * (fit.left() - of_both.left()) - more as f64;
            self.blocks[*block].candidate == self.blocks[*whole].candidate && more > 0 && needed < least
        };
        let cost = |place: usize| judged[place].2.cost();
        let enough = (0..judged.len()).filter(is_enough).min_by(|&a, &b| cost(a).total_cmp(&cost(b)));
        enough.unwrap_or(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::fitting::fit::fit;
    use crate::diagnose::naming::candidates::candidates;
    use crate::diagnose::reading::data::Data;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    const RESPONSE: &str = "intensity_nonlinearity";

    /// How many numbers the form has that is enough for a `response`, of all forms fitted, where both at once have been taken; with the number `bounded` of these at
    /// its bound.
    fn numbers_enough(response: &str, bounded: Option<usize>) -> usize {
        let size = Geometry { width: 16, height: 12 };
        let effect = injection(&format!("{RESPONSE}:{response}")).unwrap();
        let recordings = taken(size, 2, &[effect], &["four-motion", "wdft-rail"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        let candidates = candidates(&data, &baseline.series);
        let pass = Pass::of(&data, &baseline, &candidates, noise, 1.0);
        let blocks = (0..pass.blocks.len()).filter(|&block| pass.name(block, &candidates) == RESPONSE);
        let fitted = |block: usize| {
            let pieces = pass.pieces(&[block], &candidates);
            (0.0, block, fit(&data, Some(&baseline), pieces, noise, &|_| true))
        };
        let mut judged: Vec<_> = blocks.map(fitted).collect();
        let place = judged.iter().position(|judged| pass.is_of_both_forms(judged.1)).unwrap();
        if let Some(number) = bounded {
            let piece = &mut judged[place].2.pieces[0];
            piece.values[number] = piece.effect.parameters[number].bounds.1;
        }
        judged[pass.form_enough(&judged, place)].2.columns.len()
    }

    #[test]
    fn both_forms_at_once_stay_where_neither_is_enough() {
        assert_eq!(numbers_enough("exponent=0.05", None), 1);
        assert_eq!(numbers_enough("quadratic=0.06,cubic=0.03", None), 2);
        assert_eq!(numbers_enough("quadratic=0.035,cubic=0.035,exponent=0.035", None), 3);
    }

    #[test]
    fn both_forms_at_once_do_not_stay_at_a_bound() {
        assert!(numbers_enough("quadratic=0.035,cubic=0.035,exponent=0.035", Some(0)) < 3);
    }
}
