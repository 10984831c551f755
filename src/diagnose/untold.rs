//! What the sets that a fit has seen do not tell of a series of numbers, as those of the phase steps are.

use super::columns::{Column, Tangents};
use super::data::Data;
use super::fit::Fit;
use super::gram::Gram;
use super::noise::Noise;
use super::pieces::Piece;

/// A series has so many numbers at least.
const SERIES: usize = 5;
/// Sets that have less of all that is known of a number do not tell it.
const TOLD: f64 = 0.05;

/// Sets that do not use a phase step say nothing of its error, or, where a charge stays from the frame before, next to nothing. What those that count do not tell
/// of a series of numbers, of the `pieces` that were fitted to them, is what they have in common: it cannot be told from the pixels' own phases and amplitudes.
pub fn untold(
    data: &Data,
    of: &Fit,
    pieces: &mut [Piece],
    noise: Noise,
    counts: &(dyn Fn(usize) -> bool + Sync),
) {
    let numbers = |number: usize| -> Vec<(usize, usize)> {
        let is_number = |column: &Column| {
            column.piece == number && !of.pieces[number].effect.parameters[column.parameter].is_shape()
        };
        let places = of.columns.iter().enumerate().filter(|(_, column)| is_number(column));
        places.map(|(place, column)| (place, column.parameter)).collect()
    };
    let series: Vec<_> =
        (0..of.pieces.len()).map(|n| (n, numbers(n))).filter(|s| s.1.len() >= SERIES).collect();
    if series.is_empty() {
        return;
    }
    let (tangents, _) = Tangents::new(data, &of.pixels, &of.pieces, &[]);
    let known =
        |counts: &(dyn Fn(usize) -> bool + Sync)| Gram::of(data, &tangents, noise, counts).project(None).raw;
    let (here, all) = (known(counts), known(&|_| true));
    for (number, numbers) in series {
        let values = &mut pieces[number].values;
        let (told, untold): (Vec<_>, Vec<_>) =
            numbers.into_iter().partition(|&(place, _)| here[place] > TOLD * all[place]);
        let common =
            told.iter().map(|&(_, parameter)| values[parameter]).sum::<f64>() / told.len().max(1) as f64;
        untold.into_iter().for_each(|(_, parameter)| values[parameter] = common);
    }
}
