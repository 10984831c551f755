//! The recordings that would tell names from their rivals, in words.

use crate::diagnose::{ENOUGH_RHO, NextRecording};

/// A sentence for each name and rival of these proposals, in their order.
pub fn to_separate(proposals: &[NextRecording]) -> Vec<String> {
    let of_pair = |pair: &[NextRecording]| {
        let by = |next: &NextRecording| {
            format!("{} (expected {:.1} standard deviations)", next.what, next.expected_rho)
        };
        let recordings = match pair.iter().all(|next| next.expected_rho < ENOUGH_RHO) {
            true => "none of the recordings that are known here would be enough".to_owned(),
            false => pair.iter().map(by).collect::<Vec<_>>().join(", or "),
        };
        format!("To separate {}: {recordings}", pair[0].to_separate.join(" from "))
    };
    proposals.chunk_by(|a, b| a.to_separate == b.to_separate).map(of_pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recordings_of_a_pair_stand_together_and_what_is_not_enough_is_not_proposed() {
        let of = |rival: &str, what: &str, expected_rho| NextRecording {
            to_separate: vec!["a".to_owned(), rival.to_owned()],
            what: what.to_owned(),
            expected_rho,
        };
        let all = [of("b", "x", 30.0), of("b", "y", 4.0), of("c", "z", 2.9)];
        assert_eq!(
            to_separate(&all),
            [
                "To separate a from b: x (expected 30.0 standard deviations), or y (expected 4.0 standard deviations)",
                "To separate a from c: none of the recordings that are known here would be enough",
            ]
        );
    }
}
