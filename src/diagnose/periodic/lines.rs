//! Lines: what is periodic in time, or in the encoder's reading, with a period that nobody knows beforehand.

use super::lamps::{MAINS_OFF, is_mains};
use crate::diagnose::fitting::gram::Whitened;
use crate::diagnose::reading::data::Data;
use crate::diagnose::statistics::gaps::{gaps, seen_cycles};
use crate::diagnose::statistics::periodogram::{
    ANY, FINENESS, Scan, Sought, Sum, add_powers, chi2, greatest, longest,
};
use std::f64::consts::TAU;

/// What frames and sets say of errors that they share.
#[derive(Debug, Clone, Default)]
pub struct Series {
    /// The frames, in the order in which they were seen.
    pub frames: Vec<FrameSeen>,
    /// The sets, in the order in which they were seen.
    pub sets: Vec<SetSeen>,
    /// From a frame to the next, s.
    pub frame_period_s: f64,
}

/// What a frame says.
#[derive(Debug, Clone, Copy, Default)]
pub struct FrameSeen {
    /// Its recording.
    pub take: usize,
    /// Its start, s.
    pub time_s: f64,
    /// The phase that was commanded, turns.
    pub turns: f64,
    /// Of ambient light.
    pub ambient: Sum,
    /// Of an error of the light's phase, rad.
    pub phase: Sum,
}

/// What a set says.
#[derive(Debug, Clone, Copy, Default)]
pub struct SetSeen {
    /// Its number, over all recordings.
    pub number: usize,
    /// Its recording.
    pub take: usize,
    /// Its start, s.
    pub time_s: f64,
    /// The encoder's reading without its noise, as far as that is known, m.
    pub reading_m: f64,
    /// The carriage's velocity, m/s.
    pub velocity_m_s: f64,
    /// Of an error of the target's position.
    pub position: Sum,
    /// Chi squared, and samples.
    pub chi2: (f64, usize),
}

/// A line.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// Cycles a second, or a metre.
    pub frequency: f64,
    /// Chi squared that it explains.
    pub chi2: f64,
    /// Frequencies that were looked at and could have shown it.
    pub looked: f64,
}

/// Periods of an encoder's error: cycles a metre.
const CYCLES_M: (f64, f64) = (0.6, 250.0);
/// An encoder's error changes less than what it measures, and is seen at more than one of its phases. A line that has one phase at all places, as places on a
/// grid have of some, would take the readings' own noise back out, by a slope of -1.
const OF_ENCODER: Sought = Sought { constant: true, steepest: 0.3, most_alike: 0.5 };
/// Of a line that is seen nearly at rest, so many cycles from frame to frame, all added up, are a drift too.
pub const DRIFT_CYCLES: f64 = 3.0;
/// The same where the line is twice the mains' frequency, which is known beforehand.
pub const MAINS_DRIFT_CYCLES: f64 = 1.5;

impl Series {
    /// With one more frame.
    pub fn with(mut self, data: &Data, whitened: &Whitened) -> Self {
        let moment = &data.takes[whitened.take].moments[whitened.index];
        let frame = whitened.frame;
        let sum = |shape: &[f64]| {
            let mut sum = (0.0, 0.0);
            for ((root, residual), shape) in whitened.roots.iter().zip(whitened.residual).zip(shape) {
                let value = root * shape;
                sum.0 += value * residual;
                sum.1 += value * value;
            }
            sum
        };
        let position = sum(&frame.position);
        let phase = sum(&frame.own[1]);
        self.frame_period_s = moment.frame_period_s;
        self.frames.push(FrameSeen {
            take: whitened.take,
            time_s: moment.time_s,
            turns: (moment.step_rad + moment.offset_rad) / TAU,
            ambient: sum(&frame.ambient),
            phase: (phase.0 / frame.times, phase.1 / frame.times.powi(2)),
        });
        if moment.frame == 0 {
            self.sets.push(SetSeen {
                number: whitened.set,
                take: whitened.take,
                time_s: moment.time_s,
                reading_m: moment.place_m,
                velocity_m_s: moment.velocity_m_s,
                ..SetSeen::default()
            });
        }
        if let Some(seen) = self.sets.last_mut() {
            seen.position.0 += position.0;
            seen.position.1 += position.1;
            seen.chi2.0 += whitened.residual.iter().map(|residual| residual * residual).sum::<f64>();
            seen.chi2.1 += whitened.roots.iter().filter(|root| **root > 0.0).count();
        }
        self
    }

    /// Those of both.
    pub fn and(mut self, other: Self) -> Self {
        self.frame_period_s = self.frame_period_s.max(other.frame_period_s);
        self.frames.extend(other.frames);
        self.sets.extend(other.sets);
        self
    }

    /// The recording whose residuals exceed the noise most.
    pub fn worst_take(&self) -> usize {
        let takes = self.sets.iter().map(|seen| seen.take + 1).max().unwrap_or(0);
        let mut excess = vec![0.0; takes];
        for seen in &self.sets {
            excess[seen.take] += seen.chi2.0 - seen.chi2.1 as f64;
        }
        (0..takes).max_by(|&a, &b| excess[a].total_cmp(&excess[b])).unwrap_or(0)
    }

    /// What the frames of each recording say of the ambient light.
    pub fn by_take(&self) -> Vec<Vec<(f64, Sum)>> {
        let takes = self.frames.iter().map(|frame| frame.take + 1).max().unwrap_or(0);
        let of_take = |take: usize| {
            let frames = self.frames.iter().filter(|frame| frame.take == take);
            frames.map(|frame| (frame.time_s, frame.ambient)).collect()
        };
        (0..takes).map(of_take).collect()
    }

    /// The strongest line of the ambient light in time, with a phase of its own in every recording, Hz.
    pub fn in_time(&self, ends: (f64, f64)) -> Option<Line> {
        // A line that frames see at rest is a drift.
        strongest(&self.by_take(), ends, self.frame_period_s)
    }

    /// Where each recording has a line of the ambient light that is at `frequency_hz` in all, Hz: there or, where it clearly has more, near it.
    pub fn near(&self, frequency_hz: f64) -> Vec<f64> {
        let takes = self.by_take();
        let step = 1.0 / (FINENESS * longest(&takes));
        takes.iter().map(|take| own(take, frequency_hz, step)).collect()
    }

    /// Standard deviation of the amplitude of a line in recording `take`, as a share of the ambient light; nothing where there is none.
    pub fn blur(&self, take: usize) -> Option<f64> {
        let of_take = self.frames.iter().filter(|frame| frame.take == take);
        let information: f64 = of_take.map(|frame| frame.ambient.1).sum();
        (information > 0.0).then(|| blur(information))
    }

    /// The strongest line in the encoder's reading, cycles a metre, and, where it is another one, that of the longest period among those that are as
    /// strong but for what noise makes of them: at places that are nearly evenly apart a line has images that are nearly as strong.
    pub fn in_position(&self) -> Vec<Line> {
        // Recordings at one place see no line.
        let moves = |of: &SetSeen| {
            let far = |seen: &&SetSeen| (seen.reading_m - of.reading_m).abs() > CYCLES_M.1.recip();
            self.sets.iter().filter(|seen| seen.take == of.take).any(|seen| far(&seen))
        };
        let moving = self.sets.iter().filter(|seen| moves(seen));
        let sets: Vec<(f64, Sum)> = moving.map(|seen| (seen.reading_m, seen.position)).collect();
        with_images(sets, CYCLES_M)
    }
}

/// The strongest line of all groups, each with a phase of its own (Lomb 1976, with the information as weights).
///
/// Where frames are a `period` apart: not those that go through whole turns from each frame to the next, or nearly.
pub fn strongest(groups: &[Vec<(f64, Sum)>], ends: (f64, f64), period: f64) -> Option<Line> {
    let scan = Scan::of(groups, ends, ANY)?;
    let lines = moving(&scan, &drifts(groups, period));
    let Scan { low, step, .. } = scan;
    let line = |number: usize| Line {
        frequency: low + number as f64 * step,
        chi2: lines[number],
        looked: lines.len() as f64,
    };
    let best = Some(greatest(&lines)).filter(|&best| best < lines.len()).map(line)?;
    if is_mains(best.frequency) {
        return Some(best);
    }
    // Frames that are evenly apart see frequencies alike whose sum or difference is a multiple of theirs: of these lamps have twice the mains'.
    let is_image =
        |number: &usize| are_alike(best.frequency, line(*number).frequency, period, 2.0 * step * period);
    let as_strong = |number: &usize| lines[*number] > best.chi2 * NEARLY;
    let of_mains = (0..lines.len()).filter(|&number| is_mains(line(number).frequency) && period > 0.0);
    let images = of_mains.filter(is_image).filter(as_strong).map(line);
    Some(images.max_by(|a, b| a.chi2.total_cmp(&b.chi2)).unwrap_or(best))
}

/// Whether frames that are a period (s) apart see two lines (Hz) alike, but for so many `turns` from a frame to the next.
pub fn are_alike(one_hz: f64, other_hz: f64, period_s: f64, turns: f64) -> bool {
    let is_whole = |all: f64| (all - all.round()).abs() < turns;
    is_whole((one_hz + other_hz) * period_s) || is_whole((one_hz - other_hz) * period_s)
}

/// What lines explain that are no drift to frames: chi squared, of each frequency of a scan.
fn moving(Scan { low, step, powers }: &Scan, is_drift: &dyn Fn(f64) -> bool) -> Vec<f64> {
    let power =
        |(number, &power): (usize, &f64)| if is_drift(low + number as f64 * step) { 0.0 } else { power };
    powers.iter().enumerate().map(power).collect()
}

/// Whether a line of a frequency is a drift to frames that are a `period` apart.
fn drifts(groups: &[Vec<(f64, Sum)>], period: f64) -> impl Fn(f64) -> bool {
    let gaps: Vec<Vec<(f64, f64)>> = groups.iter().map(|group| gaps(group)).collect();
    move |frequency| {
        let cycles = if is_mains(frequency) { MAINS_DRIFT_CYCLES } else { DRIFT_CYCLES };
        period > 0.0 && gaps.iter().all(|gaps| seen_cycles(gaps, frequency) < cycles)
    }
}

/// What the strongest line between the `ends` explains, chi squared, wherever it is between the steps of a scan: what lines that frames see alike explain may
/// be compared.
pub fn most_between(groups: &[Vec<(f64, Sum)>], ends: (f64, f64), period: f64) -> f64 {
    let Some(scan) = Scan::of(groups, ends, ANY) else { return 0.0 };
    let is_drift = drifts(groups, period);
    let lines = moving(&scan, &is_drift);
    let finest = |number: usize| {
        let line = finer(groups, &scan, ANY, number);
        if is_drift(line.frequency) { lines[number] } else { line.chi2 }
    };
    peaks(&lines).into_iter().map(finest).fold(0.0, f64::max)
}

/// The numbers of the peaks among `powers` that have nearly the greatest one.
fn peaks(powers: &[f64]) -> Vec<usize> {
    let most = powers.iter().copied().fold(0.0, f64::max);
    let is_peak = |&n: &usize| {
        let beside = [n.checked_sub(1), Some(n + 1)].into_iter().flatten().filter_map(|n| powers.get(n));
        powers[n] > 0.0 && powers[n] >= NEARLY * most && beside.copied().all(|beside| beside <= powers[n])
    };
    (0..powers.len()).filter(is_peak).collect()
}

/// The line at the peak of a scan that has this `number`: one between two steps has a twentieth less there, and so has its image, but at another place
/// between its own.
fn finer(groups: &[Vec<(f64, Sum)>], scan: &Scan, sought: Sought, number: usize) -> Line {
    let step = scan.step / FINER as f64;
    let first = scan.low + (number as f64 - 1.0) * scan.step;
    let mut fine = [0.0; 2 * FINER + 1];
    groups.iter().for_each(|group| add_powers(group, first, step, sought, &mut fine));
    let best = greatest(&fine);
    Line { frequency: first + best as f64 * step, chi2: fine[best], looked: scan.powers.len() as f64 }
}

/// The strongest line of a series, beside a constant (Zechmeister and Kürster 2009: nothing tells how far away the target is but the readings), and that of
/// the longest period among those that are as strong, if it is another one.
fn with_images(group: Vec<(f64, Sum)>, ends: (f64, f64)) -> Vec<Line> {
    let groups = [group];
    let Some(scan) = Scan::of(&groups, ends, OF_ENCODER) else { return Vec::new() };
    let finest = |number| finer(&groups, &scan, OF_ENCODER, number);
    let lines: Vec<Line> = peaks(&scan.powers).into_iter().map(finest).collect();
    let Some(&strongest) = lines.iter().max_by(|a, b| a.chi2.total_cmp(&b.chi2)) else { return lines };
    // Of many images one is stronger by chance.
    let least = strongest.chi2 - AS_STRONG - 2.0 * (lines.len() as f64).ln();
    let longest = lines.into_iter().find(|line| line.chi2 > least);
    let other = longest.filter(|longest| longest.frequency < strongest.frequency);
    std::iter::once(strongest).chain(other).collect()
}

/// Peaks of at least this share of the greatest power are looked at more finely, in so many steps.
const NEARLY: f64 = 0.9;
const FINER: usize = 8;
/// Lines whose chi squared differs by less are as strong: three nats.
const AS_STRONG: f64 = 6.0;

/// Standard deviation of a line's amplitude where there is so much information: sine and cosine have half of it each.
pub fn blur(information: f64) -> f64 {
    (2.0 / information).sqrt()
}

/// Where a group has a line that is at `frequency` in all: there, or near it where this group clearly has more.
fn own(group: &[(f64, Sum)], frequency: f64, step: f64) -> f64 {
    let window = (MAINS_OFF * frequency / step).floor();
    let low = frequency - window * step;
    let mut powers = vec![0.0; 2 * window as usize + 1];
    add_powers(group, low, step, ANY, &mut powers);
    let common = powers[window as usize];
    let best = greatest(&powers);
    let seen = group.iter().filter(|(_, sum)| sum.1 > 0.0).count();
    // More noise than was stated makes more of all frequencies.
    let noise = (chi2(group) / seen.max(1) as f64).max(1.0);
    if powers[best] > common + CLEARLY_MORE * noise { low + best as f64 * step } else { frequency }
}

/// Chi squared by which noise as it was stated hardly ever makes a line stronger nearby.
pub const CLEARLY_MORE: f64 = 25.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::periodic::lamps::FLICKER_HZ;
    use crate::physics::Draws;

    /// Errors, m, at places, which are known to a tenth of a millimetre, less their mean.
    fn group(count: usize, at: &dyn Fn(usize) -> f64, error_m: &dyn Fn(usize) -> f64) -> Vec<(f64, Sum)> {
        let mean = (0..count).map(error_m).sum::<f64>() / count as f64;
        (0..count).map(|n| (at(n), (1e8 * (error_m(n) - mean), 1e8))).collect()
    }

    /// Places nearly evenly apart, as on a rail: the line is found, whatever its place between the steps of frequency, and not one of its images.
    #[test]
    fn a_line_at_places_that_are_nearly_evenly_apart_is_not_its_image() {
        for &(cycles_m, amplitude) in
            [0.75, 1.25, 2.05, 3.33, 5.17].map(|c| [(c, 3.0), (c, 10.0)]).as_flattened()
        {
            for seed in 0..4 {
                let off = Draws::of(seed, 7).normal(51);
                let at = |n: usize| 1.0 + 0.05 * n as f64 + 1e-4 * off[n];
                let noise = Draws::of(seed, 8).normal(51);
                let error_m = |n: usize| 1e-4 * (amplitude * (TAU * cycles_m * at(n)).sin() + noise[n]);
                let group = group(51, &at, &error_m);
                let lines = with_images(group, CYCLES_M);
                let line = lines.last().unwrap();
                assert!((line.frequency - cycles_m).abs() < 0.1, "{cycles_m}: {lines:?}");
            }
        }
    }

    /// Readings on a grid that are off by noise, which the target's places are not: no line takes it back out.
    #[test]
    fn the_readings_own_noise_is_no_line() {
        for seed in 0..8 {
            let off = Draws::of(seed, 7).normal(300);
            let at = |n: usize| 1.0 + 0.05 * (n % 45) as f64 + 1.5e-4 * off[n];
            let noise = Draws::of(seed, 8).normal(300);
            let of_readings = group(300, &at, &|n| 1e-4 * (0.2 * noise[n] - 1.5 * off[n]));
            let found = with_images(of_readings.clone(), CYCLES_M);
            let line = found.first().map_or(0.0, |line| line.chi2);
            assert!(line < 0.1 * chi2(&of_readings), "{line} of {}", chi2(&of_readings));
        }
    }

    /// Frames 25 ms apart see 80.2, 119.8 and 120.2 Hz alike, and 96.9 and 103.1 Hz: what may be twice the mains is.
    #[test]
    fn of_two_images_the_one_at_twice_the_mains_is_a_lamps() {
        // Not quite evenly: which of the images is the strongest is chance.
        let off = Draws::of(9, 4).normal(800);
        let at = |n: usize| 0.025 * n as f64 + 1e-4 * off[n];
        for (hz, stated_hz) in [(119.8, [119.8, 120.2]), (80.2, [119.8, 120.2]), (103.1, [103.1, 96.9])] {
            for seed in 0..6 {
                let noise = Draws::of(seed, 3).normal(800);
                let line = |n: usize| (TAU * hz * at(n) + 1.0).sin() + noise[n];
                let group: Vec<(f64, Sum)> = (0..800).map(|n| (at(n), (line(n), 1.0))).collect();
                let found = strongest(&[group], FLICKER_HZ, 0.025).unwrap();
                assert!(stated_hz.iter().any(|hz| (found.frequency - hz).abs() < 0.05), "{hz}: {found:?}");
            }
        }
    }

    /// Frames 20 ms apart see 100 Hz at rest; sets that are 275 ms apart see it the other way round each time.
    #[test]
    fn a_line_that_sets_see_is_no_drift_though_frames_see_it_at_rest() {
        let hz = 99.998;
        for (between_s, is_seen) in [(0.275, true), (0.28, false)] {
            let at = |n: usize| 0.02 * (n % 4) as f64 + between_s * (n / 4) as f64;
            let group: Vec<(f64, Sum)> =
                (0..400).map(|n| (at(n), ((TAU * hz * at(n) + 1.0).sin(), 1.0))).collect();
            let line = strongest(&[group], FLICKER_HZ, 0.02).unwrap();
            assert_eq!((line.frequency - hz).abs() < 0.01, is_seen, "{between_s}: {line:?}");
        }
    }

    #[test]
    fn a_line_is_found_among_gaps() {
        let at = |n: usize| 0.025 * n as f64 + 0.175 * (n / 4) as f64;
        let group: Vec<(f64, Sum)> =
            (0..400).map(|n| (at(n), ((TAU * 103.1 * at(n) + 1.0).sin(), 1.0))).collect();
        let line = strongest(&[group], (90.0, 112.0), 0.025).unwrap();
        assert!((line.frequency - 103.1).abs() < 0.01, "{line:?}");
        assert!((line.chi2 - 200.0).abs() < 10.0, "{line:?}");
    }
}
