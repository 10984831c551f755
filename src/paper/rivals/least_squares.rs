//! Linear least squares.

use nalgebra::{DMatrix, DVector};

/// Singular values below this share of the largest count as 0.
const DEPENDENT: f64 = 1e-10;

/// The coefficients that make Σ (y − Σ c_i b_i(x))² least; `None` where there are no points, or the basis is not independent on them.
pub fn fit(basis: fn(f64) -> Vec<f64>, points: &[(f64, f64)]) -> Option<Vec<f64>> {
    let rows: Vec<Vec<f64>> = points.iter().map(|(x, _)| basis(*x)).collect();
    let size = rows.first()?.len();
    let matrix = DMatrix::from_row_iterator(rows.len(), size, rows.into_iter().flatten());
    let ordinates = DVector::from_iterator(points.len(), points.iter().map(|(_, y)| *y));
    let parts = matrix.svd(true, true);
    let least = DEPENDENT * parts.singular_values.max();
    if parts.rank(least) < size {
        return None;
    }
    Some(parts.solve(&ordinates, least).ok()?.iter().copied().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_found_and_a_dependent_basis_refused() {
        let points: Vec<(f64, f64)> =
            (0..9).map(f64::from).map(|x| (x, 1.0 - 2.0 * x + 0.5 * x * x)).collect();
        let found = fit(|x| vec![1.0, x, x * x], &points).unwrap();
        for (found, true_value) in found.iter().zip([1.0, -2.0, 0.5]) {
            assert!((found - true_value).abs() < 1e-9, "{found}");
        }
        assert_eq!(fit(|x| vec![x, 2.0 * x], &points), None);
        assert_eq!(fit(|x| vec![1.0, x, x * x], &points[..2]), None);
        assert_eq!(fit(|x| vec![x], &[]), None);
    }
}
