//! Linear least squares by the normal equations.

/// The coefficients that make Σ (y − Σ c_i b_i(x))² least; `None` where the basis is not independent on the points.
///
/// Normal equations square the condition number. The bases here are near to orthogonal on their points, so that this costs nothing.
pub fn fit(basis: fn(f64) -> Vec<f64>, points: &[(f64, f64)]) -> Option<Vec<f64>> {
    let rows: Vec<(Vec<f64>, f64)> = points.iter().map(|(x, y)| (basis(*x), *y)).collect();
    let size = rows.first()?.0.len();
    // The matrix, and the right side as its last column.
    let mut matrix = vec![vec![0.0; size + 1]; size];
    for (row, y) in &rows {
        for (i, line) in matrix.iter_mut().enumerate() {
            for (cell, value) in line.iter_mut().zip(row.iter().chain([y])) {
                *cell += row[i] * value;
            }
        }
    }
    for pivot in 0..size {
        let largest =
            (pivot..size).max_by(|a, b| matrix[*a][pivot].abs().total_cmp(&matrix[*b][pivot].abs()))?;
        matrix.swap(pivot, largest);
        let line = matrix[pivot].clone();
        if line[pivot].abs() < 1e-12 {
            return None;
        }
        for (_, other) in matrix.iter_mut().enumerate().filter(|(i, _)| *i != pivot) {
            let factor = other[pivot] / line[pivot];
            other.iter_mut().zip(&line).for_each(|(cell, value)| *cell -= factor * value);
        }
    }
    Some((0..size).map(|i| matrix[i][size] / matrix[i][i]).collect())
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
    }
}
