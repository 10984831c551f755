//! What is left out before anything is looked for: pixels with noise of their own, and sets that are unlike their neighbours.

use super::noisy_pixels::noisy_pixels;
use super::settle::outlying;
use crate::diagnose::fitting::fit::{AS_IT_IS, Fit, fit, fit_until};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::locating::mismatch::Place;
use crate::diagnose::periodic::lines::{Series, SetSeen};
use crate::diagnose::reading::data::Data;
use std::collections::BTreeMap;

/// So many sets in a row that are unlike all others are no outliers, but something that lasts.
const LASTS: usize = 3;

/// What is left out.
#[derive(Debug, Clone, Default)]
pub struct LeftOut {
    /// Sets of each recording, by their numbers in it.
    pub sets: BTreeMap<String, Vec<usize>>,
    /// Pixels with noise of their own, by row and column of the sensor.
    pub pixels: Vec<(usize, usize)>,
    /// Pixels that show the same code in every frame, or none that counts, likewise.
    pub stuck: Vec<(usize, usize)>,
    /// The noisy pixels by their numbers among those that are looked at, and the sets by theirs among all.
    noisy: Vec<usize>,
    outlying: Vec<usize>,
    /// Where sets in a row are, most significant first.
    pub lasting: Vec<Place>,
}

/// `data` without what is left out of it, where that is anything, with the fit of the simulation to that, which was `baseline` before.
pub fn without_outliers(data: &Data, mut baseline: Fit, noise: Noise) -> (Option<Data>, Fit, LeftOut) {
    let refitted = |fewer: &Data, from: &Fit| fit(fewer, Some(from), Vec::new(), noise, &|_| true);
    let noisy = noisy_pixels(data, &baseline, noise);
    let mut fewer = without_pixels(data, &noisy);
    if let Some(fewer) = &fewer {
        baseline = refitted(fewer, &baseline);
    }
    let outlying = outlying(&baseline.series);
    let lasting = lasting(data, &baseline.series, &outlying);
    if let Some(without) = fewer.as_ref().unwrap_or(data).without(&outlying) {
        baseline = refitted(&without, &baseline);
        fewer = Some(without);
    }
    (fewer, baseline, LeftOut { lasting, ..LeftOut::of(data, noisy, outlying) })
}

/// Where at least [so many](LASTS) of the `outlying` sets follow each other in a recording of `data`, what they leave in all, most first.
fn lasting(data: &Data, series: &Series, outlying: &[usize]) -> Vec<Place> {
    let sets = data.sets();
    let seen: Vec<&SetSeen> = series.sets.iter().filter(|seen| outlying.contains(&seen.number)).collect();
    let follow = |one: &&SetSeen, other: &&SetSeen| {
        let ((take, set), next) = (sets[one.number], sets[other.number]);
        (take, set + 1) == next
    };
    let runs = seen.chunk_by(follow).filter(|run| run.len() >= LASTS);
    let mut lasting: Vec<Place> = runs
        .map(|run| {
            let chi2: f64 = run.iter().map(|seen| seen.chi2.0 - seen.chi2.1 as f64).sum();
            let [first, last] = [run[0], run[run.len() - 1]].map(|seen| sets[seen.number].1);
            Place {
                coordinate: "time_s",
                shape: format!("sets {first} to {last}, unlike those before and after them"),
                ln_bayes: 0.5 * chi2,
                chi2: (chi2 + run.len() as f64, run.len()),
                looked: sets.len() as f64,
                take: sets[run[0].number].0,
                is_random: false,
            }
        })
        .collect();
    lasting.sort_by(|one, other| other.ln_bayes.total_cmp(&one.ln_bayes));
    lasting
}

/// Row and column of `pixels`.
fn places(data: &Data, pixels: &[usize]) -> Vec<(usize, usize)> {
    let (places, geometry) = (data.grid.pixels(), data.described.geometry);
    pixels.iter().map(|&pixel| geometry.row_column(places[pixel])).collect()
}

/// `data` without some `pixels`, if there are any.
pub fn without_pixels(data: &Data, pixels: &[usize]) -> Option<Data> {
    let mut counts = vec![true; data.pixels()];
    pixels.iter().for_each(|&pixel| counts[pixel] = false);
    (!pixels.is_empty()).then(|| data.only(|_, pixel| counts[pixel]))
}

impl LeftOut {
    fn of(data: &Data, noisy: Vec<usize>, outlying: Vec<usize>) -> Self {
        let mut sets = BTreeMap::<String, Vec<usize>>::new();
        let all = data.sets();
        for &(take, set) in outlying.iter().filter_map(|&number| all.get(number)) {
            sets.entry(data.takes[take].name.clone()).or_default().push(set);
        }
        Self { sets, pixels: places(data, &noisy), noisy, outlying, ..Self::default() }
    }

    /// The same, and pixels that are `stuck`.
    #[must_use]
    pub fn with_stuck(self, data: &Data, stuck: &[usize]) -> Self {
        Self { stuck: places(data, stuck), ..self }
    }

    /// `data` without what is to be left out of it beside the effects of `fitted`, where those are other sets: a strong effect hides outliers, and may look like some. Where
    /// nothing is named, no set is. Where all `is_explained` as it is, sets that are no outliers are not missed.
    pub fn beside(
        &self,
        data: &Data,
        fitted: &Fit,
        noise: Noise,
        is_explained: bool,
    ) -> Option<(Data, Self)> {
        let quiet = without_pixels(data, &self.noisy);
        let quiet = quiet.as_ref().unwrap_or(data);
        let outlying = match &fitted.pieces[..] {
            [] => Vec::new(),
            _ if self.outlying.is_empty() => outlying(&fitted.series),
            // As the fit without them has them.
            pieces => outlying(&fit_until(quiet, fitted, pieces.to_vec(), noise, &|_| true, AS_IT_IS).series),
        };
        let has_more = outlying.iter().any(|set| !self.outlying.contains(set));
        let are_others = has_more || !is_explained && outlying != self.outlying;
        are_others.then(|| {
            let fewer = quiet.without(&outlying).unwrap_or_else(|| quiet.clone());
            (fewer, Self::of(data, self.noisy.clone(), outlying))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::frames::Geometry;

    #[test]
    fn sets_in_a_row_last() {
        let size = Geometry { width: 8, height: 6 };
        let recordings = taken(size, 2, &[], &["four-rail", "four-sweep"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let sets = data.sets();
        let second = sets.iter().position(|set| set.0 == 1).unwrap();
        let places = |outlying: &[usize]| {
            let of = |number: usize| SetSeen {
                number,
                chi2: if number > second { (300.0, 100) } else { (150.0, 100) },
                ..SetSeen::default()
            };
            let mut series = Series::default();
            series.sets.extend((0..sets.len()).map(of));
            let places = lasting(&data, &series, outlying);
            places.into_iter().map(|place| (place.take, place.shape, place.chi2)).collect::<Vec<_>>()
        };
        assert_eq!(places(&[3, 4, 6, 7, 9]), []);
        // The last sets of a recording and the first of the next do not follow each other.
        assert_eq!(places(&[second - 2, second - 1, second, second + 1]), []);
        let told =
            |first: usize, last: usize| format!("sets {first} to {last}, unlike those before and after them");
        let found = places(&[3, 4, 5, 9, second + 2, second + 3, second + 4, second + 5]);
        assert_eq!(found, [(1, told(2, 5), (804.0, 4)), (0, told(3, 5), (153.0, 3))]);
    }
}
