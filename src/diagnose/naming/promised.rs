//! Two effects that tangents promise together, of which the strongest was taken first.

use super::found::Named;
use super::pass::RIVAL_NATS;
use super::tolerated::{are_of_distance, tolerated};
use crate::diagnose::fitting::fit::{Fit, HOPE, fit_below};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::Parameter;

/// Both, as they were promised.
#[derive(Debug, Clone)]
pub struct Promised {
    /// Their pieces.
    pub pieces: Vec<Piece>,
    /// Their names.
    pub named: Vec<Named>,
}

impl Promised {
    /// Whether what `came` is of the two by the same numbers in the same recordings, whatever its choice, without a shape that it could have fitted.
    fn is_of_it(&self, came: &[Piece]) -> bool {
        let is_promised = |piece: &Piece| {
            let is_the_same = |other: &Piece| {
                other.effect.name == piece.effect.name
                    && other.takes == piece.takes
                    && other.free == piece.free
            };
            let is_fitted_shape = |parameter: &Parameter| parameter.is_shape() && !parameter.is_choice;
            !piece.effect.parameters.iter().any(is_fitted_shape) && self.pieces.iter().any(is_the_same)
        };
        came.iter().all(is_promised)
    }

    /// Whether what `came` is one of the two as it was promised, and the other has been tried beside that, where tangents are good, in vain: `excess`, by an
    /// effect's name, is what it would explain there besides chance, chi squared.
    pub fn is_hopeless(&self, came: &[Piece], excess: &dyn Fn(&str) -> f64) -> bool {
        let numbers = |pieces: &[Piece]| pieces.iter().map(|piece| piece.free.len()).sum::<usize>() as f64;
        let is_another = |named: &&Named| !came.iter().any(|piece| piece.effect.name == named.name);
        let hoped: f64 = self.named.iter().filter(is_another).map(|named| excess(named.name)).sum();
        let needed = 2.0 * RIVAL_NATS + numbers(&self.pieces) - numbers(came);
        self.is_of_it(came) && HOPE * hoped < needed
    }

    /// Both together from the `baseline` on, where one of them did not come and they fit clearly better than what came, by the fit and its names.
    pub fn better_than(
        &self,
        data: &Data,
        noise: Noise,
        baseline: &Fit,
        (came, names): (&Fit, &[Named]),
    ) -> Option<(Fit, Vec<Named>)> {
        let is_there = |named: &Named| names.iter().any(|other| other.name == named.name);
        if self.named.iter().all(is_there) {
            return None;
        }
        // Of several that are of the distance, what is more may be what the form of one leaves; so it may beside what came as it was promised.
        let all = || names.iter().chain(&self.named).map(|named| named.name);
        let are_of_distance = all().all(|one| all().all(|other| are_of_distance(one, other)));
        let may_be_of_form = are_of_distance || self.is_of_it(&came.pieces);
        let of_forms = if may_be_of_form { 0.5 * tolerated(names) } else { 0.0 };
        let most = came.cost() - RIVAL_NATS.max(of_forms);
        let fitted = fit_below(data, baseline, self.pieces.clone(), noise, most);
        (fitted.cost() < most).then(|| {
            // Neither explains more than both.
            let gain = (baseline.counted() - fitted.counted()).max(0.0);
            let mut named = self.named.clone();
            named.iter_mut().for_each(|named| named.score.0 = named.score.0.min(gain));
            (fitted, named)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(name: &str, free: &[usize]) -> Piece {
        Piece::off(name, free, &[0, 1])
    }

    #[test]
    fn what_was_tried_beside_what_came_as_promised_is_not_tried_again() {
        let [falloff, drift] = ["inverse_square_falloff", "illumination_drift"];
        let named =
            |name| Named { name, ln_bayes: 9.0, score: (9.0, 1), rivals: Vec::new(), is_trusted: false };
        let promised = Promised {
            pieces: vec![piece(falloff, &[0]), piece(drift, &[0, 1, 2])],
            named: [falloff, drift].map(named).to_vec(),
        };
        let is_hopeless = |came: &[Piece], of_falloff: f64, of_drift: f64| {
            promised.is_hopeless(came, &|name| if name == drift { of_drift } else { of_falloff })
        };
        // By three numbers more, and three nats: three times what is promised must be 9.
        let came = [piece(falloff, &[0])];
        assert!(is_hopeless(&came, 1e9, 2.9) && !is_hopeless(&came, 1e9, 3.1));
        // In some recordings only, in another way, or with a shape of which it may have taken another one.
        let [came] = came;
        assert!(!is_hopeless(&[Piece { takes: vec![0], ..came }], 0.0, 0.0));
        assert!(!is_hopeless(&[piece("frame_gain", &[0])], 0.0, 0.0));
        assert!(!is_hopeless(&[piece(drift, &[0, 1, 2])], 0.0, 0.0));
        // What has a choice has no shape that it could have fitted.
        let scatter = Piece { takes: vec![0, 1], ..piece("lens_scatter", &[0]) };
        let promised = Promised { pieces: vec![scatter.clone(), piece(drift, &[0])], named: Vec::new() };
        assert!(promised.is_of_it(&[scatter]) && !promised.is_of_it(&[piece(drift, &[0])]));
        // Nothing came: both are still to be tried.
        assert!(!is_hopeless(&[], 5.0, 5.0));
    }
}
