//! Errors that samples share at random: those of a set, a frame, a row, a column, of neighbours, or of each pixel alone.
//!
//! The evidence for a common error of variance s² is ln Z(s²) = Σ [½ s² u² / (1 + s² k) − ½ ln(1 + s² k)] over the clusters, with u
//! a cluster's score and k its information.

use super::jitters::{Frame, Jitters};
use super::levels::{LEVELS, Level, MODES, PHASE, POSITION, VELOCITY};
use super::ripples::Ripples;
use super::swings::{Seen, Swing, Swings};
use super::tones::{Heard, Tone, Tones, WAYS};
use super::waves::{Wave, Waves};
use super::white::White;
use crate::diagnose::fitting::gram::Whitened;
use crate::diagnose::reading::data::Data;
use crate::diagnose::statistics::periodogram::Sum;
use crate::diagnose::statistics::shared_variance::SharedVariance;
use crate::diagnose::statistics::tamed::tamed;
use std::sync::LazyLock;

/// The first levels, of which there are few.
const FEW: usize = 2;
/// The first one of rows and columns whose frames of a set are off together.
const OF_SETS: usize = 6;
const STEPS: usize = 14;
/// Least and greatest standard deviation of each mode; a frame's position is a time, s.
pub const ENDS: [(f64, f64); 6] =
    [(0.03, 100.0), (3e-5, 0.1), (3e-5, 0.1), (1e-5, 0.03), (1e-4, 0.3), (3e-5, 0.1)];

fn variance(mode: usize, step: f64) -> f64 {
    let (low, high) = ENDS[mode];
    (low * (high / low).powf(step / (STEPS - 1) as f64)).powi(2)
}

/// A common error that the data ask for.
#[derive(Debug, Clone, Copy)]
pub struct Cluster {
    /// Which samples share it.
    pub level: Level,
    /// Of [`MODES`].
    pub mode: usize,
    /// Its standard deviation.
    pub sigma: f64,
    /// How exactly that is known, one standard deviation; 0 where it is not looked at: of rows, columns and pixels.
    pub known_to: f64,
    /// By how much it raises the variance of what a cluster says.
    pub inflation: f64,
    /// The same of columns that live where it is seen best: a time of moving frames is an error of the fastest ones above all.
    pub inflation_there: f64,
    /// Evidence, nats.
    pub ln_bayes: f64,
    /// The recording that shows it most.
    pub take: usize,
    /// Of offsets of frames, rows and columns: how correlated they are, in the standard deviations of what white noise makes, where it is
    /// known.
    pub correlation: Option<f64>,
}

/// Of a level and mode: clusters, their information, its square, and the scores' squares beyond what noise makes.
type Informed = [[[f64; 4]; MODES.len()]; LEVELS.len()];
type Curves = [[[f64; STEPS]; MODES.len()]; LEVELS.len()];

/// Evidence of all levels and modes, recording by recording.
#[derive(Debug, Clone, Default)]
pub struct Clusters {
    evidence: Vec<Curves>,
    information: Informed,
    /// What sets and frames say, recording by recording: a few of them that are far off are no effect.
    few: [[Vec<(usize, Sum)>; MODES.len()]; FEW],
    /// Score and information of the set whose frames come just now.
    set: [Sum; MODES.len()],
    /// The same of its rows and columns, of which offsets and gains are looked at.
    lines_of_set: [[Vec<Sum>; 2]; LINES.len()],
    /// Offsets of frames, rows and columns.
    white: [White; OFFSETS.len()],
    /// Offsets of rows and columns.
    waves: [Waves; LINES.len()],
    /// Sets in time.
    swings: Swings,
    /// Frames in time.
    tones: Tones,
    /// Frames over the place.
    pub ripples: Ripples,
    /// Frames' errors of phase and time together.
    pub jitters: Jitters,
}

/// Levels whose offsets are noise where they are white.
pub const OFFSETS: [Level; 3] = [Level::Frame, Level::Row, Level::Column];
/// Levels over which offsets may be a wave, and whose frames of a set may be off together.
const LINES: [Level; 2] = [Level::Row, Level::Column];

impl Clusters {
    /// With the clusters of one more frame; the frames of a set come one after the other.
    pub fn with(mut self, data: &Data, whitened: &Whitened) -> Self {
        self.evidence.resize_with(data.takes.len(), Default::default);
        let geometry = data.geometry();
        let (width, blocks) = (geometry.width, geometry.width.div_ceil(2));
        let (frame, take) = (whitened.frame, &data.takes[whitened.take]);
        let moment = take.moments[whitened.index];
        let velocity_m_s = moment.velocity_m_s;
        // From the middle of the set on, so that another velocity leaves its place where it is.
        let from_middle_s = moment.in_set_s - 0.5 * (take.frames - 1) as f64 * moment.frame_period_s;
        let mut heard = [(0.0, 0.0); MODES.len()];
        let sizes = [1, geometry.height, width, blocks * geometry.height.div_ceil(2), geometry.pixels()];
        for (mode, all) in heard.iter_mut().enumerate() {
            // A set is at another place as a whole; a frame is only if it is taken at another time of a movement.
            if mode == POSITION || mode == VELOCITY {
                let per = if mode == POSITION { 1.0 } else { from_middle_s };
                for pixel in 0..whitened.roots.len() {
                    let value = whitened.roots[pixel] * frame.position[pixel] * per;
                    all.0 += value * whitened.residual[pixel];
                    all.1 += value * value;
                }
                self.set[mode].0 += all.0;
                self.set[mode].1 += all.1;
                if mode == VELOCITY || velocity_m_s == 0.0 {
                    continue;
                }
            }
            // A pixel alone has noise, whatever it is proportional to.
            let levels = if mode < 2 { sizes.len() } else { 1 };
            let mut sums: Vec<_> = sizes[..levels].iter().map(|&size| vec![(0.0, 0.0); size]).collect();
            for pixel in 0..whitened.roots.len() {
                let shape = match mode {
                    0 => 1.0,
                    1 => frame.base[pixel],
                    PHASE => frame.own[1][pixel] / frame.times,
                    POSITION => velocity_m_s * frame.position[pixel],
                    _ => frame.base[pixel] - frame.own[3][pixel] * frame.ambient[pixel],
                };
                let value = whitened.roots[pixel] * shape;
                let (row, column) = (pixel / width, pixel % width);
                for (sums, place) in
                    sums.iter_mut().zip([0, row, column, row / 2 * blocks + column / 2, pixel])
                {
                    sums[place].0 += value * whitened.residual[pixel];
                    sums[place].1 += value * value;
                }
            }
            self.ripples.add(mode, whitened.take, [moment.commanded_m(), moment.position_m], sums[0][0]);
            if mode != POSITION {
                *all = sums[0][0];
                self.set[mode].0 += all.0;
                self.set[mode].1 += all.1;
            }
            if mode == 0 {
                let is_first = whitened.index == 0;
                for (white, sums) in self.white.iter_mut().zip(&sums) {
                    let errors = sums.iter().map(|(score, k)| if *k > 0.0 { score / k.sqrt() } else { 0.0 });
                    white.add(errors.collect(), moment.frame, take.frames, is_first);
                }
                for (waves, sums) in self.waves.iter_mut().zip(&sums[1..]) {
                    waves.add(whitened.take, moment.time_s, moment.frame_period_s, sums);
                }
            }
            for (of_set, sums) in self.lines_of_set.iter_mut().zip(&sums[1..]) {
                join(&mut of_set[mode], sums);
            }
            for (level, sums) in sums.iter().enumerate() {
                inform(&mut self.information[level + 1][mode], sums);
                match level {
                    0 => self.few[1][mode].push((whitened.take, sums[0])),
                    _ => add(&mut self.evidence[whitened.take][level + 1][mode], mode, sums),
                }
            }
        }
        let Whitened { roots, residual, set, .. } = *whitened;
        self.jitters.add(Frame::seen(frame, roots, residual, (whitened.take, set), &moment));
        let at = [moment.offset_rad, moment.commanded_m()];
        if moment.lit {
            let (take, number, time_s) = (whitened.take, (moment.set, moment.frame), moment.time_s);
            let ways = WAYS.map(|mode| heard[mode]);
            self.tones.add(Heard { take, number, time_s, at, ways });
        }
        if (whitened.index + 1).is_multiple_of(take.frames) {
            let sums = std::mem::take(&mut self.set);
            // Without its light the camera has neither gain nor phase.
            let swinging =
                std::array::from_fn(|mode| if mode == 0 || moment.lit { sums[mode] } else { (0.0, 0.0) });
            let (take, number, time_s) = (whitened.take, moment.set, moment.time_s);
            self.swings.add(Seen { take, number, time_s, at, modes: swinging });
            for (mode, sum) in sums.into_iter().enumerate() {
                inform(&mut self.information[0][mode], &[sum]);
                self.few[0][mode].push((whitened.take, sum));
            }
            for (line, modes) in std::mem::take(&mut self.lines_of_set).iter().enumerate() {
                for (mode, sums) in modes.iter().enumerate() {
                    inform(&mut self.information[OF_SETS + line][mode], sums);
                    add(&mut self.evidence[whitened.take][OF_SETS + line][mode], mode, sums);
                }
            }
        }
        self
    }

    /// Those of both.
    pub fn and(mut self, other: Self) -> Self {
        if self.evidence.len() < other.evidence.len() {
            self.evidence.resize_with(other.evidence.len(), Default::default);
        }
        for (curves, others) in self.evidence.iter_mut().zip(other.evidence) {
            for (sum, other) in
                curves.iter_mut().flatten().flatten().zip(others.into_iter().flatten().flatten())
            {
                *sum += other;
            }
        }
        for (sum, other) in self.information.iter_mut().flatten().zip(other.information.into_iter().flatten())
        {
            sum.iter_mut().zip(other).for_each(|(sum, other)| *sum += other);
        }
        for (few, others) in self.few.iter_mut().flatten().zip(other.few.into_iter().flatten()) {
            few.extend(others);
        }
        self.white = std::array::from_fn(|level| self.white[level].clone().and(&other.white[level]));
        let [rows, columns] = self.waves;
        let [more_rows, more_columns] = other.waves;
        self.waves = [rows.and(more_rows), columns.and(more_columns)];
        self.swings = self.swings.and(other.swings);
        self.tones = self.tones.and(other.tones);
        self.ripples = self.ripples.and(other.ripples);
        self.jitters = self.jitters.and(other.jitters);
        self
    }

    /// The strongest waves over rows and over columns.
    pub fn waves(&self) -> Vec<(Level, Wave)> {
        let of = |(waves, level): (&Waves, Level)| Some((level, waves.strongest()?));
        self.waves.iter().zip(LINES).filter_map(of).collect()
    }

    /// The strongest swings of sets in time.
    pub fn swings(&self) -> Vec<Swing> {
        self.swings.strongest()
    }

    /// The strongest tone of frames in time.
    pub fn tone(&self) -> Option<Tone> {
        self.tones.strongest()
    }

    /// Evidence with that of sets and frames.
    fn with_few(&self) -> Vec<Curves> {
        let mut evidence = self.evidence.clone();
        for (level, modes) in self.few.iter().enumerate() {
            for (mode, few) in modes.iter().enumerate() {
                let mut by_take = vec![Vec::new(); evidence.len()];
                tamed(few).into_iter().for_each(|(take, sum)| by_take[take].push(sum));
                for (curves, sums) in evidence.iter_mut().zip(by_take) {
                    add(&mut curves[level][mode], mode, &sums);
                }
            }
        }
        evidence
    }

    /// Standard deviation by the scores' variance, and how exactly it is known: a score's square scatters by twice the square of what it is on
    /// average.
    fn moment(&self, level: usize, mode: usize) -> (f64, f64) {
        let [_, _, squares, beyond] = self.information[level][mode];
        let variance = if squares > 0.0 { (beyond / squares).max(0.0) } else { 0.0 };
        if variance == 0.0 {
            return (0.0, 0.0);
        }
        let scatter = |&(_, (_, k)): &(usize, Sum)| 2.0 * (k + variance * k * k).powi(2);
        let scatter: f64 = self.few[level][mode].iter().map(scatter).sum();
        (variance.sqrt(), 0.5 * scatter.sqrt() / squares / variance.sqrt())
    }

    /// The best of every level and mode that has any evidence, best first.
    pub fn ranked(&self) -> Vec<Cluster> {
        let evidence = self.with_few();
        let mut found = Vec::new();
        for (number, level) in LEVELS.into_iter().enumerate() {
            for mode in 0..MODES.len() {
                let at = |step: usize| evidence.iter().map(|take| take[number][mode][step]).sum::<f64>();
                let best = (0..STEPS).max_by(|&a, &b| at(a).total_cmp(&at(b))).unwrap_or(0);
                let spread = peak(best, &at);
                let of_take = |take: &usize| evidence[*take][number][mode][best];
                let take = (0..evidence.len()).max_by(|a, b| of_take(a).total_cmp(&of_take(b)));
                let [count, information, squares, _] = self.information[number][mode];
                // What is tamed must not say how strong it is.
                let (sigma, known_to) = match level {
                    Level::Set | Level::Frame => self.moment(number, mode),
                    _ => (variance(mode, spread).sqrt(), 0.0),
                };
                found.push(Cluster {
                    level,
                    mode,
                    sigma,
                    known_to,
                    inflation: 1.0 + variance(mode, spread) * information / count.max(1.0),
                    inflation_there: 1.0
                        + variance(mode, spread) * squares / information.max(f64::MIN_POSITIVE),
                    ln_bayes: at(best),
                    take: take.unwrap_or(0),
                    correlation: match OFFSETS.iter().position(|offset| *offset == level) {
                        Some(place) if mode == 0 => self.white[place].correlation(),
                        _ => None,
                    },
                });
            }
        }
        found.retain(|cluster| cluster.ln_bayes > 0.0);
        found.sort_by(|a, b| b.ln_bayes.total_cmp(&a.ln_bayes));
        found
    }
}

/// Where the evidence is greatest, between the steps: by the parabola through the best one and its neighbours.
fn peak(best: usize, at: &dyn Fn(usize) -> f64) -> f64 {
    if best == 0 || best + 1 == STEPS {
        return best as f64;
    }
    let (left, middle, right) = (at(best - 1), at(best), at(best + 1));
    let bend = left - 2.0 * middle + right;
    best as f64 + if bend < 0.0 { 0.5 * (left - right) / bend } else { 0.0 }
}

/// Sums of a frame's lines with those of the frames before it.
fn join(of_set: &mut Vec<Sum>, of_frame: &[Sum]) {
    of_set.resize(of_frame.len(), (0.0, 0.0));
    of_set.iter_mut().zip(of_frame).for_each(|(all, sum)| *all = (all.0 + sum.0, all.1 + sum.1));
}

fn inform(informed: &mut [f64; 4], sums: &[Sum]) {
    for &(score, information) in sums.iter().filter(|sum| sum.1 > 0.0) {
        informed[0] += 1.0;
        informed[1] += information;
        informed[2] += information * information;
        informed[3] += score * score - information;
    }
}

fn add(curve: &mut [f64; STEPS], mode: usize, sums: &[Sum]) {
    let clusters = SharedVariance::of(sums);
    for (evidence, variance) in curve.iter_mut().zip(VARIANCES[mode]) {
        *evidence += clusters.evidence(variance);
    }
}

/// Variances of all modes, step by step.
static VARIANCES: LazyLock<[[f64; STEPS]; MODES.len()]> =
    LazyLock::new(|| std::array::from_fn(|mode| std::array::from_fn(|step| variance(mode, step as f64))));

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_seen_in_a_few_frames_raises_columns_of_these() {
        // A time of moving frames: a quarter of them, ten times as fast, have a hundred times the information. All are off by one standard deviation.
        let (variance, slow, fast): (f64, f64, f64) = (4e-6, 1e4, 1e6);
        let mut clusters = Clusters { evidence: vec![Curves::default()], ..Clusters::default() };
        for number in 0..400 {
            let information: f64 = if number % 4 == 0 { fast } else { slow };
            let error = [variance.sqrt(), -variance.sqrt()][number / 4 % 2];
            let sum = (information * error, information);
            inform(&mut clusters.information[1][POSITION], &[sum]);
            clusters.few[1][POSITION].push((0, sum));
        }
        let found = clusters.ranked();
        let Cluster { inflation, inflation_there, .. } = found[0];
        assert_eq!((found[0].level, found[0].mode), (Level::Frame, POSITION));
        // Of a column that goes with the velocity it raises the variance by the information's mean, weighted by itself.
        let ratio = 4.0 * (fast * fast + 3.0 * slow * slow) / (fast + 3.0 * slow).powi(2);
        assert!(inflation > 1.3 && inflation < 1.0 + variance * fast, "{inflation}");
        assert!(
            ((inflation_there - 1.0) / (inflation - 1.0) - ratio).abs() < 1e-9 * ratio,
            "{inflation_there}"
        );
    }
}
