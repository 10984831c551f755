//! What is left out before anything is looked for: pixels with noise of their own, and sets that are unlike their neighbours.

use super::data::Data;
use super::fit::{Fit, fit};
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
}

/// `data` without what is left out of it, where that is anything, with the fit of the simulation to that, which was `baseline` before.
pub fn without_outliers(data: &Data, mut baseline: Fit, noise: Noise) -> (Option<Data>, Fit, LeftOut) {
    let refitted = |fewer: &Data, from: &Fit| fit(fewer, Some(from), Vec::new(), noise, &|_| true);
    let noisy = noisy_pixels(data, &baseline, noise);
    let mut fewer = (!noisy.is_empty()).then(|| data.only(|_, pixel| !noisy.contains(&pixel)));
    if let Some(fewer) = &fewer {
        baseline = refitted(fewer, &baseline);
    }
    let outlying = outlying(&baseline.series);
    if let Some(without) = fewer.as_ref().unwrap_or(data).without(&outlying) {
        baseline = refitted(&without, &baseline);
        fewer = Some(without);
    }
    let mut left_out = LeftOut::default();
    let sets = data.sets();
    for &(take, set) in outlying.iter().filter_map(|&number| sets.get(number)) {
        left_out.sets.entry(data.takes[take].name.clone()).or_default().push(set);
    }
    let (places, width) = (data.grid.pixels(), data.described.geometry.width);
    left_out.pixels = noisy.into_iter().map(|pixel| (places[pixel] / width, places[pixel] % width)).collect();
    (fewer, baseline, left_out)
}
