//! Neighbouring pixels that are off together in a part of a recording: what sits before the lens for a while, condenses on it, or warms a corner of the sensor.

use super::areas::{Rectangle, Said, Search, beside_own, leave_common, spans};
use super::ranges::Ranges;
use crate::diagnose::fitting::gram::Whitened;
use crate::diagnose::reading::data::Data;
use crate::diagnose::statistics::evidence::Greatest;
use crate::diagnose::tangents::columns::OWN;
use crate::widest::widest;
use nalgebra::{Matrix4, Vector4};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// In which way they may be off.
const MODES: [&str; 3] = ["offset", "gain", "phase"];
/// Parts of a recording, by time; any that follow one another are looked at together.
const PARTS: usize = 8;
/// Rows and columns of a patch; as many as there are (0): a few whole lines.
const SIZES: [(usize, usize); 13] =
    [(2, 2), (3, 3), (4, 4), (6, 6), (8, 8), (1, 0), (2, 0), (3, 0), (4, 0), (0, 1), (0, 2), (0, 3), (0, 4)];

/// Sums of a way of being off: score, information, and what it shares with the pixel's own numbers.
const OF_MODE: usize = 2 + OWN;
const SUMS: usize = MODES.len() * OF_MODE;

/// Sums over parts of recordings.
#[derive(Debug, Clone, Default)]
pub struct Patches {
    /// By recording and part: `[sum][pixel]`.
    parts: BTreeMap<(usize, usize), Vec<f32>>,
}

/// A patch that stands out.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// Of [`MODES`].
    pub mode: &'static str,
    /// The recording.
    pub take: usize,
    /// First and last row and column, of the pixels that are looked at.
    pub rows: (usize, usize),
    /// The same of columns.
    pub columns: (usize, usize),
    /// From and until when, as shares of the recording.
    pub times: (f64, f64),
    /// Its evidence.
    pub found: Greatest,
}

impl Patch {
    /// It in words: rows and columns are the sensor's.
    pub fn shape(&self, data: &Data, ranges: &Ranges) -> String {
        let pixels = data.grid.pixels();
        let (sensor, width) = (data.grid.sensor, data.geometry().width);
        let at = |row: usize, column: usize| sensor.row_column(pixels[row * width + column]);
        let (first, last) = (at(self.rows.0, self.columns.0), at(self.rows.1, self.columns.1));
        let duration_s = ranges.duration_s[self.take];
        let (from_s, to_s) = (self.times.0 * duration_s, self.times.1 * duration_s);
        let place = format!("rows {} to {}, columns {} to {}", first.0, last.0, first.1, last.1);
        format!("{} in {place}, from {from_s:.1} to {to_s:.1} s of {}", self.mode, data.takes[self.take].name)
    }
}

impl Patches {
    /// With one more frame.
    pub fn with(mut self, data: &Data, whitened: &Whitened) -> Self {
        let moments = &data.takes[whitened.take].moments;
        let time_s = |index: usize| moments[index].time_s;
        let duration_s = time_s(moments.len() - 1) - time_s(0);
        let share = (time_s(whitened.index) - time_s(0)) / duration_s.max(f64::MIN_POSITIVE);
        let part = ((share * PARTS as f64) as usize).min(PARTS - 1);
        let (frame, pixels) = (whitened.frame, whitened.roots.len());
        let sums = self.parts.entry((whitened.take, part)).or_insert_with(|| vec![0.0; SUMS * pixels]);
        let root = |values: &mut dyn Iterator<Item = f64>| -> Vec<f64> {
            values.zip(whitened.roots).map(|(value, root)| value * root).collect()
        };
        let own: [Vec<f64>; OWN] = std::array::from_fn(|number| root(&mut frame.own[number].iter().copied()));
        let modes =
            [whitened.roots.to_vec(), root(&mut frame.base.iter().copied()), root(&mut frame.phase())];
        let of_modes = modes.iter().flat_map(|mode| {
            let with = [whitened.residual, &mode[..]].into_iter().chain(own.iter().map(|own| &own[..]));
            with.map(move |other| (&mode[..], other))
        });
        for (sums, (a, b)) in sums.chunks_exact_mut(pixels).zip(of_modes) {
            widest!((sums: &'a mut [f32], a: &'a [f64], b: &'a [f64]) {
                for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
                    *sum += (a * b) as f32;
                }
            });
        }
        self
    }

    /// Of other frames, too.
    pub fn and(mut self, other: Self) -> Self {
        for (part, sums) in other.parts {
            match self.parts.get_mut(&part) {
                Some(mine) => mine.iter_mut().zip(sums).for_each(|(sum, other)| *sum += other),
                None => drop(self.parts.insert(part, sums)),
            }
        }
        self
    }

    /// The patch that stands out most, over what patches of its size and way of being off usually say. `inverses`: of the normal equations of each pixel's own numbers.
    pub fn strongest(&self, data: &Data, inverses: &[Matrix4<f64>]) -> Option<Patch> {
        let all =
            (0..MODES.len()).into_par_iter().flat_map_iter(|mode| self.strongest_of(data, inverses, mode));
        all.max_by(|a, b| a.found.chi2.0.total_cmp(&b.found.chi2.0))
    }

    /// The same of each recording and size, for one way of being off.
    fn strongest_of(&self, data: &Data, inverses: &[Matrix4<f64>], mode: usize) -> Vec<Patch> {
        let looked = (data.takes.len() * spans(PARTS).count() * MODES.len() * inverses.len()) as f64;
        let mut all = Vec::new();
        for take in 0..data.takes.len() {
            let mut search = Search::of(&SIZES);
            for (from, to) in
                spans(PARTS).filter(|(from, to)| [from, to].iter().all(|part| self.has(take, **part)))
            {
                let said = self.said(data, inverses, mode, take, (from, to));
                search.look(&said, data.geometry().width, (from, to));
            }
            all.extend(search.end().map(|Rectangle { rows, columns, part: (from, to), chi2, .. }| Patch {
                mode: MODES[mode],
                take,
                rows,
                columns,
                times: (from as f64 / PARTS as f64, (to + 1) as f64 / PARTS as f64),
                found: Greatest::of(chi2, 1, looked),
            }));
        }
        all
    }

    /// Whether anything was seen in a part of a recording.
    fn has(&self, take: usize, part: usize) -> bool {
        self.parts.contains_key(&(take, part))
    }

    /// What each pixel says of one way of being off in parts of a recording, beside its own numbers, and beside what all pixels of the target, or of the background, do.
    fn said(
        &self,
        data: &Data,
        inverses: &[Matrix4<f64>],
        mode: usize,
        take: usize,
        (from, to): (usize, usize),
    ) -> Vec<Said> {
        let pixels = inverses.len();
        let parts: Vec<&Vec<f32>> = (from..=to).filter_map(|part| self.parts.get(&(take, part))).collect();
        let sum = |number: usize, pixel: usize| -> f64 {
            let at = (mode * OF_MODE + number) * pixels + pixel;
            parts.iter().map(|sums| f64::from(sums[at])).sum()
        };
        let of_pixel = |pixel: usize| {
            let own = Vector4::from_fn(|number, _| sum(2 + number, pixel));
            beside_own(sum(0, pixel), sum(1, pixel), own, &inverses[pixel])
        };
        let mut said: Vec<Said> = (0..pixels).map(of_pixel).collect();
        leave_common(&mut said, &data.target);
        said
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::locating::location::locate;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// What is said of a patch in a clean rail of 16 x 12 pixels, of which these pixels have so much less light in the second half of it.
    fn found(pixels: &[(usize, usize)], share: f64) -> (String, f64) {
        let recordings = taken(Geometry { width: 16, height: 12 }, 3, &[], &["four-rail", "wdft-rail"]);
        let mut data = Data::of(&recordings.unwrap(), Vec::new()).unwrap();
        let frames = data.takes[0].moments.len();
        for frame in frames / 2..frames {
            for (row, column) in pixels {
                data.takes[0].signal_dn[frame * 192 + row * 16 + column] *= (1.0 - share) as f32;
            }
        }
        let noise = stated_noise(&data);
        let location = locate(&data, &unfitted(&data, noise), noise);
        let patch =
            location.columns.into_iter().find(|located| located.shape.contains(", columns ")).unwrap();
        (patch.shape, patch.ln_bayes)
    }

    #[test]
    fn a_patch_is_found_where_it_is_and_one_pixel_is_none() {
        let patch: Vec<(usize, usize)> =
            (4..7).flat_map(|row| (9..12).map(move |column| (row, column))).collect();
        // However much of the light is gone. Pixels settle in between, so that the other recording may be off by more, and nothing is said of which it is.
        for share in [0.02, 0.3] {
            let (shape, ln_bayes) = found(&patch, share);
            assert!(ln_bayes > 20.0, "{shape}: {ln_bayes}");
            assert!(shape.contains(" in rows 4 to 6, columns 9 to 11, from "), "{shape}");
        }
        for clean in [&[][..], &[(5, 7)]] {
            let (shape, ln_bayes) = found(clean, 0.3);
            assert_eq!(ln_bayes, 0.0, "{clean:?}: {shape}");
        }
    }
}
