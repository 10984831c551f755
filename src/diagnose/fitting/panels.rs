//! Products of tall matrices, panel after panel side by side.

use nalgebra::DMatrix;
use rayon::prelude::*;

/// Columns of a panel: the same on any number of threads.
const PANEL: usize = 32;

/// The lower triangle of a' b, which is symmetric; above it there is no more than what its panels have.
pub fn lower_product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let (size, transposed) = (b.ncols(), a.transpose());
    let mut product = DMatrix::zeros(size, size);
    product.as_mut_slice().par_chunks_mut((PANEL * size).max(1)).enumerate().for_each(|(panel, product)| {
        let first = PANEL * panel;
        let width = PANEL.min(size - first);
        let below = transposed.rows(first, size - first) * b.columns(first, width);
        for (column, below) in product.chunks_mut(size).zip(below.column_iter()) {
            column[first..].copy_from_slice(below.as_slice());
        }
    });
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of no column, of less than a panel, of whole panels, of a few more.
    #[test]
    fn below_the_diagonal_it_is_the_product() {
        for size in [0, 1, PANEL - 1, 2 * PANEL, 2 * PANEL + 3] {
            let a = DMatrix::from_fn(2 * size + 5, size, |row, column| ((row * 7 + column * 13) % 11) as f64);
            let product = lower_product(&a, &a);
            let whole = a.tr_mul(&a);
            assert_eq!(product.lower_triangle(), whole.lower_triangle(), "{size}");
        }
    }
}
