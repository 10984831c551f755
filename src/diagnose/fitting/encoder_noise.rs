//! The noise of the encoder's reading: an error of each set's place, of a variance that is estimated.

use crate::diagnose::statistics::evidence::of_variance;

/// The variance of the encoder's reading that explains the sets' common position errors best, m²: `(sum, square)` a set.
pub fn jitter(sets: &[(f64, f64)]) -> f64 {
    let evidence =
        |variance: f64| -> f64 { sets.iter().map(|&(sum, square)| of_variance(variance, sum, square)).sum() };
    let best = |variances: &mut dyn Iterator<Item = f64>, from: (f64, f64)| {
        variances.map(|v| (v, evidence(v))).fold(from, |best, v| if v.1 > best.1 { v } else { best })
    };
    // From a micrometre to half a millimetre: more is no encoder's noise, but something that must be named.
    let coarse =
        (0..=JITTERS).map(|step| LEAST_JITTER_M * MOST_JITTERS.powf(f64::from(step) / f64::from(JITTERS)));
    let mut found = best(&mut coarse.map(|jitter_m| jitter_m * jitter_m), (0.0, 0.0));
    // Between two of these chi squared changes by some units where there are a thousand sets; two fits are compared by less.
    let mut ratio = MOST_JITTERS.powf(2.0 / f64::from(JITTERS));
    while found.0 > 0.0 && ratio > FINE_RATIO {
        ratio = ratio.powf(0.25);
        let about = found.0;
        found = best(&mut (-3..=3).map(|step| about * ratio.powi(step)), found);
    }
    found.0
}

/// Jitters of the encoder's reading that are tried first: from the least, m, so many up to so many times that; and between them up to steps of this ratio
/// of variances.
const LEAST_JITTER_M: f64 = 1e-6;
const MOST_JITTERS: f64 = 500.0;
const JITTERS: i32 = 60;
const FINE_RATIO: f64 = 1.005;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    /// The evidence at the jitter that is found is the greatest but for a hundredth of a nat, wherever that jitter lies between the steps.
    #[test]
    fn the_encoders_jitter_is_where_its_evidence_is_greatest() {
        for (seed, jitter_m) in [(1, 3e-5_f64), (2, 3.1e-5), (3, 3.2e-5), (4, 4e-4)] {
            let square = 1e10_f64;
            let draws = Draws::of(seed, 1).normal(1200);
            let sigma = (square + square * square * jitter_m * jitter_m).sqrt();
            let sets: Vec<(f64, f64)> = draws.into_iter().map(|draw| (draw * sigma, square)).collect();
            let evidence = |variance: f64| -> f64 {
                sets.iter().map(|&(sum, square)| of_variance(variance, sum, square)).sum()
            };
            // All sets are alike: the likelihood's peak is known (the mean square of the scores).
            let mean = sets.iter().map(|(sum, _)| sum * sum).sum::<f64>() / 1200.0;
            let exact = (mean / square - 1.0) / square;
            let lost = evidence(exact) - evidence(jitter(&sets));
            assert!((0.0..0.01).contains(&lost), "{jitter_m}: {lost}");
        }
        assert_eq!(jitter(&[(0.0, 1e10); 10]), 0.0);
    }
}
