//! What errors of different sets share: each moves the pixels' own numbers, and so what all other sets leave.
//!
//! Of few sets these numbers take much, and what is left of the errors, M'(1 - P) M, is far from what each set leaves alone: beside errors that are clearly
//! more than the noise columns would lose more than they have. Of many sets each has hardly any part in the numbers, and they may be freed set by set.

use super::products::products;
use super::set_errors::{Jitter, SetErrors, explained};
use nalgebra::{DMatrix, Matrix4, Vector4};

/// Some sets' errors by columns, one below the other; in which row each set's begin, and what is left of them alone.
pub type Stack<'a> = (DMatrix<f64>, Vec<(usize, &'a DMatrix<f64>)>);

/// More sets than these hardly share anything, and cost more than all else.
const MOST: usize = 400;

/// Of some sets' errors of the reading what the pixels' own numbers leave, each with each.
#[derive(Debug, Clone)]
pub struct Coupled {
    left: DMatrix<f64>,
}

impl Coupled {
    /// Of sets with one error each, those of which something is `left` alone, where the numbers have these `inverses` of their products with each other;
    /// nothing where they are many.
    pub fn of(
        errors: &[SetErrors],
        inverses: &[Matrix4<f64>],
        left: &[Option<DMatrix<f64>>],
    ) -> Option<Self> {
        let seen: Vec<(&SetErrors, f64)> = errors
            .iter()
            .zip(left)
            .filter_map(|(errors, left)| Some((errors, left.as_ref()?[(0, 0)])))
            .collect();
        if seen.is_empty() || seen.len() > MOST {
            return None;
        }
        let (pixels, roots) = (inverses.len(), inverses.iter().map(root).collect::<Vec<_>>());
        let length = 4 * pixels;
        let mut moves = vec![0.0_f32; seen.len() * length];
        for (moves, (errors, _)) in moves.chunks_exact_mut(length).zip(&seen) {
            let own: Vec<f64> = errors.own().collect();
            for (pixel, root) in roots.iter().enumerate() {
                let of = root.tr_mul(&Vector4::from_fn(|number, _| own[number * pixels + pixel]));
                (0..4).for_each(|number| moves[number * pixels + pixel] = of[number] as f32);
            }
        }
        let shared = products(&moves, length);
        let of = |a: usize, b: usize| if a == b { seen[a].1 } else { -f64::from(shared[(a, b)]) };
        Some(Self { left: DMatrix::from_fn(seen.len(), seen.len(), of) })
    }

    /// What errors of the variance `reading_m2` explain of the products of columns with each other, of which these are the `sums` (set by column). And the
    /// logarithm of the factor by which the errors raise the determinant of the covariance.
    fn explained(&self, mut sums: DMatrix<f64>, reading_m2: f64) -> (DMatrix<f64>, f64) {
        let mut covariance = &self.left * reading_m2;
        (0..covariance.nrows()).for_each(|set| covariance[(set, set)] += 1.0);
        sums *= reading_m2.sqrt();
        let Some(cholesky) = covariance.cholesky() else {
            return (DMatrix::zeros(sums.ncols(), sums.ncols()), 0.0);
        };
        let lower = cholesky.l_dirty();
        lower.solve_lower_triangular_mut(&mut sums);
        (sums.tr_mul(&sums), 2.0 * (0..lower.nrows()).map(|set| lower[(set, set)].ln()).sum::<f64>())
    }
}

/// Takes from the products of columns with each other, `full`, what errors explain of them: those of readings, of the variance `reading_m2`, of all sets
/// together where they are `coupled`, and what frames are off by; `sums` are the errors by columns. The logarithm of the factor by which the errors raise the
/// determinant of the covariance.
pub fn taken(
    full: &mut DMatrix<f64>,
    sums: &mut [Stack],
    coupled: Option<&Coupled>,
    jitter: Jitter,
    reading_m2: f64,
) -> f64 {
    if let Some(coupled) = coupled {
        let mut all = DMatrix::zeros(coupled.left.nrows(), full.ncols());
        let mut first = 0;
        for (sums, _) in sums {
            all.rows_mut(first, sums.nrows()).copy_from(sums);
            first += sums.nrows();
        }
        let (explained, freedom) = coupled.explained(all, reading_m2);
        *full -= explained;
        return freedom;
    }
    let mut freedom = 0.0;
    for (sums, lefts) in sums {
        for &(first, left) in lefts.iter() {
            freedom += explained(sums.rows_mut(first, left.nrows()), left, jitter, reading_m2);
        }
        *full -= sums.tr_mul(sums);
    }
    freedom
}

/// A root of a product of numbers, A = R R'.
fn root(square: &Matrix4<f64>) -> Matrix4<f64> {
    square.cholesky().map_or_else(
        || {
            let eigen = square.symmetric_eigen();
            eigen.eigenvectors * Matrix4::from_diagonal(&eigen.eigenvalues.map(|value| value.max(0.0).sqrt()))
        },
        |cholesky| cholesky.l(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::fitting::set_errors::{count, places};
    use crate::diagnose::tangents::columns::OWN;
    use crate::physics::Draws;

    const SETS: usize = 5;
    const PIXELS: usize = 6;
    const READING_M2: f64 = 9.0;

    /// Samples of all sets, of pixels in two frames each; the pixels' own numbers, the readings' errors and two columns by them, as they are written out.
    struct Written {
        own: DMatrix<f64>,
        errors: DMatrix<f64>,
        columns: DMatrix<f64>,
    }

    const FRAMES: usize = 2;
    const SAMPLES: usize = SETS * FRAMES * PIXELS;

    fn drawn() -> (Vec<SetErrors>, Written) {
        let draws = |seed: u64| Draws::of(seed, 9).normal(SAMPLES);
        let numbers: [Vec<f64>; OWN] = std::array::from_fn(|number| draws(number as u64));
        let errors = draws(10);
        let mut written = Written {
            own: DMatrix::zeros(SAMPLES, OWN * PIXELS),
            errors: DMatrix::zeros(SAMPLES, SETS),
            columns: DMatrix::from_fn(SAMPLES, 2, |sample, column| draws(20 + column as u64)[sample]),
        };
        let mut sets = vec![SetErrors::empty(count([0.0; 2], FRAMES), PIXELS); SETS];
        for (index, first) in (0..SAMPLES).step_by(PIXELS).enumerate() {
            let (set, here) = (index / FRAMES, first..first + PIXELS);
            let own = numbers.each_ref().map(|numbers| numbers[here.clone()].to_vec());
            let places: Vec<usize> = places([0.0; 2], index % FRAMES).collect();
            sets[set].add(&places, &[errors[here.clone()].to_vec()], &own);
            for (pixel, sample) in here.enumerate() {
                written.errors[(sample, set)] = errors[sample];
                (0..OWN)
                    .for_each(|number| written.own[(sample, number * PIXELS + pixel)] = own[number][pixel]);
            }
        }
        (sets, written)
    }

    /// Five sets of two frames, in which six pixels have four numbers of their own each: products of columns beside errors that are three times the noise, by
    /// the inverse of the covariance written out, and the pixels' numbers solved for.
    #[test]
    fn products_are_those_by_the_inverse_of_the_covariance() {
        let (sets, Written { own, errors, mut columns }) = drawn();
        let plain = own.tr_mul(&own).try_inverse().unwrap();
        let free = |of: &DMatrix<f64>| of - &own * (&plain * own.tr_mul(of));
        let left_of_errors = errors.tr_mul(&free(&errors));
        // The first column is made of nothing but such errors, those that leave the most.
        let eigen = left_of_errors.clone().symmetric_eigen();
        columns.set_column(0, &(&errors * eigen.eigenvectors.column(eigen.eigenvalues.imax())));
        let covariance = DMatrix::identity(SAMPLES, SAMPLES) + READING_M2 * &errors * errors.transpose();
        let weight = covariance.try_inverse().unwrap();
        let normal = own.tr_mul(&(&weight * &own)).try_inverse().unwrap();
        let with = own.tr_mul(&(&weight * &columns));
        let exact = columns.tr_mul(&(&weight * &columns)) - with.tr_mul(&(&normal * &with));

        let inverses: Vec<Matrix4<f64>> = (0..PIXELS)
            .map(|pixel| {
                let of = |number: usize| own.column(number * PIXELS + pixel);
                Matrix4::from_fn(|a, b| of(a).dot(&of(b))).try_inverse().unwrap()
            })
            .collect();
        let left: Vec<_> = sets.iter().map(|set| set.left(&inverses, None)).collect();
        let found = |coupled: Option<&Coupled>| {
            let mut full = columns.tr_mul(&free(&columns));
            let rows = left.iter().flatten().enumerate().collect();
            let mut sums = [(errors.tr_mul(&free(&columns)), rows)];
            let freedom = taken(&mut full, &mut sums, coupled, [0.0; 2], READING_M2);
            (full, freedom)
        };
        let coupled = Coupled::of(&sets, &inverses, &left);
        let (full, freedom) = found(coupled.as_ref());
        assert!((&full - &exact).amax() < 1e-5 * exact.amax(), "{full} {exact}");
        // The determinant of what the numbers leave of the errors beside the noise.
        let determinant = (DMatrix::identity(SETS, SETS) + READING_M2 * left_of_errors).determinant();
        assert!((freedom - determinant.ln()).abs() < 1e-5);
        // Set by set something is left that is less than nothing.
        let (alone, _) = found(None);
        assert!(exact[(0, 0)] > 0.0 && alone[(0, 0)] < 0.0, "{exact} {alone}");
    }

    #[test]
    fn many_sets_are_not_coupled() {
        let (sets, _) = drawn();
        let inverses = vec![Matrix4::identity() * 1e-3; PIXELS];
        let many = |count: usize| {
            let sets: Vec<SetErrors> = sets.iter().cycle().take(count).cloned().collect();
            let left: Vec<_> = sets.iter().map(|set| set.left(&inverses, None)).collect();
            Coupled::of(&sets, &inverses, &left).is_some()
        };
        assert_eq!([many(0), many(1), many(MOST), many(MOST + 1)], [false, true, true, false]);
    }
}
