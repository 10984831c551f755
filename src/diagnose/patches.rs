//! Neighbouring pixels that are off together in a part of a recording: what sits before the lens for a while, condenses on it, or warms a corner of the sensor.

use super::columns::OWN;
use super::data::Data;
use super::evidence::Greatest;
use super::gram::Whitened;
use super::ranges::Ranges;
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
/// A pixel counts for so many standard deviations at most: one alone is no patch.
const MOST_SIGMAS: f64 = 4.0;
/// What is nearly all absorbed by the pixel's own numbers is rounding.
const SEEN: f64 = 1e-3;
/// Shares of a recording's patches of one size, and chi squared of one degree that noise makes so often (Abramowitz and Stegun 1964, table 26.8).
const USUAL: [(f64, f64); 2] = [(0.5, 0.455), (0.3, 1.074)];

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

/// What a pixel says of one way of being off in one part: score and information.
type Said = (f64, f64);

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
        let spans = || (0..PARTS).flat_map(|from| (from..PARTS).map(move |to| (from, to)));
        let looked = (data.takes.len() * spans().count() * MODES.len() * inverses.len()) as f64;
        let mut all = Vec::new();
        for take in 0..data.takes.len() {
            let mut squares: [Vec<f64>; SIZES.len()] = Default::default();
            let mut greatest: [Option<Patch>; SIZES.len()] = Default::default();
            for (from, to) in
                spans().filter(|(from, to)| [from, to].iter().all(|part| self.has(take, **part)))
            {
                let area =
                    Area::of(&self.said(data, inverses, mode, take, (from, to)), data.geometry().width);
                for ((&size, squares), greatest) in SIZES.iter().zip(&mut squares).zip(&mut greatest) {
                    let (height, width) = area.size(size);
                    for (row, column, (score, information)) in area.patches((height, width)) {
                        let chi2 = score * score / information;
                        squares.push(chi2);
                        if greatest.as_ref().is_none_or(|patch| chi2 > patch.found.chi2.0) {
                            *greatest = Some(Patch {
                                mode: MODES[mode],
                                take,
                                rows: (row, row + height - 1),
                                columns: (column, column + width - 1),
                                times: (from as f64 / PARTS as f64, (to + 1) as f64 / PARTS as f64),
                                found: Greatest::of(chi2, 1, looked),
                            });
                        }
                    }
                }
            }
            let over_usual = |(squares, patch): (&mut Vec<f64>, Option<Patch>)| {
                let patch = patch?;
                let found = Greatest::of(patch.found.chi2.0 / inflation(squares), 1, looked);
                Some(Patch { found, ..patch })
            };
            all.extend(squares.iter_mut().zip(greatest).filter_map(over_usual));
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
            let raw = sum(1, pixel);
            let information = raw - own.dot(&(inverses[pixel] * own));
            if information > SEEN * raw { (sum(0, pixel), information) } else { (0.0, 0.0) }
        };
        let mut said: Vec<Said> = (0..pixels).map(of_pixel).collect();
        for is_target in [false, true] {
            let here = |pixel: usize| data.target[pixel] == is_target;
            // A patch that is far off is no part of what all do: the median.
            let of = said.iter().enumerate().filter(|(pixel, said)| here(*pixel) && said.1 > 0.0);
            let mut off: Vec<f64> = of.map(|(_, (score, information))| score / information).collect();
            let middle = off.len() / 2;
            if off.is_empty() {
                continue;
            }
            let common = *off.select_nth_unstable_by(middle, f64::total_cmp).1;
            for (_, said) in said.iter_mut().enumerate().filter(|(pixel, _)| here(*pixel)) {
                let most = MOST_SIGMAS * said.1.sqrt();
                said.0 = (said.0 - common * said.1).clamp(-most, most);
            }
        }
        said
    }
}

/// By how much patches say more than noise makes them, where most of them do, or many.
fn inflation(squares: &mut [f64]) -> f64 {
    let count = squares.len();
    let usual = |(share, of_noise): (f64, f64)| {
        let place = ((1.0 - share) * (count - 1) as f64) as usize;
        *squares.select_nth_unstable_by(place, f64::total_cmp).1 / of_noise
    };
    USUAL.map(usual).into_iter().fold(1.0, f64::max)
}

/// Sums over all pixels above and to the left.
struct Area {
    width: usize,
    height: usize,
    /// `[row][column]`, with a first row and column of zeros.
    sums: Vec<Said>,
}

impl Area {
    fn of(said: &[Said], width: usize) -> Self {
        let (height, line) = (said.len() / width, width + 1);
        let mut sums = vec![(0.0, 0.0); (height + 1) * line];
        for row in 0..height {
            let mut of_row = (0.0, 0.0);
            for column in 0..width {
                let (score, information) = said[row * width + column];
                of_row = (of_row.0 + score, of_row.1 + information);
                let above = sums[row * line + column + 1];
                sums[(row + 1) * line + column + 1] = (above.0 + of_row.0, above.1 + of_row.1);
            }
        }
        Self { width, height, sums }
    }

    /// So many rows and columns, or all of them.
    fn size(&self, (rows, columns): (usize, usize)) -> (usize, usize) {
        (if rows == 0 { self.height } else { rows }, if columns == 0 { self.width } else { columns })
    }

    /// Patches of so many rows and columns of which anything is known: first row and column, and the sum.
    fn patches(&self, (height, width): (usize, usize)) -> impl Iterator<Item = (usize, usize, Said)> {
        let line = self.width + 1;
        let (rows, columns) =
            ((self.height + 1).saturating_sub(height), (self.width + 1).saturating_sub(width));
        let at = move |row: usize, column: usize| self.sums[row * line + column];
        let of = move |row: usize, column: usize| {
            let (a, b) = (at(row, column), at(row + height, column + width));
            let (c, d) = (at(row, column + width), at(row + height, column));
            (row, column, (a.0 + b.0 - c.0 - d.0, a.1 + b.1 - c.1 - d.1))
        };
        let all = (0..rows).flat_map(move |row| (0..columns).map(move |column| of(row, column)));
        // Of the whole, what is left of nothing by rounding is nothing.
        let least = 1e-9 * self.sums.last().map_or(0.0, |all| all.1);
        all.filter(move |(_, _, (_, information))| *information > least)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::diagnose::finished::unfitted;
    use crate::diagnose::location::locate;
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

    /// Of a sum over a rectangle nothing but the corners is asked.
    #[test]
    fn sums_over_areas_are_those_of_their_pixels() {
        let said: Vec<Said> = (0..12).map(|pixel| (f64::from(pixel * pixel % 7), 1.0)).collect();
        let area = Area::of(&said, 4);
        let by_hand = |row: usize, column: usize, (height, width): (usize, usize)| -> f64 {
            let rows = (row..row + height).flat_map(|row| (column..column + width).map(move |c| row * 4 + c));
            rows.map(|pixel| said[pixel].0).sum()
        };
        for size in [(2, 2), area.size((1, 0)), area.size((0, 3)), (3, 3)] {
            let patches: Vec<_> = area.patches(size).collect();
            assert_eq!(patches.len(), (4 - size.0) * (5 - size.1));
            for (row, column, (score, information)) in patches {
                assert_eq!((score, information), (by_hand(row, column, size), (size.0 * size.1) as f64));
            }
        }
        assert_eq!(area.size((1, 0)), (1, 4));
        assert_eq!(area.patches((4, 4)).count(), 0);
    }

    /// Of a normal distribution half of the squares are above 0.455, and three tenths above 1.074: twice as much scatter has four times that.
    #[test]
    fn what_most_patches_say_is_taken_from_each() {
        let squares = |scale: f64| -> Vec<f64> {
            crate::physics::Draws::of(3, 1).normal(20_000).iter().map(|z| scale * z * z).collect()
        };
        assert!((1.0..1.05).contains(&inflation(&mut squares(1.0))));
        assert!((3.9..4.2).contains(&inflation(&mut squares(4.0))));
        assert_eq!(inflation(&mut squares(0.5)), 1.0);
    }
}
