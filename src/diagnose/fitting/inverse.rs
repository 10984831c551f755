//! The inverse of the normal equations of a pixel's own numbers.

use nalgebra::{Matrix4, Vector4};

/// Less of an eigenvalue, where each number has a unit of its own, is what numbers are not told apart by.
const LEAST: f64 = 1e-9;
/// Where the determinant is above this no eigenvalue is as small: their sum is 4, so that three of them multiply to (4/3)³ at most.
const WELL_TOLD: f64 = 1e-6;

/// Pseudo-inverse: what a pixel's own numbers are not told apart by stays where it is.
pub fn inverse(own: &Matrix4<f64>) -> Matrix4<f64> {
    let unit = |row: usize| if own[(row, row)] > 0.0 { own[(row, row)].sqrt().recip() } else { 0.0 };
    let scale = Vector4::from_fn(|row, _| unit(row));
    let scaled = Matrix4::from_fn(|row, column| own[(row, column)] * scale[row] * scale[column]);
    let inverse = well_told(&scaled).unwrap_or_else(|| pseudo_inverse(&scaled));
    Matrix4::from_fn(|row, column| inverse[(row, column)] * scale[row] * scale[column])
}

/// The inverse, where all numbers but those that nothing is known of are told well: many times faster.
fn well_told(scaled: &Matrix4<f64>) -> Option<Matrix4<f64>> {
    let mut all = *scaled;
    for number in (0..4).filter(|&number| scaled[(number, number)] == 0.0) {
        all[(number, number)] = 1.0;
    }
    let cholesky = all.cholesky()?;
    (cholesky.determinant() > WELL_TOLD).then(|| cholesky.inverse())
}

fn pseudo_inverse(scaled: &Matrix4<f64>) -> Matrix4<f64> {
    let eigen = scaled.symmetric_eigen();
    let kept = eigen.eigenvalues.map(|value| if value > LEAST { value.recip() } else { 0.0 });
    eigen.eigenvectors * Matrix4::from_diagonal(&kept) * eigen.eigenvectors.transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_close(a: &Matrix4<f64>, b: &Matrix4<f64>) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-9 * b.abs().max(1e-9))
    }

    /// By hand: a number by itself, two that share half of what is known, one of which nothing is known.
    #[test]
    fn what_is_told_is_inverted() {
        let own = Matrix4::new(
            4.0, 0.0, 0.0, 0.0, //
            0.0, 1.0, 5.0, 0.0, //
            0.0, 5.0, 100.0, 0.0, //
            0.0, 0.0, 0.0, 0.0,
        );
        let inverse = Matrix4::new(
            0.25,
            0.0,
            0.0,
            0.0, //
            0.0,
            4.0 / 3.0,
            -0.2 / 3.0,
            0.0, //
            0.0,
            -0.2 / 3.0,
            0.04 / 3.0,
            0.0, //
            0.0,
            0.0,
            0.0,
            0.0,
        );
        assert!(is_close(&super::inverse(&own), &inverse), "{}", super::inverse(&own));
    }

    /// Two numbers that do the same, but for rounding or for less than counts, have half each; a little more, and they are told.
    #[test]
    fn what_is_not_told_stays() {
        let of = |apart: f64| {
            let mut own = Matrix4::identity();
            own[(0, 0)] = 9.0;
            (own[(0, 1)], own[(1, 0)]) = (3.0 * (1.0 - apart), 3.0 * (1.0 - apart));
            super::inverse(&own)
        };
        for apart in [0.0, 1e-15, 1e-10] {
            let inverse = of(apart);
            assert!(
                (inverse[(0, 0)] - 0.25 / 9.0).abs() < 1e-6 && (inverse[(1, 1)] - 0.25).abs() < 1e-6,
                "{apart}"
            );
        }
        // The least eigenvalue is `apart`, of both ways of inverting.
        for apart in [1e-7_f64, 1e-4] {
            let expected = (1.0 - (1.0 - apart).powi(2)).recip();
            assert!((of(apart)[(1, 1)] / expected - 1.0).abs() < 1e-5, "{apart}: {}", of(apart)[(1, 1)]);
        }
    }
}
