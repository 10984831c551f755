//! What was named, and is not needed beside what came after it.

use super::completed::NEEDED_NATS;
use super::data::Data;
use super::fit::{Fit, fit_below};
use super::noise::Noise;
use super::pieces::Piece;
use super::search::Named;

/// Takes out of `current`, and of what is `named`, what is not needed beside the others, the least needed first.
pub fn drop_needless(data: &Data, noise: Noise, current: &mut Fit, named: &mut Vec<Named>) {
    while named.len() > 1 {
        let without = |number: usize| {
            let name = named[number].name;
            let pieces: Vec<Piece> =
                current.pieces.iter().filter(|piece| piece.effect.name != name).cloned().collect();
            let numbers = named[number].score.1 as f64;
            // Of numbers that the fit may have, all.
            let shapes = |piece: &Piece| piece.effect.parameters.iter().filter(|row| row.is_shape()).count();
            let fitted: usize = pieces.iter().map(|piece| piece.free.len() + shapes(piece)).sum();
            let most = 0.5 * current.chi2 + NEEDED_NATS + numbers + fitted as f64;
            let left = fit_below(data, current, pieces, noise, most);
            let needed = 0.5 * (left.left() - current.chi2) - numbers;
            (number, needed, left)
        };
        // Of two that are needed as little, the later one.
        let least = (0..named.len()).rev().map(without).min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((number, _, left)) = least.filter(|least| least.1 < NEEDED_NATS) else { return };
        *current = left;
        named.remove(number);
    }
}
