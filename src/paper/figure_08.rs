//! Figure 8: a linear step error with one, two and three roots at m = −1.

use super::camera::Method;
use super::figure::{Figure, Plot};
use super::figure_12::phase_stepped;
use super::residual::span;
use crate::physics::Correlation;
use crate::problem::Result;

/// Step errors up to a tenth of the step.
const STEP_ERRORS: u32 = 40;
const LARGEST: f64 = 0.1;

/// Rows with a third of a turn as the step and one, two and three roots at the image.
const ROWS: [(&str, &str); 3] =
    [("one root", "dft-3"), ("two roots", "n-plus-1-b-3"), ("three roots", "n-plus-3-3")];

/// Step error and half the range of the error, m, of `method` on `correlation`.
pub fn swing(method: &Method, correlation: &Correlation) -> Vec<(f64, f64)> {
    let at = |n| {
        let step_error = LARGEST * (2.0 * f64::from(n) / f64::from(STEP_ERRORS) - 1.0);
        let errors_m: Vec<f64> =
            phase_stepped(method, correlation, step_error).into_iter().map(|point| point.1).collect();
        (step_error, span(&errors_m) / 2.0)
    };
    (0..=STEP_ERRORS).map(at).collect()
}

/// The figure.
///
/// # Errors
/// As [`Method::of`].
pub fn figure() -> Result<Figure> {
    let plot = |(name, row): &(&'static str, &str)| {
        Ok(Plot::line(*name, swing(&Method::of(name, row)?, &Correlation::sinusoidal())))
    };
    Ok(Figure {
        number: 8,
        title: "Step error with one, two and three roots at m = \u{2212}1",
        abscissa: "step error, share of the step",
        ordinate: "half the range of the error, m",
        plots: ROWS.iter().map(plot).collect::<Result<_>>()?,
        assumed: "step of a third of a turn: the DFT of three frames, N+1 type B, N+3; 30 MHz, a sine",
    })
}
