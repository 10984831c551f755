//! When, where and how the frames of a recording are taken.

use crate::physics::Moment;
use crate::problem::{Problem, Result};
use crate::recording::{Kind, Recording, SetRow};

/// The frames of a recording, without their codes.
#[derive(Debug, Clone, PartialEq)]
pub struct Course {
    /// What is recorded.
    pub kind: Kind,
    /// Modulation frequency, Hz.
    pub frequency_hz: f64,
    /// The phase step of each frame of a set, rad, without the set's offset.
    pub steps_rad: Vec<f64>,
    /// From the start of a frame to the start of the next within a set, s.
    pub frame_period_s: f64,
    /// One row a set.
    pub sets: Vec<SetRow>,
    /// Start of each frame `[set, frame]`, s, where they are not evenly spaced.
    pub frame_times_s: Option<Vec<f64>>,
}

/// Where a frame has no position, m: a dark one, of which no light comes, or one of a scene that stands still.
const NO_POSITION_M: f64 = 1.0;

impl Course {
    /// The course of `recording`.
    ///
    /// # Errors
    /// A set with light and without a position, of which nothing can be simulated.
    pub fn of(recording: &Recording) -> Result<Self> {
        let course = Self::still(recording);
        match course.sets.iter().position(|row| row.position_m.is_none() && course.lit()) {
            None => Ok(course),
            Some(set) => Err(Problem::in_file(
                &recording.folder.join("sets.csv"),
                format_args!("set {set} has no position_m"),
            )
            .expected("the target's distance in m, in every set that has light")
            .remedy("leave the set out, or set the recording's kind to dark")),
        }
    }

    /// The course of a `recording` whose sets need no position: of a scene that stands still, wherever it is.
    pub fn still(recording: &Recording) -> Self {
        Self {
            kind: recording.kind,
            frequency_hz: recording.frequency_hz,
            steps_rad: recording.steps_rad.clone(),
            frame_period_s: recording.frame_period_s,
            sets: recording.sets.clone(),
            frame_times_s: recording.frame_times_s.clone(),
        }
    }

    /// Whether the camera's light is on.
    pub fn lit(&self) -> bool {
        self.kind != Kind::Dark
    }

    /// Frames a set.
    pub fn frames(&self) -> usize {
        self.steps_rad.len()
    }

    /// All frames.
    pub fn count(&self) -> usize {
        self.sets.len() * self.frames()
    }

    /// Start of frame number `index` of all, s.
    fn start_s(&self, index: usize) -> f64 {
        let (set, frame) = (index / self.frames(), index % self.frames());
        match &self.frame_times_s {
            Some(times_s) => times_s[index],
            None => self.sets[set].time_s + frame as f64 * self.frame_period_s,
        }
    }

    /// Frame number `index` of all (below [`Course::count`]), in the order `[set, frame]`.
    pub fn moment(&self, index: usize) -> Moment {
        let (set, frame) = (index / self.frames(), index % self.frames());
        let (row, time_s) = (&self.sets[set], self.start_s(index));
        Moment {
            set,
            frame,
            frames: self.frames(),
            time_s,
            in_set_s: time_s - row.time_s,
            frame_period_s: self.frame_period_s,
            step_rad: self.steps_rad[frame],
            offset_rad: row.phase_offset_rad,
            position_m: row.position_m.unwrap_or(NO_POSITION_M),
            place_m: row.position_m.unwrap_or(NO_POSITION_M),
            velocity_m_s: row.velocity_m_s,
            frequency_hz: self.frequency_hz,
            lit: self.lit(),
            transmission: 1.0,
        }
    }

    /// Every frame, in the order `[set, frame]`.
    pub fn moments(&self) -> Vec<Moment> {
        (0..self.count()).map(|index| self.moment(index)).collect()
    }
}

/// Every frame of `recording` as the simulator takes it, in the order `[set, frame]`.
///
/// # Errors
/// As [`Course::of`].
pub fn moments(recording: &Recording) -> Result<Vec<Moment>> {
    Ok(Course::of(recording)?.moments())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frames::{Geometry, RawSets};

    fn recording() -> Recording {
        let row = |time_s, position_m| SetRow {
            time_s,
            position_m,
            velocity_m_s: -0.5,
            phase_offset_rad: 0.25,
            extra: Vec::new(),
        };
        Recording {
            folder: "campaign/four-motion".into(),
            name: "four-motion".to_owned(),
            kind: Kind::Motion,
            frequency_hz: 30e6,
            steps_rad: vec![0.0, 1.5],
            frame_period_s: 0.025,
            raw: RawSets::new(Geometry { width: 1, height: 1 }, 2, vec![0; 6]).unwrap(),
            sets: vec![row(1.0, Some(2.0)), row(1.05, Some(1.9)), row(1.2, Some(1.8))],
            extra_columns: Vec::new(),
            mask: None,
            frame_times_s: None,
            camera: None,
        }
    }

    #[test]
    fn a_recordings_frames_are_the_simulators_moments() {
        let moments = moments(&recording()).unwrap();
        let places: Vec<_> = moments.iter().map(|m| (m.set, m.frame)).collect();
        assert_eq!(places, [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (2, 1)]);
        // A period before the set's first frame, where the target is: a step of 1.5 rad before it, the set's last one, or the last one of the set before.
        let before = Moment::before(4, |index| moments[index]);
        assert_eq!(
            before.map(|before| (before.set, before.step_rad, before.position_m)),
            [(2, -1.5, 1.8), (2, 1.5, 1.8), (1, 1.5, 1.9)]
        );
        let before = before[0];
        assert!((before.time_s - 1.175).abs() < 1e-12 && (before.in_set_s + 0.025).abs() < 1e-12);
        assert_eq!(Moment::before(5, |index| moments[index]), [moments[4]; 3]);
        let last = moments[5];
        assert_eq!((last.position_m, last.velocity_m_s, last.offset_rad), (1.8, -0.5, 0.25));
        assert_eq!((last.step_rad, last.frames, last.lit, last.frequency_hz), (1.5, 2, true, 30e6));
        assert!((last.time_s - 1.225).abs() < 1e-12 && (last.in_set_s - 0.025).abs() < 1e-12);
    }

    #[test]
    fn recorded_times_count_and_dark_frames_need_no_position() {
        let mut recording = recording();
        recording.frame_times_s = Some(vec![1.0, 1.03, 1.05, 1.10, 1.2, 1.24]);
        let late = &moments(&recording).unwrap()[3];
        assert_eq!(late.time_s, 1.10);
        recording.sets[1].position_m = None;
        let refusal = moments(&recording).unwrap_err().to_string();
        assert!(refusal.starts_with("campaign/four-motion/sets.csv: set 1 has no position_m"), "{refusal}");
        recording.kind = Kind::Dark;
        let moments = moments(&recording).unwrap();
        assert!(moments.iter().all(|m| !m.lit && m.position_m > 0.0));
    }
}
