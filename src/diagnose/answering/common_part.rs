//! Errors of single frames or settings, stated without what all of them have in common: that is the pixels' own phase, or their own light, and says nothing.

use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::reading::data::Data;
use crate::diagnose::reading::frequencies::frequencies;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::effects::phase_step_errors::A_TURN;
use nalgebra::DVector;

/// Effects of which only differences show: which of their numbers says how many errors a turn has, if one does, whether each is a factor's, less 1, and what their common part is.
const OF_DIFFERENCES: [(&str, Option<usize>, bool, &str); 2] =
    [("phase_step_errors", Some(A_TURN), false, "phase"), ("frame_gain", None, true, "light")];

/// What is less of a number's variance than this is no covariance with another.
const ALONE: f64 = 1e-6;

/// What all errors of an effect have in common: their mean.
#[derive(Debug, Clone)]
pub struct CommonPart {
    mean: f64,
    /// Whether an error is a factor, less 1.
    is_factor: bool,
    /// The covariance of the mean with each fitted number.
    with: DVector<f64>,
    /// Its variance.
    variance: f64,
    /// The fitted numbers that have it.
    columns: Vec<usize>,
    /// What it is of the pixels' own.
    own: &'static str,
}

impl CommonPart {
    /// That of the effect `name` in a `fit`; nothing where it shows: where some recordings or frames have no such error, others are relative to these, and at several modulation frequencies the
    /// pixels' own is not the same.
    pub fn of(data: &Data, fit: &Fit, name: &str) -> Option<Self> {
        let (_, a_turn, is_factor, own) = OF_DIFFERENCES.into_iter().find(|(effect, ..)| *effect == name)?;
        let of = || fit.pieces.iter().enumerate().filter(|(_, piece)| piece.effect.name == name);
        // A phase matters with light only; a gain also without.
        let has_it = |take: &usize| is_factor || data.takes[*take].moments.iter().any(|moment| moment.lit);
        let mut there = (0..data.takes.len()).filter(has_it);
        let are_all = there.all(|take| of().any(|(_, piece)| piece.takes.contains(&take)));
        let is_whole = |piece: &Piece| {
            let a_turn = a_turn.map_or(0.0, |number| piece.values[number]) as usize;
            let frames = piece.takes.iter().map(|&take| data.takes[take].frames).max().unwrap_or(0);
            errors(piece).count() == if a_turn > 0 { a_turn } else { frames }
        };
        if !are_all || !of().all(|(_, piece)| is_whole(piece)) || frequencies(&data.takes).len() > 1 {
            return None;
        }
        let all: Vec<(usize, f64)> = of()
            .flat_map(|(number, piece)| errors(piece).map(move |error| (number, piece, error)))
            .filter_map(|(number, piece, error)| Some((fit.column_of(number, error)?, piece.values[error])))
            .collect();
        // A setting that no frame takes is known by nothing, and has nothing in common with others.
        let is_taken = |column: usize| {
            let others = all.iter().filter(|(other, _)| *other != column);
            let most = others.map(|(other, _)| fit.covariance[(column, *other)].abs()).fold(0.0, f64::max);
            most > ALONE * fit.covariance[(column, column)]
        };
        let all: Vec<(usize, f64)> = all.iter().copied().filter(|(column, _)| is_taken(*column)).collect();
        let share = (all.len().max(1) as f64).recip();
        let columns: Vec<usize> = all.iter().map(|(column, _)| *column).collect();
        let mean = share * all.iter().map(|(_, value)| value).sum::<f64>();
        let mut direction = DVector::zeros(fit.covariance.nrows());
        columns.iter().for_each(|&column| direction[column] = share);
        let with = &fit.covariance * &direction;
        let variance = with.dot(&direction);
        (columns.len() > 1).then_some(Self { mean, is_factor, with, variance, columns, own })
    }

    /// `value` without a `mean`.
    fn less(&self, value: f64, mean: f64) -> f64 {
        if self.is_factor { (1.0 + value) / (1.0 + mean) - 1.0 } else { value - mean }
    }

    /// The `value` of a fitted number without it, and the standard deviation of that; nothing of a number that does not have it.
    pub fn without(&self, fit: &Fit, column: usize, value: f64) -> Option<(f64, f64)> {
        let (scale, of_mean) = match self.is_factor {
            true => ((1.0 + self.mean).recip(), (1.0 + value) / (1.0 + self.mean)),
            false => (1.0, 1.0),
        };
        let own = fit.covariance[(column, column)];
        let variance = own - 2.0 * of_mean * self.with[column] + of_mean * of_mean * self.variance;
        let sigma = scale * variance.max(0.0).sqrt();
        self.columns.contains(&column).then(|| (self.less(value, self.mean), sigma))
    }

    /// Of the true `values` of all parameters that of `number` as it is stated: without what those that are fitted have in common.
    pub fn true_without(&self, fit: &Fit, values: &[f64], number: usize) -> f64 {
        let of = |column: &usize| values[fit.columns[*column].parameter];
        let mean = self.columns.iter().map(of).sum::<f64>() / self.columns.len() as f64;
        self.less(values[number], mean)
    }

    /// The values of the `piece` of this `number` in a `fit` without it, as far as their bounds allow.
    pub fn values_without(&self, fit: &Fit, number: usize, piece: &Piece) -> Vec<f64> {
        let of = |(parameter, &value): (usize, &f64)| {
            let column = fit.column_of(number, parameter);
            let without = column.and_then(|column| self.without(fit, column, value));
            let (low, high) = piece.bounds_within(parameter, fit.pixels.full_scale_dn);
            without.map_or(value, |(value, _)| value.max(low).min(high))
        };
        piece.values.iter().enumerate().map(of).collect()
    }

    /// What is said of errors that are stated without it.
    pub fn in_words(&self) -> String {
        format!(
            " What all of them have in common is the pixels' own {}: they are stated without it.",
            self.own
        )
    }
}

/// Which numbers of a `piece` are errors of one frame or setting each.
fn errors(piece: &Piece) -> impl Iterator<Item = usize> {
    let parameters = piece.effect.parameters;
    piece.free.iter().copied().filter(|&number| parameters[number].is_usual_strength(false))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::fitting::fit::fit;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// A campaign of these `recordings` with an `effect`, and the fit of the first `errors` of it to all.
    fn fitted(recordings: &[&str], effect: &str, errors: usize) -> (Data, Fit) {
        let size = Geometry { width: 8, height: 6 };
        let recordings = taken(size, 3, &[injection(effect).unwrap()], recordings).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let (free, takes) = ((0..errors).collect::<Vec<_>>(), (0..data.takes.len()).collect::<Vec<_>>());
        let name = effect.split(':').next().unwrap().to_owned().leak();
        let pieces = vec![Piece::off(name, &free, &takes)];
        let fit = fit(&data, Some(&unfitted(&data, noise)), pieces, noise, &|_| true);
        (data, fit)
    }

    /// Whatever all of the fitted numbers have more, what is stated stays, with its standard deviation, and is what there is.
    fn is_stated(effect: &str, truth: [f64; 4], more: impl Fn(f64) -> f64) {
        let (data, mut fit) = fitted(&["four-rail", "four-sweep"], effect, 4);
        let name = fit.pieces[0].effect.name;
        let stated = |fit: &Fit| {
            let common = CommonPart::of(&data, fit, name).unwrap();
            let values = common.values_without(fit, 0, &fit.pieces[0]);
            let of = |column: usize| common.without(fit, column, fit.pieces[0].values[column]).unwrap();
            let all = [0, 1, 2, 3].map(of);
            assert!(all.iter().zip(&values).all(|((value, _), written)| value == written));
            let truths = [0, 1, 2, 3].map(|number| common.true_without(fit, &truth, number));
            (all, truths)
        };
        let (before, truths) = stated(&fit);
        for ((value, sigma), truth) in before.iter().zip(truths) {
            assert!(
                (value - truth).abs() < 4.0 * sigma && *sigma < 2e-3,
                "{name}: {value} +- {sigma}, not {truth}"
            );
        }
        fit.pieces[0].values[..4].iter_mut().for_each(|value| *value = more(*value));
        for ((value, sigma), (was, was_sigma)) in stated(&fit).0.iter().zip(before) {
            assert!(
                (value - was).abs() < 1e-12 && (sigma - was_sigma).abs() < 0.2 * was_sigma,
                "{name}: {value} +- {sigma}"
            );
        }
    }

    #[test]
    fn what_all_have_in_common_is_not_stated() {
        let errors = [0.004, -0.002, 0.03, 0.01];
        is_stated(
            "phase_step_errors:setting_0_rad=0.004,setting_1_rad=-0.002,setting_2_rad=0.03,setting_3_rad=0.01",
            errors,
            |value| value + 0.05,
        );
        is_stated("frame_gain:frame_0=0.004,frame_1=-0.002,frame_2=0.03,frame_3=0.01", errors, |value| {
            1.05 * (1.0 + value) - 1.0
        });
    }

    /// Errors of some frames only are relative to the others; where an effect has other numbers, there is nothing in common.
    #[test]
    fn what_shows_is_stated_as_it_is() {
        let gains = "frame_gain:frame_1=0.01";
        let (data, three) = fitted(&["four-rail"], gains, 3);
        assert!(CommonPart::of(&data, &three, "frame_gain").is_none());
        let (data, four) = fitted(&["four-rail"], gains, 4);
        assert!(CommonPart::of(&data, &four, "frame_gain").is_some());
        assert!(CommonPart::of(&data, &four, "phase_step_errors").is_none());
        assert!(CommonPart::of(&data, &four, "image_lag").is_none());
        let (data, of_four) = fitted(&["four-rail", "wdft-rail"], gains, 4);
        assert!(CommonPart::of(&data, &of_four, "frame_gain").is_none());
    }
}
