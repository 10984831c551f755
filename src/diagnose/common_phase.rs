//! The phase that all pixels have in common, where frames' errors are known to be larger than the noise.
//!
//! The pixels' own numbers are projected out as if the noise were white, and errors that samples of a set share are freed of them set by set. For what a
//! pixel has for itself that is as good as exact. But frames that are off by much move the phases of all pixels together, and so what all other sets leave,
//! too. This one direction is therefore kept out of the projection: it is a column, beside which all others are fitted with the errors' covariance.

use super::columns::OWN;
use nalgebra::{DMatrix, DVector};

/// The pixels' phase among their own numbers.
const PHASE: usize = 1;
/// Errors may take all but this of its square: the rest is rounding.
const LEAST: f64 = 1e-12;

/// A unit of phase of every pixel.
#[derive(Debug, Clone, Copy)]
pub struct CommonPhase {
    /// Its square.
    square: f64,
}

impl CommonPhase {
    /// Of pixels whose phases have these `squares`; nothing where none has any.
    pub fn of(squares: &[f64]) -> Option<Self> {
        let square = squares.iter().sum();
        (square > 0.0).then_some(Self { square })
    }

    /// What shares `own` with the pixels' own numbers (number after number) shares with it.
    pub fn with(own: impl Iterator<Item = f64>, pixels: usize) -> f64 {
        own.skip(PHASE * pixels).take(pixels).sum()
    }

    /// Products of errors from which the pixels' own numbers were taken, `left`, without it among those: by what each error shares `with` it.
    pub fn keep(self, left: &mut DMatrix<f64>, with: &[f64]) {
        for (row, a) in with.iter().enumerate() {
            for (column, b) in with.iter().enumerate() {
                left[(row, column)] += a * b / self.square;
            }
        }
    }

    /// What columns that share `mixed` with the pixels' own numbers share with it, which `solved`, a step of these numbers a column, is freed of.
    pub fn freed(self, mixed: &DMatrix<f64>, solved: &mut DMatrix<f64>) -> DVector<f64> {
        let pixels = mixed.nrows() / OWN;
        let of = |column: usize| Self::with(mixed.column(column).iter().copied(), pixels);
        let with = DVector::from_fn(mixed.ncols(), |column, _| of(column));
        shift(solved, &(-&with / self.square));
        with
    }

    /// The symmetric `full` products of columns with itself as another one, last, which shares `with` each.
    pub fn append(self, full: DMatrix<f64>, with: &DVector<f64>) -> DMatrix<f64> {
        let size = full.nrows();
        let mut appended = full.resize(size + 1, size + 1, self.square);
        appended.view_mut((0, size), (size, 1)).copy_from(with);
        appended.view_mut((size, 0), (1, size)).copy_from(&with.transpose());
        appended
    }

    /// The `full` products without it, which is their last column, where it is fitted, as `solved` then has it. Chi squared that it takes from the last column
    /// but it, the residual.
    pub fn fitted(self, full: &mut DMatrix<f64>, solved: &mut DMatrix<f64>) -> f64 {
        let size = full.nrows() - 1;
        let (pivot, with) = (full[(size, size)], full.view((0, size), (size, 1)).column(0).into_owned());
        full.resize_mut(size, size, 0.0);
        if pivot <= LEAST * self.square {
            return 0.0;
        }
        full.ger(-pivot.recip(), &with, &with, 1.0);
        shift(solved, &(&with / pivot));
        with[size - 1].powi(2) / pivot
    }
}

/// Moves the phases of all pixels by a step for each column.
fn shift(solved: &mut DMatrix<f64>, steps: &DVector<f64>) {
    let pixels = solved.nrows() / OWN;
    for (column, step) in steps.iter().enumerate() {
        solved.column_mut(column).rows_mut(PHASE * pixels, pixels).add_scalar_mut(*step);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    const PIXELS: usize = 5;
    const FRAMES: usize = 6;
    const COLUMNS: usize = 3;
    /// Of the frames' phases, over the noise's: some stand still.
    const VARIANCES: [f64; FRAMES] = [0.0, 0.0, 3.0, 20.0, 0.5, 40.0];

    /// Frames whose phases are off, each a set: what is known of the columns, and of the pixels' phases beside them, is what the whole covariance says,
    /// although sets are looked at one by one. As a part of the projection it is not.
    #[test]
    fn frames_that_are_off_move_no_others() {
        let tangents: Vec<f64> = Draws::of(1, 7).normal(PIXELS).iter().map(|draw| 1.0 + 0.2 * draw).collect();
        let draws = Draws::of(2, 7).normal(FRAMES * PIXELS * COLUMNS);
        let columns = DMatrix::from_vec(FRAMES * PIXELS, COLUMNS, draws);
        let of_pixel = |row: usize, pixel: usize| if row % PIXELS == pixel { tangents[pixel] } else { 0.0 };
        let own = DMatrix::from_fn(FRAMES * PIXELS, PIXELS, of_pixel);
        let of_frame =
            |row: usize, frame: usize| if row / PIXELS == frame { tangents[row % PIXELS] } else { 0.0 };
        let errors = DMatrix::from_fn(FRAMES * PIXELS, FRAMES, of_frame);

        let mut weights = DMatrix::identity(FRAMES * PIXELS, FRAMES * PIXELS);
        for (error, variance) in errors.column_iter().zip(VARIANCES) {
            weights += variance * error * error.transpose();
        }
        let weights = weights.try_inverse().unwrap();
        let phases = (own.transpose() * &weights * &own).try_inverse().unwrap()
            * (own.transpose() * &weights * &columns);
        let exact = columns.transpose() * &weights * (&columns - &own * &phases);

        let squares: Vec<f64> = tangents.iter().map(|tangent| FRAMES as f64 * tangent * tangent).collect();
        let found = |common: Option<CommonPhase>| {
            let mut mixed = DMatrix::zeros(OWN * PIXELS, COLUMNS);
            mixed.rows_mut(PHASE * PIXELS, PIXELS).copy_from(&(own.transpose() * &columns));
            let mut solved = mixed.clone();
            for mut column in solved.column_iter_mut() {
                (0..PIXELS).for_each(|pixel| column[PHASE * PIXELS + pixel] /= squares[pixel]);
            }
            let with = common.map(|common| common.freed(&mixed, &mut solved));
            let mut full = columns.transpose() * &columns - mixed.transpose() * &solved;
            if let (Some(common), Some(with)) = (common, &with) {
                full = common.append(full, with);
            }
            for (error, variance) in errors.column_iter().zip(VARIANCES) {
                let mut shared = DMatrix::zeros(OWN * PIXELS, 1);
                shared.rows_mut(PHASE * PIXELS, PIXELS).copy_from(&(own.transpose() * error));
                let absorbed =
                    (0..PIXELS).map(|pixel| shared[PHASE * PIXELS + pixel].powi(2) / squares[pixel]);
                let mut left = DMatrix::repeat(1, 1, error.norm_squared() - absorbed.sum::<f64>());
                let error = DMatrix::from_column_slice(error.len(), 1, error.as_slice());
                let mut sums = error.transpose() * &columns - shared.transpose() * &solved;
                if let Some(common) = common {
                    let with = [CommonPhase::with(shared.iter().copied(), PIXELS)];
                    common.keep(&mut left, &with);
                    sums = DMatrix::from_row_iterator(1, COLUMNS + 1, sums.iter().copied().chain(with));
                }
                full -= variance / (1.0 + variance * left[(0, 0)]) * sums.transpose() * sums;
            }
            if let Some(common) = common {
                common.fitted(&mut full, &mut solved);
            }
            (full, solved.rows(PHASE * PIXELS, PIXELS).into_owned())
        };
        let (full, solved) = found(CommonPhase::of(&squares));
        assert!((full - &exact).amax() < 1e-12 * exact.amax());
        assert!((solved - &phases).amax() < 1e-12 * phases.amax());
        let (full, solved) = found(None);
        assert!((full - &exact).amax() > 0.01 * exact.amax());
        assert!((solved - &phases).amax() > 0.01 * phases.amax());
    }
}
