//! The fit on sets that it has not seen.
//!
//! Groups of four neighbouring sets are dealt to two folds; each fold is predicted by a model whose pixels and parameters are fitted to
//! the other one. Of a few sets, every other frame of either half of the image is predicted: by parameters that are fitted to the
//! other half, and pixels that are fitted to the frames between.

use super::columns::Tangents;
use super::data::{Data, Take};
use super::fit::{Fit, improved};
use super::gram::{Noise, whiten};
use super::pieces::Piece;
use crate::spec::SCHEMES;
use crate::units::phase_rad;
use num_complex::Complex64;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Agreement of a prediction with the recordings.
#[derive(Debug, Clone, Copy, Default)]
pub struct Agreement {
    /// Chi squared a sample.
    pub chi2_per_dof: f64,
    /// Root mean square of the difference of raw frames, DN.
    pub rms_dn: f64,
    /// The same of each frame's mean difference, DN.
    pub frame_mean_rms_dn: f64,
    /// The same of the distance that a set shows, its pixels' mean, m: four frames, WDFT and whatever else was recorded together.
    pub distance_rms_m: f64,
}

/// Both predictions.
#[derive(Debug, Clone)]
pub struct HeldOut {
    /// By the simulation that the camera describes.
    pub before: Agreement,
    /// With the effects that were found.
    pub after: Agreement,
    /// Each scheme's frames a set, and the distance's RMS before and after, m.
    pub by_frames: Vec<(usize, f64, f64)>,
    /// The improvement of chi squared over its scatter from set to set.
    pub z: f64,
    /// Sets that were predicted.
    pub sets: usize,
}

/// Neighbouring sets that are held out together.
const GROUP: usize = 4;
const FOLDS: usize = 2;

/// What a set shows.
#[derive(Debug, Clone, Copy, Default)]
struct Seen {
    /// Its recording.
    take: usize,
    chi2: f64,
    samples: usize,
    /// Squared difference of all samples, DN².
    square_dn2: f64,
    /// Squares of the frames' mean differences, DN², and frames.
    means_dn2: f64,
    frames: usize,
    /// Error of the distance, m; not a number where there is none.
    distance_m: f64,
}

/// Predicts every set of `data` by `before` and by `after`, neither of which has seen it.
pub fn held_out(data: &Data, before: &Fit, after: &Fit, noise: Noise) -> HeldOut {
    let is_few = data.sets().len() < FOLDS * GROUP;
    let predict = |fit: &Fit| -> Vec<Seen> {
        let parts = (0..if is_few { PARTS } else { FOLDS }).flat_map(|part| match is_few {
            true => predicted_frames(data, fit, noise, part),
            false => predicted(data, fit, noise, part),
        });
        // In the order of the sets.
        parts.collect::<BTreeMap<usize, Seen>>().into_values().collect()
    };
    let old = predict(before);
    let new = if after.pieces.is_empty() { old.clone() } else { predict(after) };
    let differences: Vec<f64> = old.iter().zip(&new).map(|(old, new)| old.chi2 - new.chi2).collect();
    let count = differences.len().max(1) as f64;
    let mean = differences.iter().sum::<f64>() / count;
    let scatter = (differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / count).sqrt();
    let by_frames = data.schemes().into_iter().map(|frames| {
        let of = |seen: &[Seen]| {
            let of: Vec<Seen> =
                seen.iter().filter(|seen| data.takes[seen.take].frames == frames).copied().collect();
            agreement(&of).distance_rms_m
        };
        (frames, of(&old), of(&new))
    });
    HeldOut {
        before: agreement(&old),
        after: agreement(&new),
        by_frames: by_frames.collect(),
        z: if scatter > 0.0 { mean / scatter * count.sqrt() } else { 0.0 },
        sets: if is_few { data.sets().len() } else { old.len() },
    }
}

fn agreement(sets: &[Seen]) -> Agreement {
    let samples = sets.iter().map(|set| set.samples).sum::<usize>().max(1) as f64;
    let frames = sets.iter().map(|set| set.frames).sum::<usize>().max(1) as f64;
    let distances: Vec<f64> =
        sets.iter().map(|set| set.distance_m).filter(|distance| distance.is_finite()).collect();
    Agreement {
        chi2_per_dof: sets.iter().map(|set| set.chi2).sum::<f64>() / samples,
        rms_dn: (sets.iter().map(|set| set.square_dn2).sum::<f64>() / samples).sqrt(),
        frame_mean_rms_dn: (sets.iter().map(|set| set.means_dn2).sum::<f64>() / frames).sqrt(),
        distance_rms_m: (distances.iter().map(|d| d * d).sum::<f64>() / distances.len().max(1) as f64).sqrt(),
    }
}

/// Halves of the image times every other frame.
const PARTS: usize = 4;

/// A half of the image in every other frame: `(a number of its own for each set, what it shows)`.
fn predicted_frames(data: &Data, fit: &Fit, noise: Noise, part: usize) -> Vec<(usize, Seen)> {
    let (half, odd) = (part / 2, part % 2);
    let half_of = |pixel: usize| 2 * pixel / data.pixels().max(1);
    let elsewhere = data.only(|_, pixel| half_of(pixel) != half);
    let (_, learned) = improved(&elsewhere, fit, noise, &|_| true);
    let pieces = learned.into_iter().map(|piece| Piece { free: Vec::new(), ..piece }).collect();
    let fixed = Fit { pieces, ..fit.clone() };
    let between = data.only(|frame, pixel| half_of(pixel) == half && frame % 2 != odd);
    let (pixels, pieces) = improved(&between, &fixed, noise, &|_| true);
    let held = data.only(|frame, pixel| half_of(pixel) == half && frame % 2 == odd);
    let (tangents, _) = Tangents::new(&held, &pixels, &pieces, &[]);
    let sets = data.sets().into_iter().enumerate();
    let of_set = |(number, (take, set))| {
        let seen = seen(&held, &tangents, noise, take, set)?;
        // Half of the frames have no distance.
        Some((PARTS * number + part, Seen { distance_m: f64::NAN, ..seen }))
    };
    sets.filter_map(of_set).collect()
}

/// The sets of a fold, by number, seen by a model that was fitted to the others.
fn predicted(data: &Data, fit: &Fit, noise: Noise, fold: usize) -> Vec<(usize, Seen)> {
    let is_held = |set: usize| set / GROUP % FOLDS == fold;
    let (pixels, pieces) = improved(data, fit, noise, &|set| !is_held(set));
    let (tangents, _) = Tangents::new(data, &pixels, &pieces, &[]);
    let sets = data.sets().into_par_iter().enumerate().filter(|(number, _)| is_held(*number));
    sets.filter_map(|(number, (take, set))| Some((number, seen(data, &tangents, noise, take, set)?)))
        .collect()
}

/// What a set shows; nothing where it was left out.
fn seen(data: &Data, tangents: &Tangents, noise: Noise, number: usize, set: usize) -> Option<Seen> {
    let take = &data.takes[number];
    let mut seen = Seen { take: number, ..Seen::default() };
    let mut phasors = vec![(Complex64::default(), Complex64::default()); data.pixels()];
    for frame in 0..take.frames {
        let index = set * take.frames + frame;
        let base = tangents.base(number, index);
        let (roots, residuals) = whiten(data, number, index, &base, noise);
        let weight = weight(take, frame);
        let (mut sum_dn, mut samples) = (0.0, 0);
        for pixel in (0..data.pixels()).filter(|&pixel| roots[pixel] > 0.0) {
            let difference_dn = residuals[pixel] / roots[pixel];
            seen.chi2 += residuals[pixel] * residuals[pixel];
            seen.square_dn2 += difference_dn * difference_dn;
            sum_dn += difference_dn;
            samples += 1;
            if data.target[pixel] {
                phasors[pixel].0 += weight * (base[pixel] + difference_dn);
                phasors[pixel].1 += weight * base[pixel];
            }
        }
        if samples > 0 {
            seen.samples += samples;
            seen.means_dn2 += (sum_dn / samples as f64).powi(2);
            seen.frames += 1;
        }
    }
    // The pixels' mean, as the paper averages: each with the phasor's length that the model gives it.
    let sum: Complex64 = phasors.iter().map(|(measured, model)| measured * model.conj()).sum();
    let moment = &take.moments[set * take.frames];
    let has_distance = moment.lit && sum != Complex64::default();
    seen.distance_m = if has_distance { sum.arg() / phase_rad(1.0, moment.frequency_hz) } else { f64::NAN };
    (seen.samples > 0).then_some(seen)
}

/// What a frame weighs in its set's phasor: the scheme's coefficients, or those of a plain DFT.
fn weight(take: &Take, frame: usize) -> Complex64 {
    let step_rad = |frame: usize| take.moments[frame].step_rad;
    let is_of = |scheme: &&crate::spec::Scheme| {
        scheme.angles.len() == take.frames
            && (0..take.frames).all(|frame| (scheme.angle_rad(frame) - step_rad(frame)).abs() < 1e-4)
    };
    match SCHEMES.iter().find(is_of) {
        Some(scheme) => {
            let factor = (scheme.irrational.squared() as f64).sqrt();
            Complex64::new(scheme.in_phase[frame] as f64, factor * scheme.quadrature[frame] as f64)
        }
        None => Complex64::from_polar(1.0, step_rad(frame)),
    }
}
