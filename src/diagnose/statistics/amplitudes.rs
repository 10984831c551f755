//! Amplitudes of lines in several recordings: whether they may be one and the same.

use super::evidence::tail;

/// Amplitudes, with their standard deviations, that are less likely than this to be one and the same are not.
const DISAGREEING: f64 = 1e-3;

/// Of the same amplitude recordings show shares that differ by so much: a period that is not quite that of the line, outliers that were tamed.
const UNSURE: f64 = 0.1;

/// Whether amplitudes, each with its standard deviation, may be one and the same.
pub fn agree(sizes: &[(f64, f64)]) -> bool {
    // Noise alone has an amplitude, too (Rice 1945).
    let size = |&(size, sigma): &(f64, f64)| (size * size - sigma * sigma).max(0.0).sqrt();
    let mean = |sigma: &dyn Fn(f64) -> f64| {
        let weights: f64 = sizes.iter().map(|s| sigma(s.1).powi(-2)).sum();
        sizes.iter().map(|s| size(s) * sigma(s.1).powi(-2)).sum::<f64>() / weights
    };
    let about = mean(&|sigma| sigma);
    let sigma = |sigma: f64| sigma.hypot(UNSURE * about);
    let mean = mean(&sigma);
    let chi2 = sizes.iter().map(|s| ((size(s) - mean) / sigma(s.1)).powi(2)).sum();
    sizes.len() < 2 || tail(chi2, sizes.len() - 1) > DISAGREEING
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_amplitudes_agree_and_others_do_not() {
        assert!(agree(&[]) && agree(&[(3.0, 0.1)]));
        assert!(agree(&[(3.0, 0.1), (3.1, 0.2), (2.9, 0.1)]));
        assert!(!agree(&[(3.0, 0.1), (0.1, 0.1)]));
        // One that is weak everywhere is as weak in each.
        assert!(agree(&[(1.3, 1.0), (0.8, 1.0), (1.4, 1.0), (2.0, 1.0)]));
        // A tenth is not known so well.
        assert!(agree(&[(100.0, 0.1), (108.0, 0.1)]));
    }
}
