//! Phase algorithms: their characteristic polynomials, what the roots say by Surrel's rules, how far disturbances move the
//! phase, and the search for new rows.
//!
//! Source: Y. Surrel, "Design of algorithms for phase measurements by the use of phase stepping", Applied Optics 35, 51 (1996).
//! Roots are numbered in his sign: 1 is the fundamental, −1 its image, 0 constant light, ±m the harmonic m. The camera's
//! paper measures φ the other way round, and [`Polynomial`] reads its coefficients as conjugates.

mod cyclotomic;
mod design;
mod estimator;
mod polynomial;
mod roots;
mod sensitivity;
mod table;
mod verdict;

pub use cyclotomic::Cyclotomic;
pub use design::{DESIGN_FRAMES, Design, Request, design, usual_steps};
pub use estimator::Estimator;
pub use polynomial::{Basis, Polynomial};
pub use roots::other_roots;
pub use sensitivity::{Curve, Disturbance, PhaseError};
pub use table::{Algorithm, DFT_BITS, named, table};
pub use verdict::{HarmonicVerdict, MOST_HARMONIC, Verdict};
