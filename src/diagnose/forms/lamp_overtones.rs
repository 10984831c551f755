//! The overtone of a lamp that flickers: a filament has next to none, a discharge or a rectified supply has.

use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::naming::completed::clearly_better;
use crate::diagnose::periodic::lamps::FLICKER;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;
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
    // Frames may see twice the frequency as the frequency itself: both at once are anything then.
    let size = |piece: &Piece, number: usize| piece.values[number].hypot(piece.values[number + 1]);
    let is_overtone = |(with, without): (&Piece, &Piece)| {
        let (own, before) = (size(with, FUNDAMENTAL), size(without, FUNDAMENTAL));
        with.effect.name != FLICKER
            || size(with, OVERTONE) < own && own < MOST * before && before < MOST * own
    };
    let with = clearly_better(data, &fitted, pieces, noise)
        .filter(|with| with.pieces.iter().zip(&fitted.pieces).all(is_overtone));
    with.unwrap_or(fitted)
}
