//! Strengths that came to their bounds: what is there is more than an effect may be, or something else.

use super::fit::Fit;
use crate::diagnose::tangents::columns::Column;
use crate::physics::Parameter;
use std::collections::BTreeSet;

/// A value that is nearer to its bound, as a share of all that it may be, is at it: the fit would have gone on.
const AT_BOUND: f64 = 1e-6;

/// Whether a `value`, with what the camera includes of it, is at the bound of its parameter, where signals go up to `full_scale_dn`; what is off is not.
pub fn is_at_bound(parameter: &Parameter, value: f64, full_scale_dn: f64) -> bool {
    let (low, high) = parameter.bounds_within(full_scale_dn);
    let near = AT_BOUND * (high - low);
    (value - parameter.off).abs() > near && (value - low < near || high - value < near)
}

/// Whether the strength of an effect that was fitted is at its bound.
pub fn is_bounded(fit: &Fit) -> bool {
    !bounded(fit).is_empty()
}

/// The effects with a fitted strength at its bound.
pub fn bounded(fit: &Fit) -> BTreeSet<&'static str> {
    let of_column = |column: &Column| {
        let piece = &fit.pieces[column.piece];
        let parameter = &piece.effect.parameters[column.parameter];
        let value = piece.in_all(column.parameter);
        let is_at_it = !parameter.is_shape() && is_at_bound(parameter, value, fit.pixels.full_scale_dn);
        is_at_it.then_some(piece.effect.name)
    };
    fit.columns.iter().filter_map(of_column).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::effects;

    /// A value at either end is at its bound, one that is off is not, and an end that is many full scales is nearer.
    #[test]
    fn what_would_have_gone_on_is_at_its_bound() {
        let parameter = |effect: &str, number: usize| &effects::named(effect).unwrap().parameters[number];
        let errors = parameter("phase_step_errors", 0);
        assert_eq!(
            [-0.5, -0.49, 0.0, 0.499, 0.5].map(|rad| is_at_bound(errors, rad, 255.0)),
            [true, false, false, false, true]
        );
        let share = parameter("lens_scatter", 0);
        assert!(!is_at_bound(share, 0.0, 255.0) && is_at_bound(share, 0.5, 255.0));
        let wave = parameter("adc_nonlinearity", 0);
        assert!(is_at_bound(wave, 0.02 * 255.0, 255.0) && !is_at_bound(wave, 0.02 * 255.0, 4095.0));
    }
}
