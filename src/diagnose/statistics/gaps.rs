//! How samples see a line: from one to the next it may have gone through any number of whole cycles.

use super::periodogram::Sum;

/// Gaps that differ by no more from the next longer one are the same, s: time stamps are rounded.
const SAME_GAP_S: f64 = 2e-3;

/// From a sample to the next, s, on average of those that are the same, and how often.
pub type Gap = (f64, f64);

/// Those of a group.
pub fn gaps(group: &[(f64, Sum)]) -> Vec<Gap> {
    let mut gaps: Vec<f64> = group.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
    gaps.sort_by(f64::total_cmp);
    let alike = gaps.chunk_by(|a, b| b - a <= SAME_GAP_S);
    alike.map(|gaps| (gaps.iter().sum::<f64>() / gaps.len() as f64, gaps.len() as f64)).collect()
}

/// A line that goes through less of a cycle within a group of samples that follow each other most closely is at rest there.
const AT_REST: f64 = 0.25;

/// What samples see of so many turns: what is left of whole ones.
fn seen(turns: f64) -> f64 {
    turns - turns.round()
}

/// Cycles by which samples with these `gaps` see a line of this frequency, Hz, go forward (or back: less than 0) within a group.
pub fn forward(gaps: &[Gap], frequency: f64) -> f64 {
    let Some(((within, count), between)) = gaps.split_first() else { return 0.0 };
    let groups = between.iter().map(|(_, count)| count).sum::<f64>() + 1.0;
    count / groups * seen(within * frequency)
}

/// Cycles that samples with these `gaps` see of a line of this frequency, Hz, all added up: within groups of samples that follow each other most closely, and from
/// group to group; of one that is nearly at rest within these, from each sample of a group to that of the next one. (What goes a little forward in each group, and
/// back again, is a drift to all others.)
pub fn seen_cycles(gaps: &[Gap], frequency: f64) -> f64 {
    let Some((_, between)) = gaps.split_first() else { return 0.0 };
    let of_group = forward(gaps, frequency);
    if !between.is_empty() && of_group.abs() < AT_REST {
        return between.iter().map(|(gap, count)| count * seen(gap * frequency + of_group).abs()).sum();
    }
    gaps.iter().map(|(gap, count)| count * seen(gap * frequency).abs()).sum()
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
        // Of 100 Hz half a cycle from set to set; of 55 Hz a tenth and 0.275 of one.
        assert!((seen_cycles(&gaps, 100.0) - 4.5).abs() < 1e-4);
        assert!((seen_cycles(&gaps, 55.0) - (30.0 * 0.1 + 9.0 * 0.275)).abs() < 1e-4);
        // Of 51 Hz two hundredths within a set, which is at rest: from set to set 0.005 of one.
        assert!((seen_cycles(&gaps, 51.0) - 9.0 * 0.005).abs() < 1e-4);
        assert_eq!(seen_cycles(&[], 51.0), 0.0);
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
