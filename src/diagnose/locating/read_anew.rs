//! What a column of the target's place explains where readings scatter only as much as they do beside it.
//!
//! A reading that is off in a way of its own seems, without that, to scatter; and errors of readings that may be as great as that leave little of the column.

use crate::diagnose::fitting::projected::Projected;

/// Standard deviations of a reading that are tried, as shares of what they seem to have: as many narrow steps of a bisection by the golden section.
const STEPS: usize = 8;
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Chi squared that `column` explains, after the first `fitted` ones, of what `at` a variance (m²) of the readings says, with that variance where it is the
/// most likely one beside the column: of readings that seem to have the variance `seems_m2`.
pub fn explained(at: &dyn Fn(f64) -> Projected, seems_m2: f64, fitted: usize, column: usize) -> f64 {
    // By the column, and minus twice the logarithm of the likelihood without it.
    let said = |share: f64| {
        let mut projected = at(share * share * seems_m2);
        projected.give_way(0..fitted);
        let information = projected.matrix[(column, column)];
        let by_column = if information > 0.0 { projected.vector[column].powi(2) / information } else { 0.0 };
        (by_column, projected.chi2)
    };
    let (as_it_seems, seems) = said(1.0);
    if seems_m2 == 0.0 {
        return as_it_seems;
    }
    // What another variance alone explains is no column's.
    let least = std::cell::Cell::new(seems);
    let with = |share: f64| {
        let (by_column, chi2) = said(share);
        least.set(least.get().min(chi2));
        chi2 - by_column
    };
    let (mut low, mut high) = (0.0, 1.0);
    let inner = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let [mut left, mut right] = inner(low, high);
    let (mut at_left, mut at_right) = (with(left), with(right));
    for _ in 0..STEPS {
        if at_left < at_right {
            (high, right, at_right) = (right, left, at_left);
            left = inner(low, high)[0];
            at_left = with(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = inner(low, high)[1];
            at_right = with(right);
        }
    }
    least.get() - at_left.min(at_right).min(seems - as_it_seems)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::fitting::projected::Common;
    use nalgebra::{DMatrix, DVector};

    /// Sets whose places are read with an error of their own and a variance of the noise, all alike, and are off by a number times `way`: the likelihood of both
    /// hypotheses is known, each with its own variance.
    #[test]
    fn a_column_explains_what_the_scatter_of_readings_seemed_to() {
        const NOISE: f64 = 0.5;
        let way = [1.0, -1.0, 2.0, -2.0, 1.0, -1.0, 2.0, -2.0];
        let own = [0.3, -0.8, 0.9, 0.7, -1.1, 1.2, -0.2, -0.9];
        let off: Vec<f64> = way.iter().zip(own).map(|(way, own)| 1.7 * way + own).collect();
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let sets = way.len() as f64;
        let square = sum(&off, &off);
        let nothing = DMatrix::zeros(2, 2);
        let at = |variance: f64| {
            let all = variance + NOISE;
            Projected {
                matrix: DMatrix::from_element(1, 1, sum(&way, &way) / all),
                vector: DVector::from_element(1, sum(&way, &off) / all),
                raw: DVector::from_element(1, sum(&way, &way) / all),
                jitter_m2: variance,
                chi2: square / all + sets * all.ln(),
                settled: 0.0,
                solved: DMatrix::zeros(0, 2),
                common: Common::fitted(0, &nothing, &mut nothing.clone(), &mut DMatrix::zeros(0, 2)),
            }
        };
        let left = square - sum(&way, &off).powi(2) / sum(&way, &way);
        let seems = square / sets - NOISE;
        let found = explained(&at, seems, 0, 0);
        assert!((found - sets * (square / left).ln()).abs() < 1e-3, "{found}");
        // As it seems, readings that scatter more hide a part of it.
        assert!(found > 1.5 * (square - left) / (seems + NOISE), "{found}");
    }
}
