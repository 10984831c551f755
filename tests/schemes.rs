//! Phase schemes that are not built in: plain DFTs of any number of frames, and rows of integer weights.
//!
//! Chain of trust: a DFT's phase is compared with the exact DFT of the same integer frames by `oracle` (128 bits, another
//! library than the one that makes the weights); a row's with the phase of the light that the frames were made of, and its
//! roots with those that its authors publish. Both are then co-simulated.

mod oracle;
mod support;

use oracle::{Oracle, circular_difference};
use std::f64::consts::TAU;
use support::{ROWS, everything, row, small, two_at_a_time};
use vuris::algorithms::{Basis, Polynomial};
use vuris::cosim::{Simulation, Simulator, Traffic};
use vuris::hdl::{Golden, Source};
use vuris::model::{Accumulator, PixelRecord, PixelSlot, pixel};
use vuris::spec::{DFT_FRAMES, Irrational, Pipeline, Row, Scheme, StepAngle, scheme};

fn pipeline(scheme: Scheme, adc_bits: u32) -> Pipeline {
    small("vuris", |specification| {
        specification.sensor.adc_bits = adc_bits;
        specification.modulation.scheme = scheme;
    })
}

/// The model's answer to a pixel's frames.
fn record(pipeline: &Pipeline, frames: &[i64]) -> PixelRecord {
    let mut accumulator = Accumulator::new(pipeline);
    for (step, &code) in frames.iter().enumerate() {
        accumulator.add(PixelSlot { address: 0, step, first_frame: step == 0 }, code as u32);
    }
    pixel(pipeline, accumulator.sums()[0])
}

/// The frames of `scheme` that light of `phase_rad` makes, in whole codes.
fn frames(scheme: &Scheme, amplitude: f64, offset: f64, phase_rad: f64) -> Vec<i64> {
    let frame = |step| (amplitude * (scheme.angle_rad(step) - phase_rad).cos() + offset).round() as i64;
    (0..scheme.steps()).map(frame).collect()
}

/// Fractions of a turn that cover the circle evenly for any count, by the golden ratio.
fn phases(count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(|k| TAU * (f64::from(k) * 0.618_033_988_749_895).fract())
}

/// With every number of frames: the model against the exact DFT of the same frames. What the budget does not hold is how
/// the rounded weights see the frames' own rounding to whole codes: half a code each.
#[test]
fn every_dft_is_the_exact_dft_of_the_same_frames_within_the_budget() {
    for coefficient_bits in [6, 12, 18] {
        let mut closest = f64::INFINITY;
        let worst = two_at_a_time(&DFT_FRAMES.collect::<Vec<_>>(), |&steps| {
            let mut oracle = Oracle::new();
            let scheme = Scheme::dft(steps, coefficient_bits).unwrap();
            let pipeline = pipeline(scheme.clone(), 16);
            let bits = pipeline.output.phase_bits;
            let codes_a_rad = f64::from(bits).exp2() / TAU;
            let weights = scheme.characteristic_polynomial().into_iter().zip(scheme.true_coefficients());
            let weight_errors: f64 = weights.map(|(weight, exact)| (weight - exact).norm()).sum();
            let mut worst = 0_f64;
            for (k, phase_rad) in phases(24).enumerate() {
                let amplitude = [30_000.0, 2_500.0, 300.0][k % 3];
                let frames = frames(&scheme, amplitude, 32_000.0, phase_rad);
                let record = record(&pipeline, &frames);
                assert!(record.valid);
                let (x, y) = oracle.dft(&frames);
                let exact = oracle.angle_codes(&x, &y, bits);
                // The exact DFT of these frames is that of the light, but for their rounding.
                let light = phase_rad / TAU * f64::from(bits).exp2();
                let rounding_rad = (0.5 * steps as f64 / (steps as f64 / 2.0) / amplitude).asin();
                let off = circular_difference(0, exact - light, f64::from(bits).exp2()).abs();
                assert!(
                    off <= rounding_rad * codes_a_rad,
                    "{steps} frames: the oracle is off by {off} codes"
                );
                let by_frames_rad = (0.5 * weight_errors / scheme.gain / (amplitude - 1.0)).asin();
                let bound = pipeline.budget().phase_codes() + by_frames_rad * codes_a_rad;
                let error = circular_difference(record.phase, exact, f64::from(bits).exp2()).abs();
                assert!(
                    error <= bound,
                    "{steps} frames, {coefficient_bits} bits: {error} codes, bound {bound}"
                );
                worst = worst.max(error / bound);
            }
            worst
        });
        for share in &worst {
            closest = closest.min(1.0 - share);
        }
        println!(
            "{coefficient_bits} bits: the worst error comes as near as {:.1} % to its bound",
            100.0 * closest
        );
        assert!(closest < 0.5, "the bounds are far from the errors: {worst:?}");
    }
}

#[test]
fn amplitude_and_offset_of_a_dft_are_those_of_the_light() {
    for steps in [3, 5, 8, 13, 64] {
        let scheme = Scheme::dft(steps, 14).unwrap();
        let pipeline = pipeline(scheme.clone(), 16);
        for phase_rad in phases(16) {
            let record = record(&pipeline, &frames(&scheme, 20_000.0, 30_000.0, phase_rad));
            // The frames' rounding moves the sums by half a code a frame at most.
            let allowed = 20_000.0 * scheme.weight_error_amplitude + 2.0;
            assert!(
                (record.amplitude as f64 / 16.0 - 20_000.0).abs() <= allowed,
                "{steps} frames: {record:?}"
            );
            assert!((record.offset as f64 / 16.0 - 30_000.0).abs() <= 0.6, "{steps} frames: {record:?}");
        }
    }
}

#[test]
fn a_harmonic_below_half_the_steps_comes_through_a_dft_only_as_rounding_lets_it() {
    for (steps, coefficient_bits) in [(8, 6), (9, 6), (16, 12), (31, 18)] {
        let scheme = Scheme::dft(steps, coefficient_bits).unwrap();
        let units = f64::from(coefficient_bits - 1).exp2() - 1.0;
        for harmonic in 2..=(steps as i32 - 1) / 2 {
            // Each weight is off by less than 1.5 units of a length of about steps/2 x units.
            assert!(
                scheme.harmonic_leakage(harmonic) < 2.0 * 3.0 * 1.5 / units,
                "{steps} frames, harmonic {harmonic}"
            );
        }
        assert!(
            (scheme.harmonic_leakage(steps as i32 - 1) - 1.0).abs() < 0.1,
            "the mirror of the fundamental"
        );
    }
}

#[test]
fn rows_of_published_algorithms_measure_the_phase_of_the_light() {
    for (number, &(name, ..)) in ROWS.iter().enumerate() {
        for factor in [1, 50] {
            let scheme = row(number, factor);
            assert_eq!((scheme.weight_error_rad, scheme.weight_error_amplitude), (0.0, 0.0), "{name}");
            let pipeline = pipeline(scheme.clone(), 16);
            let bits = pipeline.output.phase_bits;
            for phase_rad in phases(40) {
                let record = record(&pipeline, &frames(&scheme, 30_000.0, 32_000.0, phase_rad));
                let light = phase_rad / TAU * f64::from(bits).exp2();
                // Half a code a frame, by weights whose magnitudes add up to so much of the gain.
                let magnitudes: f64 = scheme.characteristic_polynomial().iter().map(|c| c.norm()).sum();
                let rounding_codes = magnitudes / scheme.gain * 0.5 / 30_000.0 * f64::from(bits).exp2() / TAU;
                let off = circular_difference(record.phase, light, f64::from(bits).exp2()).abs();
                assert!(
                    off <= rounding_codes + pipeline.budget().phase_codes(),
                    "{name}: off by {off} codes"
                );
                assert!(
                    (record.amplitude as f64 / 16.0 - 30_000.0).abs() < 2.0 * magnitudes / scheme.gain,
                    "{name}"
                );
                assert!((record.offset as f64 / 16.0 - 32_000.0).abs() < 0.6, "{name}: {record:?}");
            }
        }
    }
}

/// How often each harmonic from −`most` to `most` is a root, with the paper's sign of φ: that of the polynomial is the conjugate.
fn roots(scheme: &Scheme, most: i64) -> Vec<usize> {
    let polynomial = Polynomial::of_scheme(scheme).unwrap();
    (-most..=most).map(|harmonic| polynomial.multiplicity(-harmonic, Basis::Angle)).collect()
}

/// By expanding the products: Hariharan, Oreb and Eiju's row (1987) and Surrel's 4 + 1 (1993) are (x^2 - 1)(x + i)^2, Schmit
/// and Creath's (1995) is (x - 1)(x + i)^3, de Groot's (1995) is (x^2 - 1)(x + i)^4, and 3 + 1 is (x - 1)(x - z)^2 with z the
/// third root of 1 that the fundamental's opposite has; each up to a factor, and conjugate for the paper's sign of phi.
#[test]
fn roots_of_published_algorithms_are_their_authors() {
    for (name, expected) in [
        // Harmonics -3 … 3; with a step of 1/4 turn, -3 is 1 and 3 is -1.
        ("hariharan", [2, 1, 0, 1, 2, 1, 0]),
        ("schmit-creath", [3, 0, 0, 1, 3, 0, 0]),
        ("de-groot", [4, 1, 0, 1, 4, 1, 0]),
        ("four-plus-one", [2, 1, 0, 1, 2, 1, 0]),
        // With a step of 1/3 turn, -3 and 3 are 0, -2 is 1 and 2 is -1.
        ("three-plus-one", [1, 2, 0, 1, 2, 0, 1]),
    ] {
        let number = ROWS.iter().position(|row| row.0 == name).unwrap();
        let scheme = row(number, 1);
        assert_eq!(roots(&scheme, 3), expected, "{name}");
    }
}

/// Roots as the paper lists them.
#[test]
fn roots_are_the_papers() {
    let of = |name: &str| roots(scheme(name).unwrap(), 5);
    //                             m = -5 -4 -3 -2 -1  0  1  2  3  4  5
    assert_eq!(of("four_frame"), [0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1]);
    assert_eq!(of("wdft"), [2, 0, 2, 2, 0, 2, 2, 0, 2, 2, 0]);
}

#[test]
fn unequal_steps_given_as_a_list_work_too() {
    // Four frames taken in another order, and a row for three frames at 0, 1/4 and 1/2 turn whose offset is their pair's.
    for (angles, in_phase, quadrature) in
        [("0 1/2 1/4 3/4", &[1, -1, 0, 0][..], &[0, 0, 1, -1][..]), ("0 1/4 1/2", &[1, 0, -1], &[-1, 2, -1])]
    {
        let scheme = Scheme::of_row(
            "test",
            Row {
                name: "own".to_owned(),
                angles: angles.split(' ').map(|angle| StepAngle::parse(angle).unwrap()).collect(),
                in_phase: in_phase.to_vec(),
                quadrature: quadrature.to_vec(),
                offset: None,
                irrational: Irrational::One,
                reference: "test".to_owned(),
            },
        )
        .unwrap();
        let pipeline = pipeline(scheme.clone(), 16);
        for phase_rad in phases(20) {
            let record = record(&pipeline, &frames(&scheme, 30_000.0, 32_000.0, phase_rad));
            let light = phase_rad / TAU * f64::from(pipeline.output.phase_bits).exp2();
            let off = circular_difference(record.phase, light, f64::from(pipeline.output.phase_bits).exp2());
            assert!(off.abs() < 4.0, "{angles}: off by {off} codes");
        }
        let again = Pipeline::parse("again", &pipeline.to_toml()).unwrap();
        assert_eq!(again, pipeline, "{}", pipeline.to_toml());
    }
}

#[test]
fn every_scheme_survives_writing_and_reading() {
    let dfts = DFT_FRAMES.map(|steps| Scheme::dft(steps, 4 + steps as u32 % 15).unwrap());
    let rows = (0..ROWS.len()).map(|number| row(number, 3));
    for scheme in dfts.chain(rows) {
        let pipeline = pipeline(scheme, 12);
        assert_eq!(Pipeline::parse("again", &pipeline.to_toml()).unwrap(), pipeline);
    }
}

#[test]
fn dfts_and_rows_agree_in_both_simulators() {
    let dft = |steps, bits| (format!("dft of {steps}, {bits} bits"), Scheme::dft(steps, bits).unwrap());
    let of_row = |number: usize, factor| (format!("{} x {factor}", ROWS[number].0), row(number, factor));
    // Multipliers; shifts and adds; multipliers again.
    let mut schemes = vec![dft(3, 4), dft(5, 18), dft(7, 12), dft(64, 18)];
    schemes.extend((0..4).map(|number| of_row(number, 1)));
    schemes.extend([of_row(0, 1001), of_row(3, 16)]);
    // An offset whose weights are multiplied, too.
    let (_, angles, in_phase, quadrature, irrational) = ROWS[0];
    let wide_offset = Row {
        name: "wide-offset".to_owned(),
        angles: angles.split(' ').map(|angle| StepAngle::parse(angle).unwrap()).collect(),
        in_phase: in_phase.to_vec(),
        quadrature: quadrature.to_vec(),
        offset: Some(vec![500, 77, 1000, 77, 500]),
        irrational,
        reference: "test".to_owned(),
    };
    schemes.push(("wide offset".to_owned(), Scheme::of_row("test", wide_offset).unwrap()));
    let runs: Vec<_> =
        schemes.iter().flat_map(|row| Simulator::ALL.map(|simulator| (row, simulator))).collect();
    let values = two_at_a_time(&runs, |&((name, scheme), simulator)| {
        let pipeline = small("vuris-four-frame", |specification| {
            (specification.sensor.width, specification.sensor.height) = (6, 3);
            specification.sensor.adc_bits = if scheme.steps() % 2 == 0 { 16 } else { 10 };
            specification.modulation.scheme = scheme.clone();
        });
        let golden = Golden::new(&pipeline, &everything(&pipeline, 7));
        let folder = tempfile::tempdir().unwrap();
        let source = Source { pipeline: &pipeline, spec: "test" };
        let simulation = Simulation::build(source, &golden, simulator, folder.path(), &|_| {}).unwrap();
        let [mixed, straight, ..] = Traffic::profiles(3);
        [mixed, straight]
            .into_iter()
            .map(|traffic| {
                let outcome = simulation.run(traffic).unwrap();
                let findings: Vec<String> = outcome.findings.iter().map(ToString::to_string).collect();
                assert_eq!(outcome.mismatches, 0, "{name}, {}: {findings:#?}", simulator.name());
                outcome.values
            })
            .sum::<u64>()
    });
    println!("{} values compared in {} runs", values.iter().sum::<u64>(), runs.len());
}
