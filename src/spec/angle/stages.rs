//! The words of x and y, iteration by iteration: only the bits that matter.

use super::reach::{Reach, reach};
use super::{AngleSpecification, Architecture};
use crate::spec::Word;

/// A coordinate's word after an iteration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StageWord {
    /// All its bits; y's include the sign.
    pub bits: u32,
    /// Bits below 1.0.
    pub fraction_bits: u32,
}

/// x and y after iteration 0, 1, …
///
/// y stands for (its integer + ½) · 2^−fraction: its bitwise complement is then exactly its negative, and its top bit its
/// sign, so that |y| costs no adder.
#[derive(Debug, Clone, PartialEq)]
pub struct Stages {
    /// x, unsigned.
    pub x: Vec<StageWord>,
    /// y, signed.
    pub y: Vec<StageWord>,
    /// Iterations after which x stays as it is: y / x is then small enough for its angle to be a straight line.
    pub x_iterations: u32,
    /// y is doubled at every iteration instead of being made a bit narrower: the hardware is the same for all of them.
    pub scaled: bool,
}

/// Share of one phase code that a straight line for the last angles may cost.
const LINE_SHARE: f64 = 1.0 / 32.0;

impl Stages {
    pub(super) fn new(
        specification: &AngleSpecification,
        architecture: Architecture,
        iterations: u32,
    ) -> Self {
        let AngleSpecification { metric, phase_bits, length_bits, cordic, .. } = specification;
        let scaled = architecture != Architecture::Unrolled;
        let x_iterations = x_iterations(*metric, *phase_bits, *length_bits, iterations);
        let full = phase_bits + cordic.vector_guard_bits;
        let Reach { x: x_reach, y: y_reach } = reach(*metric, iterations, x_iterations);

        // Without a length, what is below a unit of y times 2^iteration no longer counts.
        let x_fraction = |i: u32| if scaled || *length_bits > 0 { full } else { full - i.min(x_iterations) };
        let x_words = (0..iterations).map(|i| {
            let unit = f64::from(x_fraction(i)).exp2();
            if i == 0 && !scaled {
                // Two magnitudes below 2 and a one, or four and three ones.
                return StageWord { bits: full + if *metric == 1 { 2 } else { 3 }, fraction_bits: full };
            }
            // Every iteration rounds up by at most a unit of y's and a half of its own.
            let largest =
                x_reach[i as usize] * unit + f64::from(4 + 2 * i.min(x_iterations) + 2 * *metric as u32);
            StageWord { bits: Word::holding(0, largest.ceil() as i64).bits, fraction_bits: x_fraction(i) }
        });
        let x: Vec<StageWord> = x_words.collect();
        let y_word = |largest: f64, fraction_bits| StageWord {
            bits: Word::holding(-(largest.ceil() as i64), largest.ceil() as i64).bits,
            fraction_bits,
        };
        if scaled {
            let bits = x.iter().map(|word| word.bits).max().unwrap_or(1);
            let x: Vec<StageWord> = x.iter().map(|word| StageWord { bits, ..*word }).collect();
            let largest = (0..).zip(&y_reach).map(|(i, y)| y * f64::from(i).exp2()).fold(0.0, f64::max);
            let largest = largest.max(x_reach.iter().copied().fold(0.0, f64::max));
            let y = y_word(largest * f64::from(full).exp2() + 8.0 + 4.0 * *metric as f64, full);
            let y = (0..iterations).map(|i| StageWord { fraction_bits: full + i, ..y }).collect();
            return Self { x, y, x_iterations, scaled };
        }
        let mut y: Vec<StageWord> = (0..iterations)
            .map(|i| match i {
                // The difference of two magnitudes, exactly.
                0 => StageWord { bits: full + 2, fraction_bits: full },
                _ => y_word(y_reach[i as usize] * f64::from(full).exp2() + f64::from(3 + i), full),
            })
            .collect();
        // A magnitude has a bit less than its y; narrower words would have to cut its top.
        for i in 1..y.len() {
            y[i].bits = y[i].bits.max(y[i - 1].bits - 1);
        }
        Self { x, y, x_iterations, scaled }
    }
}

/// Least number of iterations that x has to follow.
///
/// With t = √metric · |y| / x ≤ √metric · 2^−n after iteration n, atan t differs from the best straight line by at most
/// t³/12, and the length √(1 + t²) from its middle by at most t²/4 of itself.
fn x_iterations(metric: i64, phase_bits: u32, length_bits: u32, iterations: u32) -> u32 {
    let tangent = |n: u32| (metric as f64).sqrt() * f64::from(n).exp2().recip();
    let code_rad = std::f64::consts::TAU / f64::from(phase_bits).exp2();
    let straight = |n: u32| tangent(n).powi(3) / 12.0 <= LINE_SHARE * code_rad;
    let long_enough =
        |n: u32| length_bits == 0 || tangent(n).powi(2) / 4.0 <= f64::from(length_bits).exp2().recip();
    (1..iterations).find(|&n| straight(n) && long_enough(n)).unwrap_or(iterations.saturating_sub(1)).max(1)
}
