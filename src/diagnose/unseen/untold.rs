//! What the sets that a fit has seen do not tell of a series of numbers, as those of the phase steps are.

use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::gram::Gram;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::columns::{Column, Tangents};
use crate::diagnose::tangents::pieces::Piece;

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
        // What no set tells has no part in it.
        let known = numbers.into_iter().filter(|&(place, _)| all[place] > 0.0);
        let (told, untold): (Vec<_>, Vec<_>) = known.partition(|&(place, _)| here[place] > TOLD * all[place]);
        let common =
            told.iter().map(|&(_, parameter)| values[parameter]).sum::<f64>() / told.len().max(1) as f64;
        untold.into_iter().for_each(|(_, parameter)| values[parameter] = common);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::fitting::fit::fit;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// Sets of four frames have no fifth step, of which they say what the others have in common; what they do tell stays, and what nobody tells.
    #[test]
    fn what_sets_do_not_use_is_what_the_rest_have_in_common() {
        let size = Geometry { width: 8, height: 6 };
        let recordings = taken(size, 3, &[], &["four-rail", "wdft-rail"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let piece = Piece::off("phase_step_errors", &[0, 1, 2, 3, 4, 5, 6], &[0, 1]);
        let of = fit(&data, Some(&unfitted(&data, noise)), vec![piece], noise, &|_| true);
        let values = [1e-3, 2e-3, 4e-3, 5e-3, 0.1, 0.2, 0.3];
        let left = |counts: &(dyn Fn(usize) -> bool + Sync)| {
            let mut pieces = of.pieces.clone();
            pieces[0].values[..values.len()].copy_from_slice(&values);
            untold(&data, &of, &mut pieces, noise, counts);
            pieces[0].values[..values.len()].to_vec()
        };
        assert_eq!(left(&|_| true), values);
        let sets = data.sets();
        let of_four = left(&|set| sets[set].0 == 0);
        assert!((of_four[4] - 3e-3).abs() < 1e-12, "{of_four:?}");
        assert_eq!([&of_four[..4], &of_four[5..]].concat(), [&values[..4], &values[5..]].concat());
    }
}
