//! The short form of `make prove`: the same command on the quick ones of its proofs.

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
