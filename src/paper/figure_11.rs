//! Figure 11: the WDFT's motion error, as figure 7 is that of four frames.

use super::camera::Method;
use super::figure::Figure;

/// The figure.
pub fn figure(wdft: &Method) -> Figure {
    super::figure_07::figure(11, "WDFT: motion error at 2 m/s, taken as in the paper", wdft)
}
