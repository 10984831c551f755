//! What a set shows to a model that has not seen it.

use super::held_out::Predictor;
use crate::diagnose::fitting::whiten::{tails, whiten};
use crate::diagnose::reading::data::{Data, Take};
use crate::diagnose::shared_errors::jitters;
use crate::diagnose::tangents::arrived::Arrived;
use crate::diagnose::tangents::columns::Tangents;
use crate::spec::SCHEMES;
use crate::units::phase_rad;
use num_complex::Complex64;

/// Agreement of a prediction with the recordings.
#[derive(Debug, Clone, Copy, Default)]
pub struct Agreement {
    /// Chi squared a sample.
    pub chi2_per_dof: f64,
    /// Root mean square of the difference of raw frames, DN: of all samples that count, as they are.
    pub rms_dn: f64,
    /// The same of each frame's mean difference, DN.
    pub frame_mean_rms_dn: f64,
    /// The same of the distance that a set shows, its pixels' mean, m.
    pub distance_rms_m: f64,
}

/// What a set shows.
#[derive(Debug, Clone, Default)]
pub struct Seen {
    /// The fold, or the half of the image, in which it was predicted.
    pub fold: usize,
    /// What each frame says of random errors, where these are looked at.
    pub jitters: Vec<jitters::Frame>,
    /// Its recording.
    pub take: usize,
    pub chi2: f64,
    /// Minus twice the logarithm of the likelihood, but for a constant.
    pub unlikely: f64,
    /// The same of each pixel.
    pub of_pixels: Vec<f64>,
    pub samples: usize,
    /// Squared difference of all samples, DN².
    pub square_dn2: f64,
    /// Squares of the frames' mean differences, DN², and frames.
    pub means_dn2: f64,
    pub frames: usize,
    /// Error of the distance, m; not a number where there is none.
    pub distance_m: f64,
}

/// Halves of the image.
pub const HALVES: usize = 2;

impl Seen {
    /// Both, of the same set.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.jitters.extend(other.jitters);
        self.chi2 += other.chi2;
        self.unlikely += other.unlikely;
        self.of_pixels.iter_mut().zip(other.of_pixels).for_each(|(pixel, other)| *pixel += other);
        self.samples += other.samples;
        self.square_dn2 += other.square_dn2;
        self.means_dn2 += other.means_dn2;
        self.frames += other.frames;
        self
    }
}

/// Agreement of all `sets`.
pub fn agreement(sets: &[&Seen]) -> Agreement {
    let samples = sets.iter().map(|set| set.samples).sum::<usize>().max(1) as f64;
    let frames = sets.iter().map(|set| set.frames).sum::<usize>().max(1) as f64;
    let distances: Vec<f64> =
        sets.iter().map(|set| set.distance_m).filter(|distance| distance.is_finite()).collect();
    // What was not predicted agrees with nothing.
    let is_known = |value: f64| if sets.is_empty() { f64::NAN } else { value };
    Agreement {
        chi2_per_dof: is_known(sets.iter().map(|set| set.chi2).sum::<f64>() / samples),
        rms_dn: is_known((sets.iter().map(|set| set.square_dn2).sum::<f64>() / samples).sqrt()),
        frame_mean_rms_dn: is_known((sets.iter().map(|set| set.means_dn2).sum::<f64>() / frames).sqrt()),
        // Without any it is 0 / 0: no number.
        distance_rms_m: (distances.iter().map(|d| d * d).sum::<f64>() / distances.len() as f64).sqrt(),
    }
}

/// What a set shows; nothing where it was left out.
pub fn seen(data: &Data, tangents: &Tangents, by: Predictor, number: usize, set: usize) -> Option<Seen> {
    let (noise, take) = (by.noise, &data.takes[number]);
    let mut seen = Seen { take: number, of_pixels: vec![0.0; data.pixels()], ..Seen::default() };
    let mut phasors = vec![(Complex64::default(), Complex64::default()); data.pixels()];
    let mut arrived = Arrived::default();
    for frame in 0..take.frames {
        let index = set * take.frames + frame;
        let base = tangents.base(number, index);
        let (roots, residuals) = whiten(data, number, index, &base, noise);
        let measured = &take.signal_dn[index * data.pixels()..(index + 1) * data.pixels()];
        let tails = tails(measured, &base, &roots, &residuals);
        for (pixel, (unlikely, tail)) in seen.of_pixels.iter_mut().zip(tails).enumerate() {
            // Without weight it has no residual either.
            if roots[pixel] > 0.0 {
                let ratio = roots[pixel] * roots[pixel] * by.reference.variance(f64::from(measured[pixel]));
                *unlikely += tail + residuals[pixel] * residuals[pixel] - ratio.ln();
            }
        }
        if by.has_jitters() {
            let frame = tangents.frame(number, index, &mut arrived);
            let moment = &take.moments[index];
            seen.jitters.push(jitters::Frame::seen(&frame, &roots, &residuals, (number, 0), moment));
        }
        let weight = weight(take, frame);
        let (mut sum_dn, mut samples) = (0.0, 0);
        for pixel in (0..data.pixels()).filter(|&pixel| roots[pixel] > 0.0) {
            let difference_dn = f64::from(measured[pixel]) - base[pixel];
            seen.chi2 += residuals[pixel] * residuals[pixel];
            seen.square_dn2 += difference_dn * difference_dn;
            sum_dn += difference_dn;
            samples += 1;
            if data.target[pixel] {
                phasors[pixel].0 += weight * (base[pixel] + residuals[pixel] / roots[pixel]);
                phasors[pixel].1 += weight * base[pixel];
            }
        }
        if samples > 0 {
            (seen.samples, seen.frames) = (seen.samples + samples, seen.frames + 1);
            seen.means_dn2 += (sum_dn / samples as f64).powi(2);
        }
    }
    // The pixels' mean, as the paper averages: each with the phasor's length that the model gives it.
    let sum: Complex64 = phasors.iter().map(|(measured, model)| measured * model.conj()).sum();
    let moment = &take.moments[set * take.frames];
    let has_distance = moment.lit && sum != Complex64::default();
    seen.distance_m = if has_distance { sum.arg() / phase_rad(1.0, moment.frequency_hz) } else { f64::NAN };
    seen.unlikely = seen.of_pixels.iter().sum();
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
