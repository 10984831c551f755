//! A fit that is asserted is gone on with to its end: the light of a background is split as other pixels say by then, and a shape that moves by a third of itself at most,
//! or a long valley, may take more steps than one way has.

use super::fit::{Fit, fit};
use super::noise::Noise;
use super::split::split_anew;
use crate::diagnose::reading::data::Data;
use std::sync::Arc;

/// A further step that promises so little, chi squared, is not worth another way: one standard deviation of one number.
const PROMISED: f64 = 1.0;
/// Ways at most.
const WAYS: usize = 8;

/// The fit without any effect.
pub fn unfitted(data: &Data, noise: Noise) -> Fit {
    let fitted = fit(data, None, Vec::new(), noise, &|_| true);
    with_light_split(data, fitted, noise)
}

/// Where `fitted`, to all sets of `data`, leads in further ways, as long as each leads lower and the next step promises something.
pub fn finished(data: &Data, mut fitted: Fit, noise: Noise) -> Fit {
    fitted = with_light_split(data, fitted, noise);
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

/// Where `fitted` leads when the light of pixels that do not tell it is split as others say at its end, as long as each such split leads lower: what the split was
/// before, the strength of a flicker has been fitted to.
fn with_light_split(data: &Data, mut fitted: Fit, noise: Noise) -> Fit {
    for _ in 0..WAYS {
        let Some(pixels) = split_anew(data, &fitted.pixels, &fitted.pieces) else { break };
        let from = Fit { pixels: Arc::new(pixels), ..fitted.clone() };
        let anew = fit(data, Some(&from), fitted.pieces.clone(), noise, &|_| true);
        if anew.left() + PROMISED >= fitted.left() {
            break;
        }
        fitted = anew;
    }
    fitted
}
