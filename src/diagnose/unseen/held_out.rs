//! The fit on sets that it has not seen.
//!
//! Groups of four neighbouring sets are dealt to two folds, or single sets, where one fold would have no part of the places that the other one has; each fold is
//! predicted by a model whose pixels and parameters are fitted to the other one. Of a few
//! sets, frames of either half of the image are predicted, some at a time: by parameters that are fitted to the other half, and pixels of the other frames.

use super::held_frames::Holding;
use super::improvement::z;
use super::seen::{Agreement, HALVES, Seen, agreement, seen};
use super::untold::untold;
use crate::diagnose::fitting::fit::{Fit, beside, fit, improved};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::fitting::set_errors::Jitter;
use crate::diagnose::reading::data::Data;
use crate::diagnose::shared_errors::jitters::Jitters;
use crate::diagnose::tangents::columns::Tangents;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Both predictions.
#[derive(Debug, Clone)]
pub struct HeldOut {
    /// By the simulation that the camera describes.
    pub before: Agreement,
    /// With the effects that were found.
    pub after: Agreement,
    /// Each scheme's frames a set, and the agreement of its sets before and after.
    pub by_frames: Vec<(usize, Agreement, Agreement)>,
    /// The improvement of the likelihood over its scatter from set to set; of few sets from block to block of the image, and where few sets show it, from pixel to pixel.
    pub z: f64,
    /// Sets that were predicted.
    pub sets: usize,
}

impl HeldOut {
    /// Schemes apart, where there are several and anything was held out.
    pub fn of_schemes(&self) -> &[(usize, Agreement, Agreement)] {
        if self.by_frames.len() > 1 && self.sets > 0 { &self.by_frames } else { &[] }
    }
}

/// Neighbouring sets that are held out together.
const GROUP: usize = 4;
const FOLDS: usize = 2;
/// A fold's places are at least so far apart, of how far all are: at one place a pixel's constant light is not told from ambient light, and what would be seen
/// at others is anything.
const APART: f64 = 0.5;

/// What predicts: what is fitted, what noise its samples have, and which of the jitters of a frame's phase and of its time.
#[derive(Debug, Clone, Copy)]
pub struct Predictor<'a> {
    /// Effects and pixels.
    pub fit: &'a Fit,
    /// Noise of single samples.
    pub noise: Noise,
    /// The noise that likelihoods of all predictors are normalised by.
    pub reference: Noise,
    /// Whether there are random errors of frames: of their phase, and of their time.
    pub jitters: [bool; 2],
}

impl Predictor<'_> {
    /// Whether frames have random errors.
    pub fn has_jitters(&self) -> bool {
        self.jitters != [false; 2]
    }
}

/// Predicts every set of `data`, in their order, by `before` and by `after`, neither of which has seen it.
pub fn held_out(data: &Data, before: Predictor, after: Predictor) -> HeldOut {
    let is_few = data.sets().len() < FOLDS * GROUP;
    let holding = if is_few { Holding::of(data) } else { None };
    let group = group(data);
    let predict = |by: Predictor| -> Vec<Seen> {
        let of_half =
            |half| holding.as_ref().map_or_else(Vec::new, |holding| predicted_half(data, by, holding, half));
        let predicted: BTreeMap<usize, Seen> = match is_few {
            true => (0..HALVES).into_par_iter().flat_map_iter(of_half).collect(),
            false => (0..FOLDS)
                .into_par_iter()
                .flat_map_iter(|fold| predicted(data, by, (group, fold), before.fit.is_far()))
                .collect(),
        };
        predicted.into_values().collect()
    };
    // Jitter predicts no sample.
    let is_same = after.fit.pieces.is_empty() && after.noise == before.noise;
    let (new, old) = rayon::join(|| predict(after), || (!is_same).then(|| predict(before)));
    let old = old.unwrap_or_else(|| new.clone());
    // What the camera includes is as strong as it says; what is found, as the other folds show it.
    let included = data.unpredicted.jitter;
    let with_included = |sets: Vec<Seen>| sets.into_iter().map(|set| with_jitter(set, included)).collect();
    let old: Vec<Seen> = with_included(old);
    let new = match after.has_jitters() {
        true => with_jitters(new, [0, 1].map(|kind| after.jitters[kind] || included[kind] > 0.0)),
        false => with_included(new),
    };
    let by_frames = data.schemes().into_iter().map(|frames| {
        let of = |seen: &[Seen]| {
            agreement(&seen.iter().filter(|seen| data.takes[seen.take].frames == frames).collect::<Vec<_>>())
        };
        (frames, of(&old), of(&new))
    });
    HeldOut {
        before: agreement(&old.iter().collect::<Vec<_>>()),
        after: agreement(&new.iter().collect::<Vec<_>>()),
        by_frames: by_frames.collect(),
        z: z(&old, &new, is_few, after.has_jitters() || !is_few && included != [0.0; 2]),
        sets: if is_few { holding.map_or(0, |_| data.sets().len()) } else { old.len() },
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
            *set = with_jitter(std::mem::take(set), [phase_rad, time_s]);
        }
    }
    sets
}

/// A set with random errors of frames of these standard deviations.
fn with_jitter(mut set: Seen, [phase_rad, time_s]: Jitter) -> Seen {
    for frame in &set.jitters {
        let (square, ln_determinant) = frame.explained(phase_rad, time_s);
        set.chi2 -= square;
        set.unlikely += ln_determinant - square;
    }
    set
}

/// A half of the image, some frames at a time: `(a number of its own for each set, what it shows)`.
fn predicted_half(data: &Data, by: Predictor, holding: &Holding, half: usize) -> Vec<(usize, Seen)> {
    let Predictor { fit: of, noise, .. } = by;
    let is_here = |pixel: usize| HALVES * pixel / data.pixels().max(1) == half;
    let elsewhere = data.only(|_, pixel| !is_here(pixel));
    let pieces = fit(&elsewhere, Some(of), of.pieces.clone(), noise, &|_| true).pieces;
    let every = holding.every;
    let of_part = |part: usize| -> Vec<(usize, Seen)> {
        let is_held = |frame: usize| frame % every == part;
        // Pixels that were fitted to all frames have seen the ones that are held; those of the other half light this one as before.
        let between = data.only(|frame, pixel| !is_here(pixel) || !is_held(frame));
        let pixels = beside(&between, &pieces, noise);
        let told = between.are_told();
        // What predicts has noise of its own.
        let of_held = holding.variances.iter().skip(part).step_by(every);
        let variance = of_held.clone().sum::<f64>() / of_held.len().max(1) as f64;
        let by = Predictor { noise: noise.times(variance), ..by };
        let held = data.only(|frame, pixel| is_here(pixel) && is_held(frame) && told[pixel]);
        let (tangents, _) = Tangents::new(&held, &pixels, &pieces, &[]);
        let of_set = |(number, (take, set))| {
            let seen = seen(&held, &tangents, by, take, set)?;
            // A part of the frames has no distance.
            Some((HALVES * number + half, Seen { distance_m: f64::NAN, fold: half, ..seen }))
        };
        data.sets().into_iter().enumerate().filter_map(of_set).collect()
    };
    let parts: Vec<Vec<(usize, Seen)>> = (0..every).into_par_iter().map(of_part).collect();
    let mut all = BTreeMap::<usize, Seen>::new();
    for (place, seen) in parts.into_iter().flatten() {
        let seen = match all.remove(&place) {
            Some(before) => before.and(seen),
            None => seen,
        };
        all.insert(place, seen);
    }
    all.into_iter().collect()
}

/// How many neighbouring sets are dealt together: single ones where a fold of groups would have no part of the places.
fn group(data: &Data) -> usize {
    let place_m = |(take, set): (usize, usize)| {
        let take = &data.takes[take];
        let moment = take.moments[set * take.frames];
        moment.lit.then_some(moment.position_m)
    };
    let places_m: Vec<Option<f64>> = data.sets().into_iter().map(place_m).collect();
    let apart_m = |counts: &dyn Fn(usize) -> bool| {
        let here =
            places_m.iter().enumerate().filter(|(set, _)| counts(*set)).filter_map(|(_, place)| *place);
        let ends = here.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), m| (a.min(m), b.max(m)));
        (ends.1 - ends.0).max(0.0)
    };
    let all_m = apart_m(&|_| true);
    let is_told =
        |group: &usize| (0..FOLDS).all(|fold| apart_m(&|set| set / group % FOLDS == fold) >= APART * all_m);
    [GROUP, 1].into_iter().find(is_told).unwrap_or(GROUP)
}

/// The sets of a fold, by number, seen by a model that was fitted to the others. For the pixels' own numbers one step from what was fitted to all is
/// enough, unless the mismatch `is_far` above the noise.
fn predicted(data: &Data, by: Predictor, (group, fold): (usize, usize), is_far: bool) -> Vec<(usize, Seen)> {
    let Predictor { fit: of, noise, .. } = by;
    let is_held = |set: usize| set / group % FOLDS == fold;
    let (pixels, pieces) = if is_far || !of.pieces.is_empty() {
        let mut fit = fit(data, Some(of), of.pieces.clone(), noise, &|set| !is_held(set));
        untold(data, of, &mut fit.pieces, noise, &|set| !is_held(set));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{
        Plan, Simulation, chain, injection, number_of, practice_camera, recorded, sensor, taken,
    };
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::fitting::fit::{AS_IT_IS, fit_until};
    use crate::diagnose::stated_noise;
    use crate::diagnose::tangents::pieces::Piece;
    use crate::frames::{Geometry, RawSets};
    use crate::physics::{Active, Stage};
    use std::path::Path;
    use std::sync::Arc;

    const SEED: u64 = 3;
    const HARMONICS: &str = "harmonics";

    const GEOMETRY: Geometry = Geometry { width: 24, height: 18 };
    const PIXELS: usize = GEOMETRY.width * GEOMETRY.height;

    fn alone(fit: &Fit, noise: Noise) -> Predictor<'_> {
        Predictor { fit, noise, reference: noise, jitters: [false; 2] }
    }

    /// A set of 64 frames at each of three distances, with `effects` in so many of the upper pixels.
    fn few_sets(effects: Vec<Active>, pixels: usize) -> Data {
        sets_at_three_places(effects, pixels, 1)
    }

    /// The same with as many sets at each distance.
    fn sets_at_three_places(effects: Vec<Active>, pixels: usize, many: usize) -> Data {
        let camera = practice_camera(GEOMETRY);
        let sensor = sensor(&camera);
        let plan = Plan::usual(SEED);
        let mut course = plan.course(HARMONICS).unwrap();
        course.sets = course.sets.into_iter().step_by(GROUP / many).collect();
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
        let brighter = fit_until(&data, &brighter, Vec::new(), noise, &|_| true, AS_IT_IS);
        assert!(brighter.unreached > 100.0, "it is not settled: {}", brighter.unreached);
        let difference = baseline.chi2 - brighter.chi2;
        assert!(difference.abs() < 5.0, "{difference}");
    }

    /// Four sets at each of three places, one place after the other: by fours one fold would have two places and one a single one. A prediction by half of the
    /// samples has their noise, too: 1 + 4 / 384.
    #[test]
    fn each_fold_has_its_part_of_the_places() {
        let data = sets_at_three_places(Vec::new(), 0, GROUP);
        assert_eq!((data.sets().len(), group(&data)), (12, 1));
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        let held = held_out(&data, alone(&baseline, noise), alone(&baseline, noise));
        let (samples, numbers) = ((12 * 64 * PIXELS) as f64, 4.0);
        let expected = 1.0 + numbers / (6.0 * 64.0);
        assert!((held.before.chi2_per_dof - expected).abs() < 4.0 * (2.0 / samples).sqrt(), "{held:?}");
        // A rail's places are in either fold, by fours too.
        let rail = taken(GEOMETRY, SEED, &[], &["four-rail"]).unwrap();
        assert_eq!(group(&Data::of(&rail, Vec::new()).unwrap()), GROUP);
    }

    /// Odd and even frames tell the p numbers of a pixel alike. So, of its N samples, N - 2 p combinations are predicted by 0 and show their
    /// noise; in the others, p in the odd frames and p in the even ones, either half is predicted by the other and shows the noise of both,
    /// twice the same: 4 times a squared deviate. Their sum has the mean N + 2 p and the variance 2 (N - 2 p) + 16 (2 p); chi squared is that over what
    /// predictions by three numbers have, 1 + 3 / 96. A fit that has seen what it predicts has the mean N - p and the variance 2 (N - p).
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
        let own = 1.0 + 3.0 / 96.0;
        let (mean, deviation) = (n + 2.0 * p, (2.0 * n + 28.0 * p).sqrt());
        let chi2 = own * held.before.chi2_per_dof * n;
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
        let piece = Piece::off(effect.name, &[0], &[0]);
        let after = fit(&upper, Some(&baseline), vec![piece], noise, &|_| true);
        let both =
            chi2(held_out(&upper, alone(&baseline, noise), alone(&after, noise)).after) - left_out(&clean);
        let deviation = 4.0 * (whole / 2.0).sqrt();
        assert!(whole - 4.0 * deviation > whole / 2.0, "a quarter would not be told from {whole}");
        assert!((both - whole).abs() < 4.0 * deviation, "{both}, not {whole} +- {deviation}");
    }
}
