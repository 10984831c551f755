//! A frame's residual over its noise.

use super::noise::Noise;
use crate::diagnose::reading::data::Data;
use crate::widest::widest;

/// Residuals beyond so many standard deviations count as that many.
pub const WINSOR: f64 = 4.0;

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
                // What is no number stays none, and so does what is infinite, whose noise is.
                *root = if counts { (noise.weight(base) + 0.0 * base).sqrt() } else { 0.0 };
                let beyond = *root * (f64::from(measured) - base);
                *residual = if *root == 0.0 { 0.0 } else { beyond.clamp(-WINSOR, WINSOR) };
            }
        });
    }
    (roots, residuals)
}

/// What residuals that count as less have beyond the squares that they count as, sample by sample, by the `roots` of the weights of a frame: chi squared
/// with it is twice Huber's loss (1964), whose slope is the residual as it counts. Without it a model that is far off wherever it is off gets rid of the noise
/// there.
pub fn tails<'a>(
    signal: &'a [f32],
    base: &'a [f64],
    roots: &'a [f64],
    residuals: &'a [f64],
) -> impl Iterator<Item = f64> + 'a {
    let of = |(((&measured, &base), &root), &residual): (((&f32, &f64), &f64), &f64)| {
        let more =
            if residual.abs() < WINSOR { 0.0 } else { (root * (f64::from(measured) - base)).abs() - WINSOR };
        2.0 * WINSOR * more
    };
    signal.iter().zip(base).zip(roots).zip(residuals).map(of)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Huber's loss, k (2 |r| - k) beyond k and r² below, is what is counted and what is beyond it.
    #[test]
    fn what_counts_as_less_is_not_lost() {
        let (signal, base) = ([10.0_f32, 13.0, 0.0, 30.0], [10.5, 10.0, 9.0, 10.0]);
        let (roots, residuals) = ([1.0, 2.0, 1.0, 0.0], [-0.5, 4.0, -4.0, 0.0]);
        let counted: f64 = residuals.iter().map(|residual| residual * residual).sum();
        let huber = 0.25 + 4.0 * (2.0 * 6.0 - 4.0) + 4.0 * (2.0 * 9.0 - 4.0);
        assert_eq!(counted + tails(&signal, &base, &roots, &residuals).sum::<f64>(), huber);
    }
}
