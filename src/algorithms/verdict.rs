//! What the roots of the characteristic polynomial say, by Surrel's three rules (Surrel 1996).

use super::polynomial::{Basis, Polynomial};
use super::table::Algorithm;

/// Highest harmonic that is judged.
pub const MOST_HARMONIC: usize = 12;

/// Leakage, relative to the fundamental's vector, below which a sum counts as what floating point leaves of zero.
const ROUNDING: f64 = 1e-12;

/// A harmonic's fate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HarmonicVerdict {
    /// Its number, 2 to [`MOST_HARMONIC`].
    pub harmonic: usize,
    /// How many times exp(i harmonic δ) is a root, in Surrel's sign.
    pub upper_roots: usize,
    /// How many times exp(−i harmonic δ) is.
    pub lower_roots: usize,
    /// Which of 1, −1 and 0 its steps look like: the fundamental, its image, constant light. With both signs the same.
    pub alias: Option<i64>,
    /// Cycles of the phase's error over a turn of phase, and how large it is at most, rad for a harmonic as large as the
    /// fundamental, of either sign: (harmonic − 1 cycles by the upper, harmonic + 1 by the lower).
    pub leakage: [f64; 2],
}

impl HarmonicVerdict {
    /// How often both are roots: 0, it comes through (rule 1); 1, it is rejected; 2, under a linear step error too (rule 2);
    /// k, no term up to the power k − 1 of the step error is left (rule 3).
    pub fn rejected(&self) -> usize {
        self.upper_roots.min(self.lower_roots)
    }

    /// Cycles of the larger of its two errors.
    pub fn cycles(&self) -> usize {
        if self.leakage[0] >= self.leakage[1] { self.harmonic - 1 } else { self.harmonic + 1 }
    }
}

/// The verdict on an algorithm.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// How often the fundamental's image, −1, is a root: with k, no swing of the phase up to the power k − 1 of a step error is
    /// left. 0 would be an error without any disturbance.
    pub step_order: usize,
    /// The same under motion: frames in their order, which is another matter with unequal steps.
    pub motion_order: usize,
    /// How often constant light, 0, is a root, frames in their order: 1 as it must, 2 where a linear drift of the offset is
    /// without effect, and so on.
    pub offset_order: usize,
    /// Turn of the phase by a drift of the amplitude, rad for a relative drift of 1 a frame: the same at every phase.
    pub drift_turn_rad: f64,
    /// Harmonics 2 to [`MOST_HARMONIC`].
    pub harmonics: Vec<HarmonicVerdict>,
    /// Of equal steps: the roots exp(i m δ), all m of a turn, with their multiplicities.
    pub roots: Vec<(i64, usize)>,
    /// Noise factor σ_φ A / σ.
    pub noise_factor: f64,
}

impl Verdict {
    /// The verdict on `algorithm`; where it estimates the step, on the linear one that it is around its nominal step.
    pub fn new(algorithm: &Algorithm) -> Self {
        Self::of(&algorithm.polynomial, algorithm.equal_step().map(|step| step.denominator()))
    }

    /// The verdict on `polynomial`, with equal steps of some part / `parts` of a turn, or unequal ones.
    pub fn of(polynomial: &Polynomial, parts: Option<i64>) -> Self {
        let multiplicity = |m: i64| polynomial.multiplicity(m, Basis::Angle);
        let fundamental = polynomial.response(1, |_| 1.0);
        let leakage = |m: i64| {
            let share = polynomial.response(m, |_| 1.0).norm() / fundamental.norm();
            if share < ROUNDING { 0.0 } else { share }
        };
        let alias = |m: i64| {
            let parts = parts?;
            [1, -1, 0].into_iter().find(|like| (m - like) % parts == 0)
        };
        let harmonics = (2..=MOST_HARMONIC).map(|harmonic| {
            let m = harmonic as i64;
            HarmonicVerdict {
                harmonic,
                upper_roots: multiplicity(m),
                lower_roots: multiplicity(-m),
                alias: alias(m),
                leakage: [leakage(m), leakage(-m)],
            }
        });
        let roots = parts.into_iter().flat_map(|parts| {
            let all = -((parts - 1) / 2)..=parts / 2;
            all.map(|m| (m, multiplicity(m))).filter(|&(_, times)| times > 0)
        });
        let drift = polynomial.response(1, |n| n as f64) / fundamental;
        Self {
            step_order: multiplicity(-1),
            motion_order: polynomial.multiplicity(-1, Basis::Time),
            offset_order: polynomial.multiplicity(0, Basis::Time),
            drift_turn_rad: if drift.im.abs() < ROUNDING { 0.0 } else { drift.im },
            harmonics: harmonics.collect(),
            roots: roots.collect(),
            noise_factor: polynomial.noise_factor(),
        }
    }

    /// The harmonics that are rejected at least `times`-fold.
    pub fn rejected(&self, times: usize) -> Vec<usize> {
        self.harmonics.iter().filter(|row| row.rejected() >= times).map(|row| row.harmonic).collect()
    }
}
