//! The fit of the full forward model: the pixels' own numbers and the effects' parameters together, by Gauss and Newton.

use super::gram::{Gram, Whitened};
use super::noise::Noise;
use super::projected::Projected;
use super::settling::settled;
use super::split::split_anew;
use super::start::linear;
use super::stride::{Stride, bounded_step, is_shape};
use super::watchdog::{ENOUGH, descend};
use crate::diagnose::periodic::lines::Series;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::columns::{Column, Tangents};
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::Pixels;
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// A fitted model.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The pixels, with their own numbers.
    pub pixels: Arc<Pixels>,
    /// The effects, with their values.
    pub pieces: Vec<Piece>,
    /// The fitted parameters, in the order of `covariance`.
    pub columns: Vec<Column>,
    /// Covariance of the fitted parameters, with all other numbers free.
    pub covariance: DMatrix<f64>,
    /// Chi squared, with the sets' common position errors taken out, what their freedom costs, the logarithms of the noise's variances, and what is
    /// `beyond`: minus twice the logarithm of the likelihood, but for a constant.
    pub chi2: f64,
    /// What residuals of many standard deviations have beyond what they count as.
    pub beyond: f64,
    /// By how much a further step would lower what is left, the pixels' own numbers' part included, which `chi2` is without: next to nothing where the
    /// fit has come to an end.
    pub unreached: f64,
    /// Samples.
    pub samples: usize,
    /// Variance of the encoder's reading, m².
    pub jitter_m2: f64,
    /// What frames and sets still share.
    pub series: Series,
}

/// Which sets count, by their numbers.
type Counts<'a> = &'a (dyn Fn(usize) -> bool + Sync);

/// The pixels' own numbers from a linear fit of the fundamental, led by steps to where the effects that the camera includes are there.
fn start(data: &Data, noise: Noise, counts: Counts) -> Arc<Pixels> {
    let pixels = linear(data, counts);
    let is_far = || Round::new(data, &pixels, &[], noise, counts).is_far();
    if data.takes.iter().all(|take| take.included.is_empty()) || !is_far() {
        return pixels;
    }
    APPROACH.into_iter().fold(pixels, |pixels, share| {
        let part = data.with_share_of_included(share);
        settled(&part, &pixels, None, SETTLINGS, &[], noise, counts)
    })
}

/// Of what the camera includes, or of effects that are known, so much is there at each step; how often pixels are settled at each.
const APPROACH: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// Residuals count as 4 standard deviations at most, so that a pixel that is far off moves by steps.
const SETTLINGS: usize = 8;

/// The pixels' own numbers beside `pieces` that are known, from nothing but `data`: led by steps to where the effects are as strong as that.
pub fn beside(data: &Data, pieces: &[Piece], noise: Noise) -> Arc<Pixels> {
    let near = APPROACH.into_iter().fold(start(data, noise, &|_| true), |pixels, share| {
        let pieces: Vec<Piece> = pieces.iter().map(|piece| piece.with_share(share)).collect();
        settled(data, &pixels, None, SETTLINGS, &pieces, noise, &|_| true)
    });
    let anew = split_anew(data, &near, pieces);
    anew.map_or(near, |anew| settled(data, &Arc::new(anew), None, SETTLINGS, pieces, noise, &|_| true))
}

/// Iterations of Gauss and Newton at most: the pixels' own numbers start close, a response that is far from linear does not.
const ITERATIONS: usize = 12;
/// A step that makes the sum of squares so many times greater is not taken: another [stride](Stride) is.
const WORSE: f64 = 1.01;
/// A step that promises to take away so much is not refused before the pixels have settled.
const UNSETTLED: f64 = 100.0;
/// Near the noise all steps that are still to come are taken to lower chi squared by so many times what the next one promises at most.
pub const HOPE: f64 = 3.0;

/// Where the sum of squares is so many times the samples, the mismatch is far above the noise: the pixels' own numbers are settled before a
/// step is judged.
const FAR: f64 = 1.5;

impl Fit {
    /// Standard deviation of the fitted parameter in `column`.
    pub fn sigma(&self, column: usize) -> f64 {
        self.covariance[(column, column)].max(0.0).sqrt()
    }

    /// The column of a piece's parameter, by their numbers; nothing where that is not fitted.
    pub fn column_of(&self, piece: usize, parameter: usize) -> Option<usize> {
        self.columns.iter().position(|column| (column.piece, column.parameter) == (piece, parameter))
    }

    /// Its pieces but for those of the effect called `name`.
    pub fn pieces_without(&self, name: &str) -> Vec<Piece> {
        self.pieces.iter().filter(|piece| piece.effect.name != name).cloned().collect()
    }

    /// Chi squared that it leaves; what a further step promises to take away counts against it.
    pub fn left(&self) -> f64 {
        self.chi2 + self.unreached
    }

    /// What it leaves, and the numbers that it has, nats.
    pub fn cost(&self) -> f64 {
        0.5 * self.left() + self.columns.len() as f64
    }

    /// Chi squared of residuals as they count: what is explained of that is what shares and tolerances are of.
    pub fn counted(&self) -> f64 {
        self.chi2 - self.beyond
    }

    /// Whether what it leaves is far above the noise.
    pub fn is_far(&self) -> bool {
        self.counted() > FAR * self.samples as f64
    }

    /// Whether `other` explains more of what this one leaves than the noise of its samples.
    pub fn is_far_from(&self, other: &Self) -> bool {
        self.counted() - other.counted() > self.samples as f64
    }
}

/// So many steps downhill that each take away less than this share of what they promise are the end: down a long and bent valley many are, and little
/// comes of them.
const CREEPING: (usize, f64) = (2, 0.01);
/// Where a step took away this share of what it promised the next one is damped less.
const KEPT: f64 = 0.5;
/// By at least this share a step far from the minimum must lower the sum of squares for another one to be taken.
const SLOW: f64 = 1e-3;

/// Fits `pieces` from their values on, with the pixels of `from` or from scratch, to the sets of which `counts` is true.
pub fn fit(data: &Data, from: Option<&Fit>, pieces: Vec<Piece>, noise: Noise, counts: Counts) -> Fit {
    let pixels = from.map_or_else(|| start(data, noise, counts), |fit| Arc::clone(&fit.pixels));
    Model::begun(data, pixels, pieces, noise, counts).fitted(data, noise, counts, WHOLE)
}

/// The same from where a part of the sets `led` it, pixels and pieces, if that fits all sets better than `from`: where effects are weak, what a part says of the
/// pixels is too noisy to begin with. To its `end`.
pub fn fit_led(data: &Data, from: &Fit, pieces: Vec<Piece>, led: Option<Led>, noise: Noise, end: End) -> Fit {
    let begun = |(pixels, pieces): Led| Model::begun(data, pixels, pieces, noise, &|_| true);
    let led = led.map(begun).filter(|model| model.round.left() < from.left());
    let start = led.unwrap_or_else(|| begun((Arc::clone(&from.pixels), pieces)));
    start.fitted(data, noise, &|_| true, end)
}

/// Pixels and pieces beside each other.
pub type Led = (Arc<Pixels>, Vec<Piece>);

/// The same from the pixels of `from` on, to all sets, given up where its [cost](Fit::cost) will clearly stay beyond `most`: what comes then costs more than
/// that, and no more is known of it.
pub fn fit_below(data: &Data, from: &Fit, pieces: Vec<Piece>, noise: Noise, most: f64) -> Fit {
    fit_led(data, from, pieces, None, noise, End { most, ..WHOLE })
}

/// The same from the pixels of `from` on, to the sets of which `counts` is true, to its `end`.
pub fn fit_until(data: &Data, from: &Fit, pieces: Vec<Piece>, noise: Noise, counts: Counts, end: End) -> Fit {
    let start = Model::begun(data, Arc::clone(&from.pixels), pieces, noise, counts);
    start.fitted(data, noise, counts, end)
}

/// Where a fit ends.
#[derive(Clone, Copy)]
pub struct End {
    /// A further step would take away less of chi squared.
    pub enough: f64,
    /// Nor would it take away this share of what pieces have taken of so much.
    pub share_of: (f64, f64),
    /// It will cost more than so many nats.
    pub most: f64,
}

/// Where a fit ends that is gone on with as long as steps take anything away.
pub const WHOLE: End = End { enough: ENOUGH, share_of: (0.0, 0.0), most: f64::INFINITY };
/// Where one ends that takes no step.
pub const AS_IT_IS: End = End { enough: f64::INFINITY, ..WHOLE };

/// A model, and the normal equations around it.
struct Model {
    pixels: Arc<Pixels>,
    pieces: Vec<Piece>,
    round: Round,
    /// The step to it.
    came_by: Stride,
    /// It took away a good part of what was promised.
    kept: bool,
    /// It led downhill; not where the fit began.
    came_down: bool,
    /// Far from any minimum, what hardly moves will not come there.
    is_stuck: bool,
    /// So many steps one after the other, none of which could climb, took away next to nothing of what they promised.
    crept: usize,
}

impl Model {
    /// Where a fit of `pieces` begins.
    fn begun(data: &Data, pixels: Arc<Pixels>, pieces: Vec<Piece>, noise: Noise, counts: Counts) -> Self {
        let mut pieces: Vec<Piece> =
            pieces.into_iter().map(|piece| Piece { finite: false, ..piece }).collect();
        free_shapes(&mut pieces);
        let round = Round::new(data, &pixels, &pieces, noise, counts);
        let (came_by, kept, came_down, is_stuck, crept) = (Stride::Whole, true, false, false, 0);
        Self { pixels, pieces, round, came_by, kept, came_down, is_stuck, crept }
    }

    /// Where it ends.
    fn fitted(self, data: &Data, noise: Noise, counts: Counts, end: End) -> Fit {
        let End { enough, share_of: (share, of), most } = end;
        let is_enough = |here: &Self| here.round.gain < enough.max(share * (of - here.round.left()));
        let step = |here: &Self, may_climb: bool| {
            // Shapes are fitted from the second step on only, on a hill nothing is known of the valley behind it, and far from the data steps promise too little.
            let is_hopeless = here.came_down && !here.round.is_far() && here.round.hoped() > most;
            let is_there = here.is_stuck || here.crept == CREEPING.0 || is_hopeless || is_enough(here);
            if is_there { None } else { here.stepped(may_climb, data, noise, counts) }
        };
        descend(self, ITERATIONS, enough, &step, &|model| model.round.left()).end()
    }

    /// After the first step, of all [strides](Stride), that does not lead uphill, or, where it `may_climb`, not far; nothing where there is none, or none is
    /// worth it.
    fn stepped(&self, may_climb: bool, data: &Data, noise: Noise, counts: Counts) -> Option<Self> {
        // What has no shape has no other step with it held.
        let is_another =
            |stride: &Stride| *stride != Stride::ShapesHeld || self.round.has_shapes(&self.pieces);
        self.came_by.and_after(self.kept).filter(is_another).find_map(|stride| {
            let theta = self.round.theta(&self.pixels, &self.pieces, stride);
            let (mut pixels, pieces) = self.round.step(&self.pixels, self.pieces.clone(), &theta);
            let settle = |pixels: &Arc<Pixels>| {
                settled(data, pixels, Some(&self.pixels), SETTLINGS, &pieces, noise, counts)
            };
            if self.round.is_far() {
                pixels = settle(&pixels);
            }
            let mut round = Round::new(data, &pixels, &pieces, noise, counts);
            let takes = |round: &Round| match may_climb {
                true => round.loss() <= WORSE * self.round.loss() && round.left().is_finite(),
                false => round.left() <= self.round.left(),
            };
            let mut is_taken = takes(&round);
            // What pixels nearly absorb is large where it shows little: what is wrong with the step may be theirs.
            let may_be_pixels = round.loss() > self.round.loss() || !round.loss().is_finite();
            if !is_taken && may_be_pixels && !self.round.is_far() && self.round.gain > UNSETTLED {
                pixels = settle(&pixels);
                round = Round::new(data, &pixels, &pieces, noise, counts);
                is_taken = takes(&round);
            }
            // Where the strengths are as they fit best beside the shapes, that is no step.
            is_taken &= stride != Stride::ShapesHeld || round.left() + ENOUGH < self.round.left();
            let is_slow = round.loss() > (1.0 - SLOW) * self.round.loss();
            let is_stuck = is_slow && round.is_far();
            let came_down = round.left() <= self.round.left();
            let share = (self.round.left() - round.left()) / self.round.promise(&theta);
            let (kept, crawls) = (share > KEPT, !may_climb && share < CREEPING.1);
            let (came_by, crept) = (stride, if crawls { self.crept + 1 } else { 0 });
            let there = Self { pixels, pieces, round, came_by, kept, came_down, is_stuck, crept };
            is_taken.then_some(there)
        })
    }

    fn end(self) -> Fit {
        let Self { pixels, pieces, round, .. } = self;
        let Round { columns, projected, covariance, gain, samples, series, beyond, .. } = round;
        let Projected { chi2, jitter_m2, .. } = projected;
        Fit { pixels, pieces, columns, covariance, chi2, beyond, unreached: gain, samples, jitter_m2, series }
    }
}

/// One step of Gauss and Newton from `fit` for the sets of which `counts` is true.
pub fn improved(data: &Data, fit: &Fit, noise: Noise, counts: Counts) -> (Arc<Pixels>, Vec<Piece>) {
    let round = Round::new(data, &fit.pixels, &fit.pieces, noise, counts);
    round.step(&fit.pixels, fit.pieces.clone(), &round.theta)
}

/// What `pieces` leave, chi squared, when their strengths, beside shapes that are held, and all that else is `fitted` follow by a step, of which a model is nearly linear; and they themselves.
pub fn at_shapes(data: &Data, fitted: &Fit, pieces: Vec<Piece>, noise: Noise) -> (f64, Vec<Piece>) {
    let round = |pixels: &Arc<Pixels>, pieces: &[Piece]| Round::new(data, pixels, pieces, noise, &|_| true);
    let before = round(&fitted.pixels, &pieces);
    let theta = before.theta(&fitted.pixels, &pieces, Stride::ShapesHeld);
    let (pixels, pieces) = before.step(&fitted.pixels, pieces, &theta);
    (round(&pixels, &pieces).left(), pieces)
}

/// The normal equations around a model, solved.
struct Round {
    columns: Vec<Column>,
    projected: Projected,
    theta: DVector<f64>,
    covariance: DMatrix<f64>,
    /// By how much the step lowers chi squared.
    gain: f64,
    /// Sum of squares of the whitened residual here.
    square: f64,
    /// What residuals have beyond what they count as.
    beyond: f64,
    samples: usize,
    series: Series,
}

impl Round {
    fn new(data: &Data, pixels: &Arc<Pixels>, pieces: &[Piece], noise: Noise, counts: Counts) -> Self {
        let (tangents, columns) = Tangents::new(data, pixels, pieces, &[]);
        let visit = |series: Series, whitened: &Whitened| series.with(data, whitened);
        let (gram, series) = Gram::visited(data, &tangents, noise, counts, &visit, &Series::and);
        let projected = gram.project(None);
        let (theta, covariance) =
            bounded_step(&projected, &columns, pieces, pixels.full_scale_dn, Stride::Whole);
        let gain = projected.settled + theta.dot(&projected.vector);
        let Gram { chi2: square, beyond, samples, .. } = gram;
        Self { columns, projected, theta, covariance, gain, square, beyond, samples, series }
    }

    /// What there is to be made small, but for what sets share.
    fn loss(&self) -> f64 {
        self.square + self.beyond
    }

    fn is_far(&self) -> bool {
        self.square > FAR * self.samples as f64
    }

    /// What is left before the step, with the sets' common position errors taken out: what a step promises to take away need not go.
    fn left(&self) -> f64 {
        self.projected.chi2 + self.projected.settled
    }

    /// What the fit will cost, nats, if steps take away more than they promise, and all that residuals have beyond what they count as.
    fn hoped(&self) -> f64 {
        0.5 * (self.left() - HOPE * self.gain - self.beyond) + self.columns.len() as f64
    }

    fn has_shapes(&self, pieces: &[Piece]) -> bool {
        self.columns.iter().any(|column| is_shape(column, pieces))
    }

    /// The step of all numbers by the `stride`.
    fn theta(&self, pixels: &Pixels, pieces: &[Piece], stride: Stride) -> DVector<f64> {
        match stride {
            Stride::Whole => self.theta.clone(),
            _ => bounded_step(&self.projected, &self.columns, pieces, pixels.full_scale_dn, stride).0,
        }
    }

    /// By how much a step `theta` should lower chi squared, the pixels' own numbers' part included.
    fn promise(&self, theta: &DVector<f64>) -> f64 {
        let Projected { matrix, vector, settled, .. } = &self.projected;
        settled + 2.0 * theta.dot(vector) - theta.dot(&(matrix * theta))
    }

    /// `pixels` and `pieces`, moved by the step `theta`.
    fn step(
        &self,
        pixels: &Pixels,
        mut pieces: Vec<Piece>,
        theta: &DVector<f64>,
    ) -> (Arc<Pixels>, Vec<Piece>) {
        let pixels = Arc::new(self.projected.moved(pixels, theta, 1.0));
        for (column, step) in self.columns.iter().zip(theta.iter()) {
            let piece = &mut pieces[column.piece];
            let parameter = &piece.effect.parameters[column.parameter];
            let (low, high) = piece.bounds_within(column.parameter, pixels.full_scale_dn);
            let value = &mut piece.values[column.parameter];
            // A shape moves by a third of itself at most: its tangent holds nearby.
            let most = if parameter.is_shape() { value.abs() / 3.0 } else { f64::INFINITY };
            *value = (*value + step.clamp(-most, most)).clamp(low, high);
        }
        free_shapes(&mut pieces);
        (pixels, pieces)
    }
}

/// Shapes are fitted where there is something that has one.
fn free_shapes(pieces: &mut [Piece]) {
    for piece in pieces {
        let parameters = piece.effect.parameters;
        // What is looked for by itself has no shape.
        let there = parameters.iter().zip(&piece.values).any(|(p, &value)| p.has_shapes() && value != p.off);
        for (number, parameter) in parameters.iter().enumerate() {
            if there && parameter.is_shape() && !parameter.is_choice && !piece.free.contains(&number) {
                piece.free.push(number);
            }
        }
    }
}
