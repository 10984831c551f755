//! The way of a fit: steps that may lead uphill a little, and back to the best place where they do not lead down again.

use std::mem::replace;

/// What is left must differ by more to be less: a standard deviation of one number is 1.
pub const ENOUGH: f64 = 0.1;

/// So many steps one after the other may lead to places that are not below the best one.
const PATIENCE: usize = 5;
/// So many that change next to nothing are the end.
const SLOW: usize = 2;

/// Where at most so `many` steps lead from `start`, and, if the way was lower before, so many from there that may not lead uphill (the watchdog technique
/// of Chamberlain, Powell, Lemarechal and Pedersen 1982, with the whole way for its relaxed part). `step` is given a place and whether it may lead uphill;
/// nothing is the end of the way, and so is what changes less than `enough` however much a step promises. `left` is what there is to be made small.
pub fn descend<M>(
    start: M,
    many: usize,
    enough: f64,
    step: &dyn Fn(&M, bool) -> Option<M>,
    left: &dyn Fn(&M) -> f64,
) -> M {
    let is_below = |a: &M, b: &M| left(a) + ENOUGH < left(b);
    let mut here = start;
    let mut best: Option<M> = None;
    for may_climb in [true, false] {
        let (mut above, mut slow) = (0, 0);
        for _ in 0..many {
            let Some(there) = step(&here, may_climb) else { break };
            let behind = replace(&mut here, there);
            slow = if (left(&behind) - left(&here)).abs() < enough { slow + 1 } else { 0 };
            if best.as_ref().is_none_or(|best| is_below(&behind, best)) {
                best = Some(behind);
            }
            above = if best.as_ref().is_some_and(|best| is_below(&here, best)) { 0 } else { above + 1 };
            if above == PATIENCE || slow == SLOW {
                break;
            }
        }
        let Some(below) = best.take_if(|best| is_below(best, &here)) else { break };
        here = below;
    }
    here
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    /// Where a way ends whose places are this high, one after the other, and that goes from place to place in `downhill` where it may not climb; and how
    /// many steps it takes.
    fn end(heights: &[f64], downhill: &[(usize, usize)], many: usize) -> (usize, usize) {
        let steps = Cell::new(0);
        let step = |&here: &usize, may_climb: bool| {
            steps.set(steps.get() + 1);
            let further = downhill.iter().find(|way| way.0 == here).map(|way| way.1);
            if may_climb { (here + 1 < heights.len()).then_some(here + 1) } else { further }
        };
        (descend(0, many, ENOUGH, &step, &|&place| heights[place]), steps.get())
    }

    #[test]
    fn a_way_downhill_is_gone_to_its_end_once() {
        assert_eq!(end(&[9.0, 5.0, 2.0, 1.0], &[], 12), (3, 4));
        assert_eq!(end(&[9.0], &[], 12), (0, 1));
    }

    #[test]
    fn a_hill_on_the_way_down_is_climbed() {
        assert_eq!(end(&[9.0, 5.0, 6.0, 1.0], &[(1, 0)], 12), (3, 4));
    }

    #[test]
    fn a_way_that_ends_uphill_goes_back_and_on_downhill() {
        assert_eq!(end(&[9.0, 5.0, 6.0, 8.0], &[], 12).0, 1);
        assert_eq!(end(&[9.0, 5.0, 6.0, 8.0, 3.0], &[(1, 4)], 3).0, 4);
        // So it is where all steps were spent on the hill.
        assert_eq!(end(&[5.0, 6.0, 7.0, 8.0, 3.0], &[(0, 4)], 2).0, 4);
    }

    #[test]
    fn a_way_that_stays_above_its_best_place_is_given_up() {
        // Not a hill of four steps.
        let hill = [9.0, 5.0, 6.0, 7.0, 8.0, 7.0, 1.0];
        assert_eq!(end(&hill, &[], 12).0, 6);
        let wall = [9.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 1.0];
        assert_eq!(end(&wall, &[], 12), (1, 7));
    }

    #[test]
    fn what_hardly_changes_any_more_is_the_end() {
        assert_eq!(end(&[9.0, 5.0, 4.99, 4.98, 1.0], &[], 12), (3, 3));
        assert_eq!(end(&[9.0, 5.0, 4.99, 4.0, 3.95, 1.0], &[], 12), (5, 6));
    }

    #[test]
    fn what_is_left_by_less_than_a_tenth_is_no_reason_to_go_back() {
        assert_eq!(end(&[9.0, 5.0, 5.05], &[], 12), (2, 3));
    }
}
