//! The products of rows with each other, in single precision: what a library's matrix product spends on packing such few rows is more than they cost.
//! Operations are fused where the machine can, so that the last bits are the machine's.

use ndarray::Array2;
use pulp::{Simd, WithSimd};

/// So many rows are multiplied with as many others at a time: their sums fill half of the widest registers.
const TILE: usize = 4;
/// So many samples of a tile's rows stay at hand.
const PANEL: usize = 1024;

/// The products of all rows of `values`, of so many `pixels` each, with each other.
pub fn products(values: &[f32], pixels: usize) -> Array2<f32> {
    let mut product = Array2::zeros((values.len() / pixels, values.len() / pixels));
    let whole = product.as_slice_mut().expect("one row after the other");
    pulp::Arch::new().dispatch(Products { values, pixels, product: whole });
    product
}

struct Products<'a> {
    values: &'a [f32],
    pixels: usize,
    product: &'a mut [f32],
}

impl WithSimd for Products<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { values, pixels, product } = self;
        let count = values.len() / pixels;
        for start in (0..pixels).step_by(PANEL) {
            let end = pixels.min(start + PANEL);
            for first in (0..count).step_by(TILE) {
                for other in (0..=first).step_by(TILE) {
                    let (mut a, mut b) = ([&values[..0]; TILE], [&values[..0]; TILE]);
                    for n in 0..TILE {
                        // Beyond the last row it comes again.
                        let (row, column) = ((first + n).min(count - 1), (other + n).min(count - 1));
                        a[n] = &values[pixels * row + start..pixels * row + end];
                        b[n] = &values[pixels * column + start..pixels * column + end];
                    }
                    let sums = of_tiles(simd, a, b);
                    for (row, sums) in (first..count).zip(sums) {
                        for (column, sum) in (other..count).zip(sums) {
                            product[count * row + column] += sum;
                        }
                    }
                }
            }
        }
        for row in 0..count {
            for column in 0..row {
                product[count * column + row] = product[count * row + column];
            }
        }
    }
}

/// The products of rows, as long as each other, with others. It has no closures, as [`widest`](crate::widest) says.
#[inline(always)]
fn of_tiles<S: Simd>(simd: S, rows: [&[f32]; TILE], others: [&[f32]; TILE]) -> [[f32; TILE]; TILE] {
    let length = S::as_simd_f32s(rows[0]).0.len();
    let (mut a, mut b) = ([&S::as_simd_f32s(rows[0]).0[..0]; TILE], [&S::as_simd_f32s(rows[0]).0[..0]; TILE]);
    for n in 0..TILE {
        a[n] = &S::as_simd_f32s(rows[n]).0[..length];
        b[n] = &S::as_simd_f32s(others[n]).0[..length];
    }
    let mut wide = [[simd.splat_f32s(0.0); TILE]; TILE];
    for at in 0..length {
        for row in 0..TILE {
            let value = a[row][at];
            for other in 0..TILE {
                wide[row][other] = simd.mul_add_e_f32s(value, b[other][at], wide[row][other]);
            }
        }
    }
    let mut sums = [[0.0; TILE]; TILE];
    for row in 0..TILE {
        for other in 0..TILE {
            let mut sum = simd.reduce_sum_f32s(wide[row][other]);
            for at in length * S::F32_LANES..rows[row].len() {
                sum += rows[row][at] * others[other][at];
            }
            sums[row][other] = sum;
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    /// Rows in no multiple of the tiles, samples in no multiple of registers and panels.
    #[test]
    fn products_are_sums_over_samples() {
        for (count, pixels) in [(1, 5), (7, 37), (9, PANEL + 33)] {
            let values: Vec<f32> = Draws::of(count as u64, 3)
                .normal(count * pixels)
                .into_iter()
                .map(|value| value as f32)
                .collect();
            let product = products(&values, pixels);
            for ((a, b), product) in product.indexed_iter() {
                let row = |number: usize| &values[pixels * number..pixels * (number + 1)];
                let sum: f64 = row(a).iter().zip(row(b)).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum();
                assert!((f64::from(*product) - sum).abs() < 1e-6 * pixels as f64, "{count} {pixels} {a} {b}");
            }
        }
    }
}
