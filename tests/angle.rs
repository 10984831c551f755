//! The angle unit's model against exact arithmetic: every architecture, every kind of word.

use std::f64::consts::TAU;
use vuris::model::turn;
use vuris::spec::{AngleSpecification, AngleUnit, Atan, Cordic, Rounding, Throughput};

fn unit(bits: u32, metric: i64, phase_bits: u32, cordic: Cordic, length_bits: u32) -> AngleUnit {
    let specification = AngleSpecification {
        x_bits: bits,
        y_bits: bits,
        metric,
        phase_bits,
        length_bits,
        atan: Atan::Cordic,
        cordic,
    };
    AngleUnit::new("test", specification).unwrap()
}

/// Error of the phase in codes, between -2^(bits-1) and 2^(bits-1).
fn error(unit: &AngleUnit, x: i64, y: i64) -> f64 {
    let turns = ((unit.metric as f64).sqrt() * y as f64).atan2(x as f64) / TAU;
    let codes = f64::from(unit.phase_bits).exp2();
    let off = turn(unit, x, y).phase as f64 - turns * codes;
    off - codes * (off / codes).round()
}

/// Pseudo-random vectors of every magnitude, one octave after the other.
fn vectors(bits: u32, count: usize) -> impl Iterator<Item = (i64, i64)> {
    let mut state = 88_172_645_463_325_252_u64;
    (0..count).filter_map(move |number| {
        let mut next = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state as i64
        };
        let kept = 1 + number as u32 % bits;
        let vector = (next() >> (64 - kept), next() >> (64 - kept));
        (vector != (0, 0)).then_some(vector)
    })
}

/// The derived bound holds, and it is not a wild one.
#[test]
fn no_vector_is_further_off_than_the_budget_says() {
    let throughputs =
        [Throughput::CyclesPerPixel(1), Throughput::CyclesPerPixel(4), Throughput::OneIterationAClock];
    for metric in [1, 3] {
        for throughput in throughputs {
            for (bits, phase_bits, iterations, vector_guard_bits, angle_guard_bits) in [
                (16, 16, 16, 0, 4),
                (16, 16, 16, 2, 4),
                (16, 16, 17, 3, 5),
                (20, 12, 12, 1, 2),
                (9, 18, 20, 4, 6),
            ] {
                for length_bits in [0, 16] {
                    for rounding in [Rounding::Nearest, Rounding::Truncate] {
                        let base = Cordic::new(iterations, vector_guard_bits, angle_guard_bits);
                        let cordic = Cordic { throughput, rounding, ..base };
                        let unit = unit(bits, metric, phase_bits, cordic, length_bits);
                        let bound = unit.budget().phase_codes();
                        let worst =
                            vectors(bits, 60_000).map(|(x, y)| error(&unit, x, y).abs()).fold(0.0, f64::max);
                        let row = format!("{:?}: {worst:.3} of {bound:.3} codes", *unit);
                        assert!(worst <= bound && worst > 0.4 * bound.min(1.0), "{row}");
                    }
                }
            }
        }
    }
}

/// The project's own measure of "exact": one of the two codes next to the truth, for every vector of 12 x 12 bits.
#[test]
fn twelve_bits_are_faithful_without_exception() {
    for throughput in [Throughput::CyclesPerPixel(1), Throughput::OneIterationAClock] {
        let unit = unit(12, 1, 12, Cordic { throughput, ..Cordic::new(12, 3, 4) }, 0);
        assert!(unit.budget().phase_codes() < 1.0);
        for x in -2048..2048 {
            for y in -2048..2048 {
                assert!((x, y) == (0, 0) || error(&unit, x, y).abs() < 1.0, "({x}, {y})");
            }
        }
        assert_eq!(turn(&unit, 0, 0).phase, 0);
    }
}
