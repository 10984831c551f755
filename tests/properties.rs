//! What must hold for every specification and every frame, whatever the numbers are.
//!
//! Chain of trust: `accuracy.rs` compares the model's numbers with exact ones for chosen specifications; these properties
//! need no exact number, only the geometry of the plane, and are tried on specifications of every kind.

mod support;

use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseResult, TestRunner};
use std::cell::Cell;
use support::{small, specifications};
use vuris::model::{Accumulator, PixelRecord, PixelSlot, cordic, distance, normalise, pixel};
use vuris::spec::{Pipeline, Specification, Word};

/// A pixel's codes, frame by frame.
type Codes = Vec<u32>;

fn slot(pipeline: &Pipeline, frame: usize, first_frame: bool) -> PixelSlot {
    PixelSlot { address: 3, step: frame / pipeline.modulation.frames_per_step, first_frame }
}

fn record(pipeline: &Pipeline, codes: &[u32]) -> PixelRecord {
    let mut accumulator = Accumulator::new(pipeline);
    for (frame, &code) in codes.iter().enumerate() {
        accumulator.add(slot(pipeline, frame, frame == 0), code);
    }
    pixel(pipeline, accumulator.sums()[3])
}

/// Full scale, in DN.
fn full_scale(pipeline: &Pipeline) -> u32 {
    pipeline.derived().sample.max() as u32
}

/// Draws specifications and a pixel's codes, some of them weak, and requires `property`; `scheme` where it is one's only.
fn always(scheme: Option<&'static str>, property: impl Fn(&Pipeline, Codes) -> TestCaseResult) {
    let cases = 400;
    let tried = Cell::new(0);
    let of_scheme = move |mut specification: Specification| {
        if let Some(scheme) = scheme {
            specification.modulation.scheme = vuris::spec::scheme(scheme).unwrap().clone();
            specification.modulation.order = None;
        }
        Pipeline::new("any", specification).ok()
    };
    let specifications = specifications()
        .prop_filter_map("it is accepted with the scheme, too", move |specification| {
            of_scheme(specification.clone()).map(|_| specification)
        });
    let codes = prop::collection::vec(any::<u32>(), 27);
    TestRunner::new(Config { cases, failure_persistence: None, ..Config::default() })
        .run(
            &(specifications, codes, 0..40_u32, any::<bool>()),
            |(specification, mut codes, weaker, extreme)| {
                let pipeline = of_scheme(specification).unwrap();
                codes.truncate(pipeline.derived().frames_per_set);
                for code in &mut codes {
                    let all = full_scale(&pipeline);
                    *code = if extreme {
                        all * (*code >> 31)
                    } else {
                        (*code & all) >> weaker.saturating_sub(25)
                    };
                }
                tried.set(tried.get() + 1);
                property(&pipeline, codes)
            },
        )
        .unwrap();
    println!("{} specifications with a pixel's frames each", tried.get());
}

/// Difference of two phases, the short way round.
fn turned(pipeline: &Pipeline, from: &PixelRecord, to: &PixelRecord) -> i64 {
    Word::signed(pipeline.output.phase_bits).wrap(to.phase - from.phase)
}

/// Whether the vector lies on a border between two octants: there, the fold is one of two, and the phase of the same
/// vector by the other one may differ by rounding.
fn on_a_border(record: &PixelRecord) -> bool {
    let (x, y) = (record.vector.x.abs(), record.vector.y.abs());
    x == 0 || y == 0 || x == y
}

/// Requires that `to` is `from` turned by `expected` codes: to the code, or on a border within the worst cases of both.
fn turned_by(pipeline: &Pipeline, from: &PixelRecord, to: &PixelRecord, expected: i64) -> TestCaseResult {
    let off = Word::signed(pipeline.output.phase_bits).wrap(turned(pipeline, from, to) - expected);
    let allowed = if on_a_border(from) { 2.0 * pipeline.budget().phase_codes() } else { 0.0 };
    prop_assert!(off.abs() as f64 <= allowed, "off by {} codes: {:?} and {:?}", off, from, to);
    prop_assert_eq!(to.amplitude, from.amplitude);
    prop_assert_eq!(to.valid, from.valid);
    Ok(())
}

/// Requires that every register's word holds what it gets for these sums.
fn within_words(pipeline: &Pipeline, record: &PixelRecord) -> TestCaseResult {
    let derived = pipeline.derived();
    let mut held = vec![
        ("in-phase sum", derived.in_phase, record.sums.in_phase),
        ("quadrature sum", derived.quadrature, record.sums.quadrature),
        ("offset sum", derived.offset_sum, record.sums.offset),
        ("x", derived.x, record.vector.x),
        ("y", derived.y, record.vector.y),
        ("phase", derived.phase, record.phase),
        ("amplitude", derived.amplitude, record.amplitude),
        ("offset", derived.offset, record.offset),
        ("distance", derived.distance, record.distance),
    ];
    let normalised = normalise(pipeline, record.vector);
    let one = 1_i64 << derived.fraction_bits;
    let major = if normalised.zero { 0..=0 } else { one..=2 * one };
    prop_assert!(major.contains(&normalised.major) && (0..=normalised.major).contains(&normalised.minor));
    prop_assert!((normalised.shift as usize) < 1 << derived.normaliser.shifts.len());
    // Shifted and rounded to nearest, both by the same rule.
    let (x, y) = (record.vector.x.abs(), record.vector.y.abs());
    let (pad_bits, drop_bits) = (derived.normaliser.pad_bits, derived.normaliser.drop_bits);
    for (coordinate, exact) in [(normalised.major, x.max(y)), (normalised.minor, x.min(y))] {
        let exact = exact << normalised.shift << pad_bits;
        prop_assert!(
            2 * ((coordinate << drop_bits) - exact).abs() <= (1 << drop_bits) & !1,
            "{:?}",
            normalised
        );
    }
    // The iterations once more, as a textbook has them, to see what is between them: x / 2^i, halves up.
    let (mut x, mut y, mut angle) = (normalised.major, normalised.minor, 0);
    held.extend([("x", derived.cordic_x, x), ("y", derived.cordic_y, y)]);
    for (i, step) in (1..).zip(&derived.angle_table) {
        let part = |value: i64| (value + (1 << (i - 1))).div_euclid(1 << i);
        let sign = if y < 0 { -1 } else { 1 };
        (x, y, angle) = (x + sign * part(y), y - sign * part(x), angle + sign * step);
        held.extend([
            ("x", derived.cordic_x, x),
            ("y", derived.cordic_y, y),
            ("angle", derived.angle, angle),
        ]);
    }
    let rotated = cordic(pipeline, normalised);
    prop_assert_eq!((rotated.x, rotated.angle), (x, angle));
    for (name, word, value) in held {
        prop_assert!(word.contains(value), "{} = {} leaves {}", name, value, word);
    }
    Ok(())
}

#[test]
fn no_register_leaves_its_word() {
    always(None, |pipeline, codes| within_words(pipeline, &record(pipeline, &codes)));
}

#[test]
fn no_register_leaves_its_word_at_any_corner() {
    let mut corners = 0;
    for preset in ["vuris", "vuris-four-frame"] {
        for (adc_bits, frames_per_step, phase_bits, guard_bits) in
            [(12, 1, 18, 4), (8, 1, 8, 0), (16, 256, 24, 8), (16, 256, 8, 0), (9, 3, 13, 1)]
        {
            let pipeline = small(preset, |specification| {
                specification.sensor.adc_bits = adc_bits;
                specification.modulation.frames_per_step = frames_per_step;
                specification.cordic.iterations = (phase_bits + guard_bits).min(30);
                specification.cordic.vector_guard_bits = guard_bits;
                specification.output.phase_bits = phase_bits;
                specification.output.amplitude_fraction_bits = 8;
                specification.output.offset_fraction_bits = 8;
                specification.output.distance_unit_m = 1e-4;
            });
            let full_scale = full_scale(&pipeline);
            // Every step dark, full, or a code beside: every sum of any of the frames is among them.
            let levels = [0, 1, full_scale - 1, full_scale];
            for corner in 0..levels.len().pow(pipeline.modulation.scheme.steps() as u32) {
                let codes: Codes = (0..pipeline.derived().frames_per_set)
                    .map(|frame| levels[corner >> (2 * (frame / frames_per_step)) & 3])
                    .collect();
                within_words(&pipeline, &record(&pipeline, &codes)).unwrap();
                corners += 1;
            }
        }
    }
    println!("{corners} corners");
}

#[test]
fn sums_stay_in_their_words_in_every_order_of_frames() {
    always(None, |pipeline, codes| {
        let derived = pipeline.derived();
        // Orders that differ from case to case: by the codes' own bits.
        let mut order: Vec<usize> = (0..codes.len()).collect();
        order.sort_by_key(|&frame| codes[frame].wrapping_mul(0x9e37_79b9).rotate_left(frame as u32));
        let mut accumulator = Accumulator::new(pipeline);
        for (number, &frame) in order.iter().enumerate() {
            accumulator.add(slot(pipeline, frame, number == 0), codes[frame]);
            let sums = accumulator.sums()[3];
            prop_assert!(derived.in_phase.contains(sums.in_phase), "{:?}", sums);
            prop_assert!(derived.quadrature.contains(sums.quadrature), "{:?}", sums);
            prop_assert!(derived.offset_sum.contains(sums.offset), "{:?}", sums);
        }
        prop_assert_eq!(accumulator.sums()[3], record(pipeline, &codes).sums);
        Ok(())
    });
}

/// I_n = A cos(n/4 turn − φ): the next frame is the first of a vector a quarter turn less.
#[test]
fn with_four_frames_beginning_a_step_later_is_a_quarter_turn() {
    always(Some("four_frame"), |pipeline, mut codes| {
        let before = record(pipeline, &codes);
        codes.rotate_left(pipeline.modulation.frames_per_step);
        let quarter = 1 << (pipeline.output.phase_bits - 2);
        let after = record(pipeline, &codes);
        if before.vector.x == 0 && before.vector.y == 0 {
            return Ok(());
        }
        turned_by(pipeline, &before, &after, -quarter)?;
        prop_assert_eq!((after.offset, after.sums.saturated), (before.offset, before.sums.saturated));
        Ok(())
    });
}

/// Of a signal of three steps' period, the second of five frames on begins a third of a turn later.
#[test]
fn with_five_frames_beginning_a_step_later_is_a_third_of_a_turn() {
    always(Some("wdft"), |pipeline, codes| {
        let frames_per_step = pipeline.modulation.frames_per_step;
        let beginning = |step: usize| -> PixelRecord {
            let period = codes[..3 * frames_per_step].iter().cycle().skip(step * frames_per_step);
            record(pipeline, &period.take(codes.len()).copied().collect::<Codes>())
        };
        let (before, after) = (beginning(0), beginning(1));
        if before.vector.x == 0 && before.vector.y == 0 {
            return Ok(());
        }
        prop_assert_eq!(after.sums.offset, before.sums.offset);
        let third = f64::from(pipeline.output.phase_bits).exp2() / 3.0;
        let turn = 3.0 * third;
        let off = turned(pipeline, &before, &after) as f64 + third;
        let off = off - turn * (off / turn).round();
        prop_assert!(off.abs() <= 2.0 * pipeline.budget().phase_codes(), "off by {} codes", off);
        Ok(())
    });
}

#[test]
fn a_negative_is_half_a_turn_away() {
    always(None, |pipeline, mut codes| {
        let before = record(pipeline, &codes);
        for code in &mut codes {
            *code = full_scale(pipeline) - *code;
        }
        let after = record(pipeline, &codes);
        prop_assert_eq!((after.vector.x, after.vector.y), (-before.vector.x, -before.vector.y));
        if (before.vector.x, before.vector.y) == (0, 0) {
            return Ok(());
        }
        turned_by(pipeline, &before, &after, 1 << (pipeline.output.phase_bits - 1))
    });
}

#[test]
fn with_four_frames_swapping_both_sums_mirrors_the_phase_at_an_eighth() {
    always(Some("four_frame"), |pipeline, codes| {
        let steps: Vec<&[u32]> = codes.chunks(pipeline.modulation.frames_per_step).collect();
        let (before, after) =
            (record(pipeline, &codes), record(pipeline, &[steps[1], steps[0], steps[3], steps[2]].concat()));
        prop_assert_eq!((after.vector.x, after.vector.y), (before.vector.y, before.vector.x));
        if (before.vector.x, before.vector.y) == (0, 0) {
            return Ok(());
        }
        let quarter = 1 << (pipeline.output.phase_bits - 2);
        turned_by(pipeline, &before, &after, quarter - 2 * before.phase)
    });
}

/// The frames backwards: cos is even. With five frames, those of a signal of three steps' period. Other rows need not have the
/// symmetry.
#[test]
fn time_backwards_is_the_opposite_phase() {
    always(None, |pipeline, codes| {
        let steps: Vec<&[u32]> = codes.chunks(pipeline.modulation.frames_per_step).collect();
        let (forwards, backwards) = match &*pipeline.modulation.scheme.name {
            "wdft" => ([0, 1, 2, 0, 1].to_vec(), [0, 2, 1, 0, 2].to_vec()),
            "four_frame" | "dft" => {
                let all = 0..steps.len();
                (all.clone().collect(), all.map(|n| (steps.len() - n) % steps.len()).collect())
            }
            _ => return Ok(()),
        };
        let of = |order: Vec<usize>| {
            record(pipeline, &order.iter().flat_map(|&step| steps[step]).copied().collect::<Codes>())
        };
        let (before, after) = (of(forwards), of(backwards));
        prop_assert_eq!((after.vector.x, after.vector.y), (before.vector.x, -before.vector.y));
        turned_by(pipeline, &before, &after, -2 * before.phase)
    });
}

#[test]
fn more_light_is_more_amplitude_and_the_same_phase() {
    always(None, |pipeline, codes| {
        let most = codes.iter().max().copied().unwrap_or(0).max(1);
        for times in [2, 3, 4, 7, 16, 100] {
            if times * most > full_scale(pipeline) {
                break;
            }
            let (before, after) = (
                record(pipeline, &codes),
                record(pipeline, &codes.iter().map(|code| times * code).collect::<Codes>()),
            );
            let off = turned(pipeline, &before, &after).abs() as f64;
            // A power of two is undone by the normaliser: not even rounding differs.
            let budget = pipeline.budget();
            let allowed = if times.is_power_of_two() { 0.0 } else { 2.0 * budget.phase_codes() };
            prop_assert!(off <= allowed, "{} times the light turns the phase by {} codes", times, off);
            let (weak, strong) = (before.amplitude as f64, after.amplitude as f64);
            // Both are within their bound of the true amplitudes, whose ratio is `times`; the tenth is for the bounds' taking
            // the amplitude as it came out instead of the true one.
            let allowed =
                f64::from(times) * budget.amplitude_codes(weak + 1.0) + budget.amplitude_codes(strong + 1.0);
            let off = (strong - f64::from(times) * weak).abs();
            prop_assert!(
                off <= 1.1 * allowed,
                "{} times the light: amplitude {} becomes {}",
                times,
                weak,
                strong
            );
        }
        Ok(())
    });
}

#[test]
fn background_light_moves_the_offset_and_nothing_else() {
    always(None, |pipeline, codes| {
        let most = codes.iter().max().copied().unwrap_or(0);
        let background = (full_scale(pipeline) - most) / 2;
        let (before, after) = (
            record(pipeline, &codes),
            record(pipeline, &codes.iter().map(|code| code + background).collect::<Codes>()),
        );
        prop_assert_eq!(after.vector, before.vector);
        prop_assert_eq!((after.phase, after.amplitude), (before.phase, before.amplitude));
        prop_assert_eq!((after.distance, after.valid), (before.distance, before.valid));
        let moved = f64::from(background) * f64::from(pipeline.output.offset_fraction_bits).exp2();
        let budget = pipeline.budget();
        let allowed =
            budget.offset_codes(before.offset as f64 + 1.0) + budget.offset_codes(after.offset as f64 + 1.0);
        let off = ((after.offset - before.offset) as f64 - moved).abs();
        prop_assert!(off <= allowed, "{} DN move the offset by {}", background, after.offset - before.offset);
        Ok(())
    });
}

#[test]
fn the_order_of_frames_within_a_step_does_not_matter() {
    always(None, |pipeline, mut codes| {
        let before = record(pipeline, &codes);
        for step in codes.chunks_mut(pipeline.modulation.frames_per_step) {
            step.reverse();
        }
        prop_assert_eq!(record(pipeline, &codes), before);
        Ok(())
    });
}

#[test]
fn a_pixel_is_saturated_where_any_of_its_samples_is() {
    always(None, |pipeline, mut codes| {
        let saturation = pipeline.sensor.saturation_dn as u32;
        let any = codes.iter().any(|&code| code >= saturation);
        prop_assert_eq!(record(pipeline, &codes).sums.saturated, any);
        // No frame, and then each alone.
        for code in &mut codes {
            *code = (*code).min(saturation - 1);
        }
        prop_assert!(!record(pipeline, &codes).sums.saturated);
        for frame in 0..codes.len() {
            let before = std::mem::replace(&mut codes[frame], saturation);
            prop_assert!(record(pipeline, &codes).sums.saturated);
            codes[frame] = before;
        }
        Ok(())
    });
}

#[test]
fn constant_light_has_no_phase() {
    always(None, |pipeline, mut codes| {
        let code = codes[0];
        codes.fill(code);
        let record = record(pipeline, &codes);
        prop_assert!(!record.valid);
        prop_assert_eq!((record.phase, record.amplitude, record.distance), (0, 0, 0));
        prop_assert_eq!(record.offset, i64::from(code) << pipeline.output.offset_fraction_bits);
        Ok(())
    });
}

#[test]
fn a_pixel_is_valid_where_it_has_a_vector_that_is_strong_enough() {
    always(None, |pipeline, codes| {
        let record = record(pipeline, &codes);
        let has_vector = (record.vector.x, record.vector.y) != (0, 0);
        let scale = f64::from(pipeline.output.amplitude_fraction_bits).exp2();
        let least = (pipeline.output.minimum_amplitude_dn * scale).round();
        prop_assert_eq!(record.valid, has_vector && record.amplitude as f64 >= least);
        // As strong as this pixel, and a code stronger.
        for (more, valid) in [(0, has_vector), (1, false)] {
            let least = (record.amplitude + more) as f64 / scale;
            let other =
                pipeline.adapted("any", |specification| specification.output.minimum_amplitude_dn = least);
            prop_assert_eq!(other.is_ok_and(|other| self::record(&other, &codes).valid), valid);
        }
        Ok(())
    });
}

#[test]
fn distance_rises_with_the_phase_from_zero_to_the_unambiguous_range() {
    always(None, |pipeline, codes| {
        let derived = pipeline.derived();
        let range = vuris::units::unambiguous_range_m(pipeline.modulation.frequency_hz)
            / pipeline.output.distance_unit_m;
        prop_assert_eq!(distance(pipeline, 0), 0);
        let last = distance(pipeline, derived.phase.max()) as f64;
        let step = range / f64::from(pipeline.output.phase_bits).exp2();
        prop_assert!(
            (last - (range - step)).abs() <= pipeline.budget().distance_codes(range),
            "{} of {}",
            last,
            range
        );
        for code in codes {
            let phase = derived.phase.wrap(i64::from(code).wrapping_mul(0x9e37_79b9)).max(1);
            prop_assert!(distance(pipeline, phase - 1) <= distance(pipeline, phase), "at phase {}", phase);
        }
        Ok(())
    });
}
