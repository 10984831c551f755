//! Sets and frames that are far off: a few of them are no effect, and what most of them do is one.

use super::periodogram::Sum;

/// So many, and this share besides, may be outliers; of a normal distribution all but this share are within so many standard deviations.
const FEW_OUTLIERS: (usize, f64) = (6, 0.04);
const WITHIN: f64 = 2.05;

/// A set or frame that is off by more than four times the noise, or what is usual among all but a few, counts as four: a few outliers are no effect.
pub fn tamed(few: &[(usize, Sum)]) -> Vec<(usize, Sum)> {
    let seen = few.iter().filter(|(_, (_, information))| *information > 0.0);
    let mut sizes: Vec<f64> =
        seen.clone().map(|(_, (score, information))| score.abs() / information.sqrt()).collect();
    sizes.sort_by(f64::total_cmp);
    let outliers = FEW_OUTLIERS.0.max((FEW_OUTLIERS.1 * sizes.len() as f64).ceil() as usize);
    let most = sizes.len().checked_sub(outliers + 1).map(|place| sizes[place]);
    let usual = most.map_or(1.0, |most| (most / WITHIN).max(1.0));
    let tame = |&(take, (score, information)): &(usize, Sum)| {
        let most = 4.0 * usual * information.sqrt();
        (take, (score.clamp(-most, most), information))
    };
    seen.map(tame).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_outliers_count_as_four_and_what_all_do_stays() {
        let greatest = |far: &dyn Fn(usize) -> bool, count: usize| {
            let few = (0..count).map(|n| (0, (if far(n) { 30.0 } else { 3.0 }, 9.0)));
            tamed(&few.collect::<Vec<_>>()).iter().map(|(_, (score, _))| score / 3.0).fold(0.0, f64::max)
        };
        for count in [5, 12, 25, 72, 400] {
            assert!(greatest(&|n| n % 24 == 3 && n < 96, count) < 4.01, "{count}");
        }
        assert!(greatest(&|_| true, 400) > 9.99);
    }
}
