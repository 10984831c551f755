//! What no comparison of values shows: which silence ends a set, that a sample is taken every clock while the last set drains, and
//! that any name makes a core.
//!
//! Figures are worked out by hand; the checks of speed are shown to fail on cores that are right but slow.

mod support;

use support::small;
use vuris::artifact::Artifact;
use vuris::cosim::{Outcome, Simulator, Traffic, random_sets, silences, simulate};
use vuris::hdl::{Golden, Scenario, Segment, Source};
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
    let outcome = simulate(&source, &golden, simulator, STRAIGHT, folder.path(), fault).unwrap();
    assert_eq!(outcome.mismatches, 0, "{:?}", outcome.findings);
    outcome
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
            println!("{}, {}: {} values", preset.name, simulator.name(), outcome.values);
        }
    }
}

/// Clocks in which a sample had to wait at the three changes between four sets that follow each other at once.
fn stalled_clocks(pipeline: &Pipeline, slow: Option<(&str, &str)>) -> u64 {
    let segments = vec![Segment::of_sets("four sets", &random_sets(pipeline, 1, 4))];
    run(pipeline, segments, Simulator::Verilator, &|artifacts| {
        let Some((text, instead)) = slow else { return };
        let framing = artifacts.iter_mut().find(|artifact| artifact.path.ends_with("_framing.v")).unwrap();
        assert_eq!(framing.text.matches(text).count(), 1, "{text}");
        framing.text = framing.text.replace(text, instead);
    })
    .stalled_clocks
}

/// At each change one clock commits the set and one reads the drain's first pixel. Everything else moves: a drain of 108 pixels
/// beside a frame of 108 costs nothing.
#[test]
fn a_sample_a_clock_is_taken_while_the_last_set_drains() {
    for preset in PRESETS {
        let pipeline = small(preset.name, |_| {});
        let stalled = stalled_clocks(&pipeline, None);
        println!("{}: {stalled} clocks stalled in 3 changes of set", preset.name);
        assert_eq!(stalled, 3 * 2);
        // Right, but slow: the next set waits for the whole drain.
        let waiting = stalled_clocks(&pipeline, Some(("behind = first_frame &&", "behind = 1'b0 &&")));
        assert!(waiting > 3 * 100, "a core that waits stalls for {waiting} clocks");
    }
}

/// Words of Verilog and the benches' own names: no module of that very name is made.
#[test]
fn a_specification_may_have_any_name() {
    for name in ["module", "logic", "testbench", "bench-taps"] {
        let pipeline = small("vuris", |specification| specification.name = name.to_owned());
        for simulator in Simulator::ALL {
            let segments = vec![Segment::of_sets(name, &random_sets(&pipeline, 1, 1))];
            run(&pipeline, segments, simulator, &|_| {});
        }
    }
}
