//! Figure 9: the third harmonic under a linear step error with no, one and two roots at ±3.

use super::camera::Method;
use super::figure::{Figure, Plot};
use super::figure_08::swing;
use crate::physics::{Correlation, Harmonic};
use crate::problem::Result;

/// Rows with no root at ±3, one at each, two at each.
const ROWS: [(&str, &str); 3] =
    [("no root", "four_frame"), ("one root", "n-plus-1-b-3"), ("two roots", "wdft")];

/// The figure.
///
/// # Errors
/// As [`Method::of`].
pub fn figure() -> Result<Figure> {
    let third = Correlation::with_harmonics(&[Harmonic { number: 3, amplitude: 1.0 / 31.0, phase_rad: 0.0 }]);
    let plot =
        |(name, row): &(&'static str, &str)| Ok(Plot::line(*name, swing(&Method::of(name, row)?, &third)));
    Ok(Figure {
        number: 9,
        title: "Third harmonic and step error with no, one and two roots at \u{b1}3",
        abscissa: "step error, share of the step",
        ordinate: "half the range of the error, m",
        plots: ROWS.iter().map(plot).collect::<Result<_>>()?,
        assumed: "four frames, N+1 type B with N = 3, the WDFT (the image a root once, twice, twice); 1/31, phase 0; 30 MHz",
    })
}
