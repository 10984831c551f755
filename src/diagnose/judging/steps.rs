//! A step over the signal that was taken for a wave over the codes, or for that and a response beside it: a converter's stage, or a pixel that takes ambient light away, switches at one level.

use crate::diagnose::fitting::gram::Gram;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::fitting::projected::Projected;
use crate::diagnose::forms::overtones::OF_CODES;
use crate::diagnose::naming::found::Found;
use crate::diagnose::reading::data::Data;
use crate::diagnose::statistics::evidence::VISIBLE;
use crate::diagnose::tangents::acting::Acting;
use crate::diagnose::tangents::columns::{Column, Frame, Tangents};
use nalgebra::{DMatrix, DVector};

/// Levels that are looked at, evenly apart in the signal's root: where most codes are, at a small signal, they are nearer to each other.
const LEVELS: usize = 64;

/// Of what the wave explains, it says less than this share beside a step that was taken for it.
const BESIDE: f64 = 0.25;

/// What is a curve over the signal: a wave, and a response that bends it.
pub const CURVES: [&str; 2] = [OF_CODES, "intensity_nonlinearity"];

/// The level, DN above the pedestal, near which a step explains as much as the curve over the signal that was `found`, and most of what that does, beside
/// all else that was.
pub fn step(data: &Data, found: &Found, noise: Noise) -> Option<f64> {
    let fit = &found.fit;
    let level_dn = |level: usize| {
        let place = (level as f64 + 0.5) / LEVELS as f64;
        place * place * fit.pixels.full_scale_dn
    };
    let fill = |_: usize, _: usize, frame: &Frame| {
        let mut acting = Acting::default();
        for level in 0..LEVELS {
            let least = level_dn(level);
            acting.column(level, frame.base.iter().map(|&dn| f64::from(u8::from(dn > least))).collect());
        }
        vec![acting]
    };
    let OfNamed { projected, parts, sizes } = OfNamed::at(data, found, noise, &CURVES, LEVELS, &fill);
    let steps: Vec<usize> = (0..LEVELS).map(|level| fit.columns.len() + level).collect();
    let (information, score) = (&projected.matrix, &projected.vector);
    let explained = alone(information, score, (&parts, &sizes), &steps);
    let seen = |&level: &usize| {
        let step = steps[level];
        information[(step, step)] > VISIBLE * projected.raw[step]
    };
    explained.stands_for(seen, 0.0).map(level_dn)
}

/// What the samples say of what was named, with what may be in its place, beside all else that was found.
pub struct OfNamed {
    /// Information and score: the fit's columns, and those that may be in its place.
    pub projected: Projected,
    /// The fit's columns of what was named, but for its shapes.
    pub parts: Vec<usize>,
    /// As large as these are.
    pub sizes: DVector<f64>,
}

impl OfNamed {
    /// Of the effects called `names`, with so many columns besides, which `fill` gives by recording, number of the frame in it, and frame.
    pub fn at(
        data: &Data,
        found: &Found,
        noise: Noise,
        names: &[&str],
        columns: usize,
        fill: &(dyn Fn(usize, usize, &Frame) -> Vec<Acting> + Sync),
    ) -> Self {
        let fit = &found.fit;
        let (tangents, _) = Tangents::new(data, &fit.pixels, &fit.pieces, &[]);
        let (gram, ()) =
            Gram::with_blocks(data, &tangents, noise, &|_| true, &[columns], fill, &|(), _| (), &|(), ()| ());
        let mut projected = gram.project(Some(fit.jitter_m2));
        let is_named = |column: &usize| names.contains(&fit.pieces[fit.columns[*column].piece].effect.name);
        projected.give_way((0..fit.columns.len()).filter(|column| !is_named(column)));
        let of = |column: &usize| {
            let Column { piece, parameter } = fit.columns[*column];
            let piece = &fit.pieces[piece];
            (&piece.effect.parameters[parameter], piece.values[parameter])
        };
        let is_part = |column: &usize| is_named(column) && !of(column).0.is_shape();
        let parts: Vec<usize> = (0..fit.columns.len()).filter(is_part).collect();
        let size = |column: &usize| of(column).1 - of(column).0.off;
        let sizes = DVector::from_iterator(parts.len(), parts.iter().map(size));
        Self { projected, parts, sizes }
    }
}

/// What each explains: a wave, or what else was named, and steps.
pub struct Explained {
    /// The wave, where no step is.
    pub wave: f64,
    /// Each step, where the wave is not.
    pub steps: Vec<f64>,
    /// The wave beside each step.
    pub beside: Vec<f64>,
}

impl Explained {
    /// The step, of those that are `seen`, that explains as much as the wave and so `much_more`, and leaves that less than is [its own](BESIDE).
    pub fn stands_for(&self, seen: impl Fn(&usize) -> bool, much_more: f64) -> Option<usize> {
        let steps = (0..self.steps.len()).filter(seen);
        let best = steps.max_by(|&a, &b| self.steps[a].total_cmp(&self.steps[b]))?;
        let is_it = self.steps[best] >= self.wave + much_more && self.beside[best] < BESIDE * self.wave;
        is_it.then_some(best)
    }
}

/// From information and score at a fit that has a wave of these parts: chi squared that the wave, as it is but for its size, and in its place or beside it each
/// step, explains.
pub fn alone(
    information: &DMatrix<f64>,
    score: &DVector<f64>,
    (parts, wave): (&[usize], &DVector<f64>),
    steps: &[usize],
) -> Explained {
    let with_wave = |column: usize| -> f64 {
        parts.iter().zip(wave.iter()).map(|(&part, size)| information[(column, part)] * size).sum()
    };
    let of_wave: f64 = parts.iter().zip(wave.iter()).map(|(&part, size)| size * with_wave(part)).sum();
    let of_step = |&step: &usize| {
        let (of, shared) = (information[(step, step)], with_wave(step));
        if of <= 0.0 {
            return (0.0, 0.0);
        }
        let score = score[step] + shared;
        let own = of_wave - shared * shared / of;
        let beside =
            if own > VISIBLE * of_wave { (of_wave - shared * score / of).powi(2) / own } else { 0.0 };
        (score * score / of, beside)
    };
    let (steps, beside) = steps.iter().map(of_step).unzip();
    Explained { wave: of_wave, steps, beside }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against least squares of each alone, on samples with a wave and a step.
    #[test]
    fn each_explains_what_it_does_alone() {
        let samples = 60;
        let columns = |sample: usize| {
            let x = sample as f64 / samples as f64;
            [(5.0 * x).cos(), (5.0 * x).sin(), f64::from(u8::from(x > 0.3)), f64::from(u8::from(x > 0.6))]
        };
        let design = DMatrix::from_fn(samples, 4, |sample, column| columns(sample)[column]);
        let measured = DVector::from_fn(samples, |sample, _| {
            columns(sample)[0] * 0.7 + columns(sample)[3] + 0.1 * (17.0 * sample as f64).sin()
        });
        let taken = |of: &DMatrix<f64>| {
            let (matrix, vector) = (of.tr_mul(of), of.tr_mul(&measured));
            vector.dot(&matrix.cholesky().unwrap().solve(&vector))
        };
        let wave = design.columns(0, 2).into_owned();
        let fitted = wave.tr_mul(&wave).cholesky().unwrap().solve(&wave.tr_mul(&measured));
        let left = &measured - &wave * &fitted;
        let explained = alone(&design.tr_mul(&design), &design.tr_mul(&left), (&[0, 1], &fitted), &[2, 3]);
        let is = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(is(explained.wave, taken(&wave)));
        for (number, column) in [2, 3].into_iter().enumerate() {
            let step = design.columns(column, 1).into_owned();
            assert!(is(explained.steps[number], taken(&step)));
            let with_wave = DMatrix::from_columns(&[step.column(0).into_owned(), &wave * &fitted]);
            assert!(is(explained.beside[number], taken(&with_wave) - taken(&step)));
        }
    }
}
