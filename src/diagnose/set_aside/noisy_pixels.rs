//! Pixels that have far more noise of their own than others (hot ones, and ones that flicker: random telegraph noise), or far less (dead ones, which
//! would speak for all of their column as if they saw as much as others).

use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::in_order::joined;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::fitting::whiten::whiten;
use crate::diagnose::reading::data::Data;
use crate::diagnose::reading::places::APART_M;
use crate::diagnose::statistics::median::median;
use crate::diagnose::tangents::columns::Tangents;

/// What a pixel's residual changes by from a set to the same one again has so many times the variance of the usual pixel's.
const NOISIER: f64 = 4.0;
/// The same of a dead one.
const QUIETER: f64 = 0.25;
/// The usual pixel's is noise alone: so many times that at most. What is left out of the simulation may change faster, and bright pixels show more of it.
const USUAL: f64 = 1.5;
/// More than this share of all pixels, and more than one, is no fault of theirs.
const FEW: f64 = 0.02;
/// Of so many changes at least.
const LEAST: usize = 40;
/// So many pairs of sets are looked at one after the other.
const TOGETHER: usize = 8;

/// The pixels whose noise is far above that of others, or far below, in order; none of either where they are many, or where no set was taken again. `fit` says what
/// their signal is.
///
/// Physics that is left out is the same in a set that is taken again at the same place, and goes from a difference of the two; noise does not.
pub fn noisy_pixels(data: &Data, fit: &Fit, noise: Noise) -> Vec<usize> {
    let (tangents, _) = Tangents::new(data, &fit.pixels, &fit.pieces, &[]);
    let pixels = data.pixels();
    let sets = data.sets();
    let is_again = |pair: &&[(usize, usize)]| {
        let [one, other] = [0, 1].map(|n| {
            let (take, set) = pair[n];
            (take, &data.takes[take].moments[set * data.takes[take].frames])
        });
        one.0 == other.0
            && one.1.velocity_m_s == other.1.velocity_m_s
            && one.1.offset_rad == other.1.offset_rad
            && (one.1.place_m - other.1.place_m).abs() < APART_M
    };
    let again: Vec<&[(usize, usize)]> = sets.windows(2).filter(is_again).collect();
    let changes = |pairs: &[&[(usize, usize)]]| {
        let mut sums = vec![(0.0, 0_usize); pixels];
        for pair in pairs {
            let frames = data.takes[pair[0].0].frames;
            for frame in 0..frames {
                let [one, other] = [0, 1].map(|n| {
                    let (take, set) = pair[n];
                    let index = set * frames + frame;
                    whiten(data, take, index, &tangents.base(take, index), noise)
                });
                let residuals = one.1.iter().zip(&other.1);
                let counts = one.0.iter().zip(&other.0).map(|(one, other)| *one > 0.0 && *other > 0.0);
                for ((sum, (one, other)), _) in sums.iter_mut().zip(residuals).zip(counts).filter(|of| of.1) {
                    *sum = (sum.0 + 0.5 * (one - other) * (one - other), sum.1 + 1);
                }
            }
        }
        sums
    };
    let join = |mut all: Vec<(f64, usize)>, more: Vec<(f64, usize)>| {
        all.iter_mut().zip(more).for_each(|(all, more)| *all = (all.0 + more.0, all.1 + more.1));
        all
    };
    let Some(sums) = joined(&again, TOGETHER, changes, join) else { return Vec::new() };
    let variance = |&(square, count): &(f64, usize)| (count >= LEAST).then(|| square / count as f64);
    let usual = median(&mut sums.iter().filter_map(variance).collect::<Vec<f64>>());
    if usual > USUAL {
        return Vec::new();
    }
    let most = (FEW * pixels as f64).max(1.0);
    let few = |is_off: &dyn Fn(f64) -> bool| {
        let off = (0..pixels).filter(|&pixel| variance(&sums[pixel]).is_some_and(is_off));
        let off: Vec<usize> = off.collect();
        if off.len() as f64 > most { Vec::new() } else { off }
    };
    let mut off = [few(&|own| own > NOISIER * usual), few(&|own| own < QUIETER * usual)].concat();
    off.sort_unstable();
    off
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;
    use crate::physics::Draws;

    /// The pixels that are noisy in recordings with an `effect`, of which these have so many DN of noise more; or, where that is none, no noise at all.
    fn noisy(effect: &str, recordings: &[&str], pixels: &[(usize, f64)]) -> Vec<usize> {
        let size = Geometry { width: 16, height: 12 };
        let effects = [injection(effect).unwrap()];
        let mut data = Data::of(&taken(size, 2, &effects, recordings).unwrap(), Vec::new()).unwrap();
        for (take, recording) in data.takes.iter_mut().enumerate() {
            for &(pixel, noise_dn) in pixels {
                let frames = recording.signal_dn.chunks_exact_mut(size.pixels());
                let deviates = Draws::of(pixel as u64, take as u64).normal(recording.moments.len());
                frames.zip(deviates).for_each(|(frame, deviate)| match noise_dn {
                    0.0 => frame[pixel] = 1.0,
                    _ => frame[pixel] += (noise_dn * deviate) as f32,
                });
            }
        }
        let noise = stated_noise(&data);
        noisy_pixels(&data, &unfitted(&data, noise), noise)
    }

    #[test]
    fn hot_pixels_are_told_from_quiet_ones_whatever_is_left_out() {
        let all = ["four-rail", "four-motion"];
        for effect in ["lens_scatter:share=0", "mixed_pixels", "intensity_nonlinearity", "encoder_cyclic"] {
            assert_eq!(noisy(effect, &all, &[]), [0; 0], "{effect}");
            assert_eq!(noisy(effect, &all, &[(37, 60.0), (90, 30.0)]), [37, 90], "{effect}");
        }
        // A dead one says nothing either, whether others are hot or not.
        assert_eq!(noisy("encoder_cyclic", &all, &[(37, 60.0), (90, 0.0), (20, 0.0)]), [20, 37, 90]);
        // Many are no fault of theirs, and without a set that was taken again nothing is known.
        let many: Vec<(usize, f64)> = (40..46).map(|pixel| (pixel, 60.0)).collect();
        assert_eq!(noisy("lens_scatter:share=0", &all, &many), [0; 0]);
        assert_eq!(noisy("lens_scatter:share=0", &["four-motion"], &[(37, 60.0)]), [0; 0]);
    }
}
