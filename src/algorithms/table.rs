//! The table of algorithms: published rows, the schemes that are built in, plain DFTs, and those that estimate the step.

use super::estimator::Estimator;
use super::polynomial::{Basis, Polynomial, divisor};
use crate::problem::{Problem, Result};
use crate::spec::{DFT_FRAMES, Irrational, Row, SCHEMES, Scheme, SchemeOrigin, StepAngle};
use num_complex::Complex64;

/// A way of making a phase from frames, with what the theory needs of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Algorithm {
    /// What the command line calls it.
    pub name: String,
    /// Where it comes from.
    pub reference: String,
    /// What of its published form, or of its weights here, is to be known; may be empty.
    pub remark: String,
    /// The frames' angles.
    pub angles: Vec<StepAngle>,
    /// Its characteristic polynomial: of the true weights where the scheme's are rounded, and of the linear algorithm that
    /// it is at the nominal step where it estimates the step.
    pub polynomial: Polynomial,
    /// Where it is not linear in the frames: how it makes its phase.
    pub estimator: Option<Estimator>,
    /// The integer weights, as a specification has them; `None` where it is not linear.
    pub scheme: Option<Scheme>,
}

/// Bits of the DFTs' cosines and sines in the table.
pub const DFT_BITS: u32 = 16;

/// Name, step, frames, in-phase and quadrature weights for I_n = A cos(n δ − φ) + B, irrational, reference, remark.
type PublishedRow =
    (&'static str, (i64, i64), &'static [i64], &'static [i64], Irrational, &'static str, &'static str);

/// Rows of integers that are not built in. For the paper's sign of φ and the first frame's phase, so that the published forms,
/// which are for I_n = A cos(φ + angle_n) + B and mostly for the middle frame, are negated and turned.
const ROWS: &[PublishedRow] = &[
    (
        "dft-3",
        (1, 3),
        &[2, -1, -1],
        &[0, 1, -1],
        Irrational::Sqrt3,
        "plain DFT of 3 frames",
        "Exact with the irrational sqrt(3); the specification's scheme dft would round it.",
    ),
    (
        "dft-6",
        (1, 6),
        &[2, 1, -1, -2, -1, 1],
        &[0, 1, 1, 0, -1, -1],
        Irrational::Sqrt3,
        "plain DFT of 6 frames",
        "Exact with the irrational sqrt(3); the specification's scheme dft would round it.",
    ),
    (
        "wdft-4",
        (1, 4),
        &[1, 0, -3, 0, 3, 0, -1],
        &[0, 2, 0, -4, 0, 2, 0],
        Irrational::One,
        "Surrel 1996: windowed DFT with N = 4, weights 1 2 3 4 3 2 1",
        "",
    ),
    (
        "wdft-6",
        (1, 6),
        &[2, 2, -3, -8, -5, 6, 10, 4, -3, -4, -1],
        &[0, 2, 3, 0, -5, -6, 0, 4, 3, 0, -1],
        Irrational::Sqrt3,
        "Surrel 1996: windowed DFT with N = 6, weights 1 2 3 4 5 6 5 4 3 2 1",
        "",
    ),
    (
        "hariharan",
        (1, 4),
        &[1, 0, -2, 0, 1],
        &[0, 2, 0, -2, 0],
        Irrational::One,
        "Schwider et al. 1983; Hariharan, Oreb, Eiju 1987: tan phi = 2 (I2 - I4) / (2 I3 - I1 - I5), phase at the middle frame",
        "The same row as N+1 type B with N = 4.",
    ),
    (
        "n-plus-1-b-3",
        (1, 3),
        &[3, -3, -3, 3],
        &[1, 3, -3, -1],
        Irrational::Sqrt3,
        "N+1 type B with N = 3 (Larkin, Oreb 1992; Surrel 1993): the DFT's roots and a second one at the image",
        "",
    ),
    (
        "n-plus-1-b-6",
        (1, 6),
        &[3, 3, -3, -6, -3, 3, 3],
        &[-1, 3, 3, 0, -3, -3, 1],
        Irrational::Sqrt3,
        "N+1 type B with N = 6 (Larkin, Oreb 1992; Surrel 1993): the DFT's roots and a second one at the image",
        "",
    ),
    (
        "n-plus-3-3",
        (1, 3),
        &[3, -6, -6, 15, -3, -3],
        &[1, 4, -8, -1, 5, -1],
        Irrational::Sqrt3,
        N_PLUS_3,
        N_PLUS_3_REMARK,
    ),
    (
        "n-plus-3-4",
        (1, 4),
        &[1, 2, -7, 0, 7, -2, -1],
        &[-1, 4, 1, -8, 1, 4, -1],
        Irrational::One,
        N_PLUS_3,
        N_PLUS_3_REMARK,
    ),
    (
        "n-plus-3-6",
        (1, 6),
        &[-1, 6, -2, -6, -3, 3, 7, -3, -1],
        &[-1, 0, 4, 0, -3, -3, 1, 3, -1],
        Irrational::Sqrt3,
        N_PLUS_3,
        N_PLUS_3_REMARK,
    ),
    (
        "schmit-creath",
        (1, 4),
        &[1, 2, -6, 2, 1],
        &[-1, 4, 0, -4, 1],
        Irrational::One,
        "Schmit, Creath 1995: extended averaging, five frames, phase at the middle frame",
        "",
    ),
    (
        "de-groot-7",
        (1, 4),
        &[1, 0, -7, 0, 7, 0, -1],
        &[0, 4, 0, -8, 0, 4, 0],
        Irrational::One,
        "de Groot 1995: seven frames, phase at the middle frame",
        "",
    ),
    (
        "thirteen-frame",
        (1, 8),
        &[3, 4, 0, -12, -21, -16, 0, 16, 21, 12, 0, -4, -3],
        &[0, 4, 12, 12, 0, -16, -24, -16, 0, 12, 12, 4, 0],
        Irrational::One,
        "de Groot 2000: thirteen frames an eighth of a turn apart, phase at the middle frame",
        "Its root at 3 is there three times, that at -3 is not, and cannot be: with the step 1/8 the roots -3 and 1 are conjugates \
         over the Gaussian integers, and 1 is the fundamental. So the third harmonic is weakened, not rejected.",
    ),
];

const N_PLUS_3: &str =
    "N+3: the DFT's roots, the image three times, constant light twice; by the theory of Surrel 1996";
const N_PLUS_3_REMARK: &str = "Made of the roots that its three further frames are taken for here (insensitive to a linear drift of the offset, and to the \
     second order of a step error), which leave no freedom; that its authors chose these roots has not been checked.";

/// Name, estimator, nominal step, reference.
const ESTIMATORS: [(&str, Estimator, (i64, i64), &str); 3] = [
    (
        "carre",
        Estimator::Carre,
        (1, 4),
        "Carre 1966: tan phi = sqrt((u + v) (3 v - u)) / (I2 + I3 - I1 - I4), u = I1 - I4, v = I2 - I3",
    ),
    (
        "carre-110",
        Estimator::Carre,
        (11, 36),
        "Carre 1966, around the step of 110 degrees that is recommended for it",
    ),
    (
        "novak",
        Estimator::Novak,
        (1, 4),
        "Novak 2003: tan phi = sqrt(4 (I2 - I4)^2 - (I1 - I5)^2) / (2 I3 - I1 - I5)",
    ),
];

impl Algorithm {
    /// Of integer weights, exactly as they are; a DFT's are taken for what they are rounded from. `None` where the angles have
    /// no common part of a turn above 2⁻²⁰.
    pub fn of_scheme(scheme: &Scheme) -> Option<Self> {
        let (name, polynomial, remark) = match scheme.origin {
            SchemeOrigin::Dft { .. } => {
                let polynomial = Polynomial::of_window(&scheme.angles, &vec![1; scheme.steps()])?;
                (format!("dft-{}", scheme.steps()), polynomial, "")
            }
            SchemeOrigin::Named | SchemeOrigin::Row => {
                (scheme.name.to_string(), Polynomial::of_scheme(scheme)?, "")
            }
        };
        Some(Self {
            name,
            reference: scheme.reference.to_string(),
            remark: remark.to_owned(),
            angles: scheme.angles.to_vec(),
            polynomial,
            estimator: None,
            scheme: Some(scheme.clone()),
        })
    }

    /// An algorithm that estimates the step, around `step`.
    fn of_estimator(name: &str, estimator: Estimator, step: StepAngle, reference: &str) -> Option<Self> {
        let remark = "Not linear in the frames: no polynomial of its own, and not for the generator. Everything said of roots, \
                      noise and slopes is of the linear algorithm that it is around frames of the nominal step, the same at \
                      every phase; larger errors are simulated with the real one.";
        Some(Self {
            name: name.to_owned(),
            reference: reference.to_owned(),
            remark: remark.to_owned(),
            angles: super::estimator::centred_angles(step, estimator.frames())?,
            polynomial: estimator.linearised(step)?,
            estimator: Some(estimator),
            scheme: None,
        })
    }

    /// Frames.
    pub fn frames(&self) -> usize {
        self.angles.len()
    }

    /// The step from each frame to the next, where all are the same.
    pub fn equal_step(&self) -> Option<StepAngle> {
        let between = |pair: &[StepAngle]| {
            let (one, other) = (pair[0], pair[1]);
            let numerator = other.numerator() * one.denominator() - one.numerator() * other.denominator();
            let denominator = one.denominator() * other.denominator();
            let common = divisor(numerator, denominator).max(1);
            StepAngle::new(numerator / common, denominator / common)
        };
        let first = between(self.angles.get(..2)?)?;
        self.angles.windows(2).all(|pair| between(pair) == Some(first)).then_some(first)
    }

    /// Whether the integer weights have fewer roots than the true ones, for being rounded.
    pub fn is_rounded(&self) -> bool {
        let Some(own) = self.scheme.as_ref().and_then(Polynomial::of_scheme) else { return false };
        let harmonics = -(super::verdict::MOST_HARMONIC as i64)..=super::verdict::MOST_HARMONIC as i64;
        harmonics
            .clone()
            .any(|m| own.multiplicity(m, Basis::Angle) < self.polynomial.multiplicity(m, Basis::Angle))
    }

    /// The vector whose argument is the phase of `frames`, in floating point: of the true weights, or of the estimator.
    pub fn vector(&self, frames: &[f64]) -> Complex64 {
        match self.estimator {
            Some(estimator) => estimator.vector(frames),
            None => self.polynomial.coefficients().iter().zip(frames).map(|(c, frame)| c * frame).sum(),
        }
    }
}

/// The table's rows; a refusal would be a slip in the table.
pub fn table() -> Result<Vec<Algorithm>> {
    let unknown = |name: &str| {
        Problem::at("the table of algorithms", format_args!("{name} has no polynomial"))
            .expected("steps that are parts of a turn")
    };
    let mut rows = Vec::new();
    for scheme in SCHEMES {
        rows.push(Algorithm::of_scheme(scheme).ok_or_else(|| unknown(&scheme.name))?);
    }
    for &(name, (p, q), in_phase, quadrature, irrational, reference, remark) in ROWS {
        let angles = (0..in_phase.len() as i64).map(|n| StepAngle::new(n * p, q)).collect::<Option<Vec<_>>>();
        let row = Row {
            name: name.to_owned(),
            angles: angles.ok_or_else(|| unknown(name))?,
            in_phase: in_phase.to_vec(),
            quadrature: quadrature.to_vec(),
            offset: None,
            irrational,
            reference: reference.to_owned(),
        };
        let scheme = Scheme::of_row("the table of algorithms", row)?;
        let algorithm = Algorithm::of_scheme(&scheme).ok_or_else(|| unknown(name))?;
        rows.push(Algorithm { remark: remark.to_owned(), ..algorithm });
    }
    for (name, estimator, (p, q), reference) in ESTIMATORS {
        let step = StepAngle::new(p, q).ok_or_else(|| unknown(name))?;
        rows.push(Algorithm::of_estimator(name, estimator, step, reference).ok_or_else(|| unknown(name))?);
    }
    for frames in DFT_FRAMES {
        let algorithm = Scheme::dft(frames, DFT_BITS)
            .and_then(|scheme| Algorithm::of_scheme(&scheme))
            .ok_or_else(|| unknown("dft"))?;
        if rows.iter().all(|row| row.name != algorithm.name) {
            rows.push(algorithm);
        }
    }
    Ok(rows)
}

/// The row called `name`.
pub fn named(name: &str) -> Result<Option<Algorithm>> {
    Ok(table()?.into_iter().find(|row| row.name == name))
}
