//! The short form of `make mutate`, `make coverage` and `make prove`: the same commands on less.

use std::process::Output;

fn vuris(arguments: &[&str]) -> (String, bool) {
    let Output { stdout, stderr, status } =
        assert_cmd::cargo::cargo_bin_cmd!("vuris").args(arguments).output().unwrap();
    let said = [stdout, stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    (said, status.success())
}

/// Properties for ever, a comparison of two architectures, covers, and faults that must be seen.
#[test]
fn the_quick_proofs_hold_and_fail_where_a_fault_is() {
    for (proof, faults) in [("stream", 5), ("sums-0", 0), ("folded", 1)] {
        let (said, success) = vuris(&["prove", "--spec", "vuris", "--proof", proof]);
        assert!(success, "{said}");
        assert!(said.contains("holds:") && said.contains("reached in clock"), "{said}");
        assert!(!said.contains("FAILS") && !said.contains("MISSED"), "{said}");
        assert_eq!(said.matches("seen: ").count(), faults, "{said}");
    }
}

/// A few mutants of every module. The whole table, and what survives with its reason, is in docs/mutation-vuris.md.
#[test]
fn a_few_mutants_of_every_module_are_killed() {
    let (said, success) = vuris(&["mutate", "--spec", "vuris", "--per-module", "4"]);
    assert!(success, "{said}");
}

#[test]
fn nearly_every_line_runs_and_every_bit_moves() {
    let (said, success) = vuris(&["coverage", "--spec", "vuris"]);
    assert!(success, "{said}");
}
