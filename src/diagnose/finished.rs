//! A fit that is asserted is gone on with to its end: a shape that moves by a third of itself at most, or a long valley, may take more steps than one way has.

use super::data::Data;
use super::fit::{Fit, fit};
use super::noise::Noise;
use super::split::split_anew;

/// A further step that promises so little, chi squared, is not worth another way: one standard deviation of one number.
const PROMISED: f64 = 1.0;
/// Ways at most.
const WAYS: usize = 8;

/// Where `fitted`, to all sets of `data`, leads in further ways, as long as each leads lower and the next step promises something.
pub fn finished(data: &Data, mut fitted: Fit, noise: Noise) -> Fit {
    fitted = split_anew(data, fitted, noise);
    for _ in 0..WAYS {
        if fitted.unreached < PROMISED {
            break;
        }
        let further = fit(data, Some(&fitted), fitted.pieces.clone(), noise, &|_| true);
        let is_lower = further.left() + PROMISED < fitted.left();
        if is_lower || further.unreached < fitted.unreached && further.chi2 <= fitted.chi2 {
            fitted = further;
        }
        if !is_lower {
            break;
        }
    }
    fitted
}
