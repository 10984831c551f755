//! What must hold for every specification and every frame, whatever the numbers are.
//!
//! Chain of trust: `accuracy.rs` compares the model's numbers with exact ones for chosen specifications; these properties
//! need no exact number, only the geometry of the plane, and are tried on specifications of every kind.

mod support;

use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseResult, TestRunner};
use std::cell::Cell;
use support::{angle_units, small, specifications};
use vuris::model::{
    Accumulator, Normalised, PixelRecord, PixelSlot, Sums, distance, normalise, pixel, rotate_seen, turn,
};
use vuris::spec::{AngleUnit, Cordic, PRESETS, Pipeline, Rounding, Specification, Throughput, Word};

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

/// The vector's true length in the amplitude's codes, all gains undone.
fn true_amplitude(pipeline: &Pipeline, record: &PixelRecord) -> f64 {
    let (x, y) = (record.sums.in_phase as f64, record.sums.quadrature as f64);
    let gain = pipeline.modulation.scheme.gain * pipeline.modulation.frames_per_step as f64;
    let metric = pipeline.derived().angle.metric as f64;
    x.hypot(metric.sqrt() * y) / gain * f64::from(pipeline.output.amplitude_fraction_bits).exp2()
}

/// Requires that `to` is `from` turned by `expected` codes, and as strong.
///
/// A negative coordinate is complemented, not negated, so that a vector and its mirror image are each rounded in their own
/// way: either is within the worst case of the true phase and amplitude, and they of each other within twice that.
fn turned_by(pipeline: &Pipeline, from: &PixelRecord, to: &PixelRecord, expected: i64) -> TestCaseResult {
    let budget = pipeline.budget();
    let off = Word::signed(pipeline.output.phase_bits).wrap(turned(pipeline, from, to) - expected);
    prop_assert!(
        off.abs() as f64 <= 2.0 * budget.phase_codes(),
        "off by {} codes: {:?} and {:?}",
        off,
        from,
        to
    );
    let truth = true_amplitude(pipeline, from);
    prop_assert!((true_amplitude(pipeline, to) - truth).abs() <= 1e-9 * truth);
    let off = (to.amplitude - from.amplitude).abs();
    prop_assert!(
        off as f64 <= 2.0 * budget.amplitude_codes(truth),
        "amplitude off by {} codes: {:?} and {:?}",
        off,
        from,
        to
    );
    // Where there is a vector, only the least amplitude tells what is valid.
    let valid =
        |record: &PixelRecord| has_vector(record) && record.amplitude >= pipeline.derived().minimum_amplitude;
    prop_assert_eq!((from.valid, to.valid), (valid(from), valid(to)));
    Ok(())
}

fn has_vector(record: &PixelRecord) -> bool {
    (record.sums.in_phase, record.sums.quadrature) != (0, 0)
}

/// Places of the binary point at which every value between two iterations, shifted as far as any iteration shifts, is an
/// integer: the finest y has 24 + 8 + 30 fraction bits and its half, and 30 more places.
const POINT: u32 = 100;

/// `value` / 2^`fraction_bits`, in units of 2^-POINT.
fn exact(value: i64, fraction_bits: u32) -> i128 {
    i128::from(value) << (POINT - fraction_bits)
}

/// Half a unit of the last of `fraction_bits`.
fn half_unit(fraction_bits: u32) -> i128 {
    exact(1, fraction_bits + 1)
}

/// Requires the normaliser's law: magnitudes are shifted left exactly, until the larger one's top bit is set; a negative one is
/// short by the one that its complement lacks.
fn normalised_as_it_should(unit: &AngleUnit, x: i64, y: i64, normalised: &Normalised) -> TestCaseResult {
    let Normalised { shift, zero, .. } = *normalised;
    prop_assert_eq!(zero, (x, y) == (0, 0));
    prop_assert!(shift < 1 << unit.shift_bits() && (shift == 0 || unit.cordic.normalise));
    let coordinates = [(normalised.x, normalised.x_negative, x), (normalised.y, normalised.y_negative, y)];
    for (magnitude, negative, coordinate) in coordinates {
        prop_assert_eq!(negative, coordinate < 0);
        prop_assert!(magnitude >> unit.magnitude_bits == 0, "{:?}", normalised);
        let due = (i128::from(coordinate.abs()) << shift) - i128::from(negative);
        prop_assert!(zero || i128::from(magnitude) == due, "{:?} of ({}, {})", normalised, x, y);
    }
    let top = |one: i64, other: i64| (one | other) >> (unit.magnitude_bits - 1) == 1;
    if unit.cordic.normalise && !zero {
        prop_assert!(top(normalised.x, normalised.y), "{:?}", normalised);
    }
    Ok(())
}

/// Requires that every iteration is what it is in exact arithmetic, x + metric |y| / 2^i and |y| - x / 2^i, but for what the error
/// budget counts, that its words hold it, and that the directions are the signs' run of changes.
fn iterated_as_it_should(unit: &AngleUnit, x: i64, y: i64, normalised: Normalised) -> TestCaseResult {
    let (metric, scaled) = (i128::from(unit.metric), unit.stages.scaled);
    let nearest = unit.cordic.rounding == Rounding::Nearest;
    let mut seen = Vec::new();
    let rotated = rotate_seen(unit, normalised, |i, x, y| seen.push((i, x, y)));
    prop_assert!(seen.iter().map(|&(i, ..)| i).eq(0..unit.iterations));
    // What the vector is before iteration 0: 1.0 is the top bit of a magnitude.
    let before = |coordinate: i64| {
        i128::from(coordinate.abs()) << (normalised.shift + POINT + 1 - unit.magnitude_bits)
    };
    let (mut exact_x, mut exact_y) = (before(x), before(y));
    let mut direction = normalised.x_negative != normalised.y_negative;
    let mut directions = u64::from(direction);
    for &(i, x, y) in &seen {
        let (x_word, y_word) = (unit.stages.x[i as usize], unit.stages.y[i as usize]);
        prop_assert!(x >= 0 && x >> x_word.bits == 0, "iteration {}: x = {} leaves {:?}", i, x, x_word);
        let magnitude = y ^ y >> 63;
        prop_assert!(magnitude >> (y_word.bits - 1) == 0, "iteration {}: y = {} leaves {:?}", i, y, y_word);

        let (seen_x, seen_y) = (exact(x, x_word.fraction_bits), exact(2 * y + 1, y_word.fraction_bits + 1));
        let due_x = exact_x + ((metric * exact_y.abs()) >> i);
        let due_y = exact_y.abs() - (exact_x >> i);
        let (x_half, y_half) = (half_unit(x_word.fraction_bits), half_unit(y_word.fraction_bits));
        let (x_allowed, y_allowed) = if i == 0 {
            // In half units: what a complement lacks, what is cut off, and y's own half; see the error budget.
            let short_y = unit.pad_bits() <= 1;
            let (x_halves, y_halves) = match (scaled, unit.drop_bits()) {
                (true, _) if short_y => (2 + 4 * metric, 5),
                (true, _) => (6, 5),
                (false, 0) => (2, 1),
                (false, _) => (2 + 2 * metric, 3),
            };
            (x_halves * x_half, y_halves * y_half)
        } else {
            let narrowed = x_word.fraction_bits < unit.stages.x[i as usize - 1].fraction_bits;
            let x_halves = 2 - i128::from(nearest) + i128::from(narrowed);
            // y is doubled without loss, or shifted x is rounded to y's last bit.
            let y_halves = if scaled || nearest { 1 } else { 2 };
            (x_halves * x_half + ((3 * half_unit(unit.fraction_bits)) >> i), y_halves * y_half)
        };
        let follows = i <= unit.stages.x_iterations;
        prop_assert!(follows || seen_x == exact_x, "iteration {}: x changes", i);
        prop_assert!(!follows || (seen_x - due_x).abs() <= x_allowed, "iteration {}: x = {}", i, x);
        prop_assert!((seen_y - due_y).abs() <= y_allowed, "iteration {}: y = {}", i, y);

        (exact_x, exact_y) = (seen_x, seen_y);
        direction ^= y < 0;
        directions = 2 * directions + u64::from(direction);
    }
    prop_assert_eq!(rotated.directions, directions);
    prop_assert_eq!(Some(rotated.x), seen.last().map(|&(_, x, _)| x));
    prop_assert!(unit.length_word().contains(rotated.x));
    Ok(())
}

/// Requires that every register's word holds what it gets for these sums.
fn within_words(pipeline: &Pipeline, record: &PixelRecord) -> TestCaseResult {
    let derived = pipeline.derived();
    for (name, word, value) in [
        ("in-phase sum", derived.in_phase, record.sums.in_phase),
        ("quadrature sum", derived.quadrature, record.sums.quadrature),
        ("offset sum", derived.offset_sum, record.sums.offset),
        ("phase", derived.phase, record.phase),
        ("amplitude", derived.amplitude, record.amplitude),
        ("offset", derived.offset, record.offset),
        ("distance", derived.distance, record.distance),
    ] {
        prop_assert!(word.contains(value), "{} = {} leaves {}", name, value, word);
    }
    let (unit, x, y) = (&derived.angle, record.sums.in_phase, record.sums.quadrature);
    let normalised = normalise(unit, x, y);
    normalised_as_it_should(unit, x, y, &normalised)?;
    iterated_as_it_should(unit, x, y, normalised)
}

#[test]
fn no_register_leaves_its_word() {
    always(None, |pipeline, codes| within_words(pipeline, &record(pipeline, &codes)));
}

/// Every architecture, with and without what makes words wider.
fn cordics() -> Vec<Cordic> {
    let throughputs =
        [Throughput::CyclesPerPixel(1), Throughput::CyclesPerPixel(4), Throughput::OneIterationAClock];
    let kinds = [(true, Rounding::Nearest), (true, Rounding::Truncate), (false, Rounding::Nearest)];
    let cordic = |throughput, (normalise, rounding)| Cordic {
        throughput,
        normalise,
        rounding,
        ..Cordic::new(30, 0, 4)
    };
    throughputs.into_iter().flat_map(|throughput| kinds.map(|kind| cordic(throughput, kind))).collect()
}

#[test]
fn no_register_leaves_its_word_at_any_corner() {
    let mut corners = 0;
    for preset in PRESETS.iter().map(|preset| preset.name).filter(|name| *name != "vuris-fast") {
        for (cordic, amplitude) in cordics().iter().flat_map(|cordic| [(cordic, true), (cordic, false)]) {
            for (adc_bits, frames_per_step, phase_bits, guard_bits, fraction_bits) in [
                (12, 1, 18, 4, 8),
                (8, 1, 8, 0, 8),
                (16, 256, 24, 8, 2),
                (16, 256, 8, 0, 8),
                (9, 3, 13, 1, 8),
            ] {
                let pipeline = small(preset, |specification| {
                    specification.sensor.adc_bits = adc_bits;
                    specification.modulation.frames_per_step = frames_per_step;
                    specification.cordic = cordic.clone();
                    specification.cordic.iterations = (phase_bits + guard_bits).min(30);
                    specification.cordic.vector_guard_bits = guard_bits;
                    specification.output.phase_bits = phase_bits;
                    specification.output.amplitude = amplitude;
                    specification.output.amplitude_fraction_bits = fraction_bits;
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
    }
    println!("{corners} corners");
}

/// Angle units without a camera: words of every width, and the vectors that no camera has, -2^(bits - 1) among them.
#[test]
fn no_register_of_a_bare_angle_unit_leaves_its_word() {
    let vectors = prop::collection::vec((any::<[i64; 2]>(), [0..12_u32, 0..12_u32]), 40);
    let vectors_tried = Cell::new(0);
    TestRunner::new(Config { cases: 600, failure_persistence: None, ..Config::default() })
        .run(&(angle_units(), vectors), |(unit, vectors)| {
            for ([x, y], [x_corner, y_corner]) in vectors {
                // Half of the coordinates are at a corner, the others of any strength.
                let coordinate = |value: i64, bits: u32, corner: u32| {
                    let most = (1_i64 << (bits - 1)) - 1;
                    let corners = [-most - 1, -most, -1, 0, 1, most];
                    let strength = 64 - bits + corner.saturating_sub(6) * bits / 6;
                    corners.get(corner as usize).copied().unwrap_or(value >> strength.min(63))
                };
                let (x, y) = (coordinate(x, unit.x_bits, x_corner), coordinate(y, unit.y_bits, y_corner));
                let normalised = normalise(&unit, x, y);
                normalised_as_it_should(&unit, x, y, &normalised)?;
                iterated_as_it_should(&unit, x, y, normalised)?;
                let turned = turn(&unit, x, y);
                prop_assert!(Word::unsigned(unit.phase_bits).contains(turned.phase));
                prop_assert!(!turned.zero || turned.phase == 0);
                vectors_tried.set(vectors_tried.get() + 1);
            }
            Ok(())
        })
        .unwrap();
    println!("{} vectors", vectors_tried.get());
}

/// Without a normaliser a strong vector, whose larger coordinate fills its word, loses nothing: it comes out as it would with one.
#[test]
fn without_normalising_a_vector_that_needs_no_shift_is_turned_alike() {
    let compared = Cell::new(0);
    always(None, |pipeline, codes| {
        let with = |normalise: bool| {
            pipeline.adapted("any", |specification| specification.cordic.normalise = normalise)
        };
        let (Ok(with), Ok(without)) = (with(true), with(false)) else { return Ok(()) };
        // Without, one iteration a clock can be fast enough where it is not with: that would be other hardware.
        if with.derived().angle.architecture != without.derived().angle.architecture {
            return Ok(());
        }
        let sums = record(pipeline, &codes).sums;
        // The vector itself, and one at the ends of its words, so that strong ones are many.
        let (x_word, y_word) = (with.derived().in_phase, with.derived().quadrature);
        let ends = Sums {
            in_phase: if sums.in_phase < 0 { x_word.min() } else { x_word.max() },
            quadrature: if sums.quadrature < 0 { y_word.min() } else { y_word.max() },
            ..sums
        };
        for Sums { in_phase, quadrature, .. } in [sums, ends] {
            let turned = turn(&with.derived().angle, in_phase, quadrature);
            if turned.shift == 0 {
                prop_assert_eq!(turn(&without.derived().angle, in_phase, quadrature), turned);
                compared.set(compared.get() + 1);
            }
        }
        Ok(())
    });
    println!("{} strong vectors", compared.get());
    assert!(compared.get() > 300);
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
        if !has_vector(&before) {
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
        if !has_vector(&before) {
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
        prop_assert_eq!(
            (after.sums.in_phase, after.sums.quadrature),
            (-before.sums.in_phase, -before.sums.quadrature)
        );
        if !has_vector(&before) {
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
        prop_assert_eq!(
            (after.sums.in_phase, after.sums.quadrature),
            (before.sums.quadrature, before.sums.in_phase)
        );
        if !has_vector(&before) {
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
        prop_assert_eq!(
            (after.sums.in_phase, after.sums.quadrature),
            (before.sums.in_phase, -before.sums.quadrature)
        );
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
            // A power of two is undone by the normaliser, where there is one: not even rounding differs.
            let budget = pipeline.budget();
            let undone = times.is_power_of_two() && pipeline.cordic.normalise;
            let allowed = if undone { 0.0 } else { 2.0 * budget.phase_codes() };
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
        let vector = |record: &PixelRecord| (record.sums.in_phase, record.sums.quadrature);
        prop_assert_eq!(vector(&after), vector(&before));
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
fn an_amplitude_that_is_not_asked_for_is_0_and_has_no_field() {
    always(None, |pipeline, codes| {
        let of = |amplitude: bool| {
            pipeline.adapted("any", |specification| {
                specification.output.amplitude = amplitude;
                specification.output.minimum_amplitude_dn = 0.0;
            })
        };
        let (Ok(with), Ok(without)) = (of(true), of(false)) else { return Ok(()) };
        let fields = |pipeline: &Pipeline| -> Vec<&'static str> {
            vuris::hdl::result_fields(pipeline).iter().map(|field| field.name).collect()
        };
        prop_assert_eq!(fields(&with), ["phase", "amplitude", "offset", "distance", "usable", "saturated"]);
        prop_assert_eq!(fields(&without), ["phase", "offset", "distance", "usable", "saturated"]);
        let (before, after) = (record(&with, &codes), record(&without, &codes));
        prop_assert_eq!((after.amplitude, after.valid), (0, before.valid));
        prop_assert_eq!((after.sums, after.offset), (before.sums, before.offset));
        // Both phases are of the same vector, each within its own bound.
        let allowed = with.budget().phase_codes() + without.budget().phase_codes();
        let off = turned(&with, &before, &after);
        prop_assert!(off.abs() as f64 <= allowed, "off by {} codes", off);
        Ok(())
    });
}

#[test]
fn a_pixel_is_valid_where_it_has_a_vector_that_is_strong_enough() {
    always(None, |pipeline, codes| {
        let record = record(pipeline, &codes);
        let has_vector = has_vector(&record);
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
