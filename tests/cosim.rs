//! Does the Verilog do what the model says? Bit by bit, at every stage, in both simulators, for specifications of every
//! kind, under every traffic; and does the model's framing do what a person says?
//!
//! Chain of trust: `accuracy.rs` shows that the model's numbers are right; here the Verilog is compared with them, and the
//! framing and the clocks with figures that are worked out by hand; `faults.rs` shows that the comparison can fail.

mod support;

use proptest::test_runner::{Config, TestRunner};
use support::{everything, small, specifications, two_at_a_time};
use vuris::cosim::{Outcome, Simulation, Simulator, Traffic};
use vuris::cosim::{corner_sets, faulty_stream, random_sets, resets};
use vuris::hdl::{Golden, Scenario, Segment, Source};
use vuris::model::StreamEvent;
use vuris::spec::{PRESETS, Pipeline, Specification};

/// No pauses and no stops.
const STRAIGHT: Traffic = Traffic { seed: 1, pause_percent: 0, stop_percent: 0 };

/// Values of one pixel: 4 sums, 2 coordinates, 4 of the polar form, the distance, and 8 of the output with its markers.
const VALUES_A_PIXEL: usize = 4 + 2 + 4 + 1 + 8;

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

fn sum(outcomes: &[Vec<Outcome>]) -> u64 {
    outcomes.iter().flatten().map(|outcome| outcome.values).sum()
}

#[test]
fn both_presets_agree_in_both_simulators_under_every_traffic() {
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
        agree(preset, &pipeline, &golden, simulator, &traffics)
    });
    println!("{} values compared", sum(&outcomes));
}

/// Specifications at the ends of what is allowed.
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
            s.output.amplitude_fraction_bits = 8;
            s.output.offset_fraction_bits = 8;
            s.output.distance_unit_m = 1e-7;
        }),
        row("16 bits into a short CORDIC", wdft, |s| {
            s.sensor.adc_bits = 16;
            s.modulation.frames_per_step = 3;
            s.cordic.iterations = 10;
            s.cordic.vector_guard_bits = 0;
            s.output.phase_bits = 12;
        }),
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
    let drop_bits: Vec<u32> =
        extremes.iter().map(|(_, pipeline)| pipeline.derived().angle.drop_bits()).collect();
    // The vector's words before the CORDIC are as wide, wider and narrower: nothing rounded off, 2 bits and more.
    assert!([0, 2].iter().all(|bits| drop_bits.contains(bits)) && drop_bits.iter().any(|&bits| bits > 10));
    let runs: Vec<_> =
        extremes.iter().flat_map(|row| Simulator::ALL.map(|simulator| (row, simulator))).collect();
    let outcomes = two_at_a_time(&runs, |&((name, pipeline), simulator)| {
        let golden = Golden::new(pipeline, &everything(pipeline, 5));
        agree(name, pipeline, &golden, simulator, &Traffic::profiles(5)[..2])
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
fn specifications_of_every_kind_agree() {
    let cases = 12;
    let config = Config { cases, max_shrink_iters: 100, failure_persistence: None, ..Config::default() };
    let strategy = (specifications(), 1..u32::MAX, 0..=70_u32, 0..=70_u32);
    TestRunner::new(config)
        .run(&strategy, |(specification, seed, pause_percent, stop_percent)| {
            let pipeline = Pipeline::new("any", specification).unwrap();
            let golden = Golden::new(&pipeline, &everything(&pipeline, seed.into()));
            let traffic = Traffic { seed, pause_percent, stop_percent };
            agree("any", &pipeline, &golden, Simulator::Icarus, &[traffic]);
            Ok(())
        })
        .unwrap();
}

fn good_set(pipeline: &Pipeline) -> Segment {
    Segment::of_sets("good set", &random_sets(pipeline, 1, 1))
}

/// The clocks of a straight run, by hand. In reset for clocks 1 to 4, offered in 5, in the input's register in 6, the set's
/// first sample is taken in clock 7, its last in clock 6 + samples. Then silence: the first clock beyond the longest pause
/// commits the set. In the next clock the first pixel's sums are read; they stand at the memory's output in the clock
/// after, from which the latency counts.
#[test]
fn the_latency_and_the_silence_that_ends_a_set_are_those_of_the_specification() {
    /// Preset, change of it, samples a set, silence that ends a set, latency.
    type Case = (&'static str, fn(&mut Specification), usize, u64, u64);
    let cases: [Case; 3] = [
        // Scaling 1; magnitudes and swap 2; 12 bits shifted by 8 4 2 1; 20 iterations; phase 2; distance 2; output 1.
        ("vuris-four-frame", |_| {}, 4 * 108, 64, 1 + 2 + 4 + 20 + 2 + 2 + 1),
        // 25 bits shifted by 16 8 4 2 1, and rounded to 23.
        ("vuris", |s| s.sensor.line_blanking_clocks = 16, 5 * 108, 16, 1 + 2 + 5 + 1 + 20 + 2 + 2 + 1),
        (
            "vuris",
            |s| {
                s.sensor.line_blanking_clocks = 1000;
                s.cordic.iterations = 4;
                s.modulation.frames_per_step = 2;
            },
            10 * 108,
            1000,
            1 + 2 + 5 + 1 + 4 + 2 + 2 + 1,
        ),
    ];
    for (preset, change, samples, longest_pause, latency) in cases {
        let pipeline = small(preset, change);
        let golden = Golden::new(&pipeline, &Scenario { segments: vec![good_set(&pipeline)] });
        let outcome = &agree(preset, &pipeline, &golden, Simulator::Verilator, &[STRAIGHT])[0];
        let (sums, output) = (outcome.first_clocks[0], outcome.first_clocks[4]);
        println!("{preset}: sums in clock {sums}, output in clock {output}");
        assert_eq!(sums, 6 + samples as u64 + longest_pause + 1 + 2);
        assert_eq!(output - sums, latency);
        assert_eq!(u64::from(pipeline.derived().latency_clocks), latency);
    }
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
    let pipeline = small("vuris", |_| {});
    let segments = resets(&pipeline, 1);
    // A silence of 8 clocks more than a pause commits with its first; the first sums come out 2 clocks later, and the reset
    // leaves 5: the sums of 5 pixels, and the vectors of 4.
    let at_the_start = 5 * 4 + 4 * 2;
    // Since the first sums came out, half a frame of the next set has been taken, and the reset comes with its last: sums of
    // 53 pixels, vectors a clock, polar forms 31, distances 33 and outputs 34 clocks behind.
    let half_way = 53 * 4 + 52 * 2 + 22 * 4 + 20 + 19 * 8;
    // Each of 5 frames before the reset and after it calls for the next; so does, half way, the first of another set.
    for (first, interrupted) in [(2, at_the_start + 10), (4, half_way + 11)] {
        let pair = segments[first..first + 2].to_vec();
        let name = pair[0].name.clone();
        assert!(name.starts_with("reset while a set drains"), "{name}");
        let golden = Golden::new(&pipeline, &Scenario { segments: pair });
        // Both sets are due: the one before the reset, and the good one after it.
        assert_eq!(golden.epochs.iter().map(|epoch| epoch.records).collect::<Vec<_>>(), [108, 216]);
        for simulator in Simulator::ALL {
            let outcome = &agree(&name, &pipeline, &golden, simulator, &[STRAIGHT])[0];
            assert_eq!(outcome.values as usize, interrupted + 108 * VALUES_A_PIXEL + VALUES_A_REST);
        }
    }
}
