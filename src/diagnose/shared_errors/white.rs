//! Whether errors that samples share are white, as noise is: not alike in neighbouring rows, in one frame after the other, in one set after
//! the other. What all rows of a frame have in common is the frame's, and is not asked here.

use std::collections::VecDeque;

/// Lags along a frame: from a row, or column, to another.
const ALONG: [usize; 4] = [1, 2, 4, 8];
/// Lags from frame to frame within a set, and from a set's frame to the same of another.
const AFTER: [usize; 2] = [1, 2];
const LAGS: usize = ALONG.len() + 2 * AFTER.len();

/// Of fewer products nothing is known: z is no more than their number's root.
const LEAST: usize = 60;
/// Frames that there are at least for each error of a frame.
const FRAMES_AN_ERROR: usize = 8;

/// Sums over products of errors.
#[derive(Debug, Clone, Default)]
pub struct White {
    /// Of each lag: products, their squares, and how many there are.
    sums: [(f64, f64, usize); LAGS],
    /// Frames, and the most errors that one has.
    seen: (usize, usize),
    /// The errors of the frames before, the last one first: as many as two sets have.
    before: VecDeque<Vec<f64>>,
}

impl White {
    /// With the `errors` of number `frame` of a set of so many `frames`, in standard deviations; `is_first`: nothing was before.
    pub fn add(&mut self, errors: Vec<f64>, frame: usize, frames: usize, is_first: bool) {
        if is_first {
            self.before.clear();
        }
        self.seen = (self.seen.0 + 1, self.seen.1.max(errors.len()));
        let (errors, taken) = within(errors);
        for (lag, sum) in ALONG.into_iter().zip(&mut self.sums) {
            products(sum, &errors, errors.get(lag..).unwrap_or_default(), taken);
        }
        let of_frames = AFTER.map(|lag| if frame >= lag { lag } else { 0 });
        let of_sets = AFTER.map(|lag| lag * frames);
        for (lag, sum) in of_frames.into_iter().chain(of_sets).zip(&mut self.sums[ALONG.len()..]) {
            let other = lag.checked_sub(1).and_then(|place| self.before.get(place));
            products(sum, &errors, other.map_or(&[][..], |other| &other[..]), 0.0);
        }
        self.before.push_front(errors);
        self.before.truncate(AFTER[1] * frames);
    }

    /// Those of both.
    pub fn and(mut self, other: &Self) -> Self {
        for (sum, other) in self.sums.iter_mut().zip(other.sums) {
            *sum = (sum.0 + other.0, sum.1 + other.1, sum.2 + other.2);
        }
        self.seen = (self.seen.0 + other.seen.0, self.seen.1.max(other.seen.1));
        self
    }

    /// How far the correlations of all lags together, z² each, are above what white noise makes, in its standard deviations; nothing where too
    /// little was seen to tell.
    ///
    /// Residuals of a fit of four numbers a pixel are anticorrelated by 4 over the frames, z = -4 √(errors / frames).
    pub fn correlation(&self) -> Option<f64> {
        let (frames, errors) = self.seen;
        let known = self.sums.iter().filter(|(_, squares, count)| *count >= LEAST && *squares > 0.0);
        let squares: Vec<f64> = known.map(|(sum, squares, _)| sum * sum / squares).collect();
        let count = squares.len() as f64;
        let correlation = (squares.iter().sum::<f64>() - count) / (2.0 * count).sqrt();
        (!squares.is_empty() && frames >= FRAMES_AN_ERROR * errors).then_some(correlation)
    }
}

/// What several `errors` of one frame are beside their mean (0 is none), and what that takes from the product of two on average: of white ones the variance over their
/// number.
fn within(mut errors: Vec<f64>) -> (Vec<f64>, f64) {
    let count = errors.iter().filter(|error| **error != 0.0).count() as f64;
    if count < 2.0 {
        return (errors, 0.0);
    }
    let mean = errors.iter().sum::<f64>() / count;
    errors.iter_mut().filter(|error| **error != 0.0).for_each(|error| *error -= mean);
    let variance = errors.iter().map(|error| error * error).sum::<f64>() / (count - 1.0);
    (errors, variance / count)
}

/// Products of `some` errors and `others`, of which each has `less` than it would have.
fn products(sum: &mut (f64, f64, usize), some: &[f64], others: &[f64], less: f64) {
    let both = some.iter().zip(others).filter(|(one, other)| **one != 0.0 && **other != 0.0);
    for product in both.map(|(one, other)| one * other + less) {
        sum.0 += product;
        sum.1 += product * product;
        sum.2 += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    const ROWS: usize = 12;
    const FRAMES: usize = 4;
    const SETS: usize = 40;

    /// Of sets, whose errors `error` makes of draws, set, frame and row.
    fn correlation(error: impl Fn(&[f64], usize, usize, usize) -> f64) -> f64 {
        let mut white = White::default();
        for set in 0..SETS {
            for frame in 0..FRAMES {
                let draws = Draws::of(7, (set * FRAMES + frame) as u64).normal(ROWS);
                let errors = (0..ROWS).map(|row| error(&draws, set, frame, row)).collect();
                white.add(errors, frame, FRAMES, set == 0 && frame == 0);
            }
        }
        white.correlation().unwrap()
    }

    #[test]
    fn noise_is_white_and_what_repeats_is_not() {
        assert!(correlation(|draws, _, _, row| draws[row]) < 3.0);
        // Alike in every other row, in the frames of a set, from set to set.
        let alike = |sign: f64| 0.7 * sign;
        assert!(correlation(|draws, _, _, row| draws[row] + alike([1.0, -1.0][row % 2])) > 10.0);
        assert!(
            correlation(|draws, set, _, row| draws[row] + alike([1.0, -1.0][(set * 7 + row * row) / 3 % 2]))
                > 10.0
        );
        assert!(
            correlation(|draws, _, frame, row| draws[row] + alike([1.0, -1.0][(frame * row + frame) / 2 % 2]))
                > 10.0
        );
    }

    /// Frames that are off as a whole, by more than rows scatter, leave white rows white; of errors of frames themselves that is what is asked.
    #[test]
    fn what_all_rows_have_in_common_is_the_frames() {
        assert!(correlation(|draws, set, frame, row| draws[row] + 3.0 * ((set + frame) as f64).sin()) < 3.0);
        assert!(
            correlation(|draws, _, _, row| draws[row] + 3.0 * draws[0] + 0.7 * [1.0, -1.0][row % 2]) > 10.0
        );
        let mut frames = White::default();
        (0..120).for_each(|n| frames.add(vec![(0.1 * f64::from(n)).sin()], (n % 3) as usize, 3, n == 0));
        assert!(frames.correlation().unwrap() > 10.0);
    }

    #[test]
    fn both_parts_count() {
        let frames = |frames: usize| {
            let mut white = White::default();
            let stripes = || (0..ROWS).map(|row| [1.0, -1.0][row % 2]).collect();
            (0..frames).for_each(|frame| white.add(stripes(), frame % 3, 3, frame == 0));
            white
        };
        let one = frames(120);
        let both = one.clone().and(&one);
        // Twice as much is known: z² are twice as great, of which 8 and a half are white noise's, at most.
        let ratio = both.correlation().unwrap() / one.correlation().unwrap();
        assert!((ratio - 2.0).abs() < 0.05, "{ratio}");
        // So few frames say nothing.
        assert_eq!(frames(9).correlation(), None);
    }
}
