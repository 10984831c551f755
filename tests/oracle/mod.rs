//! The oracle: phases and amplitudes in 128-bit arithmetic by another library (astro-float) than the one that makes
//! the hardware's constants, from the integer frames alone. It knows the schemes' weights from the paper, not from the
//! specification.

// Each test file is a crate of its own and uses a part of this module.
#![allow(dead_code)]

use astro_float::{BigFloat, Consts, RoundingMode};

const BITS: usize = 128;
const MODE: RoundingMode = RoundingMode::ToEven;

/// In-phase, quadrature (its √3 left out) and offset sums of one pixel's frames, as the paper's equations say.
pub fn paper_sums(scheme: &str, frames: &[i64]) -> (i64, i64) {
    match (scheme, frames) {
        ("four_frame", &[i1, i2, i3, i4]) => (i1 - i3, i2 - i4),
        ("wdft", &[i1, i2, i3, i4, i5]) => (2 * i1 - 2 * i2 - 3 * i3 + 4 * i4 - i5, 2 * i2 - 3 * i3 + i5),
        _ => panic!("no equation for {scheme} with {} frames", frames.len()),
    }
}

/// The exact functions, with their cached constants.
pub struct Oracle {
    consts: Consts,
    turn: BigFloat,
    sqrt3: BigFloat,
}

impl Oracle {
    pub fn new() -> Self {
        let mut consts = Consts::new().expect("memory for constants");
        let turn = consts.pi(BITS, MODE).mul(&BigFloat::from_i64(2, BITS), BITS, MODE);
        let sqrt3 = BigFloat::from_i64(3, BITS).sqrt(BITS, MODE);
        Self { consts, turn, sqrt3 }
    }

    fn coordinates(&self, scheme: &str, in_phase: i64, quadrature: i64) -> (BigFloat, BigFloat) {
        let x = BigFloat::from_i64(in_phase, BITS);
        let y = BigFloat::from_i64(quadrature, BITS);
        (x, if scheme == "wdft" { y.mul(&self.sqrt3, BITS, MODE) } else { y })
    }

    /// The phase as a fraction of a turn times 2^`bits`, in [0, 2^bits). The sums must not both be 0.
    pub fn phase_codes(&mut self, scheme: &str, in_phase: i64, quadrature: i64, bits: u32) -> f64 {
        to_f64(&self.wide_phase(scheme, in_phase, quadrature, bits))
    }

    /// `code` minus that, subtracted before it becomes an `f64`; not brought into half a turn.
    pub fn phase_difference(
        &mut self,
        scheme: &str,
        in_phase: i64,
        quadrature: i64,
        bits: u32,
        code: i64,
    ) -> f64 {
        let exact = self.wide_phase(scheme, in_phase, quadrature, bits);
        to_f64(&BigFloat::from_i64(code, BITS).sub(&exact, BITS, MODE))
    }

    fn wide_phase(&mut self, scheme: &str, in_phase: i64, quadrature: i64, bits: u32) -> BigFloat {
        let (x, y) = self.coordinates(scheme, in_phase, quadrature);
        let quarter = BigFloat::from_f64(0.25, BITS);
        let turns = if in_phase == 0 {
            if quadrature > 0 { quarter } else { BigFloat::from_f64(0.75, BITS) }
        } else {
            let ratio = y.div(&x, BITS, MODE).atan(BITS, MODE, &mut self.consts).div(&self.turn, BITS, MODE);
            let base = match (in_phase < 0, quadrature < 0) {
                (true, _) => 0.5,
                (false, true) => 1.0,
                (false, false) => 0.0,
            };
            ratio.add(&BigFloat::from_f64(base, BITS), BITS, MODE)
        };
        turns.mul(&BigFloat::from_i64(1 << bits, BITS), BITS, MODE)
    }

    /// The exact plain DFT of `frames`: Σ I_n cos(n/N turn) and Σ I_n sin(n/N turn).
    pub fn dft(&mut self, frames: &[i64]) -> (BigFloat, BigFloat) {
        let zero = || BigFloat::from_i64(0, BITS);
        let (mut x, mut y) = (zero(), zero());
        for (n, &frame) in frames.iter().enumerate() {
            let part = BigFloat::from_i64(n as i64, BITS).div(
                &BigFloat::from_i64(frames.len() as i64, BITS),
                BITS,
                MODE,
            );
            let angle = part.mul(&self.turn, BITS, MODE);
            let frame = BigFloat::from_i64(frame, BITS);
            x = x.add(&frame.mul(&angle.cos(BITS, MODE, &mut self.consts), BITS, MODE), BITS, MODE);
            y = y.add(&frame.mul(&angle.sin(BITS, MODE, &mut self.consts), BITS, MODE), BITS, MODE);
        }
        (x, y)
    }

    /// The angle of (x, y) as a fraction of a turn times 2^`bits`, in [0, 2^bits); x is not 0.
    pub fn angle_codes(&mut self, x: &BigFloat, y: &BigFloat, bits: u32) -> f64 {
        let ratio = y.div(x, BITS, MODE).atan(BITS, MODE, &mut self.consts).div(&self.turn, BITS, MODE);
        let base = match (x.is_negative(), y.is_negative()) {
            (true, _) => 0.5,
            (false, true) => 1.0,
            (false, false) => 0.0,
        };
        let turns = ratio.add(&BigFloat::from_f64(base, BITS), BITS, MODE);
        to_f64(&turns.mul(&BigFloat::from_i64(1 << bits, BITS), BITS, MODE))
    }

    /// The vector's length.
    pub fn length(&mut self, scheme: &str, in_phase: i64, quadrature: i64) -> f64 {
        let (x, y) = self.coordinates(scheme, in_phase, quadrature);
        let square = |v: &BigFloat| v.mul(v, BITS, MODE);
        to_f64(&square(&x).add(&square(&y), BITS, MODE).sqrt(BITS, MODE))
    }
}

fn to_f64(value: &BigFloat) -> f64 {
    value.to_string().parse().expect("a finite number")
}

/// `code` − `exact` on the circle of `turn` codes.
pub fn circular_difference(code: i64, exact: f64, turn: f64) -> f64 {
    let difference = code as f64 - exact;
    difference - turn * (difference / turn).round()
}
