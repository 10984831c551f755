//! How samples see a line: from one to the next it may have gone through any number of whole cycles.

use super::periodogram::Sum;
use std::collections::BTreeMap;

/// Gaps that differ by less are the same, s.
const SAME_GAP_S: f64 = 1e-7;

/// From a sample to the next, s, and how often.
pub fn gaps(group: &[(f64, Sum)]) -> Vec<(f64, f64)> {
    let mut counts = BTreeMap::<i64, f64>::new();
    for pair in group.windows(2) {
        *counts.entry(((pair[1].0 - pair[0].0) / SAME_GAP_S).round() as i64).or_default() += 1.0;
    }
    counts.into_iter().map(|(gap, count)| (gap as f64 * SAME_GAP_S, count)).collect()
}

/// Cycles that samples with these `gaps` see of a line of this frequency, Hz, all added up.
pub fn seen_cycles(gaps: &[(f64, f64)], frequency: f64) -> f64 {
    let of = |&(gap, count): &(f64, f64)| {
        let turns = gap * frequency;
        count * (turns - turns.round()).abs()
    };
    gaps.iter().map(of).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_see_what_is_left_of_whole_cycles() {
        // Ten sets of four frames 20 ms apart, from a set to the next 195 ms.
        let at = |n: usize| 0.02 * (n % 4) as f64 + 0.255 * (n / 4) as f64;
        let group: Vec<(f64, Sum)> = (0..40).map(|n| (at(n), (0.0, 1.0))).collect();
        let gaps = gaps(&group);
        assert_eq!(gaps.iter().map(|gap| gap.1).collect::<Vec<_>>(), [30.0, 9.0]);
        // Of 100 Hz half a cycle from set to set; of 50.5 Hz a hundredth and 0.1525 of one.
        assert!((seen_cycles(&gaps, 100.0) - 4.5).abs() < 1e-4);
        assert!((seen_cycles(&gaps, 50.5) - (30.0 * 0.01 + 9.0 * 0.1525)).abs() < 1e-4);
        assert_eq!(seen_cycles(&gaps, 0.0), 0.0);
    }
}
