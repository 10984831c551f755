//! Periodograms: what lines explain of a series with gaps, whose samples are known to this and that (Lomb 1976, with the information as weights).

use crate::physics::cos_sin;
use crate::widest::widest;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Score and information.
pub type Sum = (f64, f64);

/// Frequencies are so many times finer than the inverse of the whole length.
pub const FINENESS: f64 = 4.0;

/// What a line is beside, and what it is not.
#[derive(Debug, Clone, Copy)]
pub struct Sought {
    /// Whether each group may have a constant.
    pub constant: bool,
    /// A line whose slope, amplitude times 2 pi frequency, is steeper is none.
    pub steepest: f64,
    /// Nor is one whose phases in a group are more alike: the length of their mean, weighted by information.
    pub most_alike: f64,
}

/// Any line, beside nothing.
pub const ANY: Sought = Sought { constant: false, steepest: f64::INFINITY, most_alike: f64::INFINITY };

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
    /// Of all groups, each with a phase of its own.
    pub fn of(groups: &[Vec<(f64, Sum)>], ends: (f64, f64), sought: Sought) -> Option<Self> {
        Self::turned(groups, &[], ends, sought)
    }

    /// The same of lines whose phase is another one at each sample, by so many `turns`, group by group, or, where there are none, by none.
    pub fn turned(
        groups: &[Vec<(f64, Sum)>],
        turns: &[Vec<f64>],
        (low, high): (f64, f64),
        sought: Sought,
    ) -> Option<Self> {
        let longest = longest(groups);
        if longest <= 0.0 {
            return None;
        }
        let step = 1.0 / (FINENESS * longest);
        let count = ((high - low) / step).ceil() as usize;
        Some(Self { low, step, powers: powers(groups, turns, (low, step), count, sought) })
    }
}

/// The powers at a `count` of frequencies from `low` on, a `step` apart, as [`Scan::turned`] has them.
pub fn powers(
    groups: &[Vec<(f64, Sum)>],
    turns: &[Vec<f64>],
    (low, step): (f64, f64),
    count: usize,
    sought: Sought,
) -> Vec<f64> {
    let starts: Vec<usize> = (0..count).step_by(TOGETHER).collect();
    let powers = starts.into_par_iter().flat_map_iter(|start| {
        let mut powers = vec![0.0; TOGETHER.min(count - start)];
        for (number, group) in groups.iter().enumerate() {
            let turns = turns.get(number).map_or(&[][..], |turns| turns);
            add_turned(group, turns, (low + start as f64 * step, step), sought, &mut powers);
        }
        powers
    });
    powers.collect()
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
    add_powers(group, frequency, 0.0, ANY, &mut power);
    power[0]
}

/// Chi squared of a group.
pub fn chi2(group: &[(f64, Sum)]) -> f64 {
    let informed = group.iter().filter(|(_, sum)| sum.1 > 0.0);
    informed.map(|(_, (score, information))| score * score / information).sum()
}

/// Neighbouring frequencies that are looked at together: each sample's phase is turned from one to the next.
const TOGETHER: usize = 64;

/// Samples that are summed side by side.
const LANES: usize = 8;
/// That many samples: score, information, cosine and sine of their phases at a frequency, and those of the angles by which these turn to the next one.
type Turning = [[f64; LANES]; 6];
/// Sums over samples: scores, with the cosine and the sine, and their information; information with the cosine and the sine.
type Sums = [[f64; LANES]; 7];

/// The sums at a frequency; the samples turn to the next one.
fn turned(samples: &mut [Turning]) -> [f64; 7] {
    let mut sums: Sums = [[0.0; LANES]; 7];
    {
        let sums = &mut sums;
        widest!((samples: &'a mut [Turning], sums: &'a mut Sums) {
            let mut all = *sums;
            for [score, information, cosine, sine, turn_cosine, turn_sine] in samples {
                for n in 0..LANES {
                    let (c, s) = (cosine[n], sine[n]);
                    let (with_cosine, with_sine) = (information[n] * c, information[n] * s);
                    all[0][n] += score[n] * c;
                    all[1][n] += score[n] * s;
                    all[2][n] += with_cosine * c;
                    all[3][n] += with_sine * s;
                    all[4][n] += with_cosine * s;
                    all[5][n] += with_cosine;
                    all[6][n] += with_sine;
                    cosine[n] = c * turn_cosine[n] - s * turn_sine[n];
                    sine[n] = s * turn_cosine[n] + c * turn_sine[n];
                }
            }
            *sums = all;
        });
    }
    sums.map(|lanes| lanes.iter().sum())
}

/// Adds the powers at `frequency` and at those after it, each `step` above the last, of what is `sought`.
pub fn add_powers(group: &[(f64, Sum)], frequency: f64, step: f64, sought: Sought, powers: &mut [f64]) {
    add_turned(group, &[], (frequency, step), sought, powers);
}

/// The same of lines whose phase is another one at each sample, by so many `turns`, if there are any.
fn add_turned(
    group: &[(f64, Sum)],
    turns: &[f64],
    (frequency, step): (f64, f64),
    sought: Sought,
    powers: &mut [f64],
) {
    let angle = |turns: f64| cos_sin(TAU * (turns - turns.floor()));
    let turning = |(first, some): (usize, &[(f64, Sum)])| {
        let mut lanes: Turning = [[0.0; LANES]; 6];
        for (n, &(at, (score, information))) in some.iter().enumerate() {
            let by = turns.get(LANES * first + n).copied().unwrap_or_default();
            let ((cosine, sine), turn) = (angle(at * frequency + by), angle(at * step));
            let of = [score, information, cosine, sine, turn.0, turn.1];
            lanes.iter_mut().zip(of).for_each(|(lanes, of)| lanes[n] = of);
        }
        lanes
    };
    let mut samples: Vec<Turning> = group.chunks(LANES).enumerate().map(turning).collect();
    let (score, information) =
        group.iter().fold((0.0, 0.0), |sums, (_, sum)| (sums.0 + sum.0, sums.1 + sum.1));
    for (number, power) in powers.iter_mut().enumerate() {
        let [mut c, mut s, mut cc, mut ss, mut cs, of_cosine, of_sine] = turned(&mut samples);
        let is_alike = of_cosine.hypot(of_sine) > sought.most_alike * information;
        if sought.constant && information > 0.0 {
            (c, s) = (c - of_cosine * score / information, s - of_sine * score / information);
            cc -= of_cosine * of_cosine / information;
            ss -= of_sine * of_sine / information;
            cs -= of_cosine * of_sine / information;
        }
        let (chi2, amplitude) = explained(c, s, cc, ss, cs);
        let slope = TAU * (frequency + number as f64 * step) * amplitude;
        if slope <= sought.steepest && !is_alike {
            *power += chi2;
        }
    }
}

/// Chi squared that a line explains, by the sums of its scores and their information; and its amplitude.
fn explained(c: f64, s: f64, cc: f64, ss: f64, cs: f64) -> (f64, f64) {
    let total = cc + ss;
    if total <= 0.0 {
        return (0.0, 0.0);
    }
    // Where frames sample one phase of the line only, the other phase says nothing.
    let determinant = cc * ss - cs * cs;
    if determinant > 1e-3 * total * total {
        let chi2 = (c * c * ss - 2.0 * c * s * cs + s * s * cc) / determinant;
        (chi2, (c * ss - s * cs).hypot(s * cc - c * cs) / determinant)
    } else if cc > ss {
        (c * c / cc, c.abs() / cc)
    } else {
        (s * s / ss, s.abs() / ss)
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
            add_powers(&group, 1.0, 0.0, Sought { constant, ..ANY }, &mut power);
            power[0] / chi2(&group)
        };
        assert!((power(true) - 1.0).abs() < 1e-9, "{}", power(true));
        assert!(power(false) < 0.97, "{}", power(false));
    }

    /// Phases that turn from one frequency to the next are those of each frequency.
    #[test]
    fn neighbouring_frequencies_are_each_by_itself() {
        let of = |n: usize| {
            let error = (0.9 * n as f64).sin() + (2.3 * n as f64).cos();
            (1.0 + 0.058 * n as f64, (error, 1.0 + 0.1 * n as f64))
        };
        let group: Vec<(f64, Sum)> = (0..26).map(of).collect();
        let (low, step) = (0.3, 0.07);
        let mut powers = [0.0; 100];
        add_powers(&group, low, step, ANY, &mut powers);
        for (number, together) in powers.into_iter().enumerate() {
            let alone = power(&group, low + number as f64 * step);
            assert!((together - alone).abs() < 1e-9 * alone.max(1.0), "{number}: {together}, not {alone}");
        }
        assert!(powers.iter().copied().fold(0.0, f64::max) > 3.0 * powers.iter().sum::<f64>() / 100.0);
    }

    #[test]
    fn a_line_that_is_too_steep_is_none() {
        let line = |n: usize| (0.3 * n as f64 + 1.0).cos();
        let group: Vec<(f64, Sum)> = (0..200).map(|n| (n as f64, (5.0 * 2e-3 * line(n), 5.0))).collect();
        let power = |steepest: f64| {
            let mut power = [0.0];
            add_powers(&group, 0.3 / TAU, 0.0, Sought { constant: true, steepest, ..ANY }, &mut power);
            power[0] / chi2(&group)
        };
        // An amplitude of 2e-3 at 0.3 rad has the slope 6e-4.
        assert!(power(6.1e-4) > 0.99 && power(5.9e-4) == 0.0);
    }

    #[test]
    fn a_line_whose_phases_are_alike_is_none() {
        // Phases of 0 and 1 rad in turn: their mean is cos 0.5 rad = 0.878 long.
        let group: Vec<(f64, Sum)> = (0..20).map(|n| ((n % 2) as f64, (1.0, 1.0))).collect();
        let power = |most_alike: f64| {
            let mut power = [0.0];
            add_powers(&group, 1.0 / TAU, 0.0, Sought { most_alike, ..ANY }, &mut power);
            power[0]
        };
        assert!(power(0.88) > 1.0 && power(0.87) == 0.0);
    }
}
