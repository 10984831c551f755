//! A frame's residual over its noise.

use super::data::Data;
use super::noise::Noise;
use crate::widest::widest;

/// Residuals beyond so many standard deviations count as that many.
const WINSOR: f64 = 4.0;

/// Roots of the weights of a frame's pixels, 0 where a sample does not count, and the residual times them.
pub fn whiten(data: &Data, take: usize, index: usize, base: &[f64], noise: Noise) -> (Vec<f64>, Vec<f64>) {
    let pixels = data.pixels();
    let signal = &data.takes[take].signal_dn[index * pixels..(index + 1) * pixels];
    let (mut roots, mut residuals) = (vec![0.0; pixels], vec![0.0; pixels]);
    {
        let (roots, residuals) = (&mut roots[..], &mut residuals[..]);
        widest!((signal: &'a [f32], base: &'a [f64], noise: Noise,
                 roots: &'a mut [f64], residuals: &'a mut [f64]) {
            for (((&measured, &base), root), residual) in signal.iter().zip(base).zip(roots).zip(residuals) {
                let counts = !measured.is_nan();
                *root = if counts { noise.weight(base).sqrt() } else { 0.0 };
                // What is no number stays none.
                let beyond = *root * (f64::from(measured) - base);
                *residual = if *root == 0.0 { 0.0 } else { beyond.clamp(-WINSOR, WINSOR) };
            }
        });
    }
    (roots, residuals)
}
