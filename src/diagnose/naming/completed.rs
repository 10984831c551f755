//! An effect that says with few numbers what it may say with more in another way: far from the baseline it needs them all, or what it cannot say alone is
//! another effect's.

use super::pass::DISBELIEF;
use super::tolerated::tolerance;
use crate::diagnose::fitting::bounds::is_bounded;
use crate::diagnose::fitting::finished::finished;
use crate::diagnose::fitting::fit::{Fit, fit, fit_below};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;

/// How often a fit is begun anew where the first one was.
const COMPLETING: usize = 4;
/// An effect without which chi squared, halved, rises by less than this and one more for each of its numbers was not needed.
pub const NEEDED_NATS: f64 = 6.0;

/// The fit of `pieces` in the place of what is `fitted`, if that is clearly better, and at no bound.
pub fn clearly_better(data: &Data, fitted: &Fit, pieces: Vec<Piece>, noise: Noise) -> Option<Fit> {
    let most = fitted.cost() - NEEDED_NATS;
    let with = fit_below(data, fitted, pieces, noise, most);
    (with.cost() < most).then(|| finished(data, with, noise)).filter(|with| !is_bounded(with))
}

/// A fit in which an effect has all of its numbers.
#[derive(Debug, Clone)]
pub struct Completed {
    /// The effect.
    pub name: &'static str,
    /// The fit.
    pub fit: Fit,
}

impl Completed {
    /// The fit with the numbers of both forms of what `fitted` says in one of them, if there is such an effect and they are needed.
    pub fn of(data: &Data, fitted: &Fit, noise: Noise) -> Option<Self> {
        let mut pieces = fitted.pieces.clone();
        for piece in pieces.iter_mut().filter(|piece| piece.may_be_of_both_forms()) {
            let parameters = piece.effect.parameters;
            piece.free = (0..parameters.len()).filter(|&number| !parameters[number].is_choice).collect();
        }
        let more = |(with, without): (&Piece, &Piece)| with.free.len() - without.free.len();
        let name = pieces
            .iter()
            .zip(&fitted.pieces)
            .find(|&pair| more(pair) > 0)
            .map(|(piece, _)| piece.effect.name)?;
        let more: usize = pieces.iter().zip(&fitted.pieces).map(more).sum();
        // Numbers that say nearly the same come to their end slowly.
        let further = |from: Fit, _| fit(data, Some(&from), from.pieces.clone(), noise, &|_| true);
        let fit = (1..COMPLETING).fold(fit(data, Some(fitted), pieces, noise, &|_| true), further);
        let gain = 0.5 * (fitted.chi2 - fit.chi2);
        // With numbers enough one bends to what is not its own, as far as it may.
        (gain > NEEDED_NATS + more as f64 && !is_bounded(&fit)).then_some(Self { name, fit })
    }

    /// Whether `other` says what this one does of what `before` leaves, but for what the effect's form may leave before it is not believed, with no more
    /// numbers: no response is exactly a power or a cubic, and with numbers enough one bends to what is not its own.
    pub fn is_said_by(&self, other: &Fit, before: &Fit) -> bool {
        let explained = |fit: &Fit| before.counted() - fit.counted();
        let least = (1.0 - DISBELIEF * tolerance(self.name)) * explained(&self.fit);
        other.columns.len() <= self.fit.columns.len() && explained(other) >= least
    }
}
