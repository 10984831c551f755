//! What the verification tests share: small sensors, specifications of every kind, two builds at a time.

// Each test file is a crate of its own and uses a part of this module.
#![allow(dead_code)]

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use vuris::cosim::{random_sets, standard};
use vuris::frames::RawSets;
use vuris::hdl::{Scenario, Segment};
use vuris::spec::{
    AngleSpecification, AngleUnit, Atan, Cordic, Irrational, Modulation, Multipliers, Output, Pipeline,
    RegisterBlock, Rounding, Row, SCHEMES, Scheme, Sensor, Specification, StepAngle, Throughput,
    normalised_order,
};
use vuris::units::unambiguous_range_m;

/// `preset` with a sensor of 12 x 9 pixels, and then as `change` says.
pub fn small(preset: &str, change: impl FnOnce(&mut Specification)) -> Pipeline {
    let small = |specification: &mut Specification| {
        specification.sensor.width = 12;
        specification.sensor.height = 9;
        change(specification);
    };
    Pipeline::named(preset).unwrap().adapted("small", small).unwrap()
}

/// A command of the program `name`, which `scripts/hdl-tools.sh` installs with the set `set`, in `folder`. Nothing of a make or a
/// user's settings reaches it.
pub fn hdl_tool(name: &str, set: &str, folder: &Path) -> Command {
    let program = Path::new(env!("CARGO_MANIFEST_DIR")).join(".tools/hdl/bin").join(name);
    assert!(
        program.is_file(),
        "{} is not here: bash scripts/hdl-tools.sh {set}, or `make setup`",
        program.display()
    );
    let mut command = Command::new(program);
    command.current_dir(folder).env("HOME", folder).stdin(Stdio::null());
    for name in ["VERILATOR_ROOT", "MAKEFLAGS", "MFLAGS", "XDG_CONFIG_HOME", "XDG_DATA_HOME"] {
        command.env_remove(name);
    }
    command
}

/// Runs `command`: whether it succeeded, and all that it said.
pub fn said(command: &mut Command) -> (bool, String) {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    (output.status.success(), text.into_owned())
}

/// Does `work` for every item, two at a time; the results in the items' order.
pub fn two_at_a_time<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let queue = Mutex::new(items.iter().enumerate());
    let results = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().unwrap().next();
                    let Some((number, item)) = next else { break };
                    let result = work(item);
                    results.lock().unwrap().push((number, result));
                }
            });
        }
    });
    let mut results = results.into_inner().unwrap();
    results.sort_by_key(|&(number, _)| number);
    results.into_iter().map(|(_, result)| result).collect()
}

/// What `vuris verify` drives the core with, and a set with codes that the stream's bytes can carry and the converter
/// cannot make: whatever their low bits are, they count as full scale.
pub fn everything(pipeline: &Pipeline, seed: u64) -> Scenario {
    let mut scenario = standard(pipeline, seed);
    let raw = random_sets(pipeline, seed + 100, 1);
    let largest = (1_u32 << pipeline.sensor.adc_bits.next_multiple_of(8)) - 1;
    let beyond =
        raw.codes().iter().enumerate().map(|(n, &code)| if n % 5 == 0 { largest - code } else { code });
    let raw = RawSets::new(raw.geometry(), raw.frames_per_set(), beyond.collect()).unwrap();
    scenario.segments.push(Segment::of_sets("codes beyond full scale", &raw));
    scenario
}

/// The steps of `scheme` in an order that `seed` gives; ascending for every fourth.
pub fn shuffled(scheme: &Scheme, seed: u64) -> Option<Vec<usize>> {
    let mut order: Vec<usize> = (0..scheme.steps()).collect();
    if !seed.is_multiple_of(4) {
        order.sort_by_key(|&step| (seed ^ (step as u64 + 1)).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    }
    normalised_order(scheme, order)
}

/// Name, step angles, weights of in-phase and quadrature sum for I_n = A cos(angle_n - phi) + B, and the irrational.
type PublishedRow = (&'static str, &'static str, &'static [i64], &'static [i64], Irrational);

/// Rows of published algorithms that are not built in.
pub const ROWS: [PublishedRow; 5] = [
    // tan phi = 2 (I4 - I2) / (2 I3 - I1 - I5) with the phase at the middle frame.
    ("hariharan", "-1/2 -1/4 0 1/4 1/2", &[-1, 0, 2, 0, -1], &[0, -2, 0, 2, 0], Irrational::One),
    ("schmit-creath", "-1/2 -1/4 0 1/4 1/2", &[-1, -2, 6, -2, -1], &[1, -4, 0, 4, -1], Irrational::One),
    (
        "de-groot",
        "-3/4 -1/2 -1/4 0 1/4 1/2 3/4",
        &[0, -4, 0, 8, 0, -4, 0],
        &[1, 0, -7, 0, 7, 0, -1],
        Irrational::One,
    ),
    // N + 1 frames with N = 3 and 4 (Surrel 1993): half of the first and of the last, and a cotangent.
    ("three-plus-one", "0 1/3 2/3 1", &[3, -3, -3, 3], &[1, 3, -3, -1], Irrational::Sqrt3),
    ("four-plus-one", "0 1/4 1/2 3/4 1", &[1, 0, -2, 0, 1], &[0, 2, 0, -2, 0], Irrational::One),
];

/// The scheme of a row of [`ROWS`], all its weights times `factor`.
pub fn row(number: usize, factor: i64) -> Scheme {
    let (name, angles, in_phase, quadrature, irrational) = ROWS[number];
    let times = |weights: &[i64]| weights.iter().map(|weight| weight * factor).collect();
    let row = Row {
        name: name.to_owned(),
        angles: angles.split(' ').map(|angle| StepAngle::parse(angle).unwrap()).collect(),
        in_phase: times(in_phase),
        quadrature: times(quadrature),
        offset: None,
        irrational,
        reference: "test".to_owned(),
    };
    Scheme::of_row("test", row).unwrap()
}

/// Schemes of every kind: named, DFTs, rows with small weights and with wide ones.
fn schemes() -> impl Strategy<Value = Scheme> {
    prop_oneof![
        (0..SCHEMES.len()).prop_map(|number| SCHEMES[number].clone()),
        (3..=9_usize, 4..=18_u32).prop_map(|(frames, bits)| Scheme::dft(frames, bits).unwrap()),
        (0..ROWS.len(), 1..=40_i64).prop_map(|(number, factor)| row(number, factor)),
    ]
}

/// CORDICs of every architecture.
fn cordics() -> impl Strategy<Value = Cordic> {
    // Every fourth one iteration a clock, the others a vector every few clocks.
    let throughput = (0..4_u32, 1..=40_u32).prop_map(|(kind, clocks)| match kind {
        0 => Throughput::OneIterationAClock,
        1 => Throughput::CyclesPerPixel(1),
        _ => Throughput::CyclesPerPixel(clocks),
    });
    (4..=30_u32, 0..=8_u32, 1..=8_u32, throughput, 1..=5_u32, 0..5_u32, any::<bool>()).prop_map(
        |(iterations, vector_guard_bits, angle_guard_bits, throughput, pipeline_every, weak, truncate)| {
            Cordic {
                throughput,
                pipeline_every,
                normalise: weak > 0,
                rounding: if truncate { Rounding::Truncate } else { Rounding::Nearest },
                ..Cordic::new(iterations, vector_guard_bits, angle_guard_bits)
            }
        },
    )
}

/// Angle units without a camera, of every kind that is accepted.
pub fn angle_units() -> impl Strategy<Value = AngleUnit> {
    // Every fourth without a length.
    let words = (2..=40_u32, 2..=40_u32, any::<bool>(), 4..=24_u32, 0..=32_u32, 0..4_u32);
    (words, cordics()).prop_map(|((x_bits, y_bits, three, phase_bits, length_bits, kind), cordic)| {
        let specification = AngleSpecification {
            x_bits,
            y_bits,
            metric: if three { 3 } else { 1 },
            phase_bits,
            length_bits: if kind == 0 { 0 } else { length_bits },
            atan: Atan::Cordic,
            cordic: Cordic {
                iterations: cordic.iterations.min(phase_bits + cordic.vector_guard_bits),
                ..cordic
            },
        };
        AngleUnit::new("any", specification).unwrap()
    })
}

/// Specifications of every kind that the program accepts: all its fields, with small sensors and few frames.
pub fn specifications() -> impl Strategy<Value = Specification> {
    let sensor = (2..=8_usize, 1..=6_usize, 8..=16_u32, 0.0..1.5_f64, 16..=100_u32).prop_map(
        |(width, height, adc_bits, saturation, line_blanking_clocks)| {
            let full_scale_dn = (1_i64 << adc_bits) - 1;
            Sensor {
                width,
                height: height.max(8_usize.div_ceil(width)),
                adc_bits,
                saturation_dn: ((full_scale_dn as f64 * saturation) as i64).clamp(1, full_scale_dn),
                line_blanking_clocks,
            }
        },
    );
    let modulation = (schemes(), 4.0..10.0_f64, 1..=3_usize, any::<u64>(), 2..=24_u32).prop_map(|row| {
        let (scheme, decade, frames_per_step, order, phase_step_bits) = row;
        let order = shuffled(&scheme, order);
        let frequency_hz = 10_f64.powf(decade);
        Modulation { scheme, frequency_hz, frames_per_step, order, phase_step_bits }
    });
    let registers = (any::<bool>(), any::<u32>())
        .prop_map(|(axi4_lite, frequency_factor)| RegisterBlock { axi4_lite, frequency_factor });
    // Bits of the distance, and the least amplitude as a part of the full scale (or none).
    let output = (8..=24_u32, 0..=8_u32, 0..=8_u32, 3.2..31.8_f64, -0.4..0.4_f64, 0..5_u32);
    (sensor, modulation, cordics(), output, registers)
        .prop_map(|(sensor, modulation, cordic, output, registers)| {
            let (
                phase_bits,
                amplitude_fraction_bits,
                offset_fraction_bits,
                distance_bits,
                weakest,
                phase_only,
            ) = output;
            let amplitude = phase_only > 0;
            let most_iterations = phase_bits + cordic.vector_guard_bits;
            let range_m = unambiguous_range_m(modulation.frequency_hz);
            let full_scale_dn = f64::from(sensor.adc_bits).exp2();
            Specification {
                unwrapping: None,
                name: "any".to_owned(),
                sensor,
                cordic: Cordic { iterations: cordic.iterations.min(most_iterations), ..cordic },
                output: Output {
                    phase_bits,
                    amplitude,
                    amplitude_fraction_bits,
                    offset_fraction_bits,
                    distance_unit_m: range_m / distance_bits.exp2(),
                    multipliers: if phase_bits % 2 == 0 { Multipliers::Dsp } else { Multipliers::ShiftAdd },
                    minimum_amplitude_dn: if amplitude { weakest.max(0.0) * full_scale_dn } else { 0.0 },
                },
                modulation,
                registers,
            }
        })
        .prop_filter("it is accepted", |specification| Pipeline::new("any", specification.clone()).is_ok())
}

/// The same `count` of what `strategy` gives, on every machine, for tools that need no other each time.
fn drawn<S: Strategy>(strategy: S, count: usize) -> Vec<S::Value> {
    let mut runner = TestRunner::deterministic();
    (0..count).map(|_| strategy.new_tree(&mut runner).unwrap().current()).collect()
}

/// `count` specifications of every kind.
pub fn accepted(count: usize) -> Vec<Pipeline> {
    let specifications = drawn(specifications(), count).into_iter();
    specifications.map(|specification| Pipeline::new("any", specification).unwrap()).collect()
}

/// `count` angle units of every kind.
pub fn accepted_units(count: usize) -> Vec<AngleUnit> {
    drawn(angle_units(), count)
}
