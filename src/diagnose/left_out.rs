//! What is left out before anything is looked for: pixels with noise of their own, and sets that are unlike their neighbours.

use super::data::Data;
use super::fit::{Fit, fit};
use super::noise::Noise;
use super::noisy_pixels::noisy_pixels;
use super::settle::outlying;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// So many numbers of sets, or pixels, are told.
const MOST: usize = 8;

/// What is left out.
#[derive(Debug, Clone, Default)]
pub struct LeftOut {
    /// Sets of each recording, by their numbers in it.
    sets: BTreeMap<String, Vec<usize>>,
    /// Pixels, by row and column of the sensor.
    pixels: Vec<(usize, usize)>,
}

/// `data` without what is left out of it, with the fit of the simulation to that, which was `baseline` before.
pub fn without_outliers(data: &Data, baseline: Fit, noise: Noise) -> (Option<Data>, Fit, LeftOut) {
    let refitted = |data: &Data, from: &Fit| fit(data, Some(from), Vec::new(), noise, &|_| true);
    let noisy = noisy_pixels(data, &baseline, noise);
    let fewer_pixels = (!noisy.is_empty()).then(|| data.only(|_, pixel| !noisy.contains(&pixel)));
    let baseline = fewer_pixels.as_ref().map_or_else(|| baseline.clone(), |fewer| refitted(fewer, &baseline));
    let outlying = outlying(&baseline.series);
    let fewer_sets = fewer_pixels.as_ref().unwrap_or(data).without(&outlying);
    let baseline = fewer_sets.as_ref().map_or_else(|| baseline.clone(), |fewer| refitted(fewer, &baseline));
    let mut left_out = LeftOut::default();
    let sets = data.sets();
    for (take, set) in outlying.iter().filter_map(|&number| sets.get(number)) {
        left_out.sets.entry(data.takes[*take].name.clone()).or_default().push(*set);
    }
    let (places, width) = (data.grid.pixels(), data.described.geometry.width);
    left_out.pixels = noisy.into_iter().map(|pixel| (places[pixel] / width, places[pixel] % width)).collect();
    (fewer_sets.or(fewer_pixels), baseline, left_out)
}

impl LeftOut {
    /// How many sets.
    pub fn sets(&self) -> usize {
        self.sets.values().map(Vec::len).sum()
    }

    /// The pixels, by row and column.
    pub fn pixels(&self) -> &[(usize, usize)] {
        &self.pixels
    }

    /// The sets of each recording.
    pub fn json(&self) -> Value {
        json!(self.sets)
    }

    /// What is left out, a sentence each.
    pub fn sentences(&self) -> Vec<String> {
        let mut sentences = Vec::new();
        let told = |of: Vec<String>| match of.len() > MOST {
            true => format!("{} and {} more", of[..MOST].join(", "), of.len() - MOST),
            false => of.join(", "),
        };
        if !self.sets.is_empty() {
            let of = |(name, sets): (&String, &Vec<usize>)| {
                format!("{name} {}", told(sets.iter().map(ToString::to_string).collect()))
            };
            let of: Vec<String> = self.sets.iter().map(of).collect();
            let count = self.sets();
            let plural = if count == 1 { "" } else { "s" };
            sentences.push(format!("{count} set{plural} unlike the neighbours: {}", of.join("; ")));
        }
        if !self.pixels.is_empty() {
            let of = self.pixels.iter().map(|(row, column)| format!("row {row} column {column}")).collect();
            let count = self.pixels.len();
            let plural = if count == 1 { "" } else { "s" };
            sentences.push(format!("{count} pixel{plural} far noisier than the others: {}", told(of)));
        }
        sentences
    }
}
