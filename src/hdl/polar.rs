//! Template contexts from the turned vector to the result: amplitude, offset, distance.

use super::Source;
use super::text::{counter_bits, literal, range, table, zero_extended};
use crate::model;
use crate::spec::{Multipliers, ScaledConstant, Word, exact};
use askama::Template;

/// Bits of a constant's multiplier.
fn factor_bits(factor: ScaledConstant) -> u32 {
    Word::holding(0, factor.multiplier).bits
}

/// Characters of a sum that stand in a line.
const LINE_CHARACTERS: usize = 90;

/// `operand` of `bits` bits times the constant `multiplier`, modulo 2^bits.
fn product(kind: Multipliers, operand: &str, bits: u32, multiplier: i64) -> String {
    if kind == Multipliers::Dsp {
        return format!("{operand} * {}", literal(bits, multiplier));
    }
    let mut text = String::new();
    let mut line = 0;
    for (place, digit) in signed_digits(multiplier).into_iter().rev() {
        let term = if place == 0 { operand.to_owned() } else { format!("({operand} << {place})") };
        let full = line + term.len() > LINE_CHARACTERS;
        line = if full { 0 } else { line } + term.len() + 3;
        let space = if full { "\n        " } else { " " };
        // The highest digit of a positive number is positive.
        match (text.is_empty(), digit) {
            (true, _) => text = term,
            (false, 1) => text += &format!("{space}+ {term}"),
            (false, _) => text += &format!("{space}- {term}"),
        }
    }
    text
}

/// The canonical signed-digit form of a positive number (Avizienis 1961): places and digits (1 or -1) that are not 0, lowest
/// first; no two are neighbours, so they are as few as can be.
fn signed_digits(number: i64) -> Vec<(u32, i64)> {
    let (mut left, mut place, mut digits) = (number, 0, Vec::new());
    while left != 0 {
        if left & 1 == 1 {
            let digit = if left & 3 == 3 { -1 } else { 1 };
            digits.push((place, digit));
            left -= digit;
        }
        left >>= 1;
        place += 1;
    }
    digits
}

#[derive(Template)]
#[template(path = "amplitude.v", escape = "none")]
struct Amplitude {
    banner: String,
    prefix: String,
    fraction_bits: u32,
    multiplier: i64,
    factor_shift: u32,
    exponent: i64,
    gain: String,
    divisor: f64,
    rows: Vec<String>,
    x_bits: u32,
    shift_bits: u32,
    factor_bits: u32,
    amplitude_bits: u32,
    places_range: String,
    spare_bits: bool,
    product: String,
    places: String,
}

pub(super) fn amplitude(source: &Source, banner: String) -> askama::Result<String> {
    let (pipeline, derived) = (source.pipeline, source.pipeline.derived());
    let factor = derived.amplitude_factor;
    let angle = &derived.angle;
    let (shift_bits, length) = (angle.shift_bits(), angle.length_word());
    let factor_bits = factor_bits(factor);
    let product_bits = length.bits + factor_bits;
    let least_places = factor.shift - 1;
    let places_bits = counter_bits(least_places as usize + (1 << shift_bits) - 1);
    let rows = [(1.2, 0), (2.0, 3), (1.0, angle.magnitude_bits - 1)].map(|(x, shift)| {
        let x = (x * f64::from(angle.fraction_bits).exp2()) as i64;
        let amplitude = model::amplitude(pipeline, x, shift, false);
        vec![x.to_string(), shift.to_string(), amplitude.to_string()]
    });
    Amplitude {
        banner,
        prefix: pipeline.prefix(),
        fraction_bits: pipeline.output.amplitude_fraction_bits,
        multiplier: factor.multiplier,
        factor_shift: factor.shift,
        exponent: i64::from(pipeline.output.amplitude_fraction_bits) + i64::from(angle.magnitude_bits)
            - 1
            - i64::from(angle.fraction_bits),
        gain: format!("{:.9}", exact::angle_gain_f64(angle.metric, angle.stages.x_iterations)),
        divisor: pipeline.modulation.scheme.gain * pipeline.modulation.frames_per_step as f64,
        rows: table(&rows),
        x_bits: length.bits,
        shift_bits,
        factor_bits,
        amplitude_bits: derived.amplitude.bits,
        places_range: range(places_bits),
        spare_bits: product_bits > derived.amplitude.bits + 1,
        product: product(
            pipeline.output.multipliers,
            "{{FACTOR_BITS{1'b0}}, x_i}",
            product_bits,
            factor.multiplier,
        ),
        places: format!(
            "{} + {}",
            zero_extended("shift_i", shift_bits, places_bits),
            literal(places_bits, least_places.into())
        ),
    }
    .render()
}

#[derive(Template)]
#[template(path = "offset.v", escape = "none")]
struct Offset {
    banner: String,
    prefix: String,
    fraction_bits: u32,
    divisor: i64,
    multiplier: i64,
    factor_shift: u32,
    rows: Vec<String>,
    sum_bits: u32,
    offset_bits: u32,
    product: String,
}

pub(super) fn offset(source: &Source, banner: String) -> askama::Result<String> {
    let (pipeline, derived) = (source.pipeline, source.pipeline.derived());
    let factor = derived.offset_factor;
    let product_bits = derived.offset.bits + factor.shift;
    let divisor = pipeline.modulation.scheme.offset_gain() * pipeline.modulation.frames_per_step as i64;
    let rows = [divisor, 100 * divisor + 1, derived.sample.max() * divisor]
        .map(|sum| vec![sum.to_string(), model::offset(pipeline, sum).to_string()]);
    Offset {
        banner,
        prefix: pipeline.prefix(),
        fraction_bits: pipeline.output.offset_fraction_bits,
        divisor,
        multiplier: factor.multiplier,
        factor_shift: factor.shift,
        rows: table(&rows),
        sum_bits: derived.offset_sum.bits,
        offset_bits: derived.offset.bits,
        product: product(
            pipeline.output.multipliers,
            &zero_extended("sum_i", derived.offset_sum.bits, product_bits),
            product_bits,
            factor.multiplier,
        ),
    }
    .render()
}

#[derive(Template)]
#[template(path = "distance.v", escape = "none")]
struct Distance {
    banner: String,
    prefix: String,
    range_m: String,
    frequency_hz: f64,
    turn: i64,
    unit_m: f64,
    multiplier: i64,
    factor_shift: u32,
    rows: Vec<String>,
    phase_bits: u32,
    power: bool,
    distance_bits: u32,
    product: String,
}

pub(super) fn distance(source: &Source, banner: String) -> askama::Result<String> {
    let (pipeline, derived) = (source.pipeline, source.pipeline.derived());
    let factor = derived.distance_factor;
    let product_bits = derived.distance.bits + factor.shift;
    let (phase, times) = match &derived.unwrapper {
        None => (derived.phase, 1),
        Some(unwrapper) => (unwrapper.unwrapped, unwrapper.ratio[0]),
    };
    let turn = derived.unwrapper.as_ref().map_or(phase.max() + 1, |unwrapper| unwrapper.codes_a_turn);
    let quarter = turn / 4;
    let frequency_hz = pipeline.modulation.frequency_hz / times as f64;
    let rows = [1, quarter, turn - 1]
        .map(|phase| vec![phase.to_string(), model::distance(pipeline, phase).to_string()]);
    Distance {
        banner,
        prefix: pipeline.prefix(),
        range_m: format!("{:.6}", crate::units::unambiguous_range_m(frequency_hz)),
        frequency_hz,
        turn,
        unit_m: pipeline.output.distance_unit_m,
        multiplier: factor.multiplier,
        factor_shift: factor.shift,
        rows: table(&rows),
        phase_bits: phase.bits,
        power: turn == 1 << phase.bits,
        distance_bits: derived.distance.bits,
        product: product(
            pipeline.output.multipliers,
            &zero_extended("phase_i", phase.bits, product_bits),
            product_bits,
            factor.multiplier,
        ),
    }
    .render()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 7 = 8 - 1, 11 = 8 + 4 - 1 or, canonical, 16 - 4 - 1; digits add up to the number and have no neighbours.
    #[test]
    fn signed_digits_are_canonical() {
        assert_eq!(signed_digits(7), [(0, -1), (3, 1)]);
        assert_eq!(signed_digits(11), [(0, -1), (2, -1), (4, 1)]);
        for number in 1..5000_i64 {
            let digits = signed_digits(number);
            assert_eq!(digits.iter().map(|(place, digit)| digit << place).sum::<i64>(), number);
            assert!(digits.windows(2).all(|pair| pair[1].0 > pair[0].0 + 1), "{number}");
        }
        assert_eq!(product(Multipliers::ShiftAdd, "x", 8, 7), "(x << 3) - x");
    }
}
