//! What the recordings themselves say of the mask, and of sets that are unlike all others.

use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::fitting::own_phases::OwnPhases;
use crate::diagnose::fitting::split::BACKGROUND_M;
use crate::diagnose::periodic::lines::{Series, SetSeen};
use crate::diagnose::reading::data::Data;
use crate::diagnose::reading::places::APART_M;
use crate::diagnose::statistics::median::median;
use crate::physics::cos_sin;
use crate::units::phase_rad;
use nalgebra::{Matrix4, Vector4};
use rayon::prelude::*;

/// A pixel sees what the mask does not say where chi squared is less by so much, and by this share.
const MUCH_BETTER: (f64, f64) = (100.0, 0.02);
/// Nor does it see the target where that is less bright than this share of what neighbours see that do: their charge, or an edge within it, does as much.
const BRIGHT_ENOUGH: f64 = 0.35;

/// Pixels that are looked at one after the other, frame by frame.
const TOGETHER: usize = 32;

/// `data` with the mask that its pixels show, and how many differ from the one that was recorded; nothing where none does.
///
/// Each pixel is fitted once as if it saw the moving target, and once as if it saw a background that stands still.
pub fn with_mask(data: &Data, noise: Noise) -> Option<(Data, usize)> {
    let count = data.pixels();
    let mut normal = vec![[Normal::default(); 2]; count];
    let obliquity = data.obliquities();
    let own_phases = OwnPhases::of(data, &|_| true);
    let besides_rad = own_phases.besides_rad(count);
    normal.par_chunks_mut(TOGETHER).enumerate().for_each(|(chunk, normal)| {
        let first = chunk * TOGETHER;
        for take in &data.takes {
            let besides_rad = &besides_rad[own_phases.number(take)][first..];
            for (index, moment) in take.moments.iter().enumerate().filter(|(_, moment)| moment.lit) {
                let position_m = moment.commanded_m();
                let angle = moment.step_rad + moment.offset_rad;
                let signals = &take.signal_dn[index * count + first..][..normal.len()];
                for (pixel, &signal) in signals.iter().enumerate().filter(|(_, signal)| signal.is_finite()) {
                    let signal = f64::from(signal);
                    let weight = noise.weight(signal);
                    let ranges_m = [position_m * obliquity[first + pixel], BACKGROUND_M];
                    for (sums, range_m) in normal[pixel].iter_mut().zip(ranges_m) {
                        let light = (range_m * range_m).recip();
                        let angle = angle - besides_rad[pixel];
                        let (cosine, sine) = cos_sin(angle - phase_rad(range_m, moment.frequency_hz));
                        sums.add([light * cosine, light * sine, light, 1.0], signal, weight);
                    }
                }
            }
        }
    });
    let fitted: Vec<[Option<Fitted>; 2]> =
        normal.iter().map(|normal| normal.map(|sums| sums.fitted())).collect();
    let amplitude = |pixel: usize| fitted[pixel][0].as_ref().map(|target| target.amplitude);
    let of_target = |pixels: &mut dyn Iterator<Item = usize>| -> Vec<f64> {
        pixels.filter(|&pixel| data.target[pixel]).filter_map(amplitude).collect()
    };
    let usual = median(&mut of_target(&mut (0..count)));
    let geometry = data.geometry();
    let is_bright = |pixel: usize| {
        let around = geometry.beside(pixel).into_iter().chain(geometry.diagonal(pixel)).flatten();
        let seen = of_target(&mut around.into_iter());
        let usual = if seen.is_empty() { usual } else { seen.iter().sum::<f64>() / seen.len() as f64 };
        amplitude(pixel).is_some_and(|amplitude| amplitude > BRIGHT_ENOUGH * usual)
    };
    let is_other = |pixel: usize| {
        let [Some(target), Some(background)] = fitted[pixel] else { return false };
        let is_target = data.target[pixel];
        let (by_mask, other) = if is_target { (target, background) } else { (background, target) };
        let is_better = by_mask.chi2 - other.chi2 > MUCH_BETTER.0 + MUCH_BETTER.1 * by_mask.chi2;
        is_better && (is_target || is_bright(pixel))
    };
    let others: Vec<bool> = (0..count).map(is_other).collect();
    let moved = others.iter().filter(|other| **other).count();
    let shown = || data.target.iter().zip(&others).map(|(target, other)| target ^ other).collect();
    (moved > 0).then(|| (data.with_target(shown()), moved))
}

/// Normal equations of four numbers.
#[derive(Debug, Clone, Copy, Default)]
struct Normal {
    matrix: Matrix4<f64>,
    vector: Vector4<f64>,
    square: f64,
}

/// What the best ones leave, and the amplitude that they say, at 1 m.
#[derive(Debug, Clone, Copy)]
struct Fitted {
    chi2: f64,
    amplitude: f64,
}

impl Normal {
    fn add(&mut self, own: [f64; 4], signal: f64, weight: f64) {
        let own = Vector4::from(own);
        let weighted = weight * own;
        self.matrix += weighted * own.transpose();
        self.vector += weighted * signal;
        self.square += weight * signal * signal;
    }

    /// The best numbers; none where nothing was seen.
    fn fitted(&self) -> Option<Fitted> {
        let scale = self.matrix.norm();
        // Numbers that are none would be looked at for ever.
        if !(scale > 0.0 && scale.is_finite()) {
            return None;
        }
        let solution = self.matrix.svd(true, true).solve(&self.vector, 1e-9 * scale).ok()?;
        let chi2 = self.square - solution.dot(&self.vector);
        Some(Fitted { chi2, amplitude: solution[0].hypot(solution[1]) })
    }
}

/// Sets on either side that a set is compared with.
const NEIGHBOURS: usize = 4;
/// So many times the usual scatter makes a set unlike its neighbours.
const UNLIKE: f64 = 5.0;
/// The usual scatter is never taken for less than this, of what noise makes of a position, or of chi squared a sample.
const LEAST_SCATTER: f64 = 0.01;
/// The encoder's usual noise, m.
const USUAL_JITTER_M: f64 = 0.2e-3;
/// More than this share of all sets is no outlier, but something that must be found.
const FEW: f64 = 0.04;
/// A position error below this is the encoder's noise, m.
const LEAST_JUMP_M: f64 = 1e-3;
/// Jumps of sets at one place, in one recording, are alike if they differ by so many standard deviations at most.
const ALIKE: f64 = 3.0;
/// Chi squared a sample of an outlying set is above its neighbours' by at least so much.
const LEAST_EXCESS: f64 = 0.3;

/// The sets that differ from their neighbours in chi squared, or by a jump of the encoder; none where they are many.
pub fn outlying(series: &Series) -> Vec<usize> {
    let chi2 = |seen: &SetSeen| seen.chi2.0 / seen.chi2.1.max(1) as f64;
    let jump = |seen: &SetSeen| if seen.position.1 > 0.0 { seen.position.0 / seen.position.1 } else { 0.0 };
    // Noise of a position, that of the encoder among it.
    let blur = |seen: &SetSeen| (seen.position.1.max(1e-12).recip() + USUAL_JITTER_M.powi(2)).sqrt();
    let unlike = |value: &dyn Fn(&SetSeen) -> f64,
                  scatter: &dyn Fn(&SetSeen) -> f64,
                  least: f64|
     -> Vec<usize> {
        let sets = &series.sets;
        let difference = |at: usize| {
            let near = at.saturating_sub(NEIGHBOURS)..(at + NEIGHBOURS + 1).min(sets.len());
            let alike = |other: &usize| {
                *other != at
                    && sets[*other].take == sets[at].take
                    && sets[*other].velocity_m_s == sets[at].velocity_m_s
            };
            let mut others: Vec<f64> = near.filter(alike).map(|other| value(&sets[other])).collect();
            // Two neighbours may both be outliers.
            if others.len() < 3 { 0.0 } else { value(&sets[at]) - median(&mut others) }
        };
        let differences: Vec<f64> = (0..sets.len()).map(difference).collect();
        let mut sizes: Vec<f64> =
            differences.iter().zip(sets).map(|(difference, seen)| difference.abs() / scatter(seen)).collect();
        let usual = (1.4826 * median(&mut sizes)).max(LEAST_SCATTER);
        let is_unlike =
            |at: &usize| differences[*at].abs() > (UNLIKE * usual * scatter(&sets[*at])).max(least);
        (0..sets.len()).filter(is_unlike).map(|at| sets[at].number).collect()
    };
    let jumps = unlike(&jump, &blur, LEAST_JUMP_M);
    let mut found = [unlike(&chi2, &|_| 1.0, LEAST_EXCESS), jumps.clone()].concat();
    found.sort_unstable();
    found.dedup();
    // What all sets at one place say is no error of a reading.
    let is_of_place = |this: &SetSeen| {
        let is_there = |other: &&SetSeen| {
            other.number != this.number
                && other.take == this.take
                && other.velocity_m_s == this.velocity_m_s
                && (other.reading_m - this.reading_m).abs() < APART_M
        };
        let is_alike =
            |other: &SetSeen| (jump(other) - jump(this)).abs() < ALIKE * blur(other).hypot(blur(this));
        let mut there = series.sets.iter().filter(is_there).peekable();
        there.peek().is_some() && there.all(is_alike)
    };
    let of_places: Vec<usize> = series
        .sets
        .iter()
        .filter(|seen| jumps.contains(&seen.number) && is_of_place(seen))
        .map(|seen| seen.number)
        .collect();
    found.retain(|number| !of_places.contains(number));
    if found.len() as f64 > FEW * series.sets.len() as f64 { Vec::new() } else { found }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// A rail with an `effect`.
    fn rail(effect: &str) -> Data {
        let size = Geometry { width: 16, height: 12 };
        let recordings = taken(size, 2, &[injection(effect).unwrap()], &["four-rail"]).unwrap();
        Data::of(&recordings, Vec::new()).unwrap()
    }

    /// A position of 0 is at no distance: its light would be infinite, and what is no number was looked at for ever.
    #[test]
    fn a_target_at_no_distance_is_refused_and_no_number_is_no_fit() {
        let size = Geometry { width: 8, height: 6 };
        let mut recordings = taken(size, 2, &[], &["four-rail"]).unwrap();
        recordings[0].sets[3].position_m = Some(0.0);
        let refusal = Data::of(&recordings, Vec::new()).unwrap_err().to_string();
        assert!(
            refusal.contains("sets.csv: position_m = 0 in set 3") && refusal.contains("way out: "),
            "{refusal}"
        );
        let mut normal = Normal::default();
        normal.add([f64::NAN, 1.0, 1.0, 1.0], 1.0, 1.0);
        assert!(normal.fitted().is_none());
        normal.matrix = Matrix4::from_element(f64::INFINITY);
        assert!(normal.fitted().is_none());
    }

    #[test]
    fn a_mask_that_is_off_by_a_column_is_corrected() {
        let data = rail("encoder_offset:offset_m=0");
        let noise = stated_noise(&data);
        assert!(with_mask(&data, noise).is_none());
        let mut shifted = data.target.clone();
        shifted.rotate_right(1);
        let differ = shifted.iter().zip(&data.target).filter(|(a, b)| a != b).count();
        let (mended, moved) = with_mask(&data.with_target(shifted), noise).unwrap();
        assert_eq!((moved, &mended.target), (differ, &data.target));
        assert_eq!(differ, 2 * 10);
    }

    /// Of a rail with so many sets a place, one that is 10 mm off is an outlier, and where all of a place are so it is the place that is: by what they are off,
    /// and by the chi squared that comes of it.
    #[test]
    fn what_all_sets_of_a_place_say_is_no_outlier() {
        let of = |a_place: usize, jumps: &[(usize, f64)]| {
            let noise = |number: usize| 1e-3 * [0.4, -0.7, 0.2, 0.9, -0.5][number % 5];
            let off = |number: usize| jumps.iter().find(|jump| jump.0 == number).map_or(0.0, |jump| jump.1);
            let set = |number: usize| SetSeen {
                number,
                reading_m: 1.0 + 0.1 * (number / a_place) as f64,
                position: (1e6 * (noise(number) + off(number)), 1e6),
                chi2: (100.0 + 1e6 * off(number).powi(2), 100),
                ..SetSeen::default()
            };
            let mut series = Series::default();
            series.sets.extend((0..120).map(set));
            outlying(&series)
        };
        assert_eq!(of(2, &[(40, 0.01)]), [40]);
        assert_eq!(of(2, &[(40, 0.01), (41, 0.01)]), [0; 0]);
        // Not by as much, not at one place, and not all that are there.
        assert_eq!(of(2, &[(40, 0.01), (41, -0.01)]), [40, 41]);
        assert_eq!(of(2, &[(40, 0.01), (45, 0.01)]), [40, 45]);
        assert_eq!(of(3, &[(42, 0.01), (43, 0.01)]), [42, 43]);
        assert_eq!(of(3, &[(42, 0.01), (43, 0.01), (44, 0.011)]), [0; 0]);
        assert_eq!(of(120, &[(40, 0.01), (41, 0.01)]), [40, 41]);
        // Many are none; a place that is off does not count.
        assert_eq!(of(2, &[(40, 0.01), (50, 0.01), (10, 0.01), (20, 0.01), (30, 0.01)]), [0; 0]);
        assert_eq!(of(2, &[(40, 0.01), (41, 0.01), (10, 0.01), (20, 0.01), (30, 0.01)]), [10, 20, 30]);
    }

    /// The background there is three or four times as far as the target comes near: what a pixel sees of this by its edge is soon more than its own light.
    #[test]
    fn a_background_that_sees_a_part_of_the_target_is_no_target() {
        for share in ["0.02", "0.05", "0.15"] {
            let data = rail(&format!("mixed_pixels:target_share={share},background_share={share}"));
            assert!(with_mask(&data, stated_noise(&data)).is_none(), "{share}");
        }
    }
}
