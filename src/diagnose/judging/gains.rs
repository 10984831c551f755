//! A drift that only tells recordings apart: what is constant within each is no drift.

use crate::diagnose::fitting::fit::{Fit, fit};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::naming::found::Found;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::columns::Column;
use crate::diagnose::tangents::pieces::Piece;

/// A drift of the light, and its number that is each recording's own.
const DRIFT: &str = "illumination_drift";
const BEFORE: &str = "relative_before";
/// What a drift does within recordings takes so many nats away, or it is none.
const WITHIN_NATS: f64 = 8.0;
/// And so much of what all of it explains.
const WITHIN: f64 = 0.1;
/// Where recordings are at two levels, so little of what tells them apart is left by these. A drift that goes on from one recording to the next has as many levels as there are
/// recordings.
const LEFT_BY_TWO: f64 = 0.1;
/// Why it is not believed.
pub const WHY: &str =
    "what it says is constant within each recording: gains of whole recordings, and no drift";

/// The name of a drift among what was `found` that is none.
pub fn gain_of_recordings(data: &Data, found: &Found, noise: Noise) -> Option<&'static str> {
    let named = found.named.iter().find(|named| named.name == DRIFT)?;
    let constant = |piece: &Piece| {
        let parameters = piece.effect.parameters;
        let before = parameters.iter().position(|parameter| parameter.name == BEFORE)?;
        let is_free = piece.free.contains(&before);
        let mut constant = Piece { values: piece.effect.off(), free: vec![before], ..piece.clone() };
        for (number, parameter) in parameters.iter().enumerate() {
            if number == before || parameter.is_shape() {
                constant.values[number] = piece.values[number];
            }
        }
        is_free.then_some(constant)
    };
    let drifts = || found.fit.pieces.iter().filter(|piece| piece.effect.name == DRIFT);
    let constants: Vec<Piece> = drifts().map(constant).collect::<Option<_>>()?;
    let pieces = [found.fit.pieces_without(DRIFT), constants].concat();
    let without: Fit = fit(data, Some(&found.fit), pieces, noise, &|_| true);
    let within = 0.5 * (without.left() - found.fit.left());
    let is_constant = within < WITHIN_NATS || within < WITHIN * 0.5 * named.score.0;
    // Shapes are fitted beside strengths.
    let is_level = |column: &Column| {
        let effect = without.pieces[column.piece].effect;
        effect.name == DRIFT && effect.parameters[column.parameter].name == BEFORE
    };
    let of = |(number, column): (usize, &Column)| {
        let value = without.pieces[column.piece].values[column.parameter];
        (value, without.sigma(number).max(f64::MIN_POSITIVE).powi(-2))
    };
    let levels = without.columns.iter().enumerate().filter(|(_, column)| is_level(column));
    let levels: Vec<(f64, f64)> = levels.map(of).collect();
    (is_constant && left_by_two(levels) < LEFT_BY_TWO).then_some(DRIFT)
}

/// Of how far levels, each with its weight, are from their mean, the share of the squares that is left by two means at the best; 0 of one level.
fn left_by_two(mut levels: Vec<(f64, f64)>) -> f64 {
    levels.sort_by(|one, other| one.0.total_cmp(&other.0));
    let squares = |levels: &[(f64, f64)]| {
        let weights: f64 = levels.iter().map(|level| level.1).sum();
        let mean = levels.iter().map(|(value, weight)| weight * value).sum::<f64>() / weights;
        levels.iter().map(|(value, weight)| weight * (value - mean).powi(2)).sum::<f64>()
    };
    let of_two = |at: usize| squares(&levels[..at]) + squares(&levels[at..]);
    let left = (1..levels.len()).map(of_two).fold(f64::INFINITY, f64::min);
    if left.is_finite() { left / squares(&levels).max(f64::MIN_POSITIVE) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::judging::searched::searched;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// What is named, and what of that is none, where `effect` acts in some recordings, and not in others.
    fn named(effect: &str, with: &[&str], without: &[&str]) -> (Vec<&'static str>, Option<&'static str>) {
        let size = Geometry { width: 10, height: 8 };
        let mut recordings = taken(size, 4, &[injection(effect).unwrap()], with).unwrap();
        recordings.extend(taken(size, 4, &[], without).unwrap());
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let found = searched(&data, unfitted(&data, noise), noise, 0.0).0.found;
        let names = found.named.iter().map(|named| named.name).collect();
        (names, gain_of_recordings(&data, &found, noise))
    }

    #[test]
    fn what_recordings_have_of_their_own_is_no_drift() {
        let all = ["four-sweep", "four-rail", "four-motion"];
        assert_eq!(named("illumination_drift:relative=0.05", &all, &[]), (vec![DRIFT], None));
        let (names, none) = named("illumination_drift:relative_before=0.03", &all[2..], &all[..2]);
        assert!(names == [DRIFT] && none == Some(DRIFT), "{names:?} {none:?}");
    }

    #[test]
    fn levels_of_a_drift_that_goes_on_are_not_two() {
        let of = |levels: &[f64]| left_by_two(levels.iter().map(|&level| (level, 1.0)).collect());
        assert_eq!([of(&[]), of(&[1.0]), of(&[1.0, 2.0])], [0.0; 3]);
        assert!(of(&[0.0, 3.0, 0.1, 2.9, 0.05]) < 0.01);
        // Warm-ups that go on over six and over three recordings, as they come.
        let warm = |count: usize| (0..count).map(|at| (-(at as f64) / 3.0).exp()).collect::<Vec<_>>();
        assert!([6, 3].into_iter().all(|count| of(&warm(count)) > 0.15), "{} {}", of(&warm(6)), of(&warm(3)));
        // Three levels at 0, 1 and 2: of the squares, 2, two means leave a half.
        assert!((of(&[2.0, 0.0, 1.0]) - 0.25).abs() < 1e-12);
    }
}
