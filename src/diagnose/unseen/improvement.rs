//! How surely what was not seen is predicted better.

use super::seen::{HALVES, Seen};
use std::ops::Range;

/// Blocks of the image, which noise makes differ by chance.
const BLOCKS: usize = 16;
/// Where few sets show what is predicted better, the improvement is about as much as its scatter from set to set, or somewhat more; from so much on pixels may
/// say that it is more.
const OF_FEW: f64 = 1.0;
/// These few: a share of all sets, and so many at least,
const FEW: (f64, usize) = (0.05, 3);
/// of which those that are better have this share of all squares of what sets gain. (Of what is normally distributed a twentieth has a quarter, on either side.)
const MOST: f64 = 0.9;

/// The improvement of the likelihood from `old` to `new`, set by set, over its scatter.
///
/// Frames of a set are not predicted independently, parts of the image are; what is off at random by frames (`has_jitters`) is not of a part. Blocks count where
/// there are few sets, halves of the image each; pixels where few of the sets show the improvement, all of them, as the brightest do of a well: the square of z is
/// about their number, however clearly each of them shows it.
pub fn z(old: &[Seen], new: &[Seen], are_few: bool, has_jitters: bool) -> f64 {
    let gains: Vec<f64> = old.iter().zip(new).map(|(old, new)| old.unlikely - new.unlikely).collect();
    let of_blocks = || {
        let of = |(old, new): (&Seen, &Seen)| -> Vec<f64> {
            let blocks = BLOCKS * new.fold / HALVES..BLOCKS * (new.fold + 1) / HALVES;
            let pixels = |block: usize| {
                let at = |block: usize| block * new.of_pixels.len() / BLOCKS;
                gain(old, new, at(block)..at(block + 1)).sum()
            };
            blocks.map(pixels).collect()
        };
        over_scatter(&old.iter().zip(new).flat_map(of).collect::<Vec<_>>())
    };
    let of_pixels = || {
        let of = |(old, new)| gain(old, new, 0..new.of_pixels.len());
        over_scatter(&old.iter().zip(new).flat_map(of).collect::<Vec<_>>())
    };
    match (are_few, has_jitters) {
        (_, true) => over_scatter(&gains),
        (true, false) => of_blocks(),
        (false, false) => {
            let z = over_scatter(&gains);
            if z > OF_FEW && are_of_few(gains) { z.max(of_pixels()) } else { z }
        }
    }
}

/// By how much each of these pixels of a set is likelier.
fn gain<'a>(old: &'a Seen, new: &'a Seen, pixels: Range<usize>) -> impl Iterator<Item = f64> + 'a {
    pixels.map(|pixel| old.of_pixels[pixel] - new.of_pixels[pixel])
}

/// Whether a few sets have nearly all of these gains, and are better, and more than one or two.
fn are_of_few(mut gains: Vec<f64>) -> bool {
    let all: f64 = gains.iter().map(|gain| gain * gain).sum();
    gains.sort_unstable_by(|a, b| b.abs().total_cmp(&a.abs()));
    let few = ((FEW.0 * gains.len() as f64) as usize).max(FEW.1);
    let better: Vec<f64> = gains.into_iter().take(few).filter(|gain| *gain > 0.0).collect();
    better.len() >= FEW.1 && better.iter().map(|gain| gain * gain).sum::<f64>() > MOST * all
}

/// The mean over its standard deviation.
fn over_scatter(differences: &[f64]) -> f64 {
    let count = differences.len().max(1) as f64;
    let mean = differences.iter().sum::<f64>() / count;
    let scatter = (differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / count).sqrt();
    if scatter > 0.0 { mean / scatter * count.sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIXELS: usize = 48;

    /// Of a hundred sets, of each of which the improvement of any pixel is given.
    fn z_of(improvement: impl Fn(usize) -> f64, has_jitters: bool) -> f64 {
        let set = |improvement: f64| Seen {
            of_pixels: vec![improvement; PIXELS],
            unlikely: PIXELS as f64 * improvement,
            ..Seen::default()
        };
        let old: Vec<Seen> = (0..100).map(|number| set(improvement(number))).collect();
        z(&old, &vec![set(0.0); 100], false, has_jitters)
    }

    /// Four sets of a hundred that are alike are worth the root of four; their pixels tell more, where these may.
    #[test]
    fn few_sets_count_by_their_pixels() {
        let of_few = |number| if number < 4 { 10.0 } else { 0.0 };
        let of_sets = z_of(of_few, true);
        assert!((of_sets - 2.04).abs() < 0.01, "{of_sets}");
        let of_pixels = z_of(of_few, false);
        assert!((of_pixels - of_sets * (PIXELS as f64).sqrt()).abs() < 1e-9, "{of_pixels}");
    }

    /// Pixels of a set may be off together: what all sets have, one alone, or some that are as often worse, is no surer by them.
    #[test]
    fn what_sets_have_in_common_is_none_of_pixels() {
        let draws = crate::physics::Draws::of(7, 1).normal(100);
        let ways: [&dyn Fn(usize) -> f64; 3] =
            [&|number| draws[number] + 0.15, &|number| if number == 0 { 12.0 } else { 0.0 }, &|number| {
                if number < 6 { [9.0, 8.0, -5.0][number % 3] } else { 0.0 }
            }];
        for (number, way) in ways.into_iter().enumerate() {
            let (of_sets, all) = (z_of(way, true), z_of(way, false));
            assert!(all == of_sets && of_sets > OF_FEW, "{number}: {all}, {of_sets}");
        }
    }
}
