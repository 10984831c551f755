//! Which recordings are taken, and where the carriage is.

use crate::recording::Kind;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::{FRAC_PI_2, TAU};

/// One set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Start from the start of the recording, s.
    pub time_s: f64,
    /// Where the target is, m.
    pub position_m: f64,
    /// What the encoder says, m.
    pub reading_m: f64,
    /// Velocity, m/s.
    pub velocity_m_s: f64,
    /// Phase offset, rad.
    pub offset_rad: f64,
}

/// One recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Take {
    /// The folder's name.
    pub name: String,
    /// What it is for.
    pub kind: Kind,
    /// Commanded phase steps, rad.
    pub steps_rad: Vec<f64>,
    /// From frame to frame, s.
    pub period_s: f64,
    /// The sets.
    pub rows: Vec<Row>,
}

/// What is drawn: lengths of the recordings, 0 where one is not taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Programme {
    /// Whether recordings with four frames are taken, and with the windowed DFT's five.
    pub schemes: [bool; 2],
    /// Phase offsets of a sweep.
    pub offsets: usize,
    /// Positions of a rail recording.
    pub positions: usize,
    /// Runs at each velocity there and back.
    pub runs: usize,
    /// Sets without light.
    pub dark: usize,
    /// Sets of 64 frames.
    pub harmonics: usize,
    /// From frame to frame, s.
    pub period_s: f64,
}

const NEAR_M: f64 = 1.0;
const FAR_M: f64 = 3.5;
const ENCODER_SIGMA_M: f64 = 1e-4;
const ENCODER_STEP_M: f64 = 1e-5;
const SPEEDS_M_S: [f64; 3] = [0.5, 1.0, 2.0];
const RUN_M: f64 = 2.25;
/// The carriage's way back to a run's start, s.
const PAUSE_S: f64 = 1.5;
/// Between still sets, s.
const SETTLE_S: f64 = 0.175;

impl Programme {
    /// The recordings.
    pub fn takes(&self, seed: u64) -> Vec<Take> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let four: Vec<f64> = (0..4).map(|n| f64::from(n) * FRAC_PI_2).collect();
        let windowed: Vec<f64> = (0..5).map(|n| f64::from(n) * TAU / 3.0).collect();
        let many: Vec<f64> = (0..64).map(|n| f64::from(n) * TAU / 64.0).collect();
        let mut takes = Vec::new();
        for ((name, steps_rad), wanted) in [("four", four), ("wdft", windowed)].into_iter().zip(self.schemes)
        {
            if !wanted {
                continue;
            }
            let still: Vec<(f64, f64)> = twice((0..self.offsets).map(|n| (2.0, turn(n, self.offsets))));
            let rail = twice((0..self.positions).map(|n| (between(n, self.positions), 0.0)));
            let dark = vec![(2.0, 0.0); self.dark];
            for (kind, suffix, places) in
                [(Kind::PhaseSweep, "sweep", still), (Kind::Rail, "rail", rail), (Kind::Dark, "dark", dark)]
            {
                if !places.is_empty() {
                    let rows = self.still(&places, steps_rad.len(), &mut random);
                    let name = format!("{name}-{suffix}");
                    takes.push(Take {
                        name,
                        kind,
                        steps_rad: steps_rad.clone(),
                        period_s: self.period_s,
                        rows,
                    });
                }
            }
            if self.runs > 0 {
                let rows = self.motion(steps_rad.len(), &mut random);
                let name = format!("{name}-motion");
                let kind = Kind::Motion;
                takes.push(Take { name, kind, steps_rad: steps_rad.clone(), period_s: self.period_s, rows });
            }
        }
        if self.harmonics > 0 {
            let places: Vec<(f64, f64)> =
                (0..self.harmonics).map(|n| ([1.5, 2.0, 3.0][n % 3], 0.0)).collect();
            let rows = self.still(&places, many.len(), &mut random);
            let name = "harmonics".to_owned();
            takes.push(Take { name, kind: Kind::Harmonics, steps_rad: many, period_s: self.period_s, rows });
        }
        takes.sort_by(|one, other| one.name.cmp(&other.name));
        takes
    }

    /// Sets at the places `(position_m, offset_rad)`.
    fn still(&self, places: &[(f64, f64)], frames: usize, random: &mut ChaCha8Rng) -> Vec<Row> {
        let each_s = frames as f64 * self.period_s + SETTLE_S;
        let row = |(set, &(position_m, offset_rad)): (usize, &(f64, f64))| Row {
            time_s: rounded(set as f64 * each_s, 1e-6),
            position_m,
            reading_m: reading(position_m, random),
            velocity_m_s: 0.0,
            offset_rad,
        };
        places.iter().enumerate().map(row).collect()
    }

    /// Runs there and back at each speed, sets back to back.
    fn motion(&self, frames: usize, random: &mut ChaCha8Rng) -> Vec<Row> {
        let each_s = frames as f64 * self.period_s;
        let (mut rows, mut time_s) = (Vec::new(), 0.0);
        for speed in SPEEDS_M_S {
            for run in 0..2 * self.runs {
                let direction = if run % 2 == 0 { 1.0 } else { -1.0 };
                let begin = random.random_range(0.02..0.2);
                let start_m = if direction > 0.0 { NEAR_M + begin } else { FAR_M - begin };
                for set in 0..(RUN_M / (speed * each_s)) as usize {
                    let position_m = start_m + direction * speed * each_s * set as f64;
                    rows.push(Row {
                        time_s: rounded(time_s, 1e-6),
                        position_m,
                        reading_m: reading(position_m, random),
                        velocity_m_s: direction * speed,
                        offset_rad: 0.0,
                    });
                    time_s += each_s;
                }
                time_s += PAUSE_S;
            }
        }
        rows
    }
}

fn twice(places: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    places.flat_map(|place| [place, place]).collect()
}

fn turn(number: usize, of: usize) -> f64 {
    rounded(TAU * number as f64 / of as f64, 1e-9)
}

fn between(number: usize, of: usize) -> f64 {
    NEAR_M + (FAR_M - NEAR_M) * number as f64 / (of.max(2) - 1) as f64
}

fn reading(position_m: f64, random: &mut ChaCha8Rng) -> f64 {
    let error: f64 = StandardNormal.sample(random);
    rounded(position_m + ENCODER_SIGMA_M * error, ENCODER_STEP_M)
}

fn rounded(value: f64, step: f64) -> f64 {
    // By division with a whole number, so that the decimal that is written is the number that was used.
    let each = (1.0 / step).round();
    (value * each).round() / each
}
