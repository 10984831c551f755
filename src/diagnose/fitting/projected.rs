//! The normal equations of columns alone, with all other numbers projected out.

use crate::diagnose::tangents::columns::{OWN, own_values_mut};
use crate::physics::Pixels;
use nalgebra::{DMatrix, DVector, Vector4};

/// The normal equations of the columns alone.
#[derive(Debug, Clone)]
pub struct Projected {
    /// Fisher information.
    pub matrix: DMatrix<f64>,
    /// Score.
    pub vector: DVector<f64>,
    /// Diagonal of the information before anything was projected out.
    pub raw: DVector<f64>,
    /// Variance of the encoder's reading, m².
    pub jitter_m2: f64,
    /// Chi squared after the projection, what the freedom of the sets' errors costs, the logarithms of the noise's variances, and what residuals have
    /// beyond what they count as: minus twice the logarithm of the likelihood, but for a constant.
    pub chi2: f64,
    /// Chi squared that the pixels' own numbers take away by a step.
    pub settled: f64,
    /// Change of the pixels' own numbers a unit of each column, and, last, by the residual: (4 x pixels) x (columns + 1), number after number.
    pub solved: DMatrix<f64>,
    /// The same of the phases that all pixels have in common at a frequency.
    pub common: Common,
}

impl Projected {
    /// Takes some columns as `fitted`: what they share with the others is theirs.
    pub fn give_way(&mut self, fitted: impl IntoIterator<Item = usize>) {
        for fitted in fitted {
            let pivot = self.matrix[(fitted, fitted)];
            if pivot > 1e-9 * self.raw[fitted] {
                let row = self.matrix.column(fitted).into_owned();
                let step = self.vector[fitted] / pivot;
                self.vector.axpy(-step, &row, 1.0);
                self.matrix.ger(-pivot.recip(), &row, &row, 1.0);
            }
        }
    }

    /// `pixels` after a `share` of what moves them with a step `theta` of the columns: their own numbers, and the phases that all have in common.
    pub fn moved(&self, pixels: &Pixels, theta: &DVector<f64>, share: f64) -> Pixels {
        let mut moved = pixels.clone();
        let own = self.own(theta);
        for (number, values) in own_values_mut(&mut moved).into_iter().enumerate() {
            values.iter_mut().zip(&own).for_each(|(value, step)| *value += share * step[number]);
        }
        for (at, step_rad) in moved.at_frequencies.iter_mut().zip(&self.common.steps_rad(theta)) {
            at.phase_rad += share * step_rad;
        }
        moved
    }

    /// How the pixels' own numbers move with a step `theta` of the columns.
    fn own(&self, theta: &DVector<f64>) -> Vec<Vector4<f64>> {
        let last = theta.len();
        let own = self.solved.column(last) - self.solved.columns(0, last) * theta;
        (0..own.len() / OWN).map(|pixel| own_of(own.as_slice(), pixel)).collect()
    }
}

/// Phases that all pixels have in common, at one modulation frequency each, where they fit best.
#[derive(Debug, Clone)]
pub struct Common {
    /// How they move a unit of each column, and, last, by the residual: phase by phase.
    steps: DMatrix<f64>,
    /// Chi squared that this takes away.
    pub settled: f64,
}

/// Of a phase, all but this of its square may be other columns': the rest is rounding (of sums in single precision).
const LEAST: f64 = 1e-6;

impl Common {
    /// Takes so many phases, which stand before the last one of the columns, out of the `full` products of these and their `solved` steps of the pixels' own
    /// numbers; the products were `raw` before anything was projected out.
    pub fn fitted(
        phases: usize,
        raw: &DMatrix<f64>,
        full: &mut DMatrix<f64>,
        solved: &mut DMatrix<f64>,
    ) -> Self {
        let last = full.nrows() - 1;
        let first = last - phases;
        let (mut steps, mut settled) = (DMatrix::zeros(phases, last + 1), 0.0);
        if phases == 0 {
            return Self { steps, settled };
        }
        for number in first..last {
            let pivot = full[(number, number)];
            if pivot <= LEAST * raw[(number, number)] {
                continue;
            }
            let with = full.column(number).into_owned();
            let own = solved.column(number).into_owned();
            settled += with[last].powi(2) / pivot;
            full.ger(-pivot.recip(), &with, &with, 1.0);
            solved.ger(-pivot.recip(), &own, &with, 1.0);
            // What moves with a phase that is fitted further on moves as that does.
            let before = steps.column(number).into_owned();
            steps.ger(-pivot.recip(), &before, &with, 1.0);
            steps.row_mut(number - first).copy_from(&(with / pivot).transpose());
        }
        *full = std::mem::take(full).remove_rows(first, phases).remove_columns(first, phases);
        *solved = std::mem::take(solved).remove_columns(first, phases);
        Self { steps: steps.remove_columns(first, phases), settled }
    }

    /// How the phases move, rad, with a step `theta` of the columns.
    pub fn steps_rad(&self, theta: &DVector<f64>) -> DVector<f64> {
        let last = theta.len();
        self.steps.column(last) - self.steps.columns(0, last) * theta
    }
}

/// A pixel's own numbers among those of all, number after number.
pub fn own_of(all: &[f64], pixel: usize) -> Vector4<f64> {
    let pixels = all.len() / OWN;
    Vector4::from_fn(|number, _| all[number * pixels + pixel])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    /// Taken out one after the other, phases leave what all numbers fitted at once do: of columns, of themselves, and of the pixels' own numbers.
    #[test]
    fn phases_are_fitted_with_all_else() {
        const COLUMNS: usize = 3;
        const PHASES: usize = 2;
        const SIZE: usize = COLUMNS + PHASES + 1;
        let samples = DMatrix::from_vec(50, SIZE, Draws::of(5, 1).normal(50 * SIZE));
        let (mut full, last) = (samples.tr_mul(&samples), SIZE - 1);
        let own = DMatrix::from_vec(OWN, SIZE, Draws::of(6, 1).normal(OWN * SIZE));
        let (raw, numbers) = (full.clone(), full.view((0, 0), (last, last)).into_owned());
        let step = numbers.clone().try_inverse().unwrap() * full.view((0, last), (last, 1)).column(0);
        let mut solved = own.clone();
        let common = Common::fitted(PHASES, &raw, &mut full, &mut solved);
        assert_eq!((full.shape(), solved.shape()), ((COLUMNS + 1, COLUMNS + 1), (OWN, COLUMNS + 1)));
        let (matrix, vector) = (full.view((0, 0), (COLUMNS, COLUMNS)), full.view((0, COLUMNS), (COLUMNS, 1)));
        let theta = matrix.into_owned().try_inverse().unwrap() * vector.column(0);
        let is_near = |found: &[f64], expected: &[f64]| {
            found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9)
        };
        assert!(is_near(theta.as_slice(), &step.as_slice()[..COLUMNS]), "{theta}, {step}");
        assert!(is_near(common.steps_rad(&theta).as_slice(), &step.as_slice()[COLUMNS..]));
        let of_own = own.column(last) - own.columns(0, last) * &step;
        let found = solved.column(COLUMNS) - solved.columns(0, COLUMNS) * &theta;
        assert!(is_near(found.as_slice(), of_own.as_slice()), "{found}, {of_own}");
        let alone = numbers.view((COLUMNS, COLUMNS), (PHASES, PHASES)).into_owned().try_inverse().unwrap();
        let with = raw.view((COLUMNS, last), (PHASES, 1)).into_owned();
        assert!((common.settled - with.dot(&(alone * &with))).abs() < 1e-9);
        // One that no frame shows stays where it is.
        let (mut full, mut solved) = (raw.clone(), own);
        full.row_mut(COLUMNS).fill(0.0);
        full.column_mut(COLUMNS).fill(0.0);
        let common = Common::fitted(PHASES, &raw, &mut full, &mut solved);
        assert_eq!(common.steps_rad(&DVector::zeros(COLUMNS))[0], 0.0);
        assert!(common.steps_rad(&DVector::zeros(COLUMNS))[1] != 0.0 && common.settled.is_finite());
    }
}
