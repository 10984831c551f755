//! Errors that all samples of a set share, and all of a frame: of the encoder's reading, and, where frames jitter, of their phases and times.
//!
//! With errors of variances V beside white noise the inverse covariance is 1 - M (1 / V + M' M)^-1 M' (Woodbury 1950), M what a unit of each error does.

use super::common_phase::CommonPhase;
use super::gram::Whitened;
use crate::diagnose::tangents::columns::OWN;
use crate::widest::widest;
use nalgebra::{DMatrix, DMatrixView, DMatrixViewMut, DVector, Matrix4, Vector4};

/// Standard deviations of what frames are off by at random: of the phase, rad, and of the time, s. An error of 0 is not there.
pub type Jitter = [f64; 2];

/// What a unit of each error does to the pixels of a frame, whitened: of the encoder's reading (m), and of the frame's own errors.
pub fn tangents(
    jitter: Jitter,
    whitened: &Whitened,
    own: &[Vec<f64>; OWN],
    position: Vec<f64>,
) -> Vec<Vec<f64>> {
    let mut errors = vec![position];
    if jitter[0] > 0.0 {
        errors.push(own[1].iter().map(|own| own / whitened.frame.times).collect());
    }
    if jitter[1] > 0.0 {
        errors.push(errors[0].iter().map(|by_m| whitened.velocity_m_s * by_m).collect());
    }
    errors
}

/// Errors of a set of so many `frames`.
pub fn count(jitter: Jitter, frames: usize) -> usize {
    1 + frames * of_frame(jitter)
}

/// Errors that a frame has for itself.
fn of_frame(jitter: Jitter) -> usize {
    jitter.iter().filter(|sigma| **sigma > 0.0).count()
}

/// Where the errors of a `frame` stand among those of its set: first that of the reading, then each frame's own.
pub fn places(jitter: Jitter, frame: usize) -> impl Iterator<Item = usize> {
    let own = of_frame(jitter);
    std::iter::once(0).chain((0..own).map(move |number| 1 + frame * own + number))
}

/// Sums over the frames of a set.
#[derive(Debug, Clone, Default)]
pub struct SetErrors {
    /// The errors against each other.
    square: DMatrix<f64>,
    /// The errors against the pixels' own numbers, number after number, error after error.
    own: Vec<f32>,
}

impl SetErrors {
    /// Of so many errors, without any frame.
    pub fn empty(errors: usize, pixels: usize) -> Self {
        Self { square: DMatrix::zeros(errors, errors), own: vec![0.0; errors * OWN * pixels] }
    }

    /// Whether no frame was looked at.
    pub fn is_empty(&self) -> bool {
        self.own.is_empty()
    }

    /// With a frame, by what its errors at these `places` and the pixels' `own` numbers do.
    pub fn add(&mut self, places: &[usize], errors: &[Vec<f64>], own: &[Vec<f64>; OWN]) {
        for (&place, error) in places.iter().zip(errors) {
            for (&other, with) in places.iter().zip(errors) {
                self.square[(place, other)] += error.iter().zip(with).map(|(a, b)| a * b).sum::<f64>();
            }
            let pixels = error.len();
            let sums = &mut self.own[place * OWN * pixels..(place + 1) * OWN * pixels];
            for (sums, own) in sums.chunks_exact_mut(pixels).zip(own) {
                let (own, error) = (&own[..], &error[..]);
                widest!((sums: &'a mut [f32], own: &'a [f64], error: &'a [f64]) {
                    for ((sum, own), error) in sums.iter_mut().zip(own).zip(error) {
                        *sum += (own * error) as f32;
                    }
                });
            }
        }
    }

    /// The errors against the pixels' own numbers, error after error.
    pub fn own(&self) -> impl Iterator<Item = f64> {
        self.own.iter().map(|&own| f64::from(own))
    }

    /// What each error shares with the phase that all pixels have in common.
    pub fn with_common_phase(&self, common: &CommonPhase) -> DVector<f64> {
        let errors = self.square.nrows();
        let each = self.own.len() / errors.max(1);
        DVector::from_fn(errors, |error, _| {
            common.with(self.own[error * each..(error + 1) * each].iter().copied().map(f64::from))
        })
    }

    /// The errors against each other where the pixels' own numbers, of which these are the `inverses`, give way, but for the phase that all have in `common`,
    /// if that is kept; nothing where none is left of them.
    pub fn left(&self, inverses: &[Matrix4<f64>], common: Option<&CommonPhase>) -> Option<DMatrix<f64>> {
        let (errors, pixels) = (self.square.nrows(), inverses.len());
        if self.is_empty() {
            return None;
        }
        let own = |error: usize, pixel: usize| {
            Vector4::from_fn(|number, _| f64::from(self.own[(error * OWN + number) * pixels + pixel]))
        };
        let mut left = self.square.clone();
        let mut solved = vec![Vector4::zeros(); pixels];
        for error in 0..errors {
            for (pixel, (solved, inverse)) in solved.iter_mut().zip(inverses).enumerate() {
                *solved = inverse * own(error, pixel);
            }
            for other in error..errors {
                let absorbed: f64 =
                    solved.iter().enumerate().map(|(pixel, solved)| own(other, pixel).dot(solved)).sum();
                left[(other, error)] -= absorbed;
                if other > error {
                    left[(error, other)] -= absorbed;
                }
            }
        }
        if let Some(common) = common {
            common.keep(&mut left, &self.with_common_phase(common));
        }
        // What the pixels' own numbers absorb altogether may be less than nothing by rounding.
        for error in (0..errors).filter(|&error| left[(error, error)] <= 0.0).collect::<Vec<_>>() {
            left.row_mut(error).fill(0.0);
            left.column_mut(error).fill(0.0);
        }
        (left.diagonal().max() > 0.0).then_some(left)
    }
}

/// Variances of the errors of a set: of the reading, m², and of its frames.
fn variances(jitter: Jitter, reading_m2: f64, errors: usize) -> DVector<f64> {
    let own: Vec<f64> = jitter.into_iter().filter(|sigma| *sigma > 0.0).map(|sigma| sigma * sigma).collect();
    DVector::from_fn(errors, |error, _| if error == 0 { reading_m2 } else { own[(error - 1) % own.len()] })
}

/// The covariance of errors that are `left` against each other, over the noise's: of the standard deviations `roots`, each in its own units.
fn beside_noise(left: DMatrixView<f64>, roots: &DVector<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(roots.len(), roots.len(), |a, b| {
        roots[a] * left[(a, b)] * roots[b] + if a == b { 1.0 } else { 0.0 }
    })
}

/// Score and information of the reading, of a set whose errors have these `scores` and are `left` against each other, where its frames' own errors are known
/// to be there.
pub fn of_reading(scores: &DVector<f64>, left: &DMatrix<f64>, jitter: Jitter) -> (f64, f64) {
    let frames = left.nrows() - 1;
    if frames == 0 {
        return (scores[0], left[(0, 0)]);
    }
    let roots = variances(jitter, 0.0, frames + 1).map(f64::sqrt).remove_row(0);
    let own = left.view((1, 1), (frames, frames));
    let Some(cholesky) = beside_noise(own, &roots).cholesky() else { return (0.0, 0.0) };
    let reading = left.view((1, 0), (frames, 1)).column(0).component_mul(&roots);
    let share = cholesky.solve(&reading);
    let of_frames = scores.rows(1, frames).component_mul(&roots);
    (scores[0] - share.dot(&of_frames), left[(0, 0)] - share.dot(&reading))
}

/// Takes what a set's errors explain of columns away from these: `sums` (error by column) become those whose products with each other are
/// it. The logarithm of the factor by which the errors raise the determinant of the covariance.
pub fn explained(mut sums: DMatrixViewMut<f64>, left: &DMatrix<f64>, jitter: Jitter, reading_m2: f64) -> f64 {
    let errors = left.nrows();
    let roots = variances(jitter, reading_m2, errors).map(f64::sqrt);
    for (error, root) in roots.iter().enumerate() {
        // An error that nothing is left of has no sums either.
        let root = if left[(error, error)] > 0.0 { *root } else { 0.0 };
        sums.row_mut(error).scale_mut(root);
    }
    let Some(cholesky) = beside_noise(left.as_view(), &roots).cholesky() else {
        sums.fill(0.0);
        return 0.0;
    };
    let lower = cholesky.l_dirty();
    lower.solve_lower_triangular_mut(&mut sums);
    2.0 * (0..errors).map(|error| lower[(error, error)].ln()).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    /// Two frames of forty samples with errors of a reading, of phases and of times: products of columns by the inverse covariance, written out.
    #[test]
    fn products_are_those_by_the_inverse_of_the_covariance() {
        const SAMPLES: usize = 40;
        let (jitter, reading_m2) = ([0.3, 0.2], 0.04);
        let draws = |seed: u64| Draws::of(seed, 7).normal(SAMPLES);
        let unit: [Vec<f64>; OWN] = std::array::from_fn(|_| vec![0.0; SAMPLES]);
        let mut set = SetErrors::empty(count(jitter, 2), SAMPLES);
        let mut covariance = DMatrix::<f64>::identity(2 * SAMPLES, 2 * SAMPLES);
        let mut columns = DMatrix::<f64>::zeros(2 * SAMPLES, 2);
        let mut sums = DMatrix::<f64>::zeros(count(jitter, 2), 2);
        let mut position = DVector::<f64>::zeros(2 * SAMPLES);
        for frame in 0..2 {
            let seed = 10 * frame as u64;
            let errors: Vec<Vec<f64>> = (1..4).map(|n| draws(seed + n)).collect();
            let places: Vec<usize> = places(jitter, frame).collect();
            set.add(&places, &errors, &unit);
            let column: Vec<Vec<f64>> = (5..7).map(|n| draws(seed + n)).collect();
            for sample in 0..SAMPLES {
                let row = frame * SAMPLES + sample;
                position[row] = errors[0][sample];
                for n in 0..2 {
                    columns[(row, n)] = column[n][sample];
                    for (&place, error) in places.iter().zip(&errors) {
                        sums[(place, n)] += error[sample] * column[n][sample];
                    }
                }
            }
            for (sigma, error) in jitter.iter().zip(&errors[1..]) {
                let mut all = DVector::zeros(2 * SAMPLES);
                (0..SAMPLES).for_each(|sample| all[frame * SAMPLES + sample] = error[sample]);
                covariance += sigma * sigma * &all * all.transpose();
            }
        }
        let left = set.left(&vec![Matrix4::identity(); SAMPLES], None).unwrap();
        let by_reading = covariance.clone().try_inverse().unwrap() * &position;
        let (score, information) = of_reading(&sums.column(0).into_owned(), &left, jitter);
        assert!((score - by_reading.dot(&columns.column(0))).abs() < 1e-9 * information.sqrt());
        assert!((information - by_reading.dot(&position)).abs() < 1e-9 * information);
        covariance += reading_m2 * &position * position.transpose();
        let exact = columns.transpose() * covariance.clone().try_inverse().unwrap() * &columns;
        let freedom = explained(sums.as_view_mut(), &left, jitter, reading_m2);
        let found = columns.transpose() * &columns - sums.transpose() * &sums;
        assert!((found - &exact).amax() < 1e-9 * exact.amax());
        assert!((freedom - covariance.determinant().ln()).abs() < 1e-9);
    }
}
