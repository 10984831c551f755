//! A drift that each recording has for itself though all may have the same: with a number of its own for each, its time constant was looked for in recordings of which
//! most are too short to tell it.

use crate::diagnose::fitting::fit::{Fit, fit_below};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::naming::found::Named;
use crate::diagnose::reading::data::Data;
use crate::diagnose::reading::included::included_of;
use crate::diagnose::tangents::columns::Column;
use crate::diagnose::tangents::pieces::Piece;

/// What may begin anew with each recording, by the same law.
const DRIFTS: [&str; 3] = ["illumination_drift", "ambient_drift", "phase_drift"];

/// In `current`, a drift that is `named` and has numbers for each recording gets one of each for all, where what is left grows by less than the numbers that are saved cost.
pub fn in_common(data: &Data, noise: Noise, current: &mut Fit, named: &mut [Named]) {
    for named in named.iter_mut().filter(|named| DRIFTS.contains(&named.name)) {
        let fits = begun(data, current, named.name).into_iter().map(|piece| {
            let pieces = [current.pieces_without(named.name), vec![piece]].concat();
            fit_below(data, current, pieces, noise, current.cost())
        });
        // A fit that was given up, or that is no number, is not taken.
        let fewer = fits.filter(|fit| fit.cost() < current.cost());
        if let Some(fitted) = fewer.min_by(|a, b| a.cost().total_cmp(&b.cost())) {
            let strengths = fitted.pieces.last().map_or(1, |piece| piece.free.len() - piece.shapes());
            let less = fitted.counted() - current.counted();
            named.score = ((named.score.0 - less).max(0.0), named.score.1.min(strengths));
            *current = fitted;
        }
    }
}

/// Pieces of all recordings from which the effect `name` may be fitted, with the values of one recording: of that which knows its strength best, and of that which knows its
/// time constant best; none where all have the same already.
fn begun(data: &Data, current: &Fit, name: &str) -> Vec<Piece> {
    let of = |number: &usize| current.pieces[*number].effect.name == name;
    let own: Vec<usize> = (0..current.pieces.len()).filter(of).collect();
    let is_of_one = |&number: &usize| current.pieces[number].takes.len() == 1;
    if own.len() < 2 || !own.iter().all(is_of_one) {
        return Vec::new();
    }
    // How many standard deviations the strength of a piece is large, and its time constant.
    let clear = |is_shape: bool, &number: &usize| {
        let piece = &current.pieces[number];
        let of_piece = current.columns.iter().enumerate().filter(|(_, column)| column.piece == number);
        let of_kind = of_piece.filter(|(_, column)| {
            let parameter = &piece.effect.parameters[column.parameter];
            // A level of the recording's own is no drift.
            parameter.is_shape() == is_shape && !parameter.is_of_recording
        });
        let deviations = |(place, column): (usize, &Column)| {
            piece.values[column.parameter].abs() / current.sigma(place).max(f64::MIN_POSITIVE)
        };
        of_kind.map(deviations).fold(0.0, f64::max)
    };
    let clearest =
        |is_shape: bool| own.iter().copied().max_by(|a, b| clear(is_shape, a).total_cmp(&clear(is_shape, b)));
    let mut from: Vec<usize> = [false, true].into_iter().filter_map(clearest).collect();
    from.dedup();
    let takes: Vec<usize> = own.iter().flat_map(|&number| current.pieces[number].takes.clone()).collect();
    let of_all = |number: usize| {
        let mut piece = current.pieces[number].clone();
        for (value, parameter) in piece.values.iter_mut().zip(piece.effect.parameters) {
            if parameter.is_of_recording {
                *value = parameter.off;
            }
        }
        piece.free.retain(|&number| !piece.effect.parameters[number].is_of_recording);
        piece.included = included_of(data, piece.effect, &takes);
        piece.takes.clone_from(&takes);
        piece
    };
    from.into_iter().map(of_all).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::fitting::fit::fit;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    const DRIFT: &str = "phase_drift";

    /// The fit of a drift that each of two recordings has for itself, of which these are true, and how many numbers it is said to have.
    fn drifts(truths: [&str; 2]) -> (Fit, usize) {
        let size = Geometry { width: 12, height: 9 };
        let recording = |(truth, name): (&str, &str)| {
            let effect = injection(&format!("{DRIFT}:{truth}")).unwrap();
            taken(size, 4, &[effect], &[name]).unwrap()
        };
        let recordings = truths.into_iter().zip(["four-rail", "four-sweep"]).flat_map(recording);
        let data = Data::of(&recordings.collect::<Vec<_>>(), Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        let of_take = |take: usize| Piece::off(DRIFT, &[0, 1], &[take]);
        // Beside what has more numbers than a drift.
        let mut own = [0, 1].map(of_take).to_vec();
        own.push(Piece::off("correlation_harmonics", &[2, 3, 6, 7], &[0, 1]));
        let mut current = fit(&data, Some(&baseline), own, noise, &|_| true);
        let score = (baseline.counted() - current.counted(), 4);
        let mut named =
            [Named { name: DRIFT, ln_bayes: 100.0, score, rivals: Vec::new(), is_trusted: false }];
        in_common(&data, noise, &mut current, &mut named);
        let explained = baseline.counted() - current.counted();
        assert!((named[0].score.0 - explained).abs() < 1e-6 * explained, "{:?}", named[0].score);
        (current, named[0].score.1)
    }

    #[test]
    fn a_drift_that_all_recordings_have_has_one_time_constant() {
        let (found, numbers) = drifts(["drift_rad=0.2,time_constant_s=20"; 2]);
        let [_, ref piece] = found.pieces[..] else { panic!("{:?}", found.pieces) };
        assert_eq!((&piece.takes[..], &piece.free[..], numbers), (&[0, 1][..], &[0, 2][..], 1));
        for (parameter, truth) in [(0, 0.2), (2, 20.0)] {
            let sigma = found.sigma(found.column_of(1, parameter).unwrap());
            let value = piece.values[parameter];
            assert!((value - truth).abs() < 3.0 * sigma && sigma < 0.2 * truth, "{value} +- {sigma}");
        }
    }

    #[test]
    fn drifts_that_are_not_the_same_stay_each_recordings_own() {
        let (found, numbers) =
            drifts(["drift_rad=0.05,time_constant_s=20", "drift_rad=-0.05,time_constant_s=20"]);
        assert_eq!((found.pieces.len(), numbers), (3, 4));
    }
}
