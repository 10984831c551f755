//! The overtone of a lamp that flickers: a filament has next to none, a discharge or a rectified supply has.

use super::bounds::is_bounded;
use super::completed::NEEDED_NATS;
use super::data::Data;
use super::finished::finished;
use super::fit::{Fit, fit_below};
use super::lamps::FLICKER;
use super::noise::Noise;
use super::pieces::Piece;
use crate::physics::effects::ambient_flicker::OVERTONE;

/// Number of the fundamental's cosine; its sine comes after it.
const FUNDAMENTAL: usize = 0;
/// By an overtone the fundamental does not become so many times larger, nor smaller.
const MOST: f64 = 1.5;

/// What is `fitted`, and twice the frequency of a flicker that is in it, where that fits clearly better.
pub fn with_overtone(data: &Data, fitted: Fit, noise: Noise) -> Fit {
    let is_bare = |free: &[usize]| !free.contains(&OVERTONE);
    let mut pieces = fitted.pieces.clone();
    let lamps = pieces.iter_mut().filter(|piece| piece.effect.name == FLICKER && is_bare(&piece.free));
    let count = lamps.map(|lamp| lamp.free.extend([OVERTONE, OVERTONE + 1])).count();
    if count == 0 {
        return fitted;
    }
    let most = fitted.cost() - NEEDED_NATS;
    let with = finished(data, fit_below(data, &fitted, pieces, noise, most), noise);
    // Frames may see twice the frequency as the frequency itself: both at once are anything then.
    let size = |piece: &Piece, number: usize| piece.values[number].hypot(piece.values[number + 1]);
    let mut pairs = with.pieces.iter().zip(&fitted.pieces).filter(|(piece, _)| piece.effect.name == FLICKER);
    let is_overtone = pairs.all(|(with, without)| {
        let (own, before) = (size(with, FUNDAMENTAL), size(without, FUNDAMENTAL));
        size(with, OVERTONE) < own && own < MOST * before && before < MOST * own
    });
    if with.cost() < most && is_overtone && !is_bounded(&with) { with } else { fitted }
}
