//! From polynomials to rows that the generator takes, and their ranking.

use super::super::polynomial::{Polynomial, divisor};
use super::super::verdict::Verdict;
use super::candidates::{Coefficients, candidates, noise_factor};
use super::request::{Demand, Request};
use crate::problem::{Problem, Result};
use crate::spec::{Row, Scheme, StepAngle};
use num_complex::Complex64;
use std::collections::BTreeSet;

/// A row that meets a request.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// The row.
    pub scheme: Scheme,
    /// Its step.
    pub step: StepAngle,
    /// What its roots say.
    pub verdict: Verdict,
    /// Digits that are not 0 in the signed-digit forms of all its weights: what the sums' adders count.
    pub digits: u32,
    /// Bits by which the larger of both sums is longer than a frame.
    pub growth_bits: u32,
    /// Which others leave it unbeaten: 1 where no row has fewer frames, less noise and fewer digits (or two of them at an equal
    /// third), 2 where only rows of rank 1 do, …
    pub rank: usize,
}

impl Design {
    /// σ_φ over that of the plain DFT in the same frames, 1 or more: what the roots cost in light.
    pub fn noise_over_dft(&self) -> f64 {
        self.verdict.noise_factor * (self.scheme.steps() as f64 / 2.0).sqrt()
    }
}

/// Candidates of each number of frames that are made rows, beside those that no other beats in noise and size: of least noise,
/// and of smallest weights.
const MOST_ROWS: usize = 20;
/// Largest factor, in either direction of the ring, by which coefficients are turned to the first frame's phase.
const MOST_FACTOR: i64 = 6;
/// What floating point leaves of zero in sums of small integers' products.
const ROUNDING: f64 = 1e-7;

/// The rows that meet `request`, best first: by rank, then by noise.
///
/// # Errors
/// Numbers out of range; a request that no row of integers can meet, with the reason for every step.
pub fn design(request: &Request) -> Result<Vec<Design>> {
    request.check()?;
    let mut seen = BTreeSet::new();
    let mut designs = Vec::new();
    for demand in request.demands()? {
        for frames in demand.least_frames().max(3)..=request.frames {
            for polynomial in promising(&demand, frames) {
                let Some(row) = row(&demand, &polynomial) else { continue };
                if seen.insert((row.angles_text(), row.row.in_phase.clone(), row.row.quadrature.clone())) {
                    designs.extend(checked(request, &demand, row.row));
                }
            }
        }
    }
    if designs.is_empty() {
        return Err(Problem::at(
            "vuris algorithms design",
            "roots that can be had, but no row of small weights with them",
        )
        .expected("weights of 18 bits, and frames among which a regular polygon gives the offset")
        .remedy("allow more growth, more frames, or other steps"));
    }
    rank(&mut designs);
    Ok(designs)
}

/// The candidates that no other beats in noise and size of the weights, those of least noise, and those of smallest weights.
fn promising(demand: &Demand, frames: usize) -> Vec<Coefficients> {
    let size = |polynomial: &Coefficients| polynomial.iter().map(|c| c.re.abs() + c.im.abs()).sum::<f64>();
    let mut rated: Vec<(f64, f64, Coefficients)> = candidates(demand, frames)
        .into_iter()
        .map(|polynomial| (noise_factor(demand, &polynomial), size(&polynomial), polynomial))
        .filter(|(noise, ..)| noise.is_finite() && *noise < 100.0)
        .collect();
    rated.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut best: Vec<Coefficients> = rated.iter().take(MOST_ROWS).map(|row| row.2.clone()).collect();
    rated.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.total_cmp(&b.0)));
    let mut least = f64::INFINITY;
    for (number, (noise, _, polynomial)) in rated.into_iter().enumerate() {
        if number < MOST_ROWS || noise < least * (1.0 - 1e-9) {
            best.push(polynomial);
        }
        least = least.min(noise);
    }
    best
}

/// A row, not yet checked.
struct Candidate {
    row: Row,
}

impl Candidate {
    fn angles_text(&self) -> String {
        self.row.angles.iter().map(|angle| format!("{angle} ")).collect()
    }
}

/// The row of Surrel's polynomial: conjugate for the paper's sign, turned by a factor of the ring so that the phase is the
/// first frame's, without a common divisor, and of all such the one of smallest weights. Where no factor turns it so, the
/// first frame's angle takes the turn.
fn row(demand: &Demand, polynomial: &[Complex64]) -> Option<Candidate> {
    let own: Coefficients = polynomial.iter().map(Complex64::conj).collect();
    let step = demand.step;
    let response = |weights: &[Complex64]| -> Complex64 {
        weights
            .iter()
            .enumerate()
            .map(|(n, c)| c * Complex64::from_polar(1.0, -(n as f64) * step.rad()))
            .sum()
    };
    let gain = response(&own);
    let unit = demand.ring.unit();
    let mut best: Option<(i64, Vec<i64>, Vec<i64>)> = None;
    for a in -MOST_FACTOR..=MOST_FACTOR {
        for b in -MOST_FACTOR..=MOST_FACTOR {
            let factor = a as f64 + b as f64 * unit;
            let turned = gain * factor;
            if turned.re > ROUNDING && turned.im.abs() < ROUNDING * turned.re {
                let weights: Coefficients = own.iter().map(|c| c * factor).collect();
                let Some((in_phase, quadrature)) = integers(&weights, unit.im) else { continue };
                let size = in_phase.iter().chain(&quadrature).map(|weight| weight.abs()).sum();
                if best.as_ref().is_none_or(|(least, ..)| size < *least) {
                    best = Some((size, in_phase, quadrature));
                }
            }
        }
    }
    let parts = 24 * step.denominator();
    let (first, in_phase, quadrature) = match best {
        Some((_, in_phase, quadrature)) => (0, in_phase, quadrature),
        None => {
            let turns = gain.arg() / std::f64::consts::TAU * parts as f64;
            let (in_phase, quadrature) = integers(&own, unit.im)?;
            ((turns - turns.round()).abs() < ROUNDING).then_some((
                turns.round() as i64,
                in_phase,
                quadrature,
            ))?
        }
    };
    let angle = |n: i64| {
        // Both in parts of a turn that are a multiple of the step's denominator.
        let numerator = first + n * step.numerator() * 24;
        let common = divisor(numerator, parts).max(1);
        StepAngle::new(numerator / common, parts / common)
    };
    let angles: Vec<StepAngle> = (0..in_phase.len() as i64).map(angle).collect::<Option<_>>()?;
    let row = Row {
        name: format!("designed-{}-{}", in_phase.len(), step.denominator()),
        angles,
        in_phase,
        quadrature,
        offset: None,
        irrational: demand.ring.0,
        reference: String::new(),
    };
    Some(Candidate { row })
}

/// Real and imaginary parts (these over `unit`) as integers without a common divisor; `None` where twice the parts are not.
fn integers(weights: &[Complex64], unit: f64) -> Option<(Vec<i64>, Vec<i64>)> {
    let twice = |value: f64| {
        let nearest = (2.0 * value).round();
        ((2.0 * value - nearest).abs() < 1e-6 && nearest.abs() < 1e6).then_some(nearest as i64)
    };
    let in_phase: Vec<i64> = weights.iter().map(|c| twice(c.re)).collect::<Option<_>>()?;
    let quadrature: Vec<i64> = weights.iter().map(|c| twice(c.im / unit)).collect::<Option<_>>()?;
    let common = in_phase.iter().chain(&quadrature).fold(0, |common, &weight| divisor(common, weight)).max(1);
    let over = |weights: Vec<i64>| weights.into_iter().map(|weight| weight / common).collect();
    Some((over(in_phase), over(quadrature)))
}

/// The design of `row`, if the generator takes it and its integers have the roots: exactly.
fn checked(request: &Request, demand: &Demand, row: Row) -> Option<Design> {
    let reference = format!("vuris algorithms design, steps of {} turn", demand.step);
    let scheme = Scheme::of_row("design", Row { reference, ..row }).ok()?;
    let polynomial = Polynomial::of_scheme(&scheme)?;
    if scheme.weight_error_rad > 0.0 || !request.is_met_by(&polynomial) {
        return None;
    }
    let digits = scheme.in_phase.iter().chain(&*scheme.quadrature).map(|&weight| signed_digits(weight)).sum();
    let growth = |weights: &[i64]| weights.iter().map(|weight| weight.unsigned_abs()).sum::<u64>();
    let most = growth(&scheme.in_phase).max(growth(&scheme.quadrature)).max(1);
    let growth_bits = most.next_power_of_two().trailing_zeros();
    (growth_bits <= request.growth_bits).then(|| Design {
        verdict: Verdict::of(&polynomial, Some(demand.step.denominator())),
        step: demand.step,
        digits,
        growth_bits,
        rank: 0,
        scheme,
    })
}

/// Digits that are not 0 in the canonical signed-digit form: where 3 n and n differ (Reitwiesner 1960).
pub(super) fn signed_digits(number: i64) -> u32 {
    let size = number.unsigned_abs();
    (size ^ (3 * size)).count_ones()
}

/// Sorts by how many layers of unbeaten rows lie above each, then by noise, digits and frames.
fn rank(designs: &mut [Design]) {
    let key = |design: &Design| (design.scheme.steps(), design.verdict.noise_factor, design.digits);
    let beats = |one: &Design, other: &Design| {
        let ((f1, n1, d1), (f2, n2, d2)) = (key(one), key(other));
        // Noise factors of the same row in other forms differ in their last bits.
        let (no_worse, better) = (n1 <= n2 * (1.0 + 1e-9), n1 < n2 * (1.0 - 1e-9));
        f1 <= f2 && no_worse && d1 <= d2 && (f1 < f2 || better || d1 < d2)
    };
    let mut rank = 0;
    while designs.iter().any(|design| design.rank == 0) {
        rank += 1;
        let open: Vec<usize> = (0..designs.len()).filter(|&n| designs[n].rank == 0).collect();
        let unbeaten: Vec<usize> = open
            .iter()
            .copied()
            .filter(|&n| open.iter().all(|&other| !beats(&designs[other], &designs[n])))
            .collect();
        for n in unbeaten {
            designs[n].rank = rank;
        }
    }
    designs.sort_by(|a, b| {
        a.rank
            .cmp(&b.rank)
            .then(a.verdict.noise_factor.total_cmp(&b.verdict.noise_factor))
            .then(a.digits.cmp(&b.digits))
            .then(a.scheme.steps().cmp(&b.scheme.steps()))
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 7 = 8 − 1, 11 = 16 − 4 − 1, 15 = 16 − 1, 21 = 16 + 4 + 1.
    #[test]
    fn signed_digits_are_counted() {
        let counts = [0, 1, -1, 2, 3, 7, 11, 15, -21].map(signed_digits);
        assert_eq!(counts, [0, 1, 1, 1, 2, 2, 3, 2, 3]);
    }
}
