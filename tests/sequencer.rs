//! The order of the phase steps: what the modulation hardware is told, by hand; and that the order changes nothing but the order.
//!
//! Chain of trust: `accuracy.rs` shows that ascending frames give the right phase; here, that permuted frames under a permuted
//! specification give the same; `cosim.rs` draws orders at random for the hardware; `faults.rs` shows that its benches see a wrong one.

mod support;

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use support::{shuffled, small, specifications};
use vuris::cosim::{Simulator, Traffic, faulty_stream, random_sets, simulate};
use vuris::frames::RawSets;
use vuris::hdl::{Golden, Scenario, Segment, Source};
use vuris::model::StreamEvent;
use vuris::reference::reference_images;
use vuris::spec::{Pipeline, normalised_order};

/// `raw`, which has the steps of `pipeline`'s scheme in ascending order, with the frames of each set as `order` has the steps.
fn taken_in(order: &[usize], pipeline: &Pipeline, raw: &RawSets) -> RawSets {
    let frames_per_step = pipeline.modulation.frames_per_step;
    let mut codes = Vec::new();
    for set in 0..raw.sets() {
        for &step in order {
            for repeat in 0..frames_per_step {
                codes.extend_from_slice(raw.frame(set, step * frames_per_step + repeat));
            }
        }
    }
    RawSets::new(raw.geometry(), raw.frames_per_set(), codes).unwrap()
}

fn golden(pipeline: &Pipeline, raw: &RawSets) -> Golden {
    Golden::new(pipeline, &Scenario { segments: vec![Segment::of_sets("sets", raw)] })
}

/// The records of the whole model, and the float reference, do not depend on the order in which the steps were taken.
#[test]
fn frames_in_any_order_of_their_steps_give_the_same_results() {
    let tried = std::cell::Cell::new([0; 2]);
    let cases = 300;
    TestRunner::new(Config { cases, failure_persistence: None, ..Config::default() })
        .run(&(specifications(), any::<u64>()), |(mut specification, seed)| {
            specification.modulation.order = None;
            let ascending = Pipeline::new("any", specification.clone()).unwrap();
            specification.modulation.order = shuffled(&ascending.modulation.scheme, seed);
            let permuted = Pipeline::new("any", specification).unwrap();
            let raw = random_sets(&ascending, seed, 2);
            let order = permuted.modulation.steps_in_order();
            let reordered = taken_in(&order, &ascending, &raw);
            prop_assert_eq!(golden(&permuted, &reordered).records, golden(&ascending, &raw).records);
            let (floats, same) = (
                reference_images(&ascending, &raw).unwrap(),
                reference_images(&permuted, &reordered).unwrap(),
            );
            prop_assert_eq!(&floats.saturated, &same.saturated);
            for (a, b) in floats.amplitude_dn.iter().zip(&same.amplitude_dn) {
                prop_assert!((a - b).abs() < 1e-9 * (1.0 + a), "{} and {}", a, b);
            }
            // Frames in an order that is not theirs are something else, so that the above says something.
            let is_ascending = permuted.modulation.order.is_none();
            let mixed_up = golden(&ascending, &reordered).records != golden(&ascending, &raw).records;
            prop_assert_eq!(mixed_up, !is_ascending);
            let mut counts = tried.get();
            counts[usize::from(is_ascending)] += 1;
            tried.set(counts);
            Ok(())
        })
        .unwrap();
    let [permuted, ascending] = tried.get();
    println!("{permuted} permuted orders, {ascending} ascending ones");
    assert!(permuted > 100);
}

/// What is told, as (step, phase, first).
fn told(golden: &Golden) -> Vec<(usize, i64, bool)> {
    golden.announcements.iter().map(|next| (next.step, next.phase, next.first)).collect()
}

/// Two frames a step, the order 0 3 1 4 2 of steps of a third of a turn, 8 bits: 85.33 and 170.67 codes. When a frame begins, the one
/// after it is told: by hand.
#[test]
fn the_sequencer_tells_the_next_frame_of_the_specified_order() {
    let pipeline = small("vuris", |specification| {
        specification.modulation.order = Some(vec![0, 3, 1, 4, 2]);
        specification.modulation.frames_per_step = 2;
        specification.modulation.phase_step_bits = 8;
    });
    let (a, b) = (85, 171);
    let set = [
        (0, 0, false),
        (3, 0, false),
        (3, 0, false),
        (1, a, false),
        (1, a, false),
        (4, a, false),
        (4, a, false),
        (2, b, false),
        (2, b, false),
        (0, 0, true),
    ];
    let golden = golden(&pipeline, &random_sets(&pipeline, 1, 2));
    assert_eq!(told(&golden), [set, set].concat());
}

/// Whatever breaks a set, what is told at the end of it calls for a set's first frame, unless the set is only broken by the next
/// start; then it calls for the frame that is missing.
#[test]
fn a_lost_set_calls_for_the_first_frame_of_another() {
    let pipeline = small("vuris-four-frame", |specification| {
        specification.modulation.order = Some(vec![3, 1, 0, 2]);
    });
    let first = (3, 3 << 14, true);
    let mut checked = 0;
    for segment in faulty_stream(&pipeline, 1) {
        let rest = Segment { name: "rest".to_owned(), events: vec![StreamEvent::Rest] };
        let good = Segment::of_sets("good", &random_sets(&pipeline, 2, 1));
        let name = segment.name.clone();
        let golden = Golden::new(&pipeline, &Scenario { segments: vec![good, rest, segment] });
        let expected = if name == "last frame missing" { (2, 2 << 14, false) } else { first };
        assert_eq!(told(&golden).last(), Some(&expected), "{name}");
        checked += 1;
    }
    println!("{checked} broken and good sets");
}

/// The same frames, taken in every order of four steps, through the hardware.
#[test]
fn every_order_of_four_steps_agrees_in_verilator() {
    let ascending = small("vuris-four-frame", |specification| {
        (specification.sensor.width, specification.sensor.height) = (4, 2);
    });
    let raw = random_sets(&ascending, 5, 2);
    let expected = golden(&ascending, &raw).records;
    let mut orders: Vec<Vec<usize>> = vec![vec![]];
    for _ in 0..4 {
        let longer = |order: &Vec<usize>| {
            let left = (0..4).filter(|step| !order.contains(step)).collect::<Vec<_>>();
            left.into_iter().map(|step| [order.as_slice(), &[step]].concat()).collect::<Vec<_>>()
        };
        orders = orders.iter().flat_map(longer).collect();
    }
    assert_eq!(orders.len(), 24);
    // Building takes most of the time: every fifth order, which begins with each step at least once.
    let built: Vec<Vec<usize>> = orders.into_iter().step_by(5).collect();
    support::two_at_a_time(&built, |order| {
        let pipeline = small("vuris-four-frame", |specification| {
            (specification.sensor.width, specification.sensor.height) = (4, 2);
            specification.modulation.order =
                normalised_order(&specification.modulation.scheme, order.clone());
        });
        let golden = golden(&pipeline, &taken_in(order, &ascending, &raw));
        assert_eq!(golden.records, expected, "{order:?}");
        let folder = tempfile::tempdir().unwrap();
        let source = Source { pipeline: &pipeline, spec: "test" };
        let outcome =
            simulate(&source, &golden, Simulator::Verilator, Traffic::default(), folder.path(), &|_| {})
                .unwrap();
        assert_eq!(outcome.mismatches, 0, "{order:?}: {:?}", outcome.findings);
        println!("{order:?}: {} values", outcome.values);
    });
}
