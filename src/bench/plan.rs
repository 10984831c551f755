//! The recordings of a campaign: what is taken, where, when, how fast.

use super::course::Course;
use crate::physics::{Draws, FREQUENCY_HZ};
use crate::problem::{Problem, Result};
use crate::recording::{Kind, SetRow};
use crate::spec::{Scheme, scheme};
use std::f64::consts::TAU;

/// How a campaign is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// Modulation frequency, Hz, > 0.
    pub frequency_hz: f64,
    /// From the start of a frame to the start of the next within a set, s, > 0.
    pub frame_period_s: f64,
    /// Draws where runs start, and the encoder's noise.
    pub seed: u64,
}

/// Schemes by what recordings of them are called.
const SCHEMES: [(&str, &str); 2] = [("four", "four_frame"), ("wdft", "wdft")];
/// Kinds by the same.
const KINDS: [(&str, Kind); 4] =
    [("sweep", Kind::PhaseSweep), ("rail", Kind::Rail), ("motion", Kind::Motion), ("dark", Kind::Dark)];
/// The recording that needs no scheme.
const HARMONICS: &str = "harmonics";

/// Standard deviation of the encoder's reading, m, and its unit.
const ENCODER_NOISE_M: f64 = 0.15e-3;
const ENCODER_UNIT_M: f64 = 1e-5;
/// Frame periods between two sets of a target that stands.
const PAUSE_PERIODS: f64 = 7.0;
const REPEATS: usize = 2;
const SWEEP_OFFSETS: usize = 48;
const STILL_M: f64 = 2.0;
/// Number of positions on the rail, the first of them, and from one to the next.
const RAIL: (usize, f64, f64) = (51, 1.0, 0.05);
const VELOCITIES_M_S: [f64; 6] = [0.5, -0.5, 1.0, -1.0, 2.0, -2.0];
const RUNS: usize = 3;
const RUN_M: f64 = 2.25;
/// Where runs away from the camera and towards it begin, within so many metres.
const RUN_STARTS_M: (f64, f64) = (1.0, 3.4);
const RUN_START_WITHIN_M: f64 = 0.05;
/// What the carriage takes to go back, s.
const RETURN_S: f64 = 2.0;
const DARK_SETS: usize = 40;
const HARMONICS_FRAMES: usize = 64;
const HARMONICS_AT_M: [f64; 3] = [1.5, 2.0, 3.0];

impl Plan {
    /// At the usual frequency, 40 frames a second.
    pub const fn usual(seed: u64) -> Self {
        Self { frequency_hz: FREQUENCY_HZ, frame_period_s: 0.025, seed }
    }

    /// What recordings are called, all of them.
    pub fn names() -> Vec<String> {
        let of_scheme = |(scheme, _): (&'static str, _)| KINDS.map(|(kind, _)| format!("{scheme}-{kind}"));
        SCHEMES.into_iter().flat_map(of_scheme).chain([HARMONICS.to_owned()]).collect()
    }

    /// The course of the recording called `name`, its positions without the encoder's noise.
    ///
    /// # Errors
    /// A name that is not one of [`Plan::names`], and a frame period so long that a moving target leaves the rail within a set.
    pub fn course(&self, name: &str) -> Result<Course> {
        let parts = name.split_once('-').unwrap_or((name, ""));
        let scheme_named =
            SCHEMES.iter().find(|(short, _)| *short == parts.0).and_then(|(_, full)| scheme(full));
        let kind = KINDS.iter().find(|(short, _)| *short == parts.1).map(|(_, kind)| *kind);
        match (scheme_named, kind) {
            (Some(scheme), Some(Kind::Motion))
                if self.frame_period_s > self.longest_period_s(scheme.steps()) =>
            {
                // Rounded down, so that what is said fits.
                let longest_s = (1e6 * self.longest_period_s(scheme.steps())).floor() / 1e6;
                let found =
                    format!("{}: the target of {name} leaves the rail within a set", self.frame_period_s);
                Err(Problem::at("--frame-period-s", found)
                    .expected(format_args!("at most {longest_s} s"))
                    .remedy("take frames faster, or leave the recording out (--recordings)"))
            }
            (Some(scheme), Some(kind)) => Ok(self.of_kind(scheme, kind)),
            _ if name == HARMONICS => Ok(self.harmonics()),
            _ => Err(Problem::at("--recordings", format_args!("{name} is none"))
                .expected(Self::names().join(", "))),
        }
    }

    fn of_kind(&self, scheme: &Scheme, kind: Kind) -> Course {
        let steps_rad: Vec<f64> = match scheme.equal_step() {
            Some(step) => (0..scheme.steps()).map(|n| n as f64 * step.rad()).collect(),
            None => (0..scheme.steps()).map(|n| scheme.angle_rad(n)).collect(),
        };
        let places: Vec<(f64, f64)> = match kind {
            Kind::PhaseSweep => {
                let offsets = 0..SWEEP_OFFSETS;
                offsets.map(|n| (STILL_M, n as f64 * TAU / SWEEP_OFFSETS as f64)).collect()
            }
            Kind::Dark => vec![(STILL_M, 0.0); DARK_SETS / REPEATS],
            _ => (0..RAIL.0).map(|n| (RAIL.1 + n as f64 * RAIL.2, 0.0)).collect(),
        };
        let frames = steps_rad.len();
        let sets = match kind {
            Kind::Motion => self.runs(frames),
            _ => self.still(frames, &places, REPEATS),
        };
        self.of(kind, steps_rad, sets)
    }

    fn harmonics(&self) -> Course {
        let step_rad = TAU / HARMONICS_FRAMES as f64;
        let places = HARMONICS_AT_M.map(|position_m| (position_m, 0.0));
        let sets = self.still(HARMONICS_FRAMES, &places, 2 * REPEATS);
        self.of(Kind::Harmonics, (0..HARMONICS_FRAMES).map(|n| n as f64 * step_rad).collect(), sets)
    }

    fn of(&self, kind: Kind, steps_rad: Vec<f64>, sets: Vec<SetRow>) -> Course {
        let Self { frequency_hz, frame_period_s, .. } = *self;
        Course { kind, frequency_hz, steps_rad, frame_period_s, sets, frame_times_s: None }
    }

    /// Sets at (position, offset), each some times, with a pause after each.
    fn still(&self, frames: usize, places: &[(f64, f64)], repeats: usize) -> Vec<SetRow> {
        let set_s = (frames as f64 + PAUSE_PERIODS) * self.frame_period_s;
        let repeated = places.iter().flat_map(|place| std::iter::repeat_n(*place, repeats));
        repeated
            .enumerate()
            .map(|(set, (position_m, phase_offset_rad))| SetRow {
                time_s: set as f64 * set_s,
                position_m: Some(position_m),
                phase_offset_rad,
                ..SetRow::default()
            })
            .collect()
    }

    /// Where each run starts, m, and its velocity, m/s.
    fn run_starts(&self) -> Vec<(f64, f64)> {
        let mut draws = Draws::of(self.seed, u64::MAX - 1);
        let start = |velocity_m_s: f64| {
            let drawn_m = RUN_START_WITHIN_M * draws.even();
            let away = velocity_m_s > 0.0;
            (if away { RUN_STARTS_M.0 + drawn_m } else { RUN_STARTS_M.1 - drawn_m }, velocity_m_s)
        };
        VELOCITIES_M_S.into_iter().flat_map(|velocity| [velocity; RUNS]).map(start).collect()
    }

    /// The longest frame period at which every frame of every run is on the rail, s. A run of several sets is no longer than
    /// [`RUN_M`]; one of a single set ends with its last frame.
    fn longest_period_s(&self, frames: usize) -> f64 {
        let (near_m, far_m) = (RAIL.1, RAIL.1 + (RAIL.0 - 1) as f64 * RAIL.2);
        let longest_s = |(start_m, velocity_m_s): (f64, f64)| {
            let room_m = if velocity_m_s > 0.0 { far_m - start_m } else { start_m - near_m };
            room_m / (velocity_m_s.abs() * (frames - 1) as f64)
        };
        self.run_starts().into_iter().map(longest_s).fold(f64::INFINITY, f64::min)
    }

    /// Runs at constant velocity, sets back to back.
    fn runs(&self, frames: usize) -> Vec<SetRow> {
        let set_s = frames as f64 * self.frame_period_s;
        let (mut sets, mut start_s) = (Vec::new(), 0.0);
        for (start_m, velocity_m_s) in self.run_starts() {
            // The distance that a run has is a whole number of sets but for rounding.
            let count = ((RUN_M / (velocity_m_s.abs() * set_s) + 1e-9).floor() as usize).max(1);
            sets.extend((0..count).map(|set| SetRow {
                time_s: start_s + set as f64 * set_s,
                position_m: Some(start_m + velocity_m_s * set as f64 * set_s),
                velocity_m_s,
                ..SetRow::default()
            }));
            start_s += count as f64 * set_s + RETURN_S;
        }
        sets
    }

    /// The rows of `course` as its encoder reads them; `recording` is the recording's number in the campaign.
    pub fn as_read(&self, course: &Course, recording: u32) -> Vec<SetRow> {
        let noise =
            Draws::of(self.seed, (u64::from(recording) << 32) | 0xffff_ffff).normal(course.sets.len());
        let read = |position_m: f64, draw: f64| {
            ((position_m + ENCODER_NOISE_M * draw) / ENCODER_UNIT_M).round() * ENCODER_UNIT_M
        };
        let rows = course.sets.iter().zip(noise);
        rows.map(|(row, draw)| SetRow { position_m: row.position_m.map(|m| read(m, draw)), ..row.clone() })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: Plan = Plan::usual(1);

    #[test]
    fn every_recording_has_a_course() {
        let sets = |name: &str| PLAN.course(name).unwrap().sets.len();
        let counts: Vec<usize> = Plan::names().iter().map(|name| sets(name)).collect();
        // 48 offsets and 51 positions twice; three runs of 2.25 m at ±0.5, ±1 and ±2 m/s in sets of 100 and 125 ms.
        assert_eq!(counts, [96, 102, 468, 40, 96, 102, 378, 40, 12]);
        let refusal = PLAN.course("four-rails").unwrap_err().to_string();
        assert!(refusal.contains("four-rails is none\n  expected: four-sweep, four-rail"), "{refusal}");
    }

    #[test]
    fn runs_keep_their_velocity_and_their_place_on_the_rail() {
        for name in ["four-motion", "wdft-motion"] {
            let sets = PLAN.course(name).unwrap().sets;
            for two in sets.windows(2) {
                let took_s = two[1].time_s - two[0].time_s;
                let moved_m = two[1].position_m.unwrap() - two[0].position_m.unwrap();
                assert!(took_s > RETURN_S || (moved_m - two[0].velocity_m_s * took_s).abs() < 1e-9);
            }
            assert!(sets.iter().all(|row| (1.0..=3.4).contains(&row.position_m.unwrap())));
        }
    }

    /// Up to the period that the refusal names every frame is on the rail; a little beyond, one would not be.
    #[test]
    fn a_period_in_which_the_target_leaves_the_rail_is_refused() {
        for name in ["four-motion", "wdft-motion"] {
            let at = |frame_period_s| Plan { frame_period_s, ..PLAN }.course(name);
            let refusal = at(1.0).unwrap_err().to_string();
            let named = refusal.split("at most ").nth(1).and_then(|rest| rest.split(' ').next());
            let longest_s: f64 = named.unwrap().parse().unwrap();
            for period_s in [1e-4, 0.025, 0.1, 0.15, 0.2, 0.9 * longest_s, longest_s] {
                for moment in at(period_s).unwrap().moments() {
                    assert!((1.0..=3.5).contains(&moment.commanded_m()), "{name}, {period_s} s: {moment:?}");
                }
            }
            assert!(at(longest_s + 2e-6).unwrap_err().to_string().contains("leaves the rail"), "{refusal}");
            // What is refused there would have been beyond the rail's end.
            let plan = Plan { frame_period_s: longest_s + 2e-6, ..PLAN };
            let frames = at(0.025).unwrap().frames();
            let last = |row: &SetRow| {
                row.position_m.unwrap() + row.velocity_m_s * (frames - 1) as f64 * plan.frame_period_s
            };
            assert!(plan.runs(frames).iter().any(|row| !(1.0..=3.5).contains(&last(row))));
        }
        assert!(Plan { frame_period_s: 1.0, ..PLAN }.course("four-rail").is_ok());
    }

    #[test]
    fn the_encoder_is_read_with_its_noise() {
        let course = PLAN.course("four-motion").unwrap();
        let read = PLAN.as_read(&course, 3);
        let pairs = course.sets.iter().zip(&read).map(|(a, b)| b.position_m.unwrap() - a.position_m.unwrap());
        let errors_m: Vec<f64> = pairs.collect();
        let rms_m = (errors_m.iter().map(|e| e * e).sum::<f64>() / errors_m.len() as f64).sqrt();
        assert!((rms_m / ENCODER_NOISE_M - 1.0).abs() < 0.15, "{rms_m}");
        assert_ne!(read, PLAN.as_read(&course, 4));
    }
}
