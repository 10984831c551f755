//! Every number that follows from a specification: widths with the bound that makes them safe, constants, latency.

use super::exact::{self, ScaledConstant};
use super::storage::{self, Storage};
use super::unwrapping::Unwrapper;
use super::{AngleSpecification, AngleUnit, Atan, Specification, Word, refused};
use crate::problem::Result;

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
    /// What is kept of a pixel's sums while frames arrive.
    pub storage: Storage,
    /// Bits of a pixel's word in the sum memory: what is kept, and the saturation flag.
    pub memory_word_bits: u32,
    /// Widths of the columns of the memory, lowest bits first.
    pub memory_columns: Vec<u32>,
    /// Bits of the sum memory.
    pub memory_bits: usize,
    /// The angle unit: from (in-phase, quadrature) to the phase. Its metric is the square of the scheme's irrational.
    pub angle: AngleUnit,
    /// The phase, a fraction of a turn: its overflow is the phase's wrap.
    pub phase: Word,
    /// The amplitude, in 2^−fraction DN: the vector's length over the gains, for the largest that the sums can hold.
    pub amplitude: Word,
    /// Amplitude a unit of the angle unit's length, before the normaliser's shift is undone.
    pub amplitude_factor: ScaledConstant,
    /// Codes of amplitude below which a pixel is invalid.
    pub minimum_amplitude: i64,
    /// The offset, in 2^−fraction DN: at most full scale.
    pub offset: Word,
    /// Offset a unit of the offset sum.
    pub offset_factor: ScaledConstant,
    /// What unwraps, where a second frequency does.
    pub unwrapper: Option<Unwrapper>,
    /// The distance, in the specification's unit: at most the rounded unambiguous range, of the unwrapped phase where there is
    /// one.
    pub distance: Word,
    /// Distance units a phase code, or an unwrapped one.
    pub distance_factor: ScaledConstant,
    /// Clocks from a pixel's sums at the memory's output to its result at the core's output, without back-pressure.
    pub latency_clocks: u32,
}

/// Widest sum: the model holds every product in 64 bits.
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
        let storage = Storage::new(scheme, frames_per_step * sample.max());
        let memory_word_bits = storage.bits() + 1;

        let vector_bits = word(in_phase).bits.max(word(quadrature).bits);
        if vector_bits > MOST_VECTOR_BITS {
            return Err(refused(source, "modulation.scheme", &scheme.name)
                .expected(format_args!(
                    "weights, ADC bits and frames a step that make sums of at most {MOST_VECTOR_BITS} bits (these need \
                     {vector_bits})"
                ))
                .remedy("take smaller weights, or fewer frames a step"));
        }
        let largest = |(low, high): (i64, i64)| high.max(-low);
        let metric = scheme.irrational.squared();
        let divisor = scheme.gain * frames_per_step as f64;
        let amplitude_scale = 2f64.powi(output.amplitude_fraction_bits as i32);
        let largest_vector =
            (largest(in_phase) as f64).hypot((metric as f64).sqrt() * largest(quadrature) as f64);
        let amplitude_word = |relative: f64| {
            let codes = largest_vector / divisor * amplitude_scale * (1.0 + relative);
            Word::holding(0, codes.ceil() as i64 + 1)
        };
        // The length must be as exact as a quarter of the amplitude's code at full scale.
        let length_bits = if output.amplitude { amplitude_word(0.0).bits + 2 } else { 0 };
        let angle = AngleUnit::new(
            source,
            AngleSpecification {
                x_bits: word(in_phase).bits,
                y_bits: word(quadrature).bits,
                metric,
                phase_bits: output.phase_bits,
                length_bits,
                atan: Atan::Cordic,
                cordic: cordic.clone(),
            },
        )?;

        // Amplitude: |v| = length / gain · 2^(magnitude_bits − 1 − fraction_bits − shift), A = |v| / divisor.
        let relative = angle.budget().length_relative.min(1.0);
        let amplitude = amplitude_word(relative + f64::from(FACTOR_GUARD_BITS).exp2().recip());
        if angle.length_word().bits + amplitude.bits + FACTOR_GUARD_BITS > 63 {
            return Err(refused(source, "output.amplitude_fraction_bits", output.amplitude_fraction_bits)
                .expected("an amplitude whose product with its factor has at most 63 bits")
                .remedy("take fewer, or weights that add up to more of the amplitude"));
        }
        let exponent = i64::from(output.amplitude_fraction_bits) + i64::from(angle.magnitude_bits)
            - 1
            - i64::from(angle.fraction_bits);
        let unrepresentable = |field: &str, value: String| {
            refused(source, field, value)
                .expected("a value whose constant multiplier has 1 to 62 fraction bits")
                .remedy("choose a unit nearer to the resolution of the result")
        };
        let amplitude_factor = exact::amplitude_factor(
            metric,
            angle.stages.x_iterations,
            divisor,
            exponent,
            amplitude.bits + FACTOR_GUARD_BITS,
        )
        .ok_or_else(|| {
            unrepresentable("output.amplitude_fraction_bits", output.amplitude_fraction_bits.to_string())
        })?;
        let minimum_amplitude = (output.minimum_amplitude_dn * amplitude_scale).round() as i64;
        if minimum_amplitude > 0 && !output.amplitude {
            return Err(refused(source, "output.minimum_amplitude_dn", output.minimum_amplitude_dn)
                .expected("0 where the amplitude is not asked for")
                .remedy("set output.amplitude = true"));
        }
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

        let unwrapper = specification
            .unwrapping
            .as_ref()
            .map(|unwrapping| Unwrapper::new(source, unwrapping, output.phase_bits))
            .transpose()?;
        let [turns, codes_divisor] = unwrapper.as_ref().map_or([1, 1], |unwrapper| unwrapper.ratio);
        let units = exact::distance_units(modulation.frequency_hz, output.distance_unit_m, turns);
        let distance_bits = Word::holding(0, units).bits;
        if !(4..=32).contains(&distance_bits) {
            return Err(refused(source, "output.distance_unit_m", output.distance_unit_m)
                .expected(format_args!(
                    "a unit of which the unambiguous range {:.4} m holds 8 to 2^32 - 1 (it holds {units})",
                    crate::units::unambiguous_range_m(modulation.frequency_hz) * turns as f64
                ))
                .remedy("choose another unit"));
        }
        let code_bits = unwrapper.as_ref().map_or(output.phase_bits, |unwrapper| unwrapper.unwrapped.bits);
        if code_bits + distance_bits + FACTOR_GUARD_BITS > 62 {
            return Err(refused(source, "output.distance_unit_m", output.distance_unit_m)
                .expected(format_args!(
                    "a unit of which the unambiguous range holds less than 2^{}: its product with the phase has 62 bits",
                    62 - FACTOR_GUARD_BITS - code_bits
                ))
                .remedy("choose a larger unit, or fewer output.phase_bits"));
        }
        let distance_factor = exact::distance_factor(
            modulation.frequency_hz,
            output.distance_unit_m,
            output.phase_bits,
            codes_divisor,
            distance_bits + FACTOR_GUARD_BITS,
        )
        .ok_or_else(|| unrepresentable("output.distance_unit_m", output.distance_unit_m.to_string()))?;

        // The angle unit, then amplitude, offset and distance side by side 2, output 1. The distance of an unwrapped phase comes
        // after the amplitude, which says whether the phase is usable, and after 4 of the unwrapping.
        let unwrapping_clocks = if unwrapper.is_some() { 4 + 2 } else { 0 };
        let latency_clocks = angle.latency_clocks() + 2 + unwrapping_clocks + 1;

        Ok(Self {
            frames_per_set: scheme.steps() * modulation.frames_per_step,
            sample,
            in_phase: word(in_phase),
            quadrature: word(quadrature),
            offset_sum: word(offset_sum),
            storage,
            memory_word_bits,
            memory_columns: storage::columns(memory_word_bits, sensor.width * sensor.height),
            memory_bits: memory_word_bits as usize * sensor.width * sensor.height,
            angle,
            phase: Word::unsigned(output.phase_bits),
            amplitude,
            amplitude_factor,
            minimum_amplitude,
            offset,
            offset_factor,
            unwrapper,
            distance: Word::unsigned(distance_bits),
            distance_factor,
            latency_clocks,
        })
    }
}
