//! How rows, or columns, may differ from each other.

use super::coordinates::along;

/// In which ways.
pub const LINE_WAYS: [&str; 3] = ["slope", "bow", "every other line"];

/// How much a pixel has of each, by its line.
pub type Ways = [f64; LINE_WAYS.len()];

/// Those of each pixel, of which some see the `target`, and which is in one of so many `lines`; whether these are such that `alternates` what takes turns in the sensor.
///
/// Of amplifiers that take turns one may have more of the target, or of the background: what all of these do is none of either.
pub fn ways(target: &[bool], lines: usize, alternates: bool, line: impl Fn(usize) -> usize) -> Vec<Ways> {
    let turn = |pixel: usize| if line(pixel).is_multiple_of(2) { 1.0 } else { -1.0 };
    let means = [false, true].map(|is_target| {
        let here = (0..target.len()).filter(|&pixel| target[pixel] == is_target);
        let (sum, count) = here.fold((0.0, 0.0), |of, pixel| (of.0 + turn(pixel), of.1 + 1.0));
        if count > 0.0 { sum / count } else { 0.0 }
    });
    let of = |pixel: usize| {
        let x = along(line(pixel), lines);
        let turn = turn(pixel) - means[usize::from(target[pixel])];
        [x, x * x - 1.0 / 3.0, if alternates && lines > 1 { turn } else { 0.0 }]
    };
    (0..target.len()).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three rows of two pixels, of which the first two see the target in the left one and the last one in none.
    #[test]
    fn lines_that_take_turns_have_no_mean_in_target_or_background() {
        let target = [true, false, true, false, false, false];
        let rows = |alternates: bool| ways(&target, 3, alternates, |pixel| pixel / 2);
        let alternating: Vec<f64> = rows(true).iter().map(|ways| ways[2]).collect();
        assert_eq!(alternating, [1.0, 0.5, -1.0, -1.5, 0.5, 0.5]);
        assert!(rows(false).iter().all(|ways| ways[2] == 0.0));
        assert!(ways(&target, 1, true, |_| 0).iter().all(|ways| ways[2] == 0.0));
        let smooth: Vec<[f64; 2]> = rows(true).iter().step_by(2).map(|ways| [ways[0], ways[1]]).collect();
        assert_eq!(smooth, [[-1.0, 1.0 - 1.0 / 3.0], [0.0, -1.0 / 3.0], [1.0, 1.0 - 1.0 / 3.0]]);
    }
}
