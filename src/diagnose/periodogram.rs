//! Periodograms: what lines explain of a series with gaps, whose samples are known to this and that (Lomb 1976, with the information as weights).

use crate::physics::cos_sin;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Score and information.
pub type Sum = (f64, f64);

/// Frequencies are so many times finer than the inverse of the whole length.
pub const FINENESS: f64 = 4.0;

/// The powers at frequencies from `low` on, `step` apart.
pub struct Scan {
    /// The first frequency.
    pub low: f64,
    /// From one to the next.
    pub step: f64,
    /// Chi squared that a line explains.
    pub powers: Vec<f64>,
}

impl Scan {
    /// Of all groups, each with a phase of its own, and, where there may be one, beside a `constant` of each.
    pub fn of(groups: &[Vec<(f64, Sum)>], (low, high): (f64, f64), constant: bool) -> Option<Self> {
        let longest = longest(groups);
        if longest <= 0.0 {
            return None;
        }
        let step = 1.0 / (FINENESS * longest);
        let count = ((high - low) / step).ceil() as usize;
        let starts: Vec<usize> = (0..count).step_by(TOGETHER).collect();
        let powers = starts.into_par_iter().flat_map_iter(|start| {
            let mut powers = vec![0.0; TOGETHER.min(count - start)];
            for group in groups {
                add_powers(group, low + start as f64 * step, step, constant, &mut powers);
            }
            powers
        });
        Some(Self { low, step, powers: powers.collect() })
    }
}

/// Where among `powers` the greatest is; 0 where there are none.
pub fn greatest(powers: &[f64]) -> usize {
    (0..powers.len()).max_by(|&a, &b| powers[a].total_cmp(&powers[b])).unwrap_or(0)
}

/// The length of the longest group.
pub fn longest(groups: &[Vec<(f64, Sum)>]) -> f64 {
    let length = |group: &Vec<(f64, Sum)>| {
        let (first, last) = group
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (at, _)| (low.min(*at), high.max(*at)));
        last - first
    };
    groups.iter().map(length).fold(0.0, f64::max)
}

/// Chi squared that a line of this frequency explains in a group.
pub fn power(group: &[(f64, Sum)], frequency: f64) -> f64 {
    let mut power = [0.0];
    add_powers(group, frequency, 0.0, false, &mut power);
    power[0]
}

/// Chi squared of a group.
pub fn chi2(group: &[(f64, Sum)]) -> f64 {
    let informed = group.iter().filter(|(_, sum)| sum.1 > 0.0);
    informed.map(|(_, (score, information))| score * score / information).sum()
}

/// Neighbouring frequencies that are looked at together: each sample's phase is turned from one to the next.
const TOGETHER: usize = 64;

/// A sample, and its phase at a frequency.
struct Turning {
    score: f64,
    information: f64,
    cosine: f64,
    sine: f64,
    /// By what it turns to the next frequency.
    turn: (f64, f64),
}

/// Adds the powers at `frequency` and at those after it, each `step` above the last, beside a `constant`, where there may be one.
pub fn add_powers(group: &[(f64, Sum)], frequency: f64, step: f64, constant: bool, powers: &mut [f64]) {
    let angle = |turns: f64| cos_sin(TAU * (turns - turns.floor()));
    let turning = |&(at, (score, information)): &(f64, Sum)| {
        let (cosine, sine) = angle(at * frequency);
        Turning { score, information, cosine, sine, turn: angle(at * step) }
    };
    let mut samples: Vec<Turning> = group.iter().map(turning).collect();
    let (score, information) =
        samples.iter().fold((0.0, 0.0), |sums, sample| (sums.0 + sample.score, sums.1 + sample.information));
    for power in powers {
        let (mut c, mut s, mut cc, mut ss, mut cs) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let (mut of_cosine, mut of_sine) = (0.0, 0.0);
        for sample in &mut samples {
            let Turning { score, information, cosine, sine, turn } = *sample;
            c += score * cosine;
            s += score * sine;
            cc += information * cosine * cosine;
            ss += information * sine * sine;
            cs += information * cosine * sine;
            of_cosine += information * cosine;
            of_sine += information * sine;
            sample.cosine = cosine * turn.0 - sine * turn.1;
            sample.sine = sine * turn.0 + cosine * turn.1;
        }
        if constant && information > 0.0 {
            (c, s) = (c - of_cosine * score / information, s - of_sine * score / information);
            cc -= of_cosine * of_cosine / information;
            ss -= of_sine * of_sine / information;
            cs -= of_cosine * of_sine / information;
        }
        *power += explained(c, s, cc, ss, cs);
    }
}

/// Chi squared that a line explains, by the sums of its scores and their information.
fn explained(c: f64, s: f64, cc: f64, ss: f64, cs: f64) -> f64 {
    let total = cc + ss;
    if total <= 0.0 {
        return 0.0;
    }
    // Where frames sample one phase of the line only, the other phase says nothing.
    let determinant = cc * ss - cs * cs;
    if determinant > 1e-3 * total * total {
        (c * c * ss - 2.0 * c * s * cs + s * s * cc) / determinant
    } else if cc > ss {
        c * c / cc
    } else {
        s * s / ss
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left of a line of few cycles beside a constant is all of it.
    #[test]
    fn beside_a_constant_a_line_of_few_cycles_explains_all_that_is_left_of_it() {
        let at = |n: usize| 1.0 + 0.058 * n as f64;
        let errors: Vec<f64> = (0..26).map(|n| (TAU * at(n) + 0.4).sin()).collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        let group: Vec<(f64, Sum)> = (0..26).map(|n| (at(n), (errors[n] - mean, 1.0))).collect();
        let power = |constant| {
            let mut power = [0.0];
            add_powers(&group, 1.0, 0.0, constant, &mut power);
            power[0] / chi2(&group)
        };
        assert!((power(true) - 1.0).abs() < 1e-9, "{}", power(true));
        assert!(power(false) < 0.97, "{}", power(false));
    }
}
