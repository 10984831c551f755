//! The short forms of `make prove`, `make mutate` and `make coverage`, and that each can fail.

use std::process::Output;
use vuris::cosim::random_sets;
use vuris::hdl::{Scenario, Segment};
use vuris::proof::coverage::{self, Kind};
use vuris::proof::mutation::{self, Campaign, Tally};
use vuris::proof::small;
use vuris::spec::Pipeline;

fn vuris(arguments: &[&str]) -> (String, bool) {
    let Output { stdout, stderr, status } =
        assert_cmd::cargo::cargo_bin_cmd!("vuris").args(arguments).output().unwrap();
    let said = [stdout, stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    (said, status.success())
}

/// Properties for ever, a comparison of two architectures, covers, and faults that must be seen.
#[test]
fn the_quick_proofs_hold_and_fail_where_a_fault_is() {
    for (proof, faults) in [("stream", 5), ("sums-0", 0), ("folded", 2)] {
        let (said, success) = vuris(&["prove", "--spec", "vuris", "--proof", proof]);
        assert!(success, "{said}");
        assert!(said.contains("holds:") && said.contains("reached in clock"), "{said}");
        assert!(!said.contains("FAILS") && !said.contains("MISSED"), "{said}");
        assert_eq!(said.matches("seen: ").count(), faults, "{said}");
    }
}

/// One set, and nothing broken: what no bench should be content with.
fn one_set(pipeline: &Pipeline) -> Scenario {
    Scenario { segments: vec![Segment::of_sets("one set", &random_sets(pipeline, 1, 1))] }
}

/// The command fails with 98 % of the faults killed, or fewer.
#[test]
fn a_few_mutants_of_each_module_are_killed() {
    let (said, success) = vuris(&["mutate", "--spec", "vuris", "--per-module", "2", "--seed", "1"]);
    assert!(success, "{said}");
    assert!(said.contains("| **all** | 24 |"), "{said}");
}

#[test]
fn a_bench_with_one_set_lets_mutants_live() {
    let campaign = Campaign { per_module: 2, seed: 1, prove: false };
    let trials = mutation::run(&Pipeline::named("vuris").unwrap(), campaign, &one_set, &|_, _| {}).unwrap();
    let tally = Tally::of(&trials);
    println!("{tally:?}");
    assert!(tally.mutants == 24 && tally.killed > 0 && tally.killed_percent() < 90.0, "{tally:?}");
}

/// The command fails with 98 % of lines or bits, or fewer.
#[test]
fn lines_run_and_bits_move() {
    let (said, success) = vuris(&["coverage", "--spec", "vuris"]);
    assert!(success, "{said}");
}

#[test]
fn one_set_leaves_lines_and_bits_out() {
    let pipeline = small(&Pipeline::named("vuris").unwrap()).unwrap();
    let points = coverage::measure(&pipeline, &one_set(&pipeline)).unwrap();
    let [lines, bits] = [Kind::Line, Kind::Toggle].map(|kind| coverage::share(&points, kind).percent());
    println!("{lines:.1} % of lines, {bits:.1} % of bits");
    assert!(lines < 98.0 && bits < 98.0, "{lines:.1} % of lines, {bits:.1} % of bits");
}
