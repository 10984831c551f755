//! The fit on sets that it has not seen.
//!
//! Groups of four neighbouring sets are dealt to two folds; each fold is predicted by a model whose pixels and parameters are fitted to
//! the other one.

use super::columns::Tangents;
use super::data::{Data, Take};
use super::fit::{Fit, improved};
use super::gram::{Noise, whiten};
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

/// What a set shows: recording, chi squared, samples, squared difference (DN²), distance (m).
type Seen = (usize, f64, usize, f64, f64);

/// Predicts every set of `data` by `before` and by `after`, neither of which has seen it.
pub fn held_out(data: &Data, before: &Fit, after: &Fit, noise: Noise) -> HeldOut {
    let predict = |fit: &Fit| -> Vec<Seen> {
        let folds = (0..FOLDS).flat_map(|fold| predicted(data, fit, noise, fold));
        // In the order of the sets.
        folds.collect::<BTreeMap<usize, Seen>>().into_values().collect()
    };
    let old = predict(before);
    let new = if after.pieces.is_empty() { old.clone() } else { predict(after) };
    let differences: Vec<f64> = old.iter().zip(&new).map(|(old, new)| old.1 - new.1).collect();
    let count = differences.len().max(1) as f64;
    let mean = differences.iter().sum::<f64>() / count;
    let scatter = (differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / count).sqrt();
    let by_frames = data.schemes().into_iter().map(|frames| {
        let of = |seen: &[Seen]| {
            let of: Vec<Seen> =
                seen.iter().filter(|seen| data.takes[seen.0].frames == frames).copied().collect();
            agreement(&of).distance_rms_m
        };
        (frames, of(&old), of(&new))
    });
    HeldOut {
        before: agreement(&old),
        after: agreement(&new),
        by_frames: by_frames.collect(),
        z: if scatter > 0.0 { mean / scatter * count.sqrt() } else { 0.0 },
        sets: old.len(),
    }
}

fn agreement(sets: &[Seen]) -> Agreement {
    let samples = sets.iter().map(|set| set.2).sum::<usize>().max(1) as f64;
    let distances: Vec<f64> = sets.iter().map(|set| set.4).filter(|distance| distance.is_finite()).collect();
    Agreement {
        chi2_per_dof: sets.iter().map(|set| set.1).sum::<f64>() / samples,
        rms_dn: (sets.iter().map(|set| set.3).sum::<f64>() / samples).sqrt(),
        distance_rms_m: (distances.iter().map(|d| d * d).sum::<f64>() / distances.len().max(1) as f64).sqrt(),
    }
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
    let (mut chi2, mut samples, mut square) = (0.0, 0, 0.0);
    let mut phasors = vec![(Complex64::default(), Complex64::default()); data.pixels()];
    for frame in 0..take.frames {
        let index = set * take.frames + frame;
        let base = tangents.base(number, index);
        let (roots, residuals) = whiten(data, number, index, &base, noise);
        let weight = weight(take, frame);
        for pixel in (0..data.pixels()).filter(|&pixel| roots[pixel] > 0.0) {
            let difference_dn = residuals[pixel] / roots[pixel];
            chi2 += residuals[pixel] * residuals[pixel];
            samples += 1;
            square += difference_dn * difference_dn;
            if data.target[pixel] {
                phasors[pixel].0 += weight * (base[pixel] + difference_dn);
                phasors[pixel].1 += weight * base[pixel];
            }
        }
    }
    // The pixels' mean, as the paper averages: each with the phasor's length that the model gives it.
    let sum: Complex64 = phasors.iter().map(|(measured, model)| measured * model.conj()).sum();
    let moment = &take.moments[set * take.frames];
    let distance_m = if moment.lit { sum.arg() / phase_rad(1.0, moment.frequency_hz) } else { f64::NAN };
    (samples > 0).then_some((number, chi2, samples, square, distance_m))
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
