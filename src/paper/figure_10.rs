//! Figure 10: linearity of the WDFT, both ways, as figure 2 has that of four frames.

use super::camera::Method;
use super::figure::Figure;

/// The figure.
pub fn figure(wdft: &Method) -> Figure {
    super::figure_02::figure(10, "WDFT: linearity error, both ways", wdft)
}
