//! The angle of a vector by tables and multipliers: see [`spec::Poly`](crate::spec::Poly).

use super::Turned;
use crate::spec::Poly;

/// Magnitude without negation: 2v for v, and 2v − 1 for −v.
const fn folded(value: i64) -> i64 {
    ((value ^ (value >> 63)) << 1) | (value < 0) as i64
}

/// The phase of (`x`, `y`), each within its word; no length.
pub fn poly(unit: &Poly, x: i64, y: i64) -> Turned {
    // The sign of |x| − |y| by one addition; −1 − y stands for −y, which is right but for the equal ones, and those have
    // the same angle either way.
    let sum = x + if (x < 0) == (y < 0) { -1 - y } else { y };
    let swapped = (sum < 0) != (x < 0);
    let (major, minor) = if swapped { (y, x) } else { (x, y) };
    let zero = folded(major) == 0;
    let (mut larger, mut smaller) = (folded(major), folded(minor));
    for &places in &unit.shifts {
        if larger >> (unit.word_bits - places) == 0 {
            larger = shifted(larger, places, major < 0);
            smaller = shifted(smaller, places, minor < 0);
        }
    }
    let fit = |value: i64, negative: bool| match unit.coordinate_bits.checked_sub(unit.word_bits) {
        Some(places) => shifted(value, places, negative),
        None => value >> (unit.word_bits - unit.coordinate_bits),
    };
    let (larger, smaller) = (fit(larger, major < 0), fit(smaller, minor < 0));
    let product = smaller * poly_reciprocal(unit, larger);
    let ratio = product >> (unit.coordinate_bits - 1 + unit.reciprocal.result_bits - unit.ratio_bits);

    // minor and major of one sign turn counterclockwise from the major axis, unless they are swapped.
    let backwards = (x < 0) ^ (y < 0) ^ swapped;
    let angle = poly_arctangent(unit, ratio, backwards);
    let axis = match (swapped, x < 0, y < 0) {
        (false, false, _) => 0,
        (true, _, false) => 1,
        (false, true, _) => 2,
        (true, _, true) => 3,
    };
    let turned = if backwards { !angle } else { angle };
    let phase = ((axis << (unit.phase_bits - 2)) + turned) & ((1 << unit.phase_bits) - 1);
    Turned { phase: if zero { 0 } else { phase }, length: 0, shift: 0, zero }
}

/// `value` shifted left by `places`; what comes in below is the sign.
const fn shifted(value: i64, places: u32, negative: bool) -> i64 {
    (value << places) | if negative { (1 << places) - 1 } else { 0 }
}

/// The scaled reciprocal of a normalised `major`, rounded down, below 1.0.
pub fn poly_reciprocal(unit: &Poly, major: i64) -> i64 {
    let table = &unit.reciprocal;
    let one = unit.coordinate_bits - 1;
    let low_bits = one - table.index_bits;
    let index = (major >> low_bits) & ((1 << table.index_bits) - 1);
    let mirrored = major ^ ((1 << low_bits) - 1);
    (mirrored * table.factors[index as usize]) >> (one + table.factor_bits - table.result_bits)
}

/// The angle of `ratio` in phase codes, 0 to an eighth of a turn; one less where it is to be complemented.
pub fn poly_arctangent(unit: &Poly, ratio: i64, backwards: bool) -> i64 {
    let table = &unit.arctangent;
    let segment = (ratio >> table.offset_bits) as usize;
    let half = 1 << (table.offset_bits - 1);
    let offset = (ratio & (2 * half - 1)) - half;
    let size = offset ^ (offset >> 63);
    let cell = (size >> (table.offset_bits - 1 - table.curve_offset_bits)) as usize;
    let product = (table.slopes[segment] * offset) >> table.slope_shift;
    // Half a code more rounds to nearest; half a code less, complemented, rounds the negative angle to nearest.
    let code = 1 << table.guard_bits;
    let rounding = if backwards { -code / 2 } else { code / 2 };
    (table.bases[segment] + rounding + table.curve(segment, cell) + product) >> table.guard_bits
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::{PolySpecification, Tables};
    use rand::{RngExt, SeedableRng};

    fn unit(bits: u32, phase_bits: u32, tables: Tables) -> Poly {
        Poly::new("test", PolySpecification { x_bits: bits, y_bits: bits, phase_bits, tables }).unwrap()
    }

    /// Largest, mean and RMS error, in codes.
    #[derive(Default)]
    struct Errors {
        largest: f64,
        sum: f64,
        squares: f64,
        count: f64,
    }

    impl Errors {
        /// f64's own error is below 1e-10 codes.
        fn add(&mut self, unit: &Poly, x: i64, y: i64) {
            let angle = poly(unit, x, y);
            assert_eq!(angle.zero, (x, y) == (0, 0));
            if angle.zero {
                assert_eq!(angle.phase, 0);
                return;
            }
            assert!((0..1 << unit.phase_bits).contains(&angle.phase));
            let codes = f64::from(unit.phase_bits).exp2();
            let turns = (y as f64).atan2(x as f64) / std::f64::consts::TAU;
            let error = angle.phase as f64 - turns * codes;
            let error = error - (error / codes).round() * codes;
            self.largest = self.largest.max(error.abs());
            self.sum += error;
            self.squares += error * error;
            self.count += 1.0;
        }

        fn assert_within(&self, unit: &Poly, what: &str) {
            let (mean, rms) = (self.sum / self.count, (self.squares / self.count).sqrt());
            println!(
                "{what}: {} vectors, max {:.4} of {:.4}, rms {rms:.4}, mean {mean:.5}",
                self.count,
                self.largest,
                unit.phase_codes()
            );
            assert!(self.largest <= unit.phase_codes(), "{what}: {}", self.largest);
        }
    }

    #[test]
    fn every_vector_of_12_bits_is_within_the_bound() {
        for tables in [Tables::Logic, Tables::Memory] {
            let unit = unit(12, 16, tables);
            let mut errors = Errors::default();
            for x in -2048..2048 {
                for y in -2048..2048 {
                    errors.add(&unit, x, y);
                }
            }
            errors.assert_within(&unit, &format!("{tables:?}"));
            assert!((errors.sum / errors.count).abs() < 0.01);
        }
    }

    #[test]
    fn vectors_of_every_strength_are_within_the_bound_and_unbiased() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        for tables in [Tables::Logic, Tables::Memory] {
            for (bits, phase_bits) in [(16, 16), (16, 8), (8, 13), (24, 18), (32, 20), (18, 11), (20, 16)] {
                let unit = unit(bits, phase_bits, tables);
                for strength in 5..bits {
                    let mut errors = Errors::default();
                    let reach = 1_i64 << strength;
                    for _ in 0..40_000 {
                        let [x, y] = [(); 2].map(|()| random.random_range(-reach..reach));
                        errors.add(&unit, x, y);
                    }
                    errors
                        .assert_within(&unit, &format!("{tables:?} {bits} bits, {phase_bits}: 2^{strength}"));
                    assert!((errors.sum / errors.count).abs() < 0.05);
                }
            }
        }
    }

    #[test]
    fn corners_axes_and_diagonals_are_within_the_bound_and_axes_are_exact() {
        for tables in [Tables::Logic, Tables::Memory] {
            for (bits, phase_bits) in [(16, 16), (2, 8), (12, 20), (32, 16)] {
                let unit = unit(bits, phase_bits, tables);
                let top = 1_i64 << (bits - 1);
                let mut corners = vec![-top, 1 - top, top - 1, -1, 0, 1];
                corners.extend(
                    (1..bits - 1).flat_map(|bit| [1 << bit, (1 << bit) - 1, -(1 << bit), 1 - (1 << bit)]),
                );
                corners.retain(|corner| (-top..top).contains(corner));
                let mut errors = Errors::default();
                for &x in &corners {
                    for &y in &corners {
                        errors.add(&unit, x, y);
                        let eighth = if x == 0 || y == 0 || x.abs() == y.abs() {
                            (y as f64).atan2(x as f64) / std::f64::consts::TAU * 8.0
                        } else {
                            continue;
                        };
                        let exact = (eighth.round() as i64).rem_euclid(8) << (phase_bits - 3);
                        assert_eq!(poly(&unit, x, y).phase, exact, "{x} {y}");
                    }
                }
                errors.assert_within(&unit, &format!("{tables:?} {bits} bits, {phase_bits}"));
            }
        }
    }
}
