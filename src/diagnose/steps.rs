//! A step over the signal that was taken for a wave over the codes, or for that and a response beside it: a converter's stage, or a pixel that takes ambient light away, switches at one level.

use super::acting::Acting;
use super::columns::{Column, Frame, Tangents};
use super::data::Data;
use super::evidence::VISIBLE;
use super::gram::Gram;
use super::noise::Noise;
use super::overtones::OF_CODES;
use super::search::Found;
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
    let is_curve = |piece: usize| CURVES.contains(&fit.pieces[piece].effect.name);
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
    let (tangents, _) = Tangents::new(data, &fit.pixels, &fit.pieces, &[]);
    let (gram, ()) =
        Gram::with_blocks(data, &tangents, noise, &|_| true, &[LEVELS], &fill, &|(), _| (), &|(), ()| ());
    let mut projected = gram.project(Some(fit.jitter_m2));
    let is_wave = |column: &usize| is_curve(fit.columns[*column].piece);
    projected.give_way((0..fit.columns.len()).filter(|column| !is_wave(column)));
    // As large as the curve is, by parts: its strengths.
    let is_part = |column: &usize| {
        let Column { piece, parameter } = fit.columns[*column];
        is_wave(column) && !fit.pieces[piece].effect.parameters[parameter].is_shape()
    };
    let parts: Vec<usize> = (0..fit.columns.len()).filter(is_part).collect();
    let of = |&column: &usize| {
        let Column { piece, parameter } = fit.columns[column];
        fit.pieces[piece].values[parameter] - fit.pieces[piece].effect.parameters[parameter].off
    };
    let wave = DVector::from_iterator(parts.len(), parts.iter().map(of));
    let steps: Vec<usize> = (0..LEVELS).map(|level| fit.columns.len() + level).collect();
    let (information, score) = (&projected.matrix, &projected.vector);
    let explained = alone(information, score, (&parts, &wave), &steps);
    let seen = |&level: &usize| {
        let step = steps[level];
        information[(step, step)] > VISIBLE * projected.raw[step]
    };
    let step = |&level: &usize| explained.steps[level];
    let best = (0..LEVELS).filter(seen).max_by(|a, b| step(a).total_cmp(&step(b)))?;
    let is_it = step(&best) >= explained.wave && explained.beside[best] < BESIDE * explained.wave;
    is_it.then(|| level_dn(best))
}

/// What each explains.
pub struct Explained {
    /// The wave, where no step is.
    pub wave: f64,
    /// Each step, where the wave is not.
    pub steps: Vec<f64>,
    /// The wave beside each step.
    pub beside: Vec<f64>,
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
