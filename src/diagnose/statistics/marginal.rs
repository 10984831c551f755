//! Marginal likelihood of numbers whose size is not known beforehand, from their score and information.

use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// Of the number that is known least beforehand, least variance, in units of what the recordings say.
const LEAST_PRIOR: f64 = 4.0;
/// So many numbers are many: what fewer cost is hardly other.
const LEAST_MANY: usize = 4;

/// A block in coordinates of its own in which its information is the identity.
#[derive(Debug, Clone)]
pub struct White {
    /// Its directions, of unit information.
    pub basis: DMatrix<f64>,
    /// The whole information times the basis.
    pub informed: DMatrix<f64>,
    /// Their score.
    pub score: DVector<f64>,
    /// How exactly each coordinate is known beforehand, in units of the one that is known least.
    known: Vec<f64>,
    /// What it costs that this was chosen, nats.
    pub choice: f64,
}

impl White {
    /// In the coordinates of a `basis` of unit information. All are known as well beforehand: what is as many standard deviations large is as likely.
    pub fn new(matrix: &DMatrix<f64>, vector: &DVector<f64>, basis: DMatrix<f64>) -> Self {
        let score = basis.tr_mul(vector);
        Self { informed: matrix * &basis, known: vec![1.0; score.len()], choice: 0.0, basis, score }
    }

    /// The same, or, where that is likelier, numbers that are as large a share of their `reach` are as likely beforehand: of many, of which few are
    /// seen well, the others cost little then (the gains of frames, of which one recording has five and another one a hundred).
    pub fn or_alike(self, reach: &dyn Fn(usize) -> f64) -> Self {
        let scaled = DMatrix::from_fn(self.basis.nrows(), self.basis.ncols(), |row, number| {
            let value = self.basis[(row, number)];
            if value == 0.0 { 0.0 } else { value / reach(row) }
        });
        let precision = scaled.tr_mul(&scaled);
        let least = |known: &DVector<f64>| known.iter().copied().fold(f64::INFINITY, f64::min);
        let eigen = precision.symmetric_eigen();
        let least = least(&eigen.eigenvalues);
        if self.score.len() < LEAST_MANY || !(least > 0.0 && least.is_finite()) {
            return self;
        }
        let turn = &eigen.eigenvectors;
        let alike = Self {
            basis: &self.basis * turn,
            informed: &self.informed * turn,
            score: turn.tr_mul(&self.score),
            known: eigen.eigenvalues.iter().map(|known| known / least).collect(),
            choice: 0.0,
        };
        let of = |white: &Self| {
            let size = white.score.len();
            ln_marginal(
                &DMatrix::identity(size, size),
                &white.score,
                std::slice::from_ref(&(0..size)),
                &[white],
            )
        };
        let [one, other] = [of(&self), of(&alike)];
        // Either is as likely.
        let choice = -(-(one - other).abs()).exp().ln_1p() + std::f64::consts::LN_2;
        Self { choice, ..if other > one { alike } else { self } }
    }

    /// What its directions, of unit information, have in common with another one's.
    pub fn shared_with(&self, other: &Self) -> DMatrix<f64> {
        self.basis.tr_mul(&other.informed)
    }
}

/// Logarithm of the marginal likelihood of blocks together, each at its place `of` the information `inner` and the `score`, with the variance of its
/// numbers before that is likeliest.
pub fn ln_marginal(inner: &DMatrix<f64>, score: &DVector<f64>, of: &[Range<usize>], parts: &[&White]) -> f64 {
    let start = |part: &&White| {
        let weighed = part.score.iter().zip(&part.known).map(|(score, known)| score * score / known);
        let weights: f64 = part.known.iter().map(|known| known.recip()).sum();
        (weighed.sum::<f64>() / weights).max(LEAST_PRIOR)
    };
    let mut prior: Vec<f64> = parts.iter().map(start).collect();
    let mut ln_marginal = f64::NEG_INFINITY;
    for _ in 0..4 {
        let mut posterior = inner.clone();
        let mut ln_prior = 0.0;
        for ((range, part), prior) in of.iter().zip(parts).zip(&prior) {
            for (n, known) in range.clone().zip(&part.known) {
                posterior[(n, n)] += known / prior;
                ln_prior += (prior / known).ln();
            }
        }
        let Some(cholesky) = posterior.cholesky() else { return f64::NEG_INFINITY };
        let theta = cholesky.solve(score);
        let inverse = cholesky.inverse();
        let ln_determinant = 2.0 * cholesky.l().diagonal().iter().map(|d| d.ln()).sum::<f64>();
        ln_marginal = 0.5 * score.dot(&theta) - 0.5 * (ln_determinant + ln_prior);
        for ((range, part), prior) in of.iter().zip(parts).zip(&mut prior) {
            let square = |(n, known): (usize, &f64)| known * (theta[n] * theta[n] + inverse[(n, n)]);
            let squares: f64 = range.clone().zip(&part.known).map(square).sum();
            *prior = (squares / range.len() as f64).max(LEAST_PRIOR);
        }
    }
    ln_marginal
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of these standard deviations, of values as large as these, with as great a reach each.
    fn of(sigmas: &[f64], values: &[f64]) -> White {
        let information: Vec<f64> = sigmas.iter().map(|sigma| sigma.powi(-2)).collect();
        let vector = DVector::from_iterator(values.len(), information.iter().zip(values).map(|(i, v)| i * v));
        let basis = DMatrix::from_diagonal(&DVector::from_column_slice(sigmas));
        let matrix = DMatrix::from_diagonal(&DVector::from_vec(information));
        White::new(&matrix, &vector, basis).or_alike(&|_| 1.0)
    }

    fn ln_of(white: &White) -> f64 {
        let size = white.score.len();
        let inner = DMatrix::identity(size, size);
        ln_marginal(&inner, &white.score, std::slice::from_ref(&(0..size)), &[white]) - white.choice
    }

    #[test]
    fn numbers_that_are_hardly_seen_cost_little_beside_those_that_are_seen_well() {
        // Four gains of ten standard deviations, and sixty of one frame each whose noise is thirty times as great.
        let sigmas: Vec<f64> = (0..64).map(|n| if n < 4 { 0.1 } else { 3.0 }).collect();
        let values: Vec<f64> = (0..64).map(|n| if n < 4 { 1.0 } else { 0.0 }).collect();
        let white = of(&sigmas, &values);
        assert!(white.known[63].max(white.known[0]) > 800.0, "{:?}", white.known);
        let four = ln_of(&of(&sigmas[..4], &values[..4]));
        assert!((ln_of(&white) - four).abs() < 4.0, "{} and {four}", ln_of(&white));
        // Had all the same chance beforehand, those that are nothing would cost more than half of what the four say, 200 nats.
        let even = White { known: vec![1.0; 64], choice: 0.0, ..white };
        assert!(ln_of(&even) < 0.6 * four, "{}", ln_of(&even));
    }

    #[test]
    fn numbers_that_are_as_clear_are_as_likely() {
        // Each is five standard deviations large, be it seen well or not.
        let sigmas: Vec<f64> = (0..20).map(|n| 0.1 * 1.3_f64.powi(n)).collect();
        let values: Vec<f64> = sigmas.iter().map(|sigma| 5.0 * sigma).collect();
        let white = of(&sigmas, &values);
        assert_eq!(white.known, [1.0; 20]);
        assert!(white.choice > 0.69 && white.choice < 0.694, "{}", white.choice);
        // ln Z = 1/2 s^2 u^2 / (1 + s^2) - 1/2 ln(1 + s^2) each, with the variance s^2 = u^2 - 1 at which it is greatest.
        let exact = 20.0 * (0.5 * 24.0 - 0.5 * 25.0_f64.ln());
        assert!((ln_of(&white) + white.choice - exact).abs() < 0.01 * exact, "{}", ln_of(&white));
    }

    #[test]
    fn numbers_as_well_seen_are_alike_in_both() {
        let white = of(&[0.5; 6], &[1.0, -1.0, 2.0, 0.5, -1.5, 1.0]);
        assert!(white.choice.abs() < 1e-9, "{}", white.choice);
    }
}
