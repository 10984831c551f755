//! The pixels' own numbers beside parameters that are known: each pixel goes by itself, and none to where it fits worse.

use super::gram::Gram;
use super::in_order::summed;
use super::noise::Noise;
use super::whiten::{tails, whiten};
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::columns::{Tangents, own_values, own_values_mut};
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::Pixels;
use nalgebra::DVector;
use std::sync::Arc;

/// Shares of its step that a pixel tries, until one leads it downhill: where light and response are far from those that were measured, a whole one may lead
/// anywhere, and of a pixel that is saturated in most frames every one does.
const SHARES: [f64; 3] = [1.0, 0.25, 0.0625];
/// A step that takes away a smaller share of what is left is the last one.
const SLOW: f64 = 0.01;

/// What pixels are judged by: recordings, effects as they are, noise, and the sets (number over all recordings) that count.
#[derive(Clone, Copy)]
struct Judges<'a> {
    data: &'a Data,
    pieces: &'a [Piece],
    noise: Noise,
    counts: &'a (dyn Fn(usize) -> bool + Sync),
}

impl Judges<'_> {
    /// Twice Huber's loss of each pixel, over the sets that count; no number where the model is none.
    fn losses(&self, pixels: &Arc<Pixels>) -> Vec<f64> {
        let (data, count) = (self.data, self.data.pixels());
        let (tangents, _) = Tangents::new(data, pixels, self.pieces, &[]);
        let with = |mut losses: Vec<f64>, take: usize, index: usize| {
            let base = tangents.base(take, index);
            let (roots, residuals) = whiten(data, take, index, &base, self.noise);
            let measured = &data.takes[take].signal_dn[index * count..(index + 1) * count];
            let tails = tails(measured, &base, &roots, &residuals);
            for ((loss, residual), tail) in losses.iter_mut().zip(&residuals).zip(tails) {
                *loss += residual * residual + tail;
            }
            losses
        };
        let join = |mut losses: Vec<f64>, others: Vec<f64>| {
            losses.iter_mut().zip(others).for_each(|(loss, other)| *loss += other);
            losses
        };
        summed(data, self.counts, &vec![0.0; count], with, join)
    }

    /// Gives each pixel its numbers `there`, if they fit no worse than those it has, whose loss is `losses`: that of what is taken is kept there. Whether all
    /// were taken.
    ///
    /// Where pixels see each other's light, what each of them does for itself may be worse together: nothing is taken then.
    fn take_better(&self, pixels: &mut Arc<Pixels>, losses: &mut Vec<f64>, there: &Arc<Pixels>) -> bool {
        let of_there = self.losses(there);
        let better = |(pixel, (loss, there)): (usize, (&f64, &f64))| {
            (*there <= *loss || !loss.is_finite() && there.is_finite()).then_some(pixel)
        };
        let better: Vec<usize> = losses.iter().zip(&of_there).enumerate().filter_map(better).collect();
        if better.len() == losses.len() {
            *pixels = Arc::clone(there);
            *losses = of_there;
            return true;
        }
        if better.is_empty() {
            return false;
        }
        let mut mixed = Pixels::clone(pixels);
        let mut own = own_values_mut(&mut mixed);
        for pixel in better {
            own.iter_mut().zip(own_values(there)).for_each(|(own, there)| own[pixel] = there[pixel]);
        }
        // A phase that all have in common goes with most of them, or stays where it is.
        let mut common = vec![there.at_frequencies.clone()];
        if there.at_frequencies != pixels.at_frequencies {
            common.push(pixels.at_frequencies.clone());
        }
        for at_frequencies in common {
            let mixed = Arc::new(Pixels { at_frequencies, ..mixed.clone() });
            let of_mixed = self.losses(&mixed);
            if total(&of_mixed) <= total(losses) {
                (*pixels, *losses) = (mixed, of_mixed);
                break;
            }
        }
        false
    }
}

/// How many losses are no numbers, and the sum of those that are.
fn total(losses: &[f64]) -> (usize, f64) {
    let numbers = losses.iter().filter(|loss| loss.is_finite());
    (losses.len() - numbers.clone().count(), numbers.sum())
}

/// The pixels with their own numbers as they fit best, but for what their tangents leave, beside `pieces` as they are: each begins where it fits best of
/// `pixels` and where it was `before`, and stays there where no share of its step leads it downhill.
pub fn settled(
    data: &Data,
    pixels: &Arc<Pixels>,
    before: Option<&Arc<Pixels>>,
    rounds: usize,
    pieces: &[Piece],
    noise: Noise,
    counts: &(dyn Fn(usize) -> bool + Sync),
) -> Arc<Pixels> {
    let known: Vec<Piece> = pieces.iter().map(|piece| Piece { free: Vec::new(), ..piece.clone() }).collect();
    let judges = Judges { data, pieces: &known, noise, counts };
    let mut here = Arc::clone(pixels);
    let mut losses = judges.losses(&here);
    if let Some(before) = before {
        judges.take_better(&mut here, &mut losses, before);
    }
    for _ in 0..rounds {
        let (tangents, _) = Tangents::new(data, &here, &known, &[]);
        let projected = Gram::of(data, &tangents, noise, counts).project(None);
        let (start, (no_numbers, sum)) = (Arc::clone(&here), total(&losses));
        for share in SHARES {
            let there = Arc::new(projected.moved(&start, &DVector::zeros(0), share));
            if judges.take_better(&mut here, &mut losses, &there) {
                break;
            }
        }
        if total(&losses) > (no_numbers, (1.0 - SLOW) * sum) {
            break;
        }
    }
    here
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// Of two places the better one, pixel by pixel; one that is none is no place to go.
    #[test]
    fn no_pixel_goes_where_it_fits_worse() {
        let size = Geometry { width: 16, height: 12 };
        let recordings = taken(size, 2, &[injection("encoder_offset:offset_m=0").unwrap()], &["four-rail"]);
        let data = Data::of(&recordings.unwrap(), Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let judges = Judges { data: &data, pieces: &[], noise, counts: &|_| true };
        let good = unfitted(&data, noise).pixels;
        let off = |first: usize, by_rad: f64| {
            let mut pixels = Pixels::clone(&good);
            pixels.phase_rad.iter_mut().skip(first).step_by(3).for_each(|phase_rad| *phase_rad += by_rad);
            Arc::new(pixels)
        };
        let is_good = |pixels: &Pixels| own_values(pixels) == own_values(&good);
        for by_rad in [0.5, f64::NAN] {
            let mut here = off(0, 0.5);
            let mut losses = judges.losses(&here);
            assert!(!judges.take_better(&mut here, &mut losses, &off(1, by_rad)), "{by_rad}: all were taken");
            assert!(is_good(&here) && losses == judges.losses(&good), "{by_rad}");
            // What is no number is left for what is one.
            let mut here = off(0, by_rad);
            let mut losses = judges.losses(&here);
            assert!(judges.take_better(&mut here, &mut losses, &good) && is_good(&here), "{by_rad}");
        }
        let [here, others] = [off(0, 0.5), off(1, 0.5)];
        let began = settled(&data, &here, Some(&others), 0, &[], noise, &|_| true);
        assert!(is_good(&began));
        // And from the wrong place downhill.
        let [before, after] = [here.clone(), settled(&data, &here, None, 8, &[], noise, &|_| true)]
            .map(|pixels| judges.losses(&pixels));
        assert!(after.iter().zip(&before).all(|(after, before)| after <= before));
        assert!(after.iter().sum::<f64>() < 0.5 * before.iter().sum::<f64>());
    }

    /// Light that scatters in the lens is everyone's: of pixels that are each better off for themselves, but only as long as all others go with them, some do
    /// not go. What is kept of the losses is that of where they are.
    #[test]
    fn pixels_that_see_each_others_light_are_judged_together() {
        let size = Geometry { width: 16, height: 12 };
        let scatter = injection("lens_scatter:share=0.3").unwrap();
        let recordings = taken(size, 2, std::slice::from_ref(&scatter), &["four-rail"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let piece = Piece { values: scatter.values, ..Piece::off(scatter.effect.name, &[0], &[0]) };
        let pieces = [piece];
        let judges = Judges { data: &data, pieces: &pieces, noise, counts: &|_| true };
        let good = settled(&data, &unfitted(&data, noise).pixels, None, 8, &pieces, noise, &|_| true);
        let scaled = |of: &dyn Fn(usize) -> f64| {
            let mut pixels = Pixels::clone(&good);
            pixels.amplitude_1m_dn.iter_mut().enumerate().for_each(|(pixel, value)| *value *= of(pixel));
            Arc::new(pixels)
        };
        // From all too bright to some much too dark, and the others as they should be.
        let mut here = scaled(&|_| 1.1);
        let mut losses = judges.losses(&here);
        let before = total(&losses);
        assert!(!judges.take_better(
            &mut here,
            &mut losses,
            &scaled(&|pixel| if pixel % 3 == 0 { 0.3 } else { 1.0 })
        ));
        assert_eq!(losses, judges.losses(&here));
        assert!(total(&losses) <= before);
    }
}
