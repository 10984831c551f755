//! What no comparison of values shows: which silence ends a set, how long samples wait while the last set drains, and that any
//! name makes a core.
//!
//! Figures are worked out by hand; the checks of speed are shown to fail on cores that are right but slow.

mod support;

use support::small;
use vuris::artifact::Artifact;
use vuris::cosim::{Outcome, Simulator, Traffic, random_sets, silences, simulate};
use vuris::hdl::{Golden, Scenario, Segment, Source};
use vuris::model::turn;
use vuris::spec::{PRESETS, Pipeline};

const STRAIGHT: Traffic = Traffic { seed: 1, pause_percent: 0, stop_percent: 0 };

fn run(
    pipeline: &Pipeline,
    segments: Vec<Segment>,
    simulator: Simulator,
    fault: &dyn Fn(&mut Vec<Artifact>),
) -> Outcome {
    let folder = tempfile::tempdir().unwrap();
    let golden = Golden::new(pipeline, &Scenario { segments });
    let source = Source { pipeline, spec: "test" };
    simulate(&source, &golden, simulator, STRAIGHT, folder.path(), fault).unwrap()
}

/// Pauses within a set change nothing; after its last pixel the longest pause of a frame still belongs to it, so that a line
/// that follows spoils the set; one clock more and the line is nobody's, and counts as another set.
#[test]
fn only_a_silence_longer_than_the_longest_pause_ends_a_set() {
    for preset in PRESETS {
        let pipeline = small(preset.name, |_| {});
        let segments = silences(&pipeline, 1);
        for (segment, (name, counters)) in segments.iter().zip([
            ("silences within a set", (1, 0)),
            ("surplus line after the longest pause", (0, 1)),
            ("surplus line after a silence", (1, 1)),
            ("good set after silences", (1, 0)),
        ]) {
            assert_eq!(segment.name, name);
            let golden = Golden::new(&pipeline, &Scenario { segments: vec![segment.clone()] });
            assert_eq!(golden.counters, counters, "{name}");
        }
        for simulator in Simulator::ALL {
            let outcome = run(&pipeline, segments.clone(), simulator, &|_| {});
            assert_eq!(outcome.mismatches, 0, "{:?}", outcome.findings);
            println!("{}, {}: {} values", preset.name, simulator.name(), outcome.values);
        }
    }
}

/// Sets that follow each other at once.
fn four_sets(pipeline: &Pipeline) -> Vec<Segment> {
    vec![Segment::of_sets("four sets", &random_sets(pipeline, 1, 4))]
}

/// Clocks in which a sample had to wait at the three changes between them.
fn stalled_clocks(pipeline: &Pipeline, slow: Option<(&str, &str)>) -> u64 {
    let outcome = run(pipeline, four_sets(pipeline), Simulator::Verilator, &|artifacts| {
        let Some((text, instead)) = slow else { return };
        let framing = artifacts.iter_mut().find(|artifact| artifact.path.ends_with("_framing.v")).unwrap();
        assert_eq!(framing.text.matches(text).count(), 1, "{text}");
        framing.text = framing.text.replace(text, instead);
    });
    // At each of the three changes the bench itself says that a slow core holds samples without need.
    assert_eq!(outcome.mismatches, if slow.is_some() { 3 } else { 0 }, "{:?}", outcome.findings);
    outcome.stalled_clocks
}

/// Right, but slow: the next set waits for the whole drain.
const WAITS: Option<(&str, &str)> = Some(("behind = first_frame &&", "behind = 1'b0 &&"));

/// At each change one clock commits the set and one reads the drain's first pixel. Everything else moves: a drain of 108 pixels
/// beside a frame of 108 costs nothing. A core that waits does so for the commit, 108 reads and the drain's end.
#[test]
fn with_a_pixel_a_clock_a_sample_a_clock_is_taken_while_the_last_set_drains() {
    let pipeline = small("vuris-fast", |_| {});
    assert_eq!(stalled_clocks(&pipeline, None), 3 * 2);
    assert_eq!(stalled_clocks(&pipeline, WAITS), 3 * (1 + 108 + 1));
}

/// One iteration a clock is a pixel every 21 clocks, and the next set's first frame stays behind the drain. It is committed in
/// clock 0; the first sums are taken in clock 3, their vector starts to turn in clock 4 or as many later as it needs places, and
/// every other 21 clocks after the one before. The sums of pixel k are taken when pixel k - 1 starts; when those of pixel 105
/// are, pixel 107 has been read, and with those of pixel 106 the drain ends, so that the second frame begins in the next clock,
/// instead of clock 108. Of the frame before, 108 samples have come meanwhile, which a core that waits takes only then.
#[test]
fn with_one_iteration_a_clock_a_first_frame_follows_the_drain() {
    for preset in ["vuris", "vuris-four-frame"] {
        let pipeline = small(preset, |_| {});
        let golden = Golden::new(&pipeline, &Scenario { segments: four_sets(&pipeline) });
        let places: u64 = (0..3)
            .map(|set| {
                let sums = golden.records[set * 108].sums;
                let shift = turn(&pipeline.derived().angle, sums.in_phase, sums.quadrature).shift;
                u64::from(shift)
            })
            .sum();
        println!("{preset}: {places} places");
        let stalled = 3 * (4 + 105 * 21 + 1 - 108) + places;
        assert_eq!(stalled_clocks(&pipeline, None), stalled, "{preset}");
        assert_eq!(stalled_clocks(&pipeline, WAITS), stalled + 3 * 108, "{preset}");
    }
}

/// Words of Verilog and the benches' own names: no module of that very name is made.
#[test]
fn a_specification_may_have_any_name() {
    for name in ["module", "logic", "testbench", "bench-taps"] {
        let pipeline = small("vuris", |specification| specification.name = name.to_owned());
        for simulator in Simulator::ALL {
            let segments = vec![Segment::of_sets(name, &random_sets(&pipeline, 1, 1))];
            let outcome = run(&pipeline, segments, simulator, &|_| {});
            assert_eq!(outcome.mismatches, 0, "{:?}", outcome.findings);
        }
    }
}
