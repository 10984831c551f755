//! The open question: why simulated motion errors of four frames are half of the measured ones.
//!
//! The hypothesis is that light falls off within a set. Its free number, the ratio of the light's constant to its modulated part, is
//! fitted to the four numbers that the paper measured. Another hypothesis with one free number stands beside it: frames that are
//! farther apart than 125 ms allow. Frames are linear in the ratio, so that two simulations tell all.

use super::camera::{Camera, Conditions, Method, SQUARE_WAVES_RATIO, Set};
use super::figure_07::with_falloff;
use super::linearity::SEED;
use super::motion::{VELOCITY_M_S, error_curve, places_m};
use super::quantity::Measured;
use super::residual::{mean, rms, span, without_mean};
use crate::physics::{Draws, FREQUENCY_HZ};
use std::f64::consts::TAU;

/// What the paper measured at 2 m/s and 125 ms: RMS and range of four frames, then of the WDFT, m.
pub const MEASURED: [Measured; 4] = [
    Measured::new(0.044, 0.002),
    Measured::new(0.112, 0.007),
    Measured::new(0.009, 0.004),
    Measured::new(0.03, 0.01),
];

/// Ratios and their spacing that are tried.
const RATIOS: u32 = 300;
const RATIO_SPACING: f64 = 0.01;
/// Random errors and their spacing, m.
const RANDOM: u32 = 40;
const RANDOM_SPACING_M: f64 = 0.5e-3;
/// Factors on the frame period, from 1.
const FACTORS: u32 = 75;
const FACTOR_SPACING: f64 = 0.02;
/// Angles at which a waveform's depth is looked for.
const ANGLES: u32 = 3600;
const RUNS: usize = 100;
const RUNS_STREAM: u64 = 5;
/// From one measurement of a run to the next, in places of the curve: 0.25 m.
const EVERY: usize = 25;

/// Σ ((predicted − measured) / error)² over the four numbers, which are taken for independent.
pub fn chi_squared(predicted_m: &[f64; 4]) -> f64 {
    let term =
        |(predicted, measured): (&f64, &Measured)| ((predicted - measured.value) / measured.error).powi(2);
    predicted_m.iter().zip(&MEASURED).map(term).sum()
}

/// A free number, a random error in m where it is free too, and what they predict.
type Trial = (f64, Option<f64>, [f64; 4]);

/// A hypothesis at its best.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// What is assumed, and what is free.
    pub hypothesis: &'static str,
    /// The free number's best value, and the least and largest for which χ² is less than one above its minimum; `None` where nothing is
    /// free.
    pub free: Option<[f64; 3]>,
    /// Random error at the best value, m, where it is free too.
    pub random_m: Option<f64>,
    /// RMS and range of four frames and of the WDFT, m.
    pub predicted_m: [f64; 4],
    /// χ² there.
    pub chi_squared: f64,
    /// Measured numbers less free ones.
    pub freedom: usize,
}

impl Fit {
    fn fixed(hypothesis: &'static str, predicted_m: [f64; 4]) -> Self {
        let chi_squared = chi_squared(&predicted_m);
        Self { hypothesis, free: None, random_m: None, predicted_m, chi_squared, freedom: 4 }
    }

    /// The best of (free number, random error, predicted); `None` where there is none.
    fn best(hypothesis: &'static str, tried: &[Trial]) -> Option<Self> {
        let scored = |one: &Trial| chi_squared(&one.2);
        let best = tried.iter().min_by(|one, other| scored(one).total_cmp(&scored(other)))?;
        let least = scored(best);
        let inside = tried.iter().filter(|one| scored(one) <= least + 1.0).map(|one| one.0);
        let (low, high) = inside
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), free| (low.min(free), high.max(free)));
        Some(Self {
            hypothesis,
            free: Some([best.0, low, high]),
            random_m: best.1,
            predicted_m: best.2,
            chi_squared: least,
            freedom: 3 - usize::from(best.1.is_some()),
        })
    }
}

/// The moving frames of one method at every place, for the ratios 0 and 1, and the static errors.
struct Curves<'a> {
    method: &'a Method,
    places_m: Vec<f64>,
    none: Vec<Vec<f64>>,
    one: Vec<Vec<f64>>,
    still_m: Vec<f64>,
}

impl<'a> Curves<'a> {
    /// Under `waveform`'s correlation.
    fn of(method: &'a Method, waveform: &Conditions) -> Self {
        let correlation = || waveform.correlation.clone();
        let camera = |ratio| Camera::new(Conditions { correlation: correlation(), ..with_falloff(ratio) });
        let (none, one) = (camera(0.0), camera(1.0));
        let places_m = places_m();
        let frames = |camera: &Camera| {
            let at = |place_m: &f64| {
                camera.frames_dn(&method.steps_rad, &Set::moving(method, *place_m, VELOCITY_M_S))
            };
            places_m.iter().map(at).collect::<Vec<_>>()
        };
        let still = |place_m: &f64| one.error_m(method, &Set::still(method, *place_m));
        Self {
            none: frames(&none),
            one: frames(&one),
            still_m: places_m.iter().map(still).collect(),
            places_m,
            method,
        }
    }

    /// Errors at every place, m.
    fn errors_m(&self, ratio: f64) -> Vec<f64> {
        let rows = self.places_m.iter().zip(&self.still_m).zip(self.none.iter().zip(&self.one));
        rows.map(|((place_m, still_m), (none, one))| {
            let frames: Vec<f64> = none.iter().zip(one).map(|(a, b)| a + ratio * (b - a)).collect();
            self.method.error_m(&frames, *place_m, FREQUENCY_HZ) - still_m
        })
        .collect()
    }
}

fn of_curve(errors_m: &[f64]) -> [f64; 2] {
    let errors_m = without_mean(errors_m);
    [rms(&errors_m), span(&errors_m)]
}

fn four_numbers(one: [f64; 2], other: [f64; 2]) -> [f64; 4] {
    [one[0], one[1], other[0], other[1]]
}

/// Where a run's measurements lie on the curve, and a normal deviate for each.
type Run = Vec<(usize, f64)>;

fn drawn_runs(places: usize) -> Vec<Run> {
    let mut draws = Draws::of(SEED, RUNS_STREAM);
    let mut run = |_| {
        let first = (EVERY as f64 * draws.even()) as usize;
        let on: Vec<usize> = (first..places).step_by(EVERY).collect();
        let deviates = draws.normal(on.len());
        on.into_iter().zip(deviates).collect()
    };
    (0..RUNS).map(&mut run).collect()
}

/// Means over runs of a run's RMS and range, m, with a random error added.
fn of_runs(errors_m: &[f64], runs: &[Run], random_m: f64) -> [f64; 2] {
    let of = |run: &Run| {
        of_curve(
            &run.iter().map(|(place, deviate)| errors_m[*place] + random_m * deviate).collect::<Vec<_>>(),
        )
    };
    let all: Vec<[f64; 2]> = runs.iter().map(of).collect();
    [0, 1].map(|number| mean(&all.iter().map(|one| one[number]).collect::<Vec<_>>()))
}

/// A free number, and the errors, m, that it makes of both methods at every place.
type Tried = [(f64, [Vec<f64>; 2])];

fn by_curve(tried: &Tried) -> Vec<Trial> {
    let numbers = |[a, b]: &[Vec<f64>; 2]| four_numbers(of_curve(a), of_curve(b));
    tried.iter().map(|(free, errors_m)| (*free, None, numbers(errors_m))).collect()
}

fn by_runs(tried: &Tried, runs: &[Run], random_m: f64, free: Option<f64>) -> Vec<Trial> {
    let numbers =
        |[a, b]: &[Vec<f64>; 2]| four_numbers(of_runs(a, runs, random_m), of_runs(b, runs, random_m));
    tried.iter().map(|(ratio, errors_m)| (*ratio, free, numbers(errors_m))).collect()
}

fn with_random(tried: &Tried, runs: &[Run]) -> Vec<Trial> {
    let random_m = (0..=RANDOM).map(|n| f64::from(n) * RANDOM_SPACING_M);
    random_m.flat_map(|random_m| by_runs(tried, runs, random_m, Some(random_m))).collect()
}

/// Errors for every ratio, with the correlation of `waveform`.
fn falling(methods: &[Method; 2], waveform: &Conditions) -> Vec<(f64, [Vec<f64>; 2])> {
    let curves = [Curves::of(&methods[0], waveform), Curves::of(&methods[1], waveform)];
    let ratios = (0..=RATIOS).map(|n| f64::from(n) * RATIO_SPACING);
    ratios.map(|ratio| (ratio, [curves[0].errors_m(ratio), curves[1].errors_m(ratio)])).collect()
}

/// The least and largest ratio that is fitted to the curves under one of `waveforms`: `None` without any.
pub fn ratios(methods: &[Method; 2], waveforms: &[Conditions]) -> Option<(f64, f64)> {
    let fitted = |waveform| Some(Fit::best("", &by_curve(&falling(methods, waveform)))?.free?[0]);
    waveforms.iter().filter_map(fitted).fold(None, |ends, ratio| {
        let (low, high) = ends.unwrap_or((ratio, ratio));
        Some((low.min(ratio), high.max(ratio)))
    })
}

/// Falloff with the ratio of two square waves, π²/8, and nothing free.
pub fn square_waves(methods: &[Method; 2]) -> Fit {
    let [four, wdft] = methods
        .each_ref()
        .map(|method| of_curve(&Curves::of(method, &Conditions::table_1()).errors_m(SQUARE_WAVES_RATIO)));
    Fit::fixed(
        "falloff; two square waves, ratio \u{3c0}\u{b2}/8 = 1.23; nothing free",
        four_numbers(four, wdft),
    )
}

/// The least ratio of constant to modulated light at which nowhere in its cycle the waveform of `conditions` is negative: its depth.
pub fn least_ratio(conditions: &Conditions) -> f64 {
    let angles = (0..ANGLES).map(|n| TAU * f64::from(n) / f64::from(ANGLES));
    -angles.map(|angle_rad| conditions.correlation.at(angle_rad)).fold(f64::INFINITY, f64::min)
}

/// All hypotheses, from the one without free numbers on.
pub fn fits(methods: &[Method; 2]) -> Vec<Fit> {
    let falling = falling(methods, &Conditions::table_1());
    // Without falloff a longer frame period is a faster target, but for the static error.
    let plain_m = |method: &Method, velocity_m_s| -> Vec<f64> {
        let camera = Camera::new(Conditions::table_1());
        error_curve(&camera, method, velocity_m_s).into_iter().map(|point| point.1).collect()
    };
    let factors = (0..=FACTORS).map(|n| 1.0 + f64::from(n) * FACTOR_SPACING);
    let of_factor =
        |factor: f64| [0, 1].map(|number: usize| plain_m(&methods[number], factor * VELOCITY_M_S));
    let slower: Vec<(f64, [Vec<f64>; 2])> = factors.map(|factor| (factor, of_factor(factor))).collect();
    let runs = drawn_runs(places_m().len());
    // The first factor is 1.
    let fixed = by_curve(&slower[..1]).into_iter();
    let fixed = fixed.map(|trial| Fit::fixed("no falloff within a set; nothing free", trial.2));
    let fitted = [
        Fit::best("falloff; ratio of constant to modulated light", &by_curve(&falling)),
        Fit::best(
            "the same, RMS and range of each run instead of the curve",
            &by_runs(&falling, &runs, 0.0, None),
        ),
        Fit::best("the same, and a random error", &with_random(&falling, &runs)),
        Fit::best("no falloff; factor on the frame period", &by_curve(&slower)),
        Fit::best("the same, of each run, and a random error", &with_random(&slower, &runs)),
    ];
    fixed.chain(fitted.into_iter().flatten()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// That frames are linear in the ratio, on which the fit rests: against a whole simulation at another ratio.
    #[test]
    fn two_ratios_tell_all() {
        for method in Method::both().unwrap() {
            let errors_m = Curves::of(&method, &Conditions::table_1()).errors_m(2.2);
            let camera = Camera::new(with_falloff(2.2));
            let whole: Vec<f64> = error_curve(&camera, &method, VELOCITY_M_S).iter().map(|p| p.1).collect();
            let apart =
                without_mean(&errors_m).iter().zip(&whole).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-12, "{apart}");
        }
    }

    #[test]
    fn what_was_measured_has_no_chi_squared_and_one_error_away_has_one() {
        let measured = MEASURED.map(|measured| measured.value);
        assert_eq!(chi_squared(&measured), 0.0);
        let [a, b, c, d] = measured;
        assert!((chi_squared(&[a, b + 0.007, c, d]) - 1.0).abs() < 1e-9);
    }
}
