//! Is the model right? Its phase, amplitude and distance against arbitrary-precision arithmetic on the same integer frames.
//!
//! Chain of trust: `oracle` is independent of the crate (its own library, its own copy of the paper's equations) and is
//! itself checked here on angles known without computation. The bounds come from the specification's error budget, so a
//! budget that promises too much fails here.

mod oracle;

use oracle::{Oracle, circular_difference, paper_sums};
use proptest::test_runner::{Config, TestRunner};
use std::f64::consts::TAU;
use vuris::model::{Sums, pixel};
use vuris::spec::{Cordic, PRESETS, Pipeline, Rounding, Throughput};

fn sums(in_phase: i64, quadrature: i64) -> Sums {
    Sums { in_phase, quadrature, offset: 0, saturated: false }
}

/// Difference of the model's phase from the exact one, in phase codes.
fn phase_error(oracle: &mut Oracle, pipeline: &Pipeline, in_phase: i64, quadrature: i64) -> f64 {
    let bits = pipeline.output.phase_bits;
    let record = pixel(pipeline, sums(in_phase, quadrature));
    assert!(record.valid);
    let exact = oracle.phase_codes(&pipeline.modulation.scheme.name, in_phase, quadrature, bits);
    circular_difference(record.phase, exact, f64::from(bits).exp2())
}

#[test]
fn the_oracle_knows_the_angles_that_need_no_computation() {
    let mut oracle = Oracle::new();
    for (x, y, eighths) in
        [(5, 0, 0), (5, 5, 1), (0, 5, 2), (-5, 5, 3), (-5, 0, 4), (-5, -5, 5), (0, -5, 6), (5, -5, 7)]
    {
        assert_eq!(oracle.phase_codes("four_frame", x, y, 16), f64::from(eighths) * 8192.0);
    }
    // With √3: (1, 1) is 60°, (3, 1) is 30°.
    assert!((oracle.phase_codes("wdft", 1, 1, 16) - 65536.0 / 6.0).abs() < 1e-9);
    assert!((oracle.phase_codes("wdft", 3, 1, 16) - 65536.0 / 12.0).abs() < 1e-9);
    assert!((oracle.length("wdft", 1, 1) - 2.0).abs() < 1e-12);
}

/// The figures that the hardware promises: under 0.05 mrad RMS, and under 0.005 mrad and 0.05 phase codes in the mean, from 20
/// codes to full scale.
#[test]
fn a_presets_phase_error_is_below_its_promise_at_every_amplitude() {
    let mut oracle = Oracle::new();
    for preset in PRESETS {
        let pipeline = Pipeline::named(preset.name).unwrap();
        let scheme = &pipeline.modulation.scheme;
        let mrad = 1e3 * TAU / f64::from(pipeline.output.phase_bits).exp2();
        for amplitude in [20.0, 35.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 2047.5] {
            let count = 1200;
            let (mut sum, mut squares) = (0.0, 0.0);
            for k in 0..count {
                // The golden ratio's fractions cover the circle evenly for any count.
                let phase = TAU * (f64::from(k) * 0.618_033_988_749_895).fract();
                let frames: Vec<i64> = (0..scheme.steps())
                    .map(|n| (amplitude * (scheme.angle_rad(n) - phase).cos() + 2047.5).round() as i64)
                    .collect();
                let (in_phase, quadrature) = paper_sums(&scheme.name, &frames);
                let error = phase_error(&mut oracle, &pipeline, in_phase, quadrature) * mrad;
                sum += error;
                squares += error * error;
            }
            let (mean, rms) = (sum / f64::from(count), (squares / f64::from(count)).sqrt());
            println!(
                "{:17} amplitude {amplitude:6.1} DN: mean {mean:+.5} mrad, RMS {rms:.5} mrad",
                preset.name
            );
            assert!(rms < 0.05, "{}: {rms} mrad RMS at {amplitude} DN", preset.name);
            assert!(mean.abs() < 0.005, "{}: {mean} mrad mean at {amplitude} DN", preset.name);
            let codes = mean / mrad;
            assert!(codes.abs() < 0.05, "{}: {codes} codes mean at {amplitude} DN", preset.name);
        }
    }
}

/// A small specification: 8-bit samples, 8-bit phase, few iterations; its sums' square is small enough to visit whole.
fn small(scheme: &str, cordic: Cordic, phase_bits: u32) -> Pipeline {
    Pipeline::named("vuris")
        .unwrap()
        .adapted("small", |specification| {
            specification.sensor.adc_bits = 8;
            specification.modulation.scheme = vuris::spec::scheme(scheme).unwrap().clone();
            specification.cordic = cordic;
            specification.output.phase_bits = phase_bits;
            specification.output.distance_unit_m = 1e-2;
        })
        .unwrap()
}

/// Worst phase error of all vectors whose in-phase sum is in `in_phase`, and quadrature sum up to `limit` either way.
fn worst_error(pipeline: &Pipeline, in_phase: std::ops::RangeInclusive<i64>, limit: i64) -> f64 {
    let mut oracle = Oracle::new();
    let vectors =
        in_phase.flat_map(|i| (-limit..=limit).map(move |q| (i, q))).filter(|&vector| vector != (0, 0));
    vectors.map(|(i, q)| phase_error(&mut oracle, pipeline, i, q).abs()).fold(0.0, f64::max)
}

const UNROLLED: Throughput = Throughput::CyclesPerPixel(1);
const FOLDED: Throughput = Throughput::CyclesPerPixel(3);
const ITERATIVE: Throughput = Throughput::OneIterationAClock;

/// A CORDIC of few iterations.
fn short(iterations: u32, vector_guard_bits: u32, throughput: Throughput) -> Cordic {
    Cordic { throughput, ..Cordic::new(iterations, vector_guard_bits, 3) }
}

/// Every vector that the sums of an 8-bit sensor's four frames can hold, and every weak vector of other words.
#[test]
fn every_vector_of_a_small_word_is_within_the_budget() {
    for (scheme, cordic, phase_bits, limit) in [
        ("four_frame", short(10, 2, UNROLLED), 8, 255),
        ("four_frame", short(6, 0, ITERATIVE), 8, 96),
        ("wdft", short(10, 1, UNROLLED), 9, 96),
        ("wdft", short(10, 1, ITERATIVE), 9, 96),
        ("four_frame", short(12, 3, FOLDED), 10, 96),
        ("wdft", Cordic { rounding: Rounding::Truncate, ..short(9, 2, FOLDED) }, 9, 64),
        // Not normalised: the guard bits alone keep the weakest vectors' directions.
        ("four_frame", Cordic { normalise: false, ..short(12, 8, ITERATIVE) }, 8, 96),
    ] {
        let pipeline = small(scheme, cordic, phase_bits);
        let bound = pipeline.budget().phase_codes();
        let worst = std::thread::scope(|scope| {
            let half = scope.spawn(|| worst_error(&pipeline, -limit..=-1, limit));
            worst_error(&pipeline, 0..=limit, limit).max(half.join().unwrap())
        });
        let cordic = &pipeline.cordic;
        println!("{scheme} {cordic:?}: worst {worst:.3} codes, bound {bound:.3}");
        assert!(worst <= bound, "{scheme} {cordic:?}: {worst} codes, bound {bound}");
        assert!(worst > bound / 4.0, "the bound {bound} is far from the worst case {worst}");
    }
}

/// Extreme sums, axes, diagonals, powers of two and their neighbours.
fn corners(pipeline: &Pipeline) -> Vec<(i64, i64)> {
    let derived = pipeline.derived();
    let values = |word: vuris::spec::Word, weights: &[i64]| {
        let scale = derived.sample.max() * pipeline.modulation.frames_per_step as i64;
        let high = weights.iter().filter(|&&w| w > 0).sum::<i64>() * scale;
        let mut values = vec![0, 1, 2, 3, high, high - 1];
        values.extend((2..word.bits - 1).flat_map(|bit| [1 << bit, (1 << bit) - 1, (1 << bit) + 1]));
        values.retain(|&value| value <= high);
        values.iter().flat_map(|&value| [value, -value]).collect::<Vec<_>>()
    };
    let quadratures = values(derived.quadrature, &pipeline.modulation.scheme.quadrature);
    values(derived.in_phase, &pipeline.modulation.scheme.in_phase)
        .into_iter()
        .flat_map(|i| quadratures.iter().map(move |&q| (i, q)))
        .filter(|&vector| vector != (0, 0))
        .collect()
}

/// Specifications whose words differ in every way: narrow and wide, padded and cut off, one frame a step and 256; by every
/// architecture, with a length and without.
fn varied() -> Vec<Pipeline> {
    let base = Pipeline::named("vuris").unwrap();
    let fast = Pipeline::named("vuris-fast").unwrap();
    let four = Pipeline::named("vuris-four-frame").unwrap();
    let wide = |base: &Pipeline, frames_per_step, phase_bits| {
        base.adapted("wide", |s| {
            s.sensor.adc_bits = 16;
            s.modulation.frames_per_step = frames_per_step;
            s.output.phase_bits = phase_bits;
            s.cordic.iterations = s.cordic.iterations.min(phase_bits + 2);
        })
        .unwrap()
    };
    let folded = |base: &Pipeline, clocks| {
        base.adapted("folded", |s| s.cordic.throughput = Throughput::CyclesPerPixel(clocks)).unwrap()
    };
    let phase_only = |base: &Pipeline| base.adapted("phase only", |s| s.output.amplitude = false).unwrap();
    vec![
        wide(&base, 1, 18),
        wide(&base, 256, 16),
        wide(&four, 256, 24),
        wide(&folded(&four, 1), 256, 24),
        wide(&folded(&four, 2), 3, 12),
        wide(&fast, 256, 16),
        phase_only(&base),
        phase_only(&wide(&fast, 1, 18)),
        phase_only(&wide(&folded(&base, 4), 3, 12)),
        phase_only(&folded(&four, 1)),
        folded(&base, 3),
        folded(&four, 8),
        small("wdft", short(8, 0, ITERATIVE), 8),
        small("wdft", Cordic { rounding: Rounding::Truncate, ..short(8, 0, UNROLLED) }, 8),
        small("four_frame", Cordic { normalise: false, ..short(12, 8, FOLDED) }, 8),
        base,
        fast,
        four,
    ]
}

#[test]
fn corner_vectors_are_within_the_budget() {
    let mut oracle = Oracle::new();
    for pipeline in varied() {
        let bound = pipeline.budget().phase_codes();
        for (in_phase, quadrature) in corners(&pipeline).into_iter().step_by(3) {
            let error = phase_error(&mut oracle, &pipeline, in_phase, quadrature).abs();
            assert!(
                error <= bound,
                "({in_phase}, {quadrature}): {error} codes, bound {bound}\n{}",
                pipeline.to_toml()
            );
        }
    }
}

#[test]
fn random_vectors_of_every_strength_are_within_the_budget() {
    let mut oracle = Oracle::new();
    for pipeline in varied() {
        let (derived, budget) = (pipeline.derived(), pipeline.budget());
        let scheme = &pipeline.modulation.scheme;
        let units = f64::from(pipeline.output.amplitude_fraction_bits).exp2();
        let scale = derived.sample.max() * pipeline.modulation.frames_per_step as i64;
        let limit = |weights: &[i64]| weights.iter().filter(|&&w| w > 0).sum::<i64>() * scale;
        let strategy = (
            -limit(&scheme.in_phase)..=limit(&scheme.in_phase),
            -limit(&scheme.quadrature)..=limit(&scheme.quadrature),
            0..derived.in_phase.bits,
        );
        TestRunner::new(Config { cases: 1000, failure_persistence: None, ..Config::default() })
            .run(&strategy, |(i, q, weaker)| {
                let (i, q) = (i >> weaker, q >> weaker);
                if (i, q) == (0, 0) {
                    return Ok(());
                }
                let error = phase_error(&mut Oracle::new(), &pipeline, i, q).abs();
                assert!(error <= budget.phase_codes(), "({i}, {q}): {error} codes");
                let record = pixel(&pipeline, sums(i, q));
                let gain = scheme.gain * pipeline.modulation.frames_per_step as f64;
                if !pipeline.output.amplitude {
                    assert_eq!(record.amplitude, 0);
                    return Ok(());
                }
                let amplitude = Oracle::new().length(&scheme.name, i, q) / gain * units;
                let error = (record.amplitude as f64 - amplitude).abs();
                assert!(error <= budget.amplitude_codes(amplitude), "({i}, {q}): {error} codes of amplitude");
                Ok(())
            })
            .unwrap();
        // The corner of all corners.
        let (i, q) = (limit(&scheme.in_phase), -limit(&scheme.quadrature));
        assert!(phase_error(&mut oracle, &pipeline, i, q).abs() <= budget.phase_codes());
    }
}

#[test]
fn offset_and_distance_are_within_the_budget() {
    for pipeline in varied() {
        let (derived, budget) = (pipeline.derived(), pipeline.budget());
        let sum_limit = pipeline.modulation.scheme.offset_gain()
            * pipeline.modulation.frames_per_step as i64
            * derived.sample.max();
        let offset_units = f64::from(pipeline.output.offset_fraction_bits).exp2();
        let range_codes = vuris::units::unambiguous_range_m(pipeline.modulation.frequency_hz)
            / pipeline.output.distance_unit_m;
        for k in 0..=5000_i64 {
            let sum = sum_limit * k / 5000;
            let exact = sum as f64 / sum_limit as f64 * derived.sample.max() as f64 * offset_units;
            let error = (vuris::model::offset(&pipeline, sum) as f64 - exact).abs();
            assert!(error <= budget.offset_codes(exact), "offset of {sum}: {error} codes");
            let phase = derived.phase.max() * k / 5000;
            let exact = phase as f64 / f64::from(pipeline.output.phase_bits).exp2() * range_codes;
            let error = (vuris::model::distance(&pipeline, phase) as f64 - exact).abs();
            assert!(error <= budget.distance_codes(exact), "distance of {phase}: {error} codes");
        }
    }
}
