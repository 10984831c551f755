//! Every number that follows from a specification: widths with the bound that makes them safe, constants, latency.

use super::exact::{self, ScaledConstant};
use super::{Irrational, Specification, Word, refused};
use crate::problem::Result;

/// The normaliser: octant fold and leading-zero shift.
#[derive(Debug, Clone, PartialEq)]
pub struct Normaliser {
    /// Bits of the larger coordinate's magnitude, before the shift.
    pub magnitude_bits: u32,
    /// Shifts of the stages, largest first: together they reach every leading-zero count.
    pub shifts: Vec<u32>,
    /// Zeros appended below the shifted magnitude, where it is narrower than the CORDIC's word.
    pub pad_bits: u32,
    /// Bits rounded off below, where it is wider.
    pub drop_bits: u32,
}

/// What follows from a [`Specification`]; every field's doc is the proof of its bound.
#[derive(Debug, Clone, PartialEq)]
pub struct Derived {
    /// Raw frames in a set: phase steps × frames a step.
    pub frames_per_set: usize,
    /// A raw code: `adc_bits`.
    pub sample: Word,
    /// In-phase sum. With s the full-scale code and M the frames a step, every partial sum, in any order of frames,
    /// lies between M·s times the sum of the negative weights and M·s times the sum of the positive ones.
    pub in_phase: Word,
    /// Quadrature sum, by the same bound.
    pub quadrature: Word,
    /// Offset sum, by the same bound; its weights are positive.
    pub offset_sum: Word,
    /// Bits of a pixel's word in the sum memory: the three sums and the saturation flag.
    pub memory_word_bits: u32,
    /// Bits of the sum memory.
    pub memory_bits: usize,
    /// What the in-phase sum is multiplied by, so that both coordinates have one scale.
    pub in_phase_factor: i64,
    /// What the quadrature sum is multiplied by.
    pub quadrature_factor: i64,
    /// Relative error of quadrature factor / in-phase factor against the irrational, proved (0 where exact).
    pub factor_error: f64,
    /// The vector's x = in-phase sum × factor: the sum's bounds times the factor.
    pub x: Word,
    /// The vector's y = quadrature sum × factor.
    pub y: Word,
    /// Octant fold and shift.
    pub normaliser: Normaliser,
    /// Fraction bits of the CORDIC's x and y: phase bits + vector guard bits. 1.0 is the least normalised x.
    pub fraction_bits: u32,
    /// The CORDIC's x: 0 < x ≤ 2√2·K < 3.2936, K the gain from iteration 1 on (< 1.16445), so two integer bits, no sign.
    pub cordic_x: Word,
    /// The CORDIC's y: |y| ≤ 2 before the first iteration, at most 2√2·K·sin 45° < 2.3290 after, so two integer bits and
    /// a sign.
    pub cordic_y: Word,
    /// The CORDIC's angle, in 2^−(phase bits + angle guard bits) turns: |z| ≤ Σ atan 2^−i < 0.1526 turn, so it fits a
    /// quarter turn either way.
    pub angle: Word,
    /// atan(2^−i) for i = 1 … iterations, in the angle's unit, rounded to nearest.
    pub angle_table: Vec<i64>,
    /// The phase, a fraction of a turn: its overflow is the phase's wrap.
    pub phase: Word,
    /// The amplitude, in 2^−fraction DN: |x, y| over the gains, for the largest vector that the sums can hold.
    pub amplitude: Word,
    /// Amplitude a unit of the CORDIC's final x, before the normaliser's shift is undone.
    pub amplitude_factor: ScaledConstant,
    /// Codes of amplitude below which a pixel is invalid.
    pub minimum_amplitude: i64,
    /// The offset, in 2^−fraction DN: at most full scale.
    pub offset: Word,
    /// Offset a unit of the offset sum.
    pub offset_factor: ScaledConstant,
    /// The distance, in the specification's unit: at most the rounded unambiguous range.
    pub distance: Word,
    /// Distance units a phase code.
    pub distance_factor: ScaledConstant,
    /// Clocks from a pixel's sums at the memory's output to its result at the core's output, without back-pressure.
    pub latency_clocks: u32,
}

/// Relative share of one phase code that the irrational's approximation may cost: 1/16.
const IRRATIONAL_SHARE: f64 = 1.0 / 16.0;

/// Widest coordinate of a vector: the model holds every product in 64 bits.
const MOST_VECTOR_BITS: u32 = 56;

/// Significant bits of a factor beyond those of its result. A multiplier of n bits is off by at most half of its last bit, a
/// relative error of 2^-n, so that a result of n - 4 bits is off by less than 1/16 code.
const FACTOR_GUARD_BITS: u32 = 4;

impl Derived {
    /// Derives everything; `source` is the name that a refusal gives.
    pub(super) fn new(source: &str, specification: &Specification) -> Result<Self> {
        let Specification { sensor, modulation, cordic, output, .. } = specification;
        let scheme = &modulation.scheme;
        let frames_per_step = modulation.frames_per_step as i64;
        let sample = Word::unsigned(sensor.adc_bits);
        let bounds = |weights: &[i64]| {
            let scale = frames_per_step * sample.max();
            let total = |sign: i64| weights.iter().filter(|&&w| w * sign > 0).sum::<i64>() * scale;
            (total(-1), total(1))
        };
        let word = |(low, high)| Word::holding(low, high);
        let (in_phase, quadrature) = (bounds(&scheme.in_phase), bounds(&scheme.quadrature));
        let offset_sum = bounds(&scheme.offset);
        let memory_word_bits = word(in_phase).bits + word(quadrature).bits + word(offset_sum).bits + 1;

        let (quadrature_factor, in_phase_factor, factor_error) = match scheme.irrational {
            Irrational::One => (1, 1, 0.0),
            Irrational::Sqrt3 => {
                // A scale error ε of one coordinate turns a vector by at most ε/2 rad (ε/2 · sin 2φ).
                let code_rad = std::f64::consts::TAU / 2f64.powi(output.phase_bits as i32);
                let (n, d) = exact::sqrt3_ratio(2.0 * IRRATIONAL_SHARE * code_rad);
                (n, d, exact::sqrt3_ratio_error(d))
            }
        };
        let times = |(low, high): (i64, i64), factor: i64| (low * factor, high * factor);
        let (x, y) = (times(in_phase, in_phase_factor), times(quadrature, quadrature_factor));
        let vector_bits = word(x).bits.max(word(y).bits);
        if vector_bits > MOST_VECTOR_BITS {
            return Err(refused(source, "modulation.scheme", &scheme.name)
                .expected(format_args!(
                    "weights, ADC bits and frames a step that make a vector of at most {MOST_VECTOR_BITS} bits (these need \
                     {vector_bits})"
                ))
                .remedy("take smaller weights, or fewer frames a step"));
        }
        let largest = |(low, high): (i64, i64)| high.max(-low);
        let magnitude_bits = Word::unsigned(1).bits.max(Word::holding(0, largest(x).max(largest(y))).bits);
        let fraction_bits = output.phase_bits + cordic.vector_guard_bits;
        let cordic_bits = fraction_bits + 1;
        if cordic.iterations > fraction_bits {
            return Err(refused(source, "cordic.iterations", cordic.iterations).expected(format_args!(
                "at most phase_bits + vector_guard_bits = {fraction_bits}: a later iteration only shifts in zeros"
            )));
        }
        let stages = magnitude_bits.next_power_of_two().trailing_zeros();
        let normaliser = Normaliser {
            magnitude_bits,
            shifts: (0..stages).rev().map(|stage| 1 << stage).collect(),
            pad_bits: cordic_bits.saturating_sub(magnitude_bits),
            drop_bits: magnitude_bits.saturating_sub(cordic_bits),
        };

        let angle_bits = output.phase_bits + cordic.angle_guard_bits;
        let angle_table =
            (1..=cordic.iterations).map(|i| exact::atan_of_power_of_two(i, angle_bits)).collect();

        // Amplitude: |v| = x_N / K · 2^(magnitude_bits − 1 − fraction_bits − shift), A = |v| / divisor.
        let divisor = scheme.gain * (in_phase_factor * frames_per_step) as f64;
        let amplitude_scale = 2f64.powi(output.amplitude_fraction_bits as i32);
        let largest_vector = (largest(x) as f64).hypot(largest(y) as f64);
        // x leaves the CORDIC too large by at most half an ulp and half an ulp of y's effect an iteration, each an ulp of
        // at least 1.0, and two of the normaliser; the factor's own error and the last rounding add less than a code.
        let relative = factor_error + f64::from(cordic.iterations + 2) / f64::from(fraction_bits).exp2();
        let amplitude_limit =
            (largest_vector / divisor * amplitude_scale * (1.0 + relative)).ceil() as i64 + 1;
        let amplitude = Word::holding(0, amplitude_limit);
        if fraction_bits + 2 + amplitude.bits + FACTOR_GUARD_BITS > 63 {
            return Err(refused(source, "output.amplitude_fraction_bits", output.amplitude_fraction_bits)
                .expected("an amplitude whose product with its factor has at most 63 bits")
                .remedy("take fewer, or weights that add up to more of the amplitude"));
        }
        let exponent = i64::from(output.amplitude_fraction_bits) + i64::from(magnitude_bits)
            - 1
            - i64::from(fraction_bits);
        let unrepresentable = |field: &str, value: String| {
            refused(source, field, value)
                .expected("a value whose constant multiplier has 1 to 62 fraction bits")
                .remedy("choose a unit nearer to the resolution of the result")
        };
        let amplitude_factor =
            exact::amplitude_factor(cordic.iterations, divisor, exponent, amplitude.bits + FACTOR_GUARD_BITS)
                .ok_or_else(|| {
                    unrepresentable(
                        "output.amplitude_fraction_bits",
                        output.amplitude_fraction_bits.to_string(),
                    )
                })?;
        let minimum_amplitude = (output.minimum_amplitude_dn * amplitude_scale).round() as i64;
        if minimum_amplitude > amplitude.max() {
            return Err(refused(source, "output.minimum_amplitude_dn", output.minimum_amplitude_dn)
                .expected(format_args!("at most {} DN", amplitude.max() as f64 / amplitude_scale)));
        }

        let offset_divisor = scheme.offset_gain() * frames_per_step;
        let offset = Word::unsigned(sensor.adc_bits + output.offset_fraction_bits);
        if word(offset_sum).bits + offset.bits + FACTOR_GUARD_BITS > 63 {
            return Err(refused(source, "modulation.scheme.offset", format_args!("{:?}", scheme.offset))
                .expected("weights whose sum's product with its factor has at most 63 bits")
                .remedy("take smaller weights, or fewer output.offset_fraction_bits"));
        }
        let offset_factor = exact::ratio_factor(
            offset_divisor,
            output.offset_fraction_bits.into(),
            offset.bits + FACTOR_GUARD_BITS,
        )
        .ok_or_else(|| {
            unrepresentable("output.offset_fraction_bits", output.offset_fraction_bits.to_string())
        })?;

        let units = exact::distance_units_a_turn(modulation.frequency_hz, output.distance_unit_m);
        let distance_bits = Word::holding(0, units).bits;
        if !(4..=32).contains(&distance_bits) {
            return Err(refused(source, "output.distance_unit_m", output.distance_unit_m)
                .expected(format_args!(
                    "a unit of which the unambiguous range {:.4} m holds 8 to 2^32 - 1 (it holds {units})",
                    crate::units::unambiguous_range_m(modulation.frequency_hz)
                ))
                .remedy("choose another unit"));
        }
        let distance_factor = exact::distance_factor(
            modulation.frequency_hz,
            output.distance_unit_m,
            output.phase_bits,
            distance_bits + FACTOR_GUARD_BITS,
        )
        .ok_or_else(|| unrepresentable("output.distance_unit_m", output.distance_unit_m.to_string()))?;

        // scaling 1, magnitudes 1, swap 1, shift stages, rounding 1, iterations, polar 2, distance 2, output 1: each a
        // register of the template of the same name.
        let latency_clocks = 3 + stages + u32::from(normaliser.drop_bits > 0) + cordic.iterations + 2 + 2 + 1;

        Ok(Self {
            frames_per_set: scheme.steps() * modulation.frames_per_step,
            sample,
            in_phase: word(in_phase),
            quadrature: word(quadrature),
            offset_sum: word(offset_sum),
            memory_word_bits,
            memory_bits: memory_word_bits as usize * sensor.width * sensor.height,
            in_phase_factor,
            quadrature_factor,
            factor_error,
            x: word(x),
            y: word(y),
            normaliser,
            fraction_bits,
            cordic_x: Word::unsigned(fraction_bits + 2),
            cordic_y: Word::signed(fraction_bits + 3),
            angle: Word::signed(angle_bits - 1),
            angle_table,
            phase: Word::unsigned(output.phase_bits),
            amplitude,
            amplitude_factor,
            minimum_amplitude,
            offset,
            offset_factor,
            distance: Word::unsigned(distance_bits),
            distance_factor,
            latency_clocks,
        })
    }
}
