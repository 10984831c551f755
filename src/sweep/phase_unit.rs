//! The unit under test, in integers: the generated hardware's arithmetic, and the same without normaliser or without rounding.

use super::configuration::{Configuration, Rounding};
use crate::spec::{Word, exact};

/// Whatever makes a phase from a vector.
pub trait PhaseOf: Sync {
    /// The phase of (x, √metric · y), 0 to 2^[`PhaseOf::phase_bits`] − 1. Not both are 0.
    fn phase(&self, x: i64, y: i64) -> i64;

    /// Bits of the phase.
    fn phase_bits(&self) -> u32;
}

/// Fold, normaliser, CORDIC, rounding and unfolding as [`crate::model`] has them, with every constant at hand.
#[derive(Debug, Clone)]
pub struct PhaseUnit {
    x_factor: i64,
    y_factor: i64,
    magnitude_bits: u32,
    /// Places to the left from the magnitude to the CORDIC's word; negative: to the right.
    to_cordic: i32,
    steps: Vec<i64>,
    angle_guard_bits: u32,
    phase_bits: u32,
    normaliser: bool,
    nearest: bool,
}

/// `value` / 2^`places` (at least 1), rounded as asked.
#[inline]
const fn cut<const NEAREST: bool>(value: i64, places: u32) -> i64 {
    if NEAREST { ((value >> (places - 1)) + 1) >> 1 } else { value >> places }
}

impl PhaseUnit {
    /// The unit of `configuration`, which is a checked one.
    pub fn new(configuration: &Configuration) -> Self {
        let &Configuration { x_bits, y_bits, phase_bits, iterations, angle_guard_bits, .. } = configuration;
        let (y_factor, x_factor) = if configuration.metric == 3 {
            exact::sqrt3_ratio(std::f64::consts::TAU / f64::from(phase_bits).exp2() / 8.0)
        } else {
            (1, 1)
        };
        let largest = ((1i64 << (x_bits - 1)) * x_factor).max((1i64 << (y_bits - 1)) * y_factor);
        let magnitude_bits = Word::holding(0, largest).bits;
        let cordic_bits = configuration.fraction_bits() + 1;
        Self {
            x_factor,
            y_factor,
            magnitude_bits,
            to_cordic: cordic_bits as i32 - magnitude_bits as i32,
            steps: (1..=iterations)
                .map(|i| exact::atan_of_power_of_two(i, phase_bits + angle_guard_bits))
                .collect(),
            angle_guard_bits,
            phase_bits,
            normaliser: configuration.normaliser,
            nearest: configuration.rounding == Rounding::Nearest,
        }
    }

    #[inline]
    fn rounded<const NEAREST: bool>(&self, x: i64, y: i64) -> i64 {
        let (x, y) = (x * self.x_factor, y * self.y_factor);
        let (x_size, y_size) = (x.abs(), y.abs());
        let swapped = y_size > x_size;
        let (mut major, mut minor) = if swapped { (y_size, x_size) } else { (x_size, y_size) };
        if self.normaliser {
            let zeros = major.leading_zeros() - (64 - self.magnitude_bits);
            (major, minor) = (major << zeros, minor << zeros);
        }
        let places = self.to_cordic.unsigned_abs();
        let (mut a, mut b) = if self.to_cordic >= 0 {
            (major << places, minor << places)
        } else {
            (cut::<NEAREST>(major, places), cut::<NEAREST>(minor, places))
        };
        let mut angle = 0;
        for (places, &step) in (1..).zip(&self.steps) {
            // −1 where b is negative, so that v ^ sign − sign is v with that sign.
            let sign = b >> 63;
            let (da, db) = (cut::<NEAREST>(b, places), cut::<NEAREST>(a, places));
            (a, b) = (a + ((da ^ sign) - sign), b - ((db ^ sign) - sign));
            angle += (step ^ sign) - sign;
        }
        let angle = cut::<NEAREST>(angle, self.angle_guard_bits);
        let backwards = swapped ^ (x < 0) ^ (y < 0);
        let quarters = i64::from(swapped) + 2 * i64::from(if swapped { y < 0 } else { x < 0 });
        let phase = (quarters << (self.phase_bits - 2)) + if backwards { -angle } else { angle };
        phase & ((1 << self.phase_bits) - 1)
    }
}

impl PhaseOf for PhaseUnit {
    #[inline]
    fn phase(&self, x: i64, y: i64) -> i64 {
        if self.nearest { self.rounded::<true>(x, y) } else { self.rounded::<false>(x, y) }
    }

    fn phase_bits(&self) -> u32 {
        self.phase_bits
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Sums, pixel};
    use crate::spec::Pipeline;

    /// The unit gives what the pipeline's model gives, for sums of both schemes, words and guard bits.
    #[test]
    fn the_unit_is_the_pipelines_model() {
        for (preset, metric) in [("vuris-four-frame", 1), ("vuris", 3)] {
            for (adc_bits, phase_bits, iterations, vector_guard_bits, angle_guard_bits) in
                [(12, 18, 20, 4, 6), (8, 8, 8, 0, 1), (16, 12, 10, 2, 3), (9, 24, 27, 8, 8)]
            {
                let pipeline = Pipeline::named(preset)
                    .unwrap()
                    .adapted("test", |specification| {
                        specification.sensor.adc_bits = adc_bits;
                        specification.output.phase_bits = phase_bits;
                        specification.cordic.iterations = iterations;
                        specification.cordic.vector_guard_bits = vector_guard_bits;
                        specification.cordic.angle_guard_bits = angle_guard_bits;
                    })
                    .unwrap();
                let derived = pipeline.derived();
                let unit = PhaseUnit::new(&Configuration {
                    metric,
                    x_bits: derived.in_phase.bits,
                    y_bits: derived.quadrature.bits,
                    phase_bits,
                    iterations,
                    vector_guard_bits,
                    angle_guard_bits,
                    normaliser: true,
                    rounding: Rounding::Nearest,
                });
                assert_eq!(
                    (unit.x_factor, unit.y_factor),
                    (derived.in_phase_factor, derived.quadrature_factor)
                );
                let (mut x, mut y) = (1i64, 1i64);
                for _ in 0..20_000 {
                    x = derived
                        .in_phase
                        .wrap(x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1442695));
                    y = derived
                        .quadrature
                        .wrap(y.wrapping_mul(3_935_559_000_370_003_845).wrapping_add(12345));
                    let scale = derived.sample.max();
                    let limit = |weights: &[i64]| weights.iter().filter(|&&w| w > 0).sum::<i64>() * scale;
                    let scheme = pipeline.modulation.scheme;
                    for places in [0, 3, 7] {
                        let (x, y) = (x >> places, y >> places);
                        if x.abs() > limit(scheme.in_phase)
                            || y.abs() > limit(scheme.quadrature)
                            || (x, y) == (0, 0)
                        {
                            continue;
                        }
                        let record = pixel(
                            &pipeline,
                            Sums { in_phase: x, quadrature: y, offset: 0, saturated: false },
                        );
                        assert_eq!(unit.phase(x, y), record.phase, "{preset} {phase_bits}: ({x}, {y})");
                    }
                }
            }
        }
    }

    /// By hand: one iteration turns (4, 4) by atan 1/2; without a normaliser the same vector sixteen times weaker loses its bits.
    #[test]
    fn tiny_units_by_hand() {
        let tiny = Configuration {
            metric: 1,
            x_bits: 4,
            y_bits: 4,
            phase_bits: 4,
            iterations: 2,
            vector_guard_bits: 0,
            angle_guard_bits: 1,
            normaliser: true,
            rounding: Rounding::Nearest,
        };
        // Angles in 1/32 turn: atan 1/2 is 2.36, atan 1/4 is 1.25: table 2, 1.
        let unit = PhaseUnit::new(&tiny);
        assert_eq!(unit.steps, [2, 1]);
        // (4, 4) to (16, 16) of 2^-4; y = 16 - 8 > 0, then + again: 2 + 1 = 3, halved and rounded up: 2 of 16 is 45 degrees.
        assert_eq!(
            [unit.phase(4, 4), unit.phase(-4, 4), unit.phase(-4, -4), unit.phase(4, -4)],
            [2, 6, 10, 14]
        );
        // (4, 0): y = 0 counts as positive: 2, then y = -8 < 0: 2 - 1 = 1, halved and rounded up: 1 (the true angle is 0).
        assert_eq!([unit.phase(4, 0), unit.phase(-8, 0), unit.phase(0, 1)], [1, 7, 3]);
        // Truncated: 1 halved is 0.
        let truncated = PhaseUnit::new(&Configuration { rounding: Rounding::Truncate, ..tiny });
        assert_eq!([truncated.phase(4, 4), truncated.phase(4, 0)], [1, 0]);
    }
}
