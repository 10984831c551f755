//! Fits of several effects of which one is to be chosen: what a part of the sets speaks against clearly is not fitted to all.

use super::data::Data;
use super::fit::{Fit, fit};
use super::gram::Noise;
use super::pass::DISBELIEF;
use super::pieces::{Piece, tolerance};

/// One set in so many of each recording is looked at first: no multiple of how often positions are repeated, as a rule.
const PART: usize = 7;
/// So many samples at least: fewer are fitted in no time.
const LEAST_SAMPLES: usize = 50_000;
/// What the best one explains of the part, but for what its form may leave, must be more by this chi squared: a part does not say
/// exactly what all sets say.
const CLEARLY_LESS: f64 = 100.0;
/// What numbers explain by chance, in standard deviations, at most.
const BY_CHANCE: f64 = 3.0;

/// One of several: what it is known by, its effect, and all pieces of a fit with it.
pub struct Entrant {
    /// Number of its block.
    pub block: usize,
    /// Its effect's name.
    pub name: &'static str,
    /// Pieces of the fit.
    pub pieces: Vec<Piece>,
}

/// Those of the `entrants` that may explain about as much of what `current` leaves as the best one. The first, the best by its tangents,
/// stays.
pub fn hopeful(data: &Data, current: &Fit, entrants: Vec<Entrant>, noise: Noise) -> Vec<Entrant> {
    if entrants.len() < 2 || current.samples / PART < LEAST_SAMPLES {
        return entrants;
    }
    let sets = data.sets();
    let left = |pieces: &[Piece]| {
        let fit = fit(data, Some(current), pieces.to_vec(), noise, &|set| sets[set].1.is_multiple_of(PART));
        (fit.chi2 + fit.unreached, fit.columns.len())
    };
    let (before, fitted) = left(&current.pieces);
    // What it explains, and of that what is no chance.
    let explained = |entrant: &Entrant| {
        let (left, numbers) = left(&entrant.pieces);
        let numbers = numbers.saturating_sub(fitted) as f64;
        let explained = before - left;
        (explained, explained - numbers - BY_CHANCE * (2.0 * numbers).sqrt())
    };
    let explained: Vec<(f64, f64)> = entrants.iter().map(explained).collect();
    let numbers = entrants.iter().zip(&explained).filter(|(_, explained)| explained.1.is_finite());
    let best = numbers.max_by(|a, b| a.1.1.total_cmp(&b.1.1));
    let (of_best, most) = best.map_or((0.0, 0.0), |(best, explained)| (tolerance(best.name), explained.1));
    let is_hopeful = |entrant: &Entrant, explained: f64| {
        let form = DISBELIEF * tolerance(entrant.name).max(of_best);
        explained > (1.0 - form) * most - CLEARLY_LESS
    };
    let with_explained = entrants.into_iter().zip(explained).enumerate();
    let stay = with_explained.filter(|(number, (entrant, e))| *number == 0 || is_hopeful(entrant, e.0));
    stay.map(|(_, (entrant, _))| entrant).collect()
}
