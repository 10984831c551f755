//! Does the Verilog do what the model says? Bit by bit, at every stage, in both simulators, for specifications of every
//! kind, under traffic of every kind; and does the model's framing do what a person says?
//!
//! Chain of trust: `accuracy.rs` shows that the model's numbers are right; here the Verilog is compared with them, and the
//! framing and the clocks with figures that are worked out by hand; `faults.rs` shows that the comparison can fail.

mod support;

use proptest::test_runner::{Config, TestRunner};
use support::{everything, small, specifications, two_at_a_time};
use vuris::cosim::{Outcome, Simulation, Simulator, Traffic};
use vuris::cosim::{corner_sets, faulty_stream, random_sets, resets};
use vuris::frames::RawSets;
use vuris::hdl::{Golden, Scenario, Segment, Source, channels};
use vuris::model::{StreamEvent, turn};
use vuris::spec::{Architecture, PRESETS, Pipeline, Rounding, Specification, Throughput};

/// No pauses and no stops.
const STRAIGHT: Traffic = Traffic { seed: 1, pause_percent: 0, stop_percent: 0 };

/// Values of one pixel: 4 sums, the phase, 4 results, and 8 of the output with its markers.
const VALUES_A_PIXEL: usize = 4 + 1 + 4 + 8;

/// Values of one rest: three counters.
const VALUES_A_REST: usize = 3;

/// Builds `pipeline` once and runs it with each of `traffics`; requires agreement.
fn agree(
    name: &str,
    pipeline: &Pipeline,
    golden: &Golden,
    simulator: Simulator,
    traffics: &[Traffic],
) -> Vec<Outcome> {
    let folder = tempfile::tempdir().unwrap();
    let source = Source { pipeline, spec: "test" };
    let simulation = Simulation::build(source, golden, simulator, folder.path(), &|_| {}).unwrap();
    let run = |&traffic: &Traffic| {
        let outcome = simulation.run(traffic).unwrap();
        let Traffic { seed, pause_percent, stop_percent } = traffic;
        let (simulator, values, sets) = (simulator.name(), outcome.values, golden.sets.len());
        println!(
            "{name}, {simulator}, seed {seed}, {pause_percent} % pauses, {stop_percent} % stops: {values} values of {sets} sets"
        );
        let findings: Vec<String> = outcome.findings.iter().map(ToString::to_string).collect();
        assert_eq!(outcome.mismatches, 0, "{name}, {traffic:?}: {findings:#?}\n{}", pipeline.to_toml());
        outcome
    };
    traffics.iter().map(run).collect()
}

/// Those of `traffics` that `simulator` runs: Verilator all. Icarus, which takes most of the time, runs the first `few`: it has another bench, and bits that
/// are not known.
fn of_simulator(simulator: Simulator, traffics: &[Traffic], few: usize) -> &[Traffic] {
    match simulator {
        Simulator::Verilator => traffics,
        Simulator::Icarus => &traffics[..few],
    }
}

fn sum(outcomes: &[Vec<Outcome>]) -> u64 {
    outcomes.iter().flatten().map(|outcome| outcome.values).sum()
}

#[test]
fn every_preset_agrees_in_both_simulators_under_traffic_of_every_kind() {
    let runs: Vec<_> =
        PRESETS.iter().flat_map(|preset| Simulator::ALL.map(|simulator| (preset.name, simulator))).collect();
    let outcomes = two_at_a_time(&runs, |&(preset, simulator)| {
        let pipeline = small(preset, |_| {});
        let golden = Golden::new(&pipeline, &everything(&pipeline, 1));
        let mut traffics = Traffic::profiles(2).to_vec();
        traffics.extend([(60, 10), (10, 70)].map(|(pause_percent, stop_percent)| Traffic {
            seed: 3,
            pause_percent,
            stop_percent,
        }));
        agree(preset, &pipeline, &golden, simulator, of_simulator(simulator, &traffics, 4))
    });
    println!("{} values compared", sum(&outcomes));
}

/// 18 bits of a magnitude where the CORDIC has 12.
fn short_words(specification: &mut Specification) {
    specification.sensor.adc_bits = 16;
    specification.modulation.frames_per_step = 3;
    specification.cordic.iterations = 10;
    specification.cordic.vector_guard_bits = 0;
    specification.output.phase_bits = 12;
}

/// Specifications at the ends of what is allowed, and of all hardware that a throughput can be met by.
fn extremes() -> Vec<(&'static str, Pipeline)> {
    let (wdft, four_frame) = ("vuris", "vuris-four-frame");
    let row = |name, preset, change: fn(&mut Specification)| (name, small(preset, change));
    vec![
        row("width 2", wdft, |s| (s.sensor.width, s.sensor.height) = (2, 4)),
        row("height 1", four_frame, |s| (s.sensor.width, s.sensor.height) = (8, 1)),
        row("a power of two of pixels", wdft, |s| (s.sensor.width, s.sensor.height) = (8, 4)),
        row("a pixel more", four_frame, |s| (s.sensor.width, s.sensor.height) = (11, 3)),
        row("8 bits, few of everything", four_frame, |s| {
            s.sensor.adc_bits = 8;
            s.sensor.line_blanking_clocks = 16;
            s.cordic.iterations = 4;
            s.cordic.vector_guard_bits = 0;
            s.cordic.angle_guard_bits = 1;
            s.output.phase_bits = 8;
            s.output.amplitude_fraction_bits = 0;
            s.output.offset_fraction_bits = 0;
            s.output.distance_unit_m = 0.1;
        }),
        row("16 bits, many of everything", wdft, |s| {
            s.sensor.adc_bits = 16;
            s.cordic.iterations = 30;
            s.cordic.vector_guard_bits = 8;
            s.cordic.angle_guard_bits = 8;
            s.output.phase_bits = 24;
            s.output.amplitude_fraction_bits = 6;
            s.output.offset_fraction_bits = 8;
            s.output.distance_unit_m = 1e-7;
        }),
        row("16 bits into a short CORDIC", wdft, short_words),
        row("16 bits into a short ring", wdft, |s| {
            short_words(s);
            s.cordic.throughput = Throughput::CyclesPerPixel(4);
            s.cordic.rounding = Rounding::Truncate;
        }),
        row("16 bits into a short unrolled CORDIC", "vuris-fast", short_words),
        row("16 bits into a short unrolled CORDIC, phase only", four_frame, |s| {
            short_words(s);
            s.cordic.throughput = Throughput::CyclesPerPixel(1);
            s.output.amplitude = false;
        }),
        row("16 bits, unrolled, many of everything", "vuris-fast", |s| {
            s.sensor.adc_bits = 16;
            s.cordic.iterations = 30;
            s.cordic.vector_guard_bits = 8;
            s.cordic.angle_guard_bits = 8;
            s.output.phase_bits = 24;
            s.output.amplitude_fraction_bits = 6;
        }),
        row("a register every 2 moves", "vuris-fast", |s| s.cordic.pipeline_every = 2),
        row("a register every 5 moves, phase only, cut off", four_frame, |s| {
            s.cordic.throughput = Throughput::CyclesPerPixel(1);
            s.cordic.pipeline_every = 5;
            s.cordic.rounding = Rounding::Truncate;
            s.output.amplitude = false;
        }),
        row("no register but the last, not normalised", four_frame, |s| {
            s.cordic.throughput = Throughput::CyclesPerPixel(1);
            s.cordic.pipeline_every = 30;
            s.cordic.normalise = false;
        }),
        row("unrolled, phase only", "vuris-fast", |s| s.output.amplitude = false),
        row("a pixel every 2 clocks", four_frame, |s| {
            s.cordic.throughput = Throughput::CyclesPerPixel(2);
        }),
        row("a pixel every 3 clocks, cut off", wdft, |s| {
            s.cordic.throughput = Throughput::CyclesPerPixel(3);
            s.cordic.rounding = Rounding::Truncate;
        }),
        row("a pixel every 4 clocks, not normalised", four_frame, |s| {
            s.cordic.throughput = Throughput::CyclesPerPixel(4);
            s.cordic.normalise = false;
        }),
        row("a pixel every 8 clocks, phase only", wdft, |s| {
            s.cordic.throughput = Throughput::CyclesPerPixel(8);
            s.output.amplitude = false;
        }),
        row("a ring of one stage", wdft, |s| {
            s.cordic.iterations = 12;
            s.cordic.throughput = Throughput::CyclesPerPixel(13);
        }),
        row("one iteration a clock, phase only, not normalised", four_frame, |s| {
            s.cordic.normalise = false;
            s.output.amplitude = false;
        }),
        row("one iteration a clock, cut off", wdft, |s| s.cordic.rounding = Rounding::Truncate),
        row("saturation and least amplitude", four_frame, |s| {
            s.sensor.saturation_dn = 3000;
            s.output.minimum_amplitude_dn = 700.0;
        }),
        row("saturation at 1", wdft, |s| s.sensor.saturation_dn = 1),
    ]
}

#[test]
fn specifications_at_the_ends_of_what_is_allowed_agree_in_both_simulators() {
    let extremes = extremes();
    // Every architecture has words before it that are narrower, wider and much wider than its own, for both metrics.
    let units = || extremes.iter().map(|(_, pipeline)| &pipeline.derived().angle);
    for kind in [
        |architecture| architecture == Architecture::Unrolled,
        |architecture| matches!(architecture, Architecture::Folded { .. }),
        |architecture| architecture == Architecture::Iterative,
    ] {
        let units = || units().filter(|unit| kind(unit.architecture));
        assert!([1, 3].iter().all(|&metric| units().any(|unit| unit.metric == metric)));
        assert!(units().any(|unit| unit.pad_bits() > 0) && units().any(|unit| unit.drop_bits() > 5));
        assert!([false, true].iter().all(|&length| units().any(|unit| unit.with_length() == length)));
        assert!([false, true].iter().all(|&normalise| units().any(|u| u.cordic.normalise == normalise)));
        assert!(units().any(|unit| unit.cordic.rounding == Rounding::Truncate));
    }
    for rounds in [2, 3, 4, 7, 12] {
        let has =
            |architecture| matches!(architecture, Architecture::Folded { rounds: r, .. } if r == rounds);
        assert!(units().any(|unit| has(unit.architecture)), "{rounds} rounds");
    }
    let rows = extremes.iter().enumerate();
    let runs: Vec<_> = rows.flat_map(|row| Simulator::ALL.map(|simulator| (row, simulator))).collect();
    let outcomes = two_at_a_time(&runs, |&((number, (name, pipeline)), simulator)| {
        let golden = Golden::new(pipeline, &everything(pipeline, 5));
        // With pauses and stops, and without: one of them for Icarus, in turn.
        let mut traffics = Traffic::profiles(5)[..2].to_vec();
        traffics.rotate_left(number % 2);
        agree(name, pipeline, &golden, simulator, of_simulator(simulator, &traffics, 1))
    });
    println!("{} values compared", sum(&outcomes));
}

#[test]
fn sets_of_256_frames_a_step_agree_in_both_simulators() {
    for preset in PRESETS {
        let pipeline = small(preset.name, |specification| {
            (specification.sensor.width, specification.sensor.height) = (4, 2);
            specification.sensor.adc_bits = 16;
            specification.modulation.frames_per_step = 256;
        });
        let sets = [("corners", corner_sets(&pipeline)), ("random frames", random_sets(&pipeline, 1, 1))];
        let segments = sets.iter().map(|(name, raw)| Segment::of_sets(name, raw)).collect();
        let golden = Golden::new(&pipeline, &Scenario { segments });
        for simulator in Simulator::ALL {
            let outcomes = agree(preset.name, &pipeline, &golden, simulator, &[Traffic::default()]);
            // Each frame that begins calls for the next.
            let announcements = 9 * 256 * pipeline.modulation.scheme.steps();
            assert_eq!(outcomes[0].values as usize, 9 * 8 * VALUES_A_PIXEL + VALUES_A_REST + announcements);
        }
    }
}

/// Specifications, seeds and traffic drawn at random; a failure is brought down to a simple one.
#[test]
fn specifications_of_every_kind_agree_in_both_simulators() {
    let cases = 20;
    let config = Config { cases, max_shrink_iters: 100, failure_persistence: None, ..Config::default() };
    let strategy = (specifications(), 1..u32::MAX, 0..=70_u32, 0..=70_u32);
    TestRunner::new(config)
        .run(&strategy, |(specification, seed, pause_percent, stop_percent)| {
            let pipeline = Pipeline::new("any", specification).unwrap();
            let golden = Golden::new(&pipeline, &everything(&pipeline, seed.into()));
            let traffic = Traffic { seed, pause_percent, stop_percent };
            let values = Simulator::ALL
                .map(|simulator| agree("any", &pipeline, &golden, simulator, &[traffic])[0].values);
            // Registers are read as often as there is time, which is not the same in both; every pixel's values are.
            let pixels = (golden.records.len() * channels(&pipeline).len()) as u64;
            assert!(values.iter().all(|&values| values >= pixels), "{values:?} of {pixels}");
            Ok(())
        })
        .unwrap();
}

fn good_set(pipeline: &Pipeline) -> Segment {
    Segment::of_sets("good set", &random_sets(pipeline, 1, 1))
}

/// A run of one set in which all pixels see the same, and its clocks.
struct Timing {
    preset: &'static str,
    change: fn(&mut Specification),
    /// Each step's code.
    codes: &'static [u32],
    /// Places by which the vector has to be shifted.
    shift: u32,
    /// Raw codes a set.
    samples: u64,
    /// Silence that ends a set.
    silence: u64,
    /// Clocks from the first pixel's sums to its result.
    latency: u64,
    /// Clocks from the first result to the 108th.
    span: u64,
}

/// A strong vector: 24570 of 15 bits with five frames, 4095 of 12 bits with four.
const STRONG_5: &[u32] = &[4095, 0, 0, 4095, 0];
const STRONG_4: &[u32] = &[4095, 0, 0, 0];

/// By hand. The angle unit's, then amplitude, offset and distance 2 and output 1; a result a clock, or as the comment says.
const TIMINGS: &[Timing] = &[
    // Unrolled. Input 1; 15 bits shifted by 8 4 2 1; 19 iterations, and 3 y for the first 10 (iterations 0 to 9: an amplitude
    // of 16 bits needs the length to 2^-18, so x follows until 3/4^n is below 2^-16: 9); last direction 1; tables
    // for the directions 0-3 4-7 8-11 12-15 16-19 and their 4 adders 5.
    Timing {
        preset: "vuris-fast",
        change: |_| {},
        codes: STRONG_5,
        shift: 0,
        samples: 5 * 108,
        silence: 64,
        latency: 1 + 4 + 29 + 1 + 5 + 3,
        span: 107,
    },
    // A register every 2 moves: 4 and 29 of them take 2 and 15.
    Timing {
        preset: "vuris-fast",
        change: |s| s.cordic.pipeline_every = 2,
        codes: STRONG_5,
        shift: 0,
        samples: 5 * 108,
        silence: 64,
        latency: 1 + 2 + 15 + 1 + 5 + 3,
        span: 107,
    },
    // The same for every vector; every 5 moves: 1 and 6.
    Timing {
        preset: "vuris-fast",
        change: |s| s.cordic.pipeline_every = 5,
        codes: &[2, 0, 0, 0, 0],
        shift: 12,
        samples: 5 * 108,
        silence: 64,
        latency: 1 + 1 + 6 + 1 + 5 + 3,
        span: 107,
    },
    // 12 bits shifted by 8 4 2 1; nothing to triple; the fold's direction is the quarter's: tables for 1-4 5-8 9-12 13-16 17-19.
    Timing {
        preset: "vuris-four-frame",
        change: |s| s.cordic.throughput = Throughput::CyclesPerPixel(1),
        codes: STRONG_4,
        shift: 0,
        samples: 4 * 108,
        silence: 64,
        latency: 1 + 4 + 19 + 1 + 5 + 3,
        span: 107,
    },
    // A ring of 5 stages, 4 rounds, 20 iterations: entry 1. It takes 5 vectors, and 5 again when they have left 20 clocks later:
    // the last is the 3rd of the 22nd five.
    Timing {
        preset: "vuris-four-frame",
        change: |s| s.cordic.throughput = Throughput::CyclesPerPixel(4),
        codes: STRONG_4,
        shift: 0,
        samples: 4 * 108,
        silence: 64,
        latency: 1 + 4 + 1 + 20 + 5 + 3,
        span: 21 * 20 + 2,
    },
    // A ring of 7 stages, 3 rounds, 21 iterations: tables for 0-3 4-7 8-11 12-15 16-19 20-21. The last is the 3rd of the 16th seven.
    Timing {
        preset: "vuris",
        change: |s| {
            s.cordic.throughput = Throughput::CyclesPerPixel(3);
            s.sensor.line_blanking_clocks = 16;
        },
        codes: STRONG_5,
        shift: 0,
        samples: 5 * 108,
        silence: 16,
        latency: 1 + 4 + 1 + 21 + 6 + 3,
        span: 15 * 21 + 2,
    },
    // One iteration a clock: input 1, start 1, iterations 19, last direction 1, result 1. The next starts when the last is done: 19
    // iterations, its last direction, and the clock in which it leaves.
    Timing {
        preset: "vuris",
        change: |_| {},
        codes: STRONG_5,
        shift: 0,
        samples: 5 * 108,
        silence: 64,
        latency: 1 + 1 + 19 + 1 + 1 + 3,
        span: 107 * 21,
    },
    // A weak vector: 4 of 15 bits takes 12 places more, all but the first while the one before is turned.
    Timing {
        preset: "vuris",
        change: |_| {},
        codes: &[2, 0, 0, 0, 0],
        shift: 12,
        samples: 5 * 108,
        silence: 64,
        latency: 12 + 1 + 1 + 19 + 1 + 1 + 3,
        span: 107 * 21,
    },
    // 4 iterations: the shift of 13 places (of 16 bits) is what takes time: the clock in which a vector is taken, 13 places,
    // and the clock in which it starts and the next is taken.
    Timing {
        preset: "vuris",
        change: |s| {
            s.sensor.line_blanking_clocks = 1000;
            s.cordic.iterations = 4;
            s.modulation.frames_per_step = 2;
        },
        codes: &[1, 0, 0, 0, 0],
        shift: 13,
        samples: 10 * 108,
        silence: 1000,
        latency: 13 + 1 + 1 + 4 + 1 + 1 + 3,
        span: 107 * 14,
    },
    // -1 is complemented to 0: all 12 places.
    Timing {
        preset: "vuris-four-frame",
        change: |s| s.cordic.iterations = 4,
        codes: &[0, 0, 1, 0],
        shift: 12,
        samples: 4 * 108,
        silence: 64,
        latency: 12 + 1 + 1 + 4 + 1 + 1 + 3,
        span: 107 * 13,
    },
    // Without a normaliser a weak vector waits for nothing.
    Timing {
        preset: "vuris-four-frame",
        change: |s| s.cordic.normalise = false,
        codes: &[1, 0, 0, 0],
        shift: 0,
        samples: 4 * 108,
        silence: 64,
        latency: 1 + 1 + 19 + 1 + 1 + 3,
        span: 107 * 21,
    },
];

/// The clocks of a straight run, by hand. In reset for clocks 1 to 4, offered in 5, in the input's register in 6, the set's
/// first sample is taken in clock 7, its last in clock 6 + samples. Then silence: the first clock beyond the longest pause
/// commits the set. In the next clock the first pixel's word is read; it stands at the memory's output in the clock
/// after, and its sums in the one after that, from which the latency counts. The bench ends a set's silence and 65 clocks after the last result.
#[test]
fn latency_throughput_and_the_silence_that_ends_a_set_are_those_of_the_specification() {
    two_at_a_time(TIMINGS, |timing| {
        let &Timing { preset, change, codes, shift, samples, silence, latency, span } = timing;
        let pipeline = small(preset, change);
        let frames_per_step = pipeline.modulation.frames_per_step;
        let frames = codes.iter().flat_map(|&code| vec![code; 108 * frames_per_step]).collect();
        let raw = RawSets::new(pipeline.geometry(), codes.len() * frames_per_step, frames).unwrap();
        let golden = Golden::new(&pipeline, &Scenario { segments: vec![Segment::of_sets("set", &raw)] });
        let unit = &pipeline.derived().angle;
        let sums = golden.records[0].sums;
        assert_eq!(turn(unit, sums.in_phase, sums.quadrature).shift, shift);
        let outcome = &agree(preset, &pipeline, &golden, Simulator::Verilator, &[STRAIGHT])[0];
        let (first_sums, first_output) = (outcome.first_clocks[0], outcome.first_clocks[3]);
        println!("{preset}: sums in clock {first_sums}, output in clock {first_output}");
        assert_eq!(first_sums, 6 + samples + silence + 1 + 3);
        assert_eq!(first_output - first_sums, latency, "latency of {}", pipeline.to_toml());
        assert_eq!(outcome.clocks - silence - 65 - first_output, span, "span of {}", pipeline.to_toml());
        // What is derived counts no shift where shifting takes a clock a place.
        let waiting = if unit.architecture == Architecture::Iterative { shift } else { 0 };
        assert_eq!(u64::from(pipeline.derived().latency_clocks + waiting), latency);
        let clocks_a_vector = u64::from(unit.clocks_a_vector(shift));
        // A ring takes and gives in bursts, and the 107 and 1 vectors do not fill the last.
        let ring = matches!(unit.architecture, Architecture::Folded { .. });
        let off = span.abs_diff(107 * clocks_a_vector);
        assert!(
            off <= if ring { u64::from(unit.iterations) } else { 0 },
            "{clocks_a_vector} clocks a vector"
        );
    });
}

/// Name of the broken set, and complete and discarded sets: after a reset, after a set.
type Broken = (&'static str, (u32, u32), (u32, u32));

/// Broken sets, each followed by a good one: complete and discarded sets, by hand, for a core that has just been reset
/// (and knows of no set until one starts) and for one that has just completed another set.
const BROKEN: [Broken; 18] = [
    // Nothing starts: after a reset it is passed over, after a set it is one without its first frame.
    ("stream joined in the middle", (1, 0), (2, 1)),
    ("first frame a line short", (1, 1), (2, 1)),
    ("line a pixel short", (1, 1), (2, 1)),
    ("line a pixel long", (1, 1), (2, 1)),
    ("line without its end", (1, 1), (2, 1)),
    ("start of frame in the middle of a frame", (1, 1), (2, 1)),
    ("start of set without start of frame", (1, 0), (2, 1)),
    ("set that starts with the end of a line", (1, 1), (2, 1)),
    ("end of line missing", (1, 1), (2, 1)),
    ("end of line too early", (1, 1), (2, 1)),
    ("start of frame missing", (1, 1), (2, 1)),
    ("start of frame within one", (1, 1), (2, 1)),
    ("start of set alone within a frame", (1, 1), (2, 1)),
    ("last frame missing", (1, 1), (2, 1)),
    ("first frame missing", (1, 0), (2, 1)),
    ("last frame a pixel short", (1, 1), (2, 1)),
    ("last frame a line long", (1, 1), (2, 1)),
    // The set is complete; the frame that follows starts none.
    ("one frame too many", (2, 1), (3, 1)),
];

#[test]
fn every_broken_set_is_discarded_and_counted_and_the_next_one_comes_out() {
    for preset in PRESETS {
        let pipeline = small(preset.name, |_| {});
        let good = good_set(&pipeline);
        let rest = Segment { name: "rest".to_owned(), events: vec![StreamEvent::Rest] };
        let mut broken = faulty_stream(&pipeline, 1);
        broken.retain(|segment| !segment.name.starts_with("good"));
        assert_eq!(broken.len(), BROKEN.len());
        let mut all = Vec::new();
        for (segment, (name, after_reset, after_a_set)) in broken.into_iter().zip(BROKEN) {
            assert_eq!(segment.name, name);
            let after_good = vec![good.clone(), rest.clone(), segment.clone(), good.clone()];
            for (segments, counters) in
                [(after_good[2..].to_vec(), after_reset), (after_good.clone(), after_a_set)]
            {
                let golden = Golden::new(&pipeline, &Scenario { segments });
                assert_eq!(golden.counters, counters, "{}: {name}", preset.name);
                assert_eq!(golden.sets.len() as u32, counters.0, "{}: {name}", preset.name);
                assert_eq!(golden.records.len() as u32, 108 * counters.0, "{}: {name}", preset.name);
            }
            all.extend(after_good);
        }
        // The hardware's counters are compared at each rest and at the end: 17 times 2 sets come out, and 3.
        let golden = Golden::new(&pipeline, &Scenario { segments: all });
        assert_eq!(golden.counters, (37, 18));
        for simulator in Simulator::ALL {
            let outcomes = agree(preset.name, &pipeline, &golden, simulator, &[Traffic::default()]);
            // Each frame that begins calls for the next: all of the 36 good sets and of 3 broken ones (last frame short, long, and one too
            // many), all but one of that without its last, 2 in the 4 whose fault is within the second, 1 in 6, none in 4. And each
            // of the 18 that are discarded calls for a new set, but for the 2 that a start of set breaks off.
            let frames = pipeline.derived().frames_per_set;
            let begun = 36 * frames + 3 * frames + (frames - 1) + 4 * 2 + 6;
            let values = 37 * 108 * VALUES_A_PIXEL + 19 * VALUES_A_REST + begun + (18 - 2);
            assert_eq!(outcomes[0].values as usize, values);
        }
    }
}

/// A set that starts wrong spoils the one before it where no silence lies between: that one's last frame seems too long.
#[test]
fn a_complete_set_is_only_trusted_once_a_frame_or_silence_follows() {
    let pipeline = small("vuris", |_| {});
    let mut segments = faulty_stream(&pipeline, 1);
    segments.retain(|segment| segment.name == "start of set without start of frame");
    segments.insert(0, good_set(&pipeline));
    segments.push(good_set(&pipeline));
    let golden = Golden::new(&pipeline, &Scenario { segments });
    assert_eq!((golden.counters, golden.sets.len()), ((1, 1), 1));
}

/// What a reset leaves to be compared of the set that it interrupts, by hand.
#[test]
fn a_reset_really_interrupts_the_drain_that_it_means_to_interrupt() {
    let interrupted = |preset: &str, first: usize| {
        let pipeline = small(preset, |_| {});
        let pair = resets(&pipeline, 1)[first..first + 2].to_vec();
        let name = pair[0].name.clone();
        assert!(name.starts_with("reset while a set drains"), "{name}");
        let golden = Golden::new(&pipeline, &Scenario { segments: pair });
        // Both sets are due: the one before the reset, and the good one after it.
        assert_eq!(golden.epochs.iter().map(|epoch| epoch.records).collect::<Vec<_>>(), [108, 216]);
        let shift = |pixel: usize| {
            let sums = golden.records[pixel].sums;
            turn(&pipeline.derived().angle, sums.in_phase, sums.quadrature).shift
        };
        let values = Simulator::ALL.map(|simulator| {
            let outcome = &agree(&name, &pipeline, &golden, simulator, &[STRAIGHT])[0];
            outcome.values as usize - (108 * VALUES_A_PIXEL + VALUES_A_REST)
        });
        assert_eq!(values[0], values[1]);
        (values[0], [0, 1, 2].map(shift))
    };
    // Each of 5 frames before the reset and after it calls for the next; so does, half way, the first of another set.
    let (start, half_way) = (10, 11);
    // A silence of 8 clocks more than a pause commits with its first; the first sums come out 3 clocks later, and the reset
    // leaves 4: the sums of 4 pixels.
    assert_eq!(interrupted("vuris-fast", 2).0, 4 * 4 + start);
    // One iteration a clock: the second pixel's sums are taken when the first one's turn begins, the third's only when it is over.
    let (values, shifts) = interrupted("vuris", 2);
    assert!(shifts[0] <= 2, "the first pixel is shifted by {shifts:?}");
    assert_eq!(values, 2 * 4 + start);
    // The next set's sample k follows the reading of pixel k's sums by a clock, and those come out 2 clocks after they are read.
    // The input's register is two samples ahead of the first; the reset comes with sample 53: sums of 52 pixels, phases 40,
    // results 42 and outputs 43 clocks behind.
    assert_eq!(interrupted("vuris-fast", 4).0, 52 * 4 + 12 + 10 * 4 + 9 * 8 + half_way);
    // One iteration a clock: when a pixel's sums are taken, the one's before it start to turn, and the one's before that leave and
    // are a phase in the next clock. When the sums of pixel 49 are taken, those of pixel 51 are read; a clock later the next
    // set's sample 51 is taken; one more, and the input's register takes sample 53, the last, which the reset follows
    // at once: sums of pixels 0 to 49, phases of 0 to 47, and the results of pixel 47 would come in the next clock.
    assert_eq!(interrupted("vuris", 4).0, 50 * 4 + 48 + 47 * 4 + 47 * 8 + half_way);
}
