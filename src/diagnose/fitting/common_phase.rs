//! The phase that all pixels have in common, where frames are known to have errors of their own.
//!
//! The pixels' own numbers are projected out as if the noise were white, and errors that samples of a set share are freed of them set by set. That leaves out
//! that frames which are off by much move the numbers of all pixels together, and so what all other sets leave, too: the most by the phase. This one direction
//! is therefore kept out of the projection: it is a column, beside which all others are fitted with the errors' covariance.

use crate::diagnose::tangents::columns::OWN;
use nalgebra::{DMatrix, DVector, Matrix4, Vector4};

/// Errors may take all but this of its square: the rest is rounding (of sums in single precision).
const LEAST: f64 = 1e-7;

/// A unit of phase of every pixel that has one.
#[derive(Debug, Clone)]
pub struct CommonPhase {
    /// How it moves the pixels' own numbers, number after number: what single pixels do not show stays where it is.
    step: DVector<f64>,
    /// Its square.
    square: f64,
}

/// What a column that is taken out changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taken {
    /// Chi squared that it takes.
    pub chi2: f64,
    /// By what factor its errors raise its variance, the logarithm.
    pub ln_variance: f64,
}

impl CommonPhase {
    /// Of pixels whose own numbers have these products `with` the phase, and these `inverses` of all products; nothing where none has a phase.
    pub fn of(with: &[Vector4<f64>], inverses: &[Matrix4<f64>]) -> Option<Self> {
        let pixels = with.len();
        let steps: Vec<Vector4<f64>> =
            with.iter().zip(inverses).map(|(with, inverse)| inverse * with).collect();
        let square = steps.iter().zip(with).map(|(step, with)| step.dot(with)).sum();
        let step = DVector::from_fn(OWN * pixels, |row, _| steps[row % pixels][row / pixels]);
        (square > 0.0).then_some(Self { step, square })
    }

    /// What shares `own` with the pixels' own numbers (number after number) shares with it.
    pub fn with(&self, own: impl Iterator<Item = f64>) -> f64 {
        self.step.iter().zip(own).map(|(step, own)| step * own).sum()
    }

    /// So much of it is what shares this `with` it, by white noise.
    pub fn per_unit(&self, with: f64) -> f64 {
        with / self.square
    }

    /// Products of errors from which the pixels' own numbers were taken, `left`, without it among those: by what each error shares `with` it.
    pub fn keep(&self, left: &mut DMatrix<f64>, with: &DVector<f64>) {
        left.ger(self.square.recip(), with, with, 1.0);
    }

    /// Such products with it among those again.
    pub fn take(&self, left: &mut DMatrix<f64>, with: &DVector<f64>) {
        left.ger(-self.square.recip(), with, with, 1.0);
    }

    /// What columns that share `mixed` with the pixels' own numbers share with it, which `solved`, a step of these numbers a column, is freed of.
    pub fn freed(&self, mixed: &DMatrix<f64>, solved: &mut DMatrix<f64>) -> DVector<f64> {
        let with = mixed.tr_mul(&self.step);
        solved.ger(-self.square.recip(), &self.step, &with, 1.0);
        with
    }

    /// The symmetric `full` products of columns with itself as another one, last, which shares `with` each.
    pub fn append(&self, full: DMatrix<f64>, with: &DVector<f64>) -> DMatrix<f64> {
        let size = full.nrows();
        let mut appended = full.resize(size + 1, size + 1, self.square);
        appended.view_mut((0, size), (size, 1)).copy_from(with);
        appended.view_mut((size, 0), (1, size)).copy_from(&with.transpose());
        appended
    }

    /// The `full` products without it, which is their last column, where it is fitted, as `solved` then has it; what that takes from the last column but it,
    /// the residual.
    pub fn fitted(&self, full: &mut DMatrix<f64>, solved: &mut DMatrix<f64>) -> Taken {
        let size = full.nrows() - 1;
        let (pivot, with) = (full[(size, size)], full.view((0, size), (size, 1)).column(0).into_owned());
        full.resize_mut(size, size, 0.0);
        if pivot <= LEAST * self.square {
            return Taken { chi2: 0.0, ln_variance: 0.0 };
        }
        full.ger(-pivot.recip(), &with, &with, 1.0);
        solved.ger(pivot.recip(), &self.step, &with, 1.0);
        Taken { chi2: with[size - 1].powi(2) / pivot, ln_variance: (pivot / self.square).ln() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    /// The pixels' phase among their own numbers.
    const PHASE: usize = 1;
    const PIXELS: usize = 6;
    /// All but one, which is dead.
    const SEEN: usize = 5;
    const FRAMES: usize = 6;
    const COLUMNS: usize = 3;
    /// Of the frames' phases, over the noise's: some stand still.
    const VARIANCES: [f64; FRAMES] = [0.0, 0.0, 3.0, 20.0, 0.5, 40.0];

    /// Frames whose phases are off, each a set: what is known of the columns, and of the pixels' phases beside them, is what the whole covariance says,
    /// although sets are looked at one by one. As a part of the projection it is not.
    #[test]
    fn frames_that_are_off_move_no_others() {
        let mut tangents: Vec<f64> =
            Draws::of(1, 7).normal(SEEN).iter().map(|draw| 1.0 + 0.2 * draw).collect();
        tangents.push(0.0);
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
        let seen = own.columns(0, SEEN);
        let phases = (seen.transpose() * &weights * seen).try_inverse().unwrap()
            * (seen.transpose() * &weights * &columns);
        let exact = columns.transpose() * &weights * (&columns - seen * &phases);

        let squares: Vec<f64> = tangents.iter().map(|tangent| FRAMES as f64 * tangent * tangent).collect();
        let inverse = |square: &f64| {
            let inverse = if *square > 0.0 { square.recip() } else { 0.0 };
            Matrix4::from_fn(|row, column| if (row, column) == (PHASE, PHASE) { inverse } else { 0.0 })
        };
        let inverses: Vec<Matrix4<f64>> = squares.iter().map(inverse).collect();
        let phases_of =
            |square: &f64| Vector4::from_fn(|number, _| if number == PHASE { *square } else { 0.0 });
        let with_phase: Vec<Vector4<f64>> = squares.iter().map(phases_of).collect();
        let found = |common: Option<&CommonPhase>| {
            let shared_by = |columns: &DMatrix<f64>| {
                let mut mixed = DMatrix::zeros(OWN * PIXELS, columns.ncols());
                mixed.rows_mut(PHASE * PIXELS, PIXELS).copy_from(&(own.transpose() * columns));
                mixed
            };
            let solved_of = |mixed: &DMatrix<f64>| {
                let mut solved = mixed.clone();
                for mut column in solved.column_iter_mut() {
                    let phase = |pixel: usize| PHASE * PIXELS + pixel;
                    (0..PIXELS).for_each(|p| column[phase(p)] *= inverses[p][(PHASE, PHASE)]);
                }
                solved
            };
            let mixed = shared_by(&columns);
            let mut solved = solved_of(&mixed);
            let with = common.map(|common| common.freed(&mixed, &mut solved));
            let mut full = columns.transpose() * &columns - mixed.transpose() * &solved;
            if let (Some(common), Some(with)) = (common, &with) {
                full = common.append(full, with);
            }
            for (error, variance) in errors.column_iter().zip(VARIANCES) {
                let error = DMatrix::from_column_slice(error.len(), 1, error.as_slice());
                let shared = shared_by(&error);
                let mut left = error.tr_mul(&error) - shared.tr_mul(&solved_of(&shared));
                let mut sums = error.transpose() * &columns - shared.transpose() * &solved;
                if let Some(common) = common {
                    let with = common.with(shared.iter().copied());
                    common.keep(&mut left, &DVector::repeat(1, with));
                    sums.resize_mut(1, COLUMNS + 1, with);
                }
                full -= variance / (1.0 + variance * left[(0, 0)]) * sums.transpose() * sums;
            }
            let before = full[(COLUMNS - 1, COLUMNS - 1)];
            let taken = common.map(|common| common.fitted(&mut full, &mut solved));
            let lower = before - full[(COLUMNS - 1, COLUMNS - 1)];
            assert!(taken.is_none_or(|taken| (taken.chi2 - lower).abs() < 1e-12 * lower));
            (full, solved.rows(PHASE * PIXELS, PIXELS).into_owned())
        };
        let (full, solved) = found(CommonPhase::of(&with_phase, &inverses).as_ref());
        assert!((full - &exact).amax() < 1e-12 * exact.amax());
        assert!((solved.rows(0, SEEN) - &phases).amax() < 1e-12 * phases.amax());
        // A pixel that shows nothing stays where it is.
        assert_eq!(solved.row(SEEN).amax(), 0.0);
        let (full, solved) = found(None);
        assert!((full - &exact).amax() > 0.01 * exact.amax());
        assert!((solved.rows(0, SEEN) - &phases).amax() > 0.01 * phases.amax());
    }
}
