//! Unwrapping with two modulation frequencies: which phase word and the next whole turns follow from a ratio M:N.
//!
//! Sets are taken in turn at f1 = M f0 and f2 = N f0, M and N without a common divisor. With u the range as a fraction of
//! c/(2 f0), the phases are φ1 = M u − k1 and φ2 = N u − k2 turns, 0 ≤ k1 < M, 0 ≤ k2 < N. Then
//! N φ1 − M φ2 = M k2 − N k1 is a whole number e (the ambiguity number), which modulo M gives k1 = −e/N and modulo N gives
//! k2 = e/M: the Chinese remainder theorem (Jongenelen and others 2011). Measured phases leave a residual
//! r = N φ1 − M φ2 − e, −1/2 ≤ r < 1/2, and the two ranges (k1 + φ1)/M and (k2 + φ2)/N differ by exactly r/(M N), on the
//! circle of c/(2 f0). Their mean with shares 1 − s and s is (k1 + φ1)/M − s r/(M N).

use super::step_angle::greatest_common_divisor;
use super::{Word, refused};
use crate::fields::Fields;
use crate::problem::Result;
use std::ops::RangeInclusive;

/// What M and N may be.
pub const RATIO: RangeInclusive<i64> = 1..=16;

/// What the weights of the mean may be.
pub const WEIGHTS: RangeInclusive<i64> = 0..=4095;

/// Bits of the second range's share in the mean.
pub const SHARE_BITS: u32 = 12;

/// What a specification says of unwrapping.
#[derive(Debug, Clone, PartialEq)]
pub struct Unwrapping {
    /// M and N: the frequencies of a set with `s_axis_tuser[2]` = 0, which is `modulation.frequency_hz`, and of one with 1, over
    /// the common f0.
    pub ratio: [i64; 2],
    /// Weights of the two ranges in their mean, 0 to 4095, not both 0. The best for phases of equal noise are M² and N².
    pub weights: [i64; 2],
    /// Largest residual that is trusted, turns, above 0 to 0.5 (all).
    pub residual_limit_turns: f64,
}

/// Reads the table `unwrapping` of a specification, where it is there; [`Unwrapper::new`] sees whether it can work.
pub(super) fn read(top: &Fields) -> Result<Option<Unwrapping>> {
    let Some(fields) = top.optional_section("unwrapping")? else { return Ok(None) };
    fields.only(&["ratio", "weights", "residual_limit_turns"])?;
    let pair = |field: &str| {
        let expected = "a list of two whole numbers, such as [5, 4]";
        <[i64; 2]>::try_from(fields.integers(field, expected)?).map_err(|_| fields.refuse(field, expected))
    };
    let ratio = pair("ratio")?;
    // Of absurd ratios the squares do not matter: they are refused for themselves.
    let squares = ratio.map(|factor| factor.saturating_mul(factor));
    Ok(Some(Unwrapping {
        ratio,
        weights: if fields.has("weights") { pair("weights")? } else { squares },
        residual_limit_turns: fields.number_or("residual_limit_turns", 0.0..=0.5, "turns", 0.25)?,
    }))
}

/// The table that reads as `unwrapping`.
pub(super) fn write(unwrapping: &Unwrapping) -> String {
    let Unwrapping { ratio, weights, residual_limit_turns } = unwrapping;
    format!(
        "\n[unwrapping]\nratio = {ratio:?}\nweights = {weights:?}\nresidual_limit_turns = {residual_limit_turns:?}\n"
    )
}

/// What follows from an [`Unwrapping`] for phase words of given bits.
#[derive(Debug, Clone, PartialEq)]
pub struct Unwrapper {
    /// M and N.
    pub ratio: [i64; 2],
    /// Bits of a phase word.
    pub phase_bits: u32,
    /// N k1 for each ambiguity number e = −M … N, e = −M first. In the noiseless case −M < e < N; rounding at the wrap of u can
    /// make it −M or N.
    pub whole_turns: Vec<i64>,
    /// The second range's share in the mean, times 2^[`SHARE_BITS`].
    pub share: i64,
    /// Largest magnitude of a trusted residual, phase codes.
    pub residual_limit: i64,
    /// Codes of a turn of f0: M N 2^phase bits. The unwrapped phase counts in these, from 0 to one less.
    pub codes_a_turn: i64,
    /// The unwrapped phase.
    pub unwrapped: Word,
    /// N φ1 − M φ2 in phase codes: between −M (2^bits − 1) and N (2^bits − 1).
    pub difference: Word,
}

impl Unwrapper {
    /// Checks `unwrapping`, for phases of `phase_bits` bits; `source` is the name that a refusal gives.
    pub(super) fn new(source: &str, unwrapping: &Unwrapping, phase_bits: u32) -> Result<Self> {
        let [m, n] = unwrapping.ratio;
        if !RATIO.contains(&m) || !RATIO.contains(&n) || m == n || greatest_common_divisor(m, n) != 1 {
            return Err(refused(source, "unwrapping.ratio", format_args!("[{m}, {n}]"))
                .expected(format_args!(
                    "two different whole numbers from {} to {} without a common divisor, the first set's frequency to the second's",
                    RATIO.start(),
                    RATIO.end()
                ))
                .remedy("[5, 4] has four times the unambiguous range of the second frequency, and five of the first"));
        }
        let [first, second] = unwrapping.weights;
        if !WEIGHTS.contains(&first) || !WEIGHTS.contains(&second) || first + second == 0 {
            return Err(refused(source, "unwrapping.weights", format_args!("[{first}, {second}]"))
                .expected(format_args!(
                    "two whole numbers from {} to {}, not both 0",
                    WEIGHTS.start(),
                    WEIGHTS.end()
                ))
                .remedy(
                    "leave the line out for the squares of the ratio, the best for phases of equal noise",
                ));
        }
        let limit_turns = unwrapping.residual_limit_turns;
        let residual_limit = (limit_turns * f64::from(phase_bits).exp2()).floor() as i64;
        if !(limit_turns > 0.0 && limit_turns <= 0.5) || residual_limit == 0 {
            return Err(refused(source, "unwrapping.residual_limit_turns", limit_turns)
                .expected("a number above 0, of a phase code or more, to 0.5, which trusts every residual"));
        }
        let largest = Word::unsigned(phase_bits).max();
        let codes_a_turn = (m * n) << phase_bits;
        // k1 = −e/N modulo M: N k1 ≡ −e modulo M, with k1 from 0 to M − 1.
        let whole_turns = (-m..=n)
            .map(|e| (0..m).map(|k1| n * k1).find(|turns| (turns + e).rem_euclid(m) == 0).unwrap_or(0))
            .collect();
        Ok(Self {
            ratio: [m, n],
            phase_bits,
            whole_turns,
            share: ((second << (SHARE_BITS + 1)) + first + second) / (2 * (first + second)),
            residual_limit,
            codes_a_turn,
            unwrapped: Word::holding(0, codes_a_turn - 1),
            difference: Word::holding(-m * largest, n * largest),
        })
    }

    /// The margin: phases that are off by less than so many codes each have the right ambiguity number.
    ///
    /// It is right as long as N e1 − M e2 stays below half a turn, 2^(bits − 1) codes, for the errors e1 and e2; with |e1| and
    /// |e2| below 2^(bits − 1)/(M + N) it does, and errors of that size with opposite signs reach it.
    pub fn margin_codes(&self) -> f64 {
        f64::from(self.phase_bits - 1).exp2() / (self.ratio[0] + self.ratio[1]) as f64
    }

    /// Worst case of the unwrapped phase in its codes, at phases that are off by up to `phase_codes`, less than the margin:
    /// (1 − s) N e1 + s M e2, and half a code where s r is rounded.
    pub fn error_codes(&self, phase_codes: f64) -> f64 {
        let [m, n] = self.ratio;
        let share = self.share as f64 / f64::from(SHARE_BITS).exp2();
        let rounding = if self.share % (1 << SHARE_BITS) == 0 { 0.0 } else { 0.5 };
        ((1.0 - share) * n as f64 + share * m as f64) * phase_codes + rounding
    }
}
