//! How samples see a line: from one to the next it may have gone through any number of whole cycles.

use super::periodogram::Sum;

/// Gaps that differ by no more from the next longer one are the same, s: time stamps are rounded.
const SAME_GAP_S: f64 = 2e-3;

/// From a sample to the next, s, on average of those that are the same, and how often.
pub fn gaps(group: &[(f64, Sum)]) -> Vec<(f64, f64)> {
    let mut gaps: Vec<f64> = group.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
    gaps.sort_by(f64::total_cmp);
    let alike = gaps.chunk_by(|a, b| b - a <= SAME_GAP_S);
    alike.map(|gaps| (gaps.iter().sum::<f64>() / gaps.len() as f64, gaps.len() as f64)).collect()
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

    /// Thirty frames a second, by time stamps of whole milliseconds, see 120 Hz at rest.
    #[test]
    fn rounded_times_do_not_move_a_line() {
        let at = |n: usize| (1000.0 * n as f64 / 30.0).round() / 1000.0;
        let group: Vec<(f64, Sum)> = (0..301).map(|n| (at(n), (0.0, 1.0))).collect();
        assert!(seen_cycles(&gaps(&group), 120.0) < 1e-6);
    }
}
