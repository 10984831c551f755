//! The fit on sets that it has not seen.
//!
//! Groups of four neighbouring sets are dealt to two folds; each fold is predicted by a model whose pixels and parameters are fitted to the other one. Of a few
//! sets, every other frame of either half of the image is predicted: by parameters that are fitted to the other half, and pixels of the frames between.

use super::columns::Tangents;
use super::data::{Data, Take};
use super::fit::{Fit, fit, improved};
use super::jitters::{self, Jitters};
use super::noise::Noise;
use super::settling::settled;
use super::whiten::{tails, whiten};
use crate::spec::SCHEMES;
use crate::units::phase_rad;
use num_complex::Complex64;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

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

/// Both predictions.
#[derive(Debug, Clone)]
pub struct HeldOut {
    /// By the simulation that the camera describes.
    pub before: Agreement,
    /// With the effects that were found.
    pub after: Agreement,
    /// Each scheme's frames a set, and the distance's RMS before and after, m.
    pub by_frames: Vec<(usize, f64, f64)>,
    /// The improvement of the likelihood over its scatter from set to set.
    pub z: f64,
    /// Sets that were predicted.
    pub sets: usize,
}

/// Neighbouring sets that are held out together.
const GROUP: usize = 4;
const FOLDS: usize = 2;

/// What a set shows.
#[derive(Debug, Clone, Default)]
struct Seen {
    /// The fold, or part, in which it was predicted.
    fold: usize,
    /// What each frame says of random errors, where these are looked at.
    jitters: Vec<jitters::Frame>,
    /// Its recording.
    take: usize,
    chi2: f64,
    /// Minus twice the logarithm of the likelihood, but for a constant.
    unlikely: f64,
    samples: usize,
    /// Squared difference of all samples, DN².
    square_dn2: f64,
    /// Squares of the frames' mean differences, DN², and frames.
    means_dn2: f64,
    frames: usize,
    /// Error of the distance, m; not a number where there is none.
    distance_m: f64,
}

/// What predicts: what is fitted, what noise its samples have, and which of the jitters of a frame's phase and of its time.
#[derive(Debug, Clone, Copy)]
pub struct Predictor<'a> {
    /// Effects and pixels.
    pub fit: &'a Fit,
    /// Noise of single samples.
    pub noise: Noise,
    /// Whether there are random errors of frames: of their phase, and of their time.
    pub jitters: [bool; 2],
}

impl Predictor<'_> {
    fn has_jitters(&self) -> bool {
        self.jitters != [false; 2]
    }
}

/// Predicts every set of `data`, in their order, by `before` and by `after`, neither of which has seen it.
pub fn held_out(data: &Data, before: Predictor, after: Predictor) -> HeldOut {
    let is_few = data.sets().len() < FOLDS * GROUP;
    let predict = |by: Predictor| -> Vec<Seen> {
        let parts = (0..if is_few { PARTS } else { FOLDS }).flat_map(|part| match is_few {
            true => predicted_frames(data, by, part),
            false => predicted(data, by, part, before.fit.is_far()),
        });
        parts.collect::<BTreeMap<usize, Seen>>().into_values().collect()
    };
    let new = predict(after);
    // Jitter predicts no sample.
    let is_same = after.fit.pieces.is_empty() && after.noise == before.noise;
    let old = if is_same { new.clone() } else { predict(before) };
    let new = with_jitters(new, after.jitters);
    let differences: Vec<f64> = old.iter().zip(&new).map(|(old, new)| old.unlikely - new.unlikely).collect();
    let count = differences.len().max(1) as f64;
    let mean = differences.iter().sum::<f64>() / count;
    let scatter = (differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / count).sqrt();
    let by_frames = data.schemes().into_iter().map(|frames| {
        let of = |seen: &[Seen]| {
            let of: Vec<Seen> =
                seen.iter().filter(|seen| data.takes[seen.take].frames == frames).cloned().collect();
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

/// With random errors of frames, as strong as the other folds show them.
fn with_jitters(mut sets: Vec<Seen>, exist: [bool; 2]) -> Vec<Seen> {
    let folds: BTreeSet<usize> = sets.iter().map(|set| set.fold).collect();
    for fold in folds {
        let mut others = Jitters::default();
        let of_others = sets.iter().filter(|set| set.fold != fold).flat_map(|set| &set.jitters);
        of_others.for_each(|frame| others.add(*frame));
        let (phase_rad, time_s) = others.likeliest(exist);
        for set in sets.iter_mut().filter(|set| set.fold == fold) {
            for frame in &set.jitters {
                let (square, ln_determinant) = frame.explained(phase_rad, time_s);
                set.chi2 -= square;
                set.unlikely += ln_determinant - square;
            }
        }
    }
    sets
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

/// How often pixels are settled where parameters are known, at most.
const SETTLING: usize = 3;
/// A half of the image in every other frame: `(a number of its own for each set, what it shows)`.
fn predicted_frames(data: &Data, by: Predictor, part: usize) -> Vec<(usize, Seen)> {
    let Predictor { fit: of, noise, .. } = by;
    let (half, odd) = (part / 2, part % 2);
    let half_of = |pixel: usize| 2 * pixel / data.pixels().max(1);
    let elsewhere = data.only(|_, pixel| half_of(pixel) != half);
    let pieces = fit(&elsewhere, Some(of), of.pieces.clone(), noise, &|_| true).pieces;
    let between = data.only(|frame, pixel| half_of(pixel) == half && frame % 2 != odd);
    let pixels = settled(&between, &of.pixels, None, SETTLING, &pieces, noise, &|_| true);
    let held = data.only(|frame, pixel| half_of(pixel) == half && frame % 2 == odd);
    let (tangents, _) = Tangents::new(&held, &pixels, &pieces, &[]);
    let sets = data.sets().into_iter().enumerate();
    let of_set = |(number, (take, set))| {
        let seen = seen(&held, &tangents, by, take, set)?;
        // Half of the frames have no distance.
        Some((PARTS * number + part, Seen { distance_m: f64::NAN, fold: part, ..seen }))
    };
    sets.filter_map(of_set).collect()
}

/// The sets of a fold, by number, seen by a model that was fitted to the others. For the pixels' own numbers one step from what was fitted to all is
/// enough, unless the mismatch `is_far` above the noise.
fn predicted(data: &Data, by: Predictor, fold: usize, is_far: bool) -> Vec<(usize, Seen)> {
    let Predictor { fit: of, noise, .. } = by;
    let is_held = |set: usize| set / GROUP % FOLDS == fold;
    let (pixels, pieces) = if is_far || !of.pieces.is_empty() {
        let fit = fit(data, Some(of), of.pieces.clone(), noise, &|set| !is_held(set));
        (fit.pixels, fit.pieces)
    } else {
        improved(data, of, noise, &|set| !is_held(set))
    };
    let (tangents, _) = Tangents::new(data, &pixels, &pieces, &[]);
    let sets = data.sets().into_par_iter().enumerate().filter(|(number, _)| is_held(*number));
    let of_set = |(number, (take, set))| {
        let seen = seen(data, &tangents, by, take, set)?;
        Some((number, Seen { fold, ..seen }))
    };
    sets.filter_map(of_set).collect()
}

/// What a set shows; nothing where it was left out.
fn seen(data: &Data, tangents: &Tangents, by: Predictor, number: usize, set: usize) -> Option<Seen> {
    let noise = by.noise;
    let take = &data.takes[number];
    let mut seen = Seen { take: number, ..Seen::default() };
    let mut phasors = vec![(Complex64::default(), Complex64::default()); data.pixels()];
    for frame in 0..take.frames {
        let index = set * take.frames + frame;
        let base = tangents.base(number, index);
        let (roots, residuals) = whiten(data, number, index, &base, noise);
        let measured = &take.signal_dn[index * data.pixels()..(index + 1) * data.pixels()];
        seen.unlikely +=
            noise.ln_variance(measured, &roots) + tails(measured, &base, &roots, &residuals).sum::<f64>();
        if by.has_jitters() {
            let frame = tangents.frame(number, index);
            let moment = &take.moments[index];
            seen.jitters.push(jitters::Frame::seen(&frame, &roots, &residuals, 0, moment));
        }
        let weight = weight(take, frame);
        let (mut sum_dn, mut samples) = (0.0, 0);
        for pixel in (0..data.pixels()).filter(|&pixel| roots[pixel] > 0.0) {
            let difference_dn = f64::from(measured[pixel]) - base[pixel];
            seen.chi2 += residuals[pixel] * residuals[pixel];
            seen.unlikely += residuals[pixel] * residuals[pixel];
            seen.square_dn2 += difference_dn * difference_dn;
            sum_dn += difference_dn;
            samples += 1;
            if data.target[pixel] {
                phasors[pixel].0 += weight * (base[pixel] + residuals[pixel] / roots[pixel]);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{Plan, Simulation, chain, injection, number_of, practice_camera, recorded, sensor};
    use crate::diagnose::fit::{fit_until, unfitted};
    use crate::diagnose::pieces::Piece;
    use crate::diagnose::stated_noise;
    use crate::frames::{Geometry, RawSets};
    use crate::physics::{Active, Stage};
    use std::path::Path;
    use std::sync::Arc;

    const SEED: u64 = 3;
    const HARMONICS: &str = "harmonics";

    const GEOMETRY: Geometry = Geometry { width: 24, height: 18 };
    const PIXELS: usize = GEOMETRY.width * GEOMETRY.height;

    fn alone(fit: &Fit, noise: Noise) -> Predictor<'_> {
        Predictor { fit, noise, jitters: [false; 2] }
    }

    /// A set of 64 frames at each of three distances, with `effects` in so many of the upper pixels.
    fn few_sets(effects: Vec<Active>, pixels: usize) -> Data {
        let camera = practice_camera(GEOMETRY);
        let sensor = sensor(&camera);
        let plan = Plan::usual(SEED);
        let mut course = plan.course(HARMONICS).unwrap();
        course.sets = course.sets.into_iter().step_by(4).collect();
        let bench = Arc::new(Stage::bench().pixels(&sensor, SEED));
        let take = |effects| {
            let chain = &chain(&camera, Arc::clone(&bench), effects);
            let recording = number_of(HARMONICS);
            let simulation = Simulation { chain, sensor: &sensor, noise: true, seed: SEED, recording };
            recorded(Path::new(""), HARMONICS, &plan, &course, &camera, &simulation, &|| ()).unwrap()
        };
        let (mut recording, upper) = (take(Vec::new()), take(effects));
        let mut codes = recording.raw.codes().to_vec();
        for (codes, upper) in codes.chunks_mut(PIXELS).zip(upper.raw.codes().chunks(PIXELS)) {
            codes[..pixels].copy_from_slice(&upper[..pixels]);
        }
        recording.raw = RawSets::new(GEOMETRY, course.frames(), codes).unwrap();
        Data::of(&[recording], Vec::new()).unwrap()
    }

    /// What a pixel's own light is taken for before it is settled says nothing of the likelihood: half a DN more light is 0.0015 more of the
    /// variance, which without its logarithm lowers chi squared by as much of each of 80 000 samples.
    #[test]
    fn a_model_with_too_much_light_does_not_look_better() {
        let data = few_sets(Vec::new(), 0);
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        let mut pixels = (*baseline.pixels).clone();
        pixels.ambient_dn.iter_mut().for_each(|ambient_dn| *ambient_dn += 0.5);
        let brighter = Fit { pixels: Arc::new(pixels), ..baseline.clone() };
        let brighter = fit_until(&data, &brighter, Vec::new(), noise, &|_| true, f64::INFINITY);
        assert!(brighter.unreached > 100.0, "it is not settled: {}", brighter.unreached);
        let difference = baseline.chi2 - brighter.chi2;
        assert!(difference.abs() < 5.0, "{difference}");
    }

    /// Odd and even frames tell the p numbers of a pixel alike. So, of its N samples, N - 2 p combinations are predicted by 0 and show their
    /// noise; in the others, p in the odd frames and p in the even ones, either half is predicted by the other and shows the noise of both,
    /// twice the same: 4 times a squared deviate. Chi squared has the mean N + 2 p and the variance 2 (N - 2 p) + 16 (2 p). A fit that has
    /// seen what it predicts has the mean N - p and the variance 2 (N - p).
    #[test]
    fn held_frames_of_a_few_sets_are_as_far_off_as_their_noise_and_that_of_the_fit() {
        let data = few_sets(Vec::new(), 0);
        assert!(data.sets().len() < FOLDS * GROUP);
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        let held = held_out(&data, alone(&baseline, noise), alone(&baseline, noise));
        // Amplitude, phase, ambient light, and, where the target moves, constant light.
        let numbers = |pixel| if data.tells_constant(pixel) { 4.0 } else { 3.0 };
        let p: f64 = (0..data.pixels()).map(numbers).sum();
        let n = baseline.samples as f64;
        assert_eq!(baseline.samples, 3 * 64 * data.pixels(), "all samples count");
        let (mean, deviation) = (n + 2.0 * p, (2.0 * n + 28.0 * p).sqrt());
        let chi2 = held.before.chi2_per_dof * n;
        assert!((chi2 - mean).abs() < 4.0 * deviation, "{chi2}, not {mean} +- {deviation}");
        let (seen, seen_deviation) = (n - p, (2.0 * (n - p)).sqrt());
        assert!(mean - 4.0 * deviation > seen + 4.0 * seen_deviation, "what was seen would pass: {seen}");
        assert_eq!((held.sets, held.z), (3, 0.0));
    }

    /// With errors that frames share the residuals' covariance is that of their noise and of these errors: measured by it, a campaign with jitter
    /// is as far off as one without. The errors are as strong as other parts show them.
    #[test]
    fn frames_that_jitter_are_as_far_off_as_jitter_makes_them() {
        let data = few_sets(vec![injection("clock_jitter:sigma_rad=0.03").unwrap()], PIXELS);
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        let before = alone(&baseline, noise);
        let held = held_out(&data, before, Predictor { jitters: [true, false], ..before });
        let still = few_sets(Vec::new(), 0);
        let baseline = unfitted(&still, noise);
        let before = alone(&baseline, noise);
        let of_noise = held_out(&still, before, before).before.chi2_per_dof;
        let n = (3 * 64 * PIXELS) as f64;
        // Both have the variance 2 a sample, and 28 for each of some three numbers a pixel.
        let deviation = (2.0 * (2.0 + 28.0 * 3.0 / 64.0) / n).sqrt();
        assert!(held.before.chi2_per_dof > of_noise + 10.0 * deviation, "{held:?}, {of_noise}");
        assert!((held.after.chi2_per_dof - of_noise).abs() < 4.0 * deviation, "{held:?}, {of_noise}");
        assert!(held.z > 3.0, "{held:?}");
        // Where there is none, none is found to matter.
        let none = held_out(&still, before, Predictor { jitters: [true; 2], ..before });
        assert!((none.after.chi2_per_dof - of_noise).abs() < 0.1 * deviation && none.z < 2.0, "{none:?}");
    }

    /// An effect in the upper half alone is not known from the lower half, where it is taken to be then: residuals are those of the effect
    /// left out of the whole image, but for its sign in the lower half. Chi squared differs by 4 times the sum over the lower half of noise
    /// times effect, each over the noise's deviation: the root of the effect's chi squared is the standard deviation of that sum.
    /// Parameters of the half itself would leave nothing of the effect, those of the whole image a quarter.
    #[test]
    fn a_half_of_the_image_is_predicted_with_the_parameters_of_the_other() {
        let scale = injection("phase_step_scale:relative=0.02").unwrap();
        let effect = scale.effect;
        let [clean, everywhere, upper] =
            [0, PIXELS, PIXELS / 2].map(|pixels| few_sets(vec![scale.clone()], pixels));
        let noise = stated_noise(&clean);
        let chi2 = |agreement: Agreement| agreement.chi2_per_dof * (3 * 64 * PIXELS) as f64;
        let left_out = |data: &Data| {
            let baseline = unfitted(data, noise);
            chi2(held_out(data, alone(&baseline, noise), alone(&baseline, noise)).before)
        };
        let whole = left_out(&everywhere) - left_out(&clean);
        let baseline = unfitted(&upper, noise);
        let piece = Piece { effect, values: effect.off(), free: vec![0], takes: vec![0], finite: false };
        let after = fit(&upper, Some(&baseline), vec![piece], noise, &|_| true);
        let both =
            chi2(held_out(&upper, alone(&baseline, noise), alone(&after, noise)).after) - left_out(&clean);
        let deviation = 4.0 * (whole / 2.0).sqrt();
        assert!(whole - 4.0 * deviation > whole / 2.0, "a quarter would not be told from {whole}");
        assert!((both - whole).abs() < 4.0 * deviation, "{both}, not {whole} +- {deviation}");
    }
}
