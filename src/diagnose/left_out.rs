//! What is left out before anything is looked for: pixels with noise of their own, and sets that are unlike their neighbours.

use super::data::Data;
use super::fit::{AS_IT_IS, Fit, fit, fit_until};
use super::noise::Noise;
use super::noisy_pixels::noisy_pixels;
use super::settle::outlying;
use std::collections::BTreeMap;

/// What is left out.
#[derive(Debug, Clone, Default)]
pub struct LeftOut {
    /// Sets of each recording, by their numbers in it.
    pub sets: BTreeMap<String, Vec<usize>>,
    /// Pixels, by row and column of the sensor.
    pub pixels: Vec<(usize, usize)>,
    /// The same pixels by their numbers among those that are looked at, and the sets by theirs among all.
    noisy: Vec<usize>,
    outlying: Vec<usize>,
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
    if let Some(without) = fewer.as_ref().unwrap_or(data).without(&outlying) {
        baseline = refitted(&without, &baseline);
        fewer = Some(without);
    }
    (fewer, baseline, LeftOut::of(data, noisy, outlying))
}

fn without_pixels(data: &Data, noisy: &[usize]) -> Option<Data> {
    (!noisy.is_empty()).then(|| data.only(|_, pixel| !noisy.contains(&pixel)))
}

impl LeftOut {
    fn of(data: &Data, noisy: Vec<usize>, outlying: Vec<usize>) -> Self {
        let mut sets = BTreeMap::<String, Vec<usize>>::new();
        let all = data.sets();
        for &(take, set) in outlying.iter().filter_map(|&number| all.get(number)) {
            sets.entry(data.takes[take].name.clone()).or_default().push(set);
        }
        let (places, width) = (data.grid.pixels(), data.described.geometry.width);
        let place = |&pixel: &usize| (places[pixel] / width, places[pixel] % width);
        Self { sets, pixels: noisy.iter().map(place).collect(), noisy, outlying }
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
