//! What a row is to withstand, as roots of its polynomial; and which requests no row of integers can meet.

use super::super::polynomial::{Basis, Polynomial, divisor};
use super::super::verdict::MOST_HARMONIC;
use crate::problem::{Problem, Result};
use crate::spec::{Irrational, StepAngle};
use num_complex::Complex64;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;
use std::ops::RangeInclusive;

/// Frames that a designed row may have.
pub const DESIGN_FRAMES: RangeInclusive<usize> = 3..=16;

/// What a row is to withstand.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Harmonics to reject, 2 to [`MOST_HARMONIC`].
    pub reject: Vec<usize>,
    /// The power of a step error, or of motion, up to which the phase must not swing: 0 for none, 1 for a linear one.
    pub motion: usize,
    /// Whether the harmonics must be rejected under a linear step error, too.
    pub harmonics_in_motion: bool,
    /// Whether linear drifts of offset and amplitude must not make the phase swing.
    pub drift: bool,
    /// Frames at most.
    pub frames: usize,
    /// Bits at most by which the longer of both sums may be longer than a frame's word.
    pub growth_bits: u32,
    /// Phase steps to try.
    pub steps: Vec<StepAngle>,
}

/// Steps that are tried where none is asked for. Only denominators with a factor of 3 or 4 can do: with others the
/// fundamental's image is a conjugate of the fundamental over the numbers that weights are made of.
pub fn usual_steps() -> Vec<StepAngle> {
    [3, 4, 6, 8, 9, 12].into_iter().filter_map(|parts| StepAngle::new(1, parts)).collect()
}

/// The numbers that a row's coefficients are: in-phase + i · irrational · quadrature.
///
/// A polynomial with coefficients in them that has a root has its conjugates over them, too, the same number of times. A root
/// that is asked for so brings others, and if the fundamental is one of them, there is no such row: with a step of 1/5 turn
/// the image brings it, whatever the weights. The image and the fundamental are no conjugates over the Gaussian integers
/// if the step's denominator is a multiple of 4, and over those with √−3 if it is one of 3.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Ring(pub Irrational);

impl Ring {
    /// Of Gaussian integers, and with √−3.
    pub const ALL: [Self; 2] = [Self(Irrational::One), Self(Irrational::Sqrt3)];

    /// Its imaginary unit: i, or i √3.
    pub fn unit(self) -> Complex64 {
        Complex64::new(0.0, (self.0.squared() as f64).sqrt())
    }

    /// A step of the lattice of its integers: i, or the third root of 1.
    pub fn lattice(self) -> Complex64 {
        match self.0 {
            Irrational::One => Complex64::i(),
            Irrational::Sqrt3 => Complex64::from_polar(1.0, TAU / 3.0),
        }
    }

    /// The order of the roots of unity that it holds, of which conjugation leaves each as it is.
    fn modulus(self) -> i64 {
        match self.0 {
            Irrational::One => 4,
            Irrational::Sqrt3 => 3,
        }
    }

    /// The conjugates of the root exp(2πi residue/parts), as residues modulo `parts`.
    pub fn orbit(self, residue: i64, parts: i64) -> BTreeSet<i64> {
        let modulus = self.modulus();
        let order = parts / divisor(parts, modulus) * modulus;
        (1..=order)
            .filter(|&a| divisor(a, order) == 1 && a % modulus == 1 % modulus)
            .map(|a| (a * residue).rem_euclid(parts))
            .collect()
    }
}

/// The roots that a step and a ring demand.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Demand {
    pub step: StepAngle,
    pub ring: Ring,
    /// Residues modulo the step's denominator, with their multiplicities.
    pub roots: BTreeMap<i64, usize>,
}

impl Demand {
    /// Frames of the shortest row with these roots.
    pub fn least_frames(&self) -> usize {
        1 + self.roots.values().sum::<usize>()
    }
}

impl Request {
    /// Checks the request's numbers.
    ///
    /// # Errors
    /// A harmonic outside 2 to 12, frames outside [`DESIGN_FRAMES`], no step, a step of whole or half turns.
    pub fn check(&self) -> Result<()> {
        let refuse = |found: String| Problem::at("vuris algorithms design", found);
        if let Some(harmonic) = self.reject.iter().find(|harmonic| !(2..=MOST_HARMONIC).contains(*harmonic)) {
            return Err(refuse(format!("--reject {harmonic}"))
                .expected(format_args!("harmonics from 2 to {MOST_HARMONIC}; 1 is what is measured")));
        }
        if !DESIGN_FRAMES.contains(&self.frames) {
            return Err(refuse(format!("--frames {}", self.frames)).expected(format_args!(
                "{} to {}",
                DESIGN_FRAMES.start(),
                DESIGN_FRAMES.end()
            )));
        }
        if let Some(step) = self.steps.iter().find(|step| step.denominator() < 3 || step.denominator() > 24) {
            return Err(refuse(format!("--step {step}")).expected(
                "parts of a turn with a denominator from 3 to 24: of half turns there are no three",
            ));
        }
        Ok(())
    }

    /// Roots m (1 is the fundamental) with the multiplicity that each needs, and what needs it.
    pub fn roots(&self) -> Vec<(i64, usize, String)> {
        let mut roots = vec![
            (0, if self.drift { 2 } else { 1 }, "constant light".to_owned()),
            (-1, (1 + self.motion).max(if self.drift { 2 } else { 1 }), IMAGE.to_owned()),
        ];
        for &harmonic in &self.reject {
            for m in [harmonic as i64, -(harmonic as i64)] {
                let times = if self.harmonics_in_motion { 2 } else { 1 };
                roots.push((m, times, format!("harmonic {harmonic}")));
            }
        }
        roots
    }

    /// The demand with `step` in `ring`, or why there is none.
    pub(super) fn demand(&self, step: StepAngle, ring: Ring) -> std::result::Result<Demand, String> {
        let parts = step.denominator();
        let mut roots = BTreeMap::new();
        for (m, times, what) in self.roots() {
            if (m - 1) % parts == 0 {
                return Err(format!(
                    "with steps of {step} turn, {what} looks like the fundamental ({m} is 1 more than a multiple of {parts})"
                ));
            }
            let orbit = ring.orbit(m, parts);
            if orbit.contains(&(1 % parts)) {
                return Err(format!(
                    "with steps of {step} turn and the irrational {}, integer weights that reject {what} reject the fundamental \
                     (roots {m} and 1 are conjugates)",
                    ring.0
                ));
            }
            for residue in orbit {
                let most = roots.entry(residue).or_insert(0);
                *most = times.max(*most);
            }
        }
        Ok(Demand { step, ring, roots })
    }

    /// Whether `polynomial` has all roots that are asked for; in exact arithmetic.
    pub fn is_met_by(&self, polynomial: &Polynomial) -> bool {
        polynomial.frames() <= self.frames
            && polynomial.multiplicity(1, Basis::Time) == 0
            && self.roots().into_iter().all(|(m, times, _)| polynomial.multiplicity(m, Basis::Time) >= times)
    }

    /// All demands that can be met within the frames.
    ///
    /// # Errors
    /// That there are none, and why for every step.
    pub(super) fn demands(&self) -> Result<Vec<Demand>> {
        let (mut met, mut reasons) = (Vec::new(), Vec::new());
        for &step in &self.steps {
            let demands = Ring::ALL.map(|ring| self.demand(step, ring));
            let shortest = demands.iter().flatten().min_by_key(|demand| demand.least_frames());
            match shortest {
                Some(demand) if demand.least_frames() > self.frames => reasons.push(format!(
                    "with steps of {step} turn, {} frames are needed: these {} roots and one frame more: {}",
                    demand.least_frames(),
                    demand.least_frames() - 1,
                    shown(demand)
                )),
                Some(_) => {}
                None => reasons.extend(refusals(&demands)),
            }
            met.extend(demands.into_iter().flatten().filter(|demand| demand.least_frames() <= self.frames));
        }
        reasons.dedup();
        if met.is_empty() {
            return Err(Problem::at(
                "vuris algorithms design",
                format_args!("no row of integers can do this:\n    {}", reasons.join("\n    ")),
            )
            .expected(format_args!("roots that leave the fundamental, in at most {} frames", self.frames))
            .remedy("allow more frames, other steps, or ask for less"));
        }
        Ok(met)
    }
}

/// Why neither ring can. One in which the fundamental's own image cannot be rejected is not worth a word beside the other.
fn refusals(demands: &[std::result::Result<Demand, String>; 2]) -> Vec<String> {
    let reasons: Vec<String> = demands.iter().filter_map(|demand| demand.clone().err()).collect();
    let telling: Vec<String> = reasons.iter().filter(|reason| !reason.contains(IMAGE)).cloned().collect();
    if telling.is_empty() { reasons } else { telling }
}

/// What the refusals call the root −1.
const IMAGE: &str = "the fundamental's image";

/// The roots in words, nearest to 0 first, such as `0, -1 twice, 2`.
fn shown(demand: &Demand) -> String {
    let parts = demand.step.denominator();
    let mut roots: Vec<(i64, usize)> = demand
        .roots
        .iter()
        .map(|(&residue, &times)| (if 2 * residue > parts { residue - parts } else { residue }, times))
        .collect();
    roots.sort_by_key(|&(m, _)| (m.abs(), m));
    let words = roots.into_iter().map(|(m, times)| match times {
        1 => m.to_string(),
        2 => format!("{m} twice"),
        _ => format!("{m} {times} times"),
    });
    words.collect::<Vec<_>>().join(", ")
}
