//! The pixels' own numbers beside parameters that are known: each pixel goes by itself, and none to where it fits worse.

use super::columns::{Tangents, own_values, own_values_mut};
use super::data::Data;
use super::gram::Gram;
use super::in_order::summed;
use super::noise::Noise;
use super::pieces::Piece;
use super::whiten::{tails, whiten};
use crate::physics::Pixels;
use nalgebra::{DVector, Vector4};
use std::sync::Arc;

/// Shares of its step that a pixel tries, until one leads it downhill: where light and response are far from those that were measured, a whole one may lead
/// anywhere, and of a pixel that is saturated in most frames every one does.
const SHARES: [f64; 3] = [1.0, 0.25, 0.0625];
/// A step that takes away a smaller share of what is left is the last one.
const SLOW: f64 = 0.01;

/// What the model stands on: recordings, effects as they are, noise, and the sets (number over all recordings) that count.
#[derive(Clone, Copy)]
struct Bench<'a> {
    data: &'a Data,
    pieces: &'a [Piece],
    noise: Noise,
    counts: &'a (dyn Fn(usize) -> bool + Sync),
}

impl Bench<'_> {
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

    /// Of each pixel the numbers `there`, where they fit no worse than those it has, whose loss is `losses`; that of what is taken is kept there. Whether
    /// all were taken.
    fn better(&self, pixels: &mut Arc<Pixels>, losses: &mut [f64], there: &Arc<Pixels>) -> bool {
        let of_there = self.losses(there);
        let better = |(pixel, (loss, there)): (usize, (&f64, &f64))| {
            (*there <= *loss || !loss.is_finite() && there.is_finite()).then_some(pixel)
        };
        let better: Vec<usize> = losses.iter().zip(&of_there).enumerate().filter_map(better).collect();
        if better.len() == losses.len() {
            *pixels = Arc::clone(there);
            losses.copy_from_slice(&of_there);
            return true;
        }
        let mut own = own_values_mut(Arc::make_mut(pixels));
        for pixel in better {
            losses[pixel] = of_there[pixel];
            own.iter_mut().zip(own_values(there)).for_each(|(own, there)| own[pixel] = there[pixel]);
        }
        false
    }
}

/// The pixels with their own numbers as they fit best, but for what their tangents leave, beside `pieces` as they are: each begins where it fits best of
/// `pixels` and `others`, and stays there where no share of its step leads it downhill.
pub fn settled(
    data: &Data,
    pixels: &Arc<Pixels>,
    others: Option<&Arc<Pixels>>,
    rounds: usize,
    pieces: &[Piece],
    noise: Noise,
    counts: &(dyn Fn(usize) -> bool + Sync),
) -> Arc<Pixels> {
    let known: Vec<Piece> = pieces.iter().map(|piece| Piece { free: Vec::new(), ..piece.clone() }).collect();
    let bench = Bench { data, pieces: &known, noise, counts };
    let mut here = Arc::clone(pixels);
    let mut losses = bench.losses(&here);
    if let Some(others) = others {
        bench.better(&mut here, &mut losses, others);
    }
    for _ in 0..rounds {
        let (tangents, _) = Tangents::new(data, &here, &known, &[]);
        let step = Gram::of(data, &tangents, noise, counts).project(None).own(&DVector::zeros(0));
        let (start, before) = (Arc::clone(&here), losses.iter().sum::<f64>());
        for share in SHARES {
            if bench.better(&mut here, &mut losses, &Arc::new(moved(&start, &step, share))) {
                break;
            }
        }
        if losses.iter().sum::<f64>() > (1.0 - SLOW) * before {
            break;
        }
    }
    here
}

/// The pixels with their own numbers moved by a `share` of a step.
pub fn moved(pixels: &Pixels, own: &[Vector4<f64>], share: f64) -> Pixels {
    let mut moved = pixels.clone();
    for (number, values) in own_values_mut(&mut moved).into_iter().enumerate() {
        values.iter_mut().zip(own).for_each(|(value, step)| *value += share * step[number]);
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fit::unfitted;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// Of two places the better one, pixel by pixel; one that is none is no place to go.
    #[test]
    fn no_pixel_goes_where_it_fits_worse() {
        let size = Geometry { width: 16, height: 12 };
        let recordings = taken(size, 2, &[injection("encoder_offset:offset_m=0").unwrap()], &["four-rail"]);
        let data = Data::of(&recordings.unwrap(), Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let bench = Bench { data: &data, pieces: &[], noise, counts: &|_| true };
        let good = unfitted(&data, noise).pixels;
        let off = |first: usize, by_rad: f64| {
            let mut pixels = Pixels::clone(&good);
            pixels.phase_rad.iter_mut().skip(first).step_by(3).for_each(|phase_rad| *phase_rad += by_rad);
            Arc::new(pixels)
        };
        let is_good = |pixels: &Pixels| own_values(pixels) == own_values(&good);
        for by_rad in [0.5, f64::NAN] {
            let mut here = off(0, 0.5);
            let mut losses = bench.losses(&here);
            assert!(!bench.better(&mut here, &mut losses, &off(1, by_rad)), "{by_rad}: all were taken");
            assert!(is_good(&here) && losses == bench.losses(&good), "{by_rad}");
            // What is no number is left for what is one.
            let mut here = off(0, by_rad);
            let mut losses = bench.losses(&here);
            assert!(bench.better(&mut here, &mut losses, &good) && is_good(&here), "{by_rad}");
        }
        let [here, others] = [off(0, 0.5), off(1, 0.5)];
        let began = settled(&data, &here, Some(&others), 0, &[], noise, &|_| true);
        assert!(is_good(&began));
        // And from the wrong place downhill.
        let [before, after] = [here.clone(), settled(&data, &here, None, 8, &[], noise, &|_| true)]
            .map(|pixels| bench.losses(&pixels));
        assert!(after.iter().zip(&before).all(|(after, before)| after <= before));
        assert!(after.iter().sum::<f64>() < 0.5 * before.iter().sum::<f64>());
    }
}
