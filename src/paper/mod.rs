//! The paper's experiments computed again: J. M. Drayton, D. A. Carnegie, A. A. Dorrington, "Improved Phase Detection Algorithms for
//! Indirect Time of Flight Range Imaging Cameras", IEEE ROSE 2012.
//!
//! One file a figure or table; [`camera`] is the one pixel that they share, [`linearity`] and [`motion`] are its experiments. Every
//! quantity, figure and table says what was assumed for it.

pub mod camera;
mod candidates;
mod figure;
mod figure_01;
mod figure_02;
mod figure_04;
pub mod figure_05;
mod figure_06;
pub mod figure_07;
pub mod figure_08;
mod figure_09;
mod figure_10;
mod figure_11;
pub mod figure_12;
pub mod linearity;
pub mod motion;
pub mod open_question;
mod open_question_table;
mod quantities;
mod quantity;
pub mod residual;
pub mod rivals;
pub mod table_1;

pub use candidates::table as candidates_table;
pub use figure::{Figure, Plot, Stroke, Table, mm};
pub use quantities::{linearity_range_m, quantities};
pub use quantity::{Measured, Quantity};

pub use open_question_table::table as open_question_table;

use crate::problem::Result;
use camera::Method;

/// The figures 1 to 12.
///
/// # Errors
/// As [`Method::of`].
pub fn figures() -> Result<Vec<Figure>> {
    let methods = Method::both()?;
    let [four, wdft] = &methods;
    Ok(vec![
        figure_01::figure(four),
        figure_02::figure(2, "Four frames: linearity error with the target moved in steps of 50 mm", four),
        table_1::figure_3(),
        figure_04::figure(four),
        figure_05::figure(four),
        figure_06::figure(four),
        figure_07::figure(7, "Four frames: motion error at 2 m/s, taken as in the paper", four),
        figure_08::figure()?,
        figure_09::figure()?,
        figure_10::figure(wdft),
        figure_11::figure(wdft),
        figure_12::figure(&methods),
    ])
}
