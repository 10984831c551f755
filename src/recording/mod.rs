//! Recordings in the format `vuris-recording/1`: read with every file checked, matched with hardware, written.
//!
//! A recording is a folder: `recording.toml` (how it was taken), `frames.npy` (raw codes), `sets.csv` (where the target
//! was), and optionally `mask.npy` and `frames.csv`. A campaign is a folder of recordings of one camera, with one
//! `camera.toml`. Keys that this program does not know are tolerated, since other programs write these files too.

pub mod arrays;
mod camera;
mod codes;
mod description;
mod frame_times;
mod kind;
pub mod matching;
mod npy;
mod plain_dft;
mod sets;
mod staging;
mod table;
mod write;

pub use camera::{AXIAL_MOTION, BASELINE, Camera, INVERSE_SQUARE_FALLOFF, effect_name};
pub use codes::MOST_BITS;
pub use kind::Kind;
pub use npy::{Codes, read as read_npy};
pub use sets::SetRow;
pub use staging::Staging;
pub use write::{write_camera, write_campaign, write_recording, write_recording_with_camera};

use crate::frames::{Geometry, RawSets};
use crate::problem::{Problem, Result};
use std::path::{Path, PathBuf};

/// The files without which there is no recording.
const REQUIRED: [&str; 3] = ["recording.toml", "frames.npy", "sets.csv"];
/// What a recording's folder may have: those, and the mask.
pub const FILES: [&str; 4] = [REQUIRED[0], REQUIRED[1], REQUIRED[2], "mask.npy"];
/// The same in words, for refusals.
const CONTENTS: &str = "a recording: a folder with recording.toml, frames.npy and sets.csv";

/// A recording that has been read and checked: shapes agree, numbers are finite, codes fit the ADC.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// The folder, as it was given; refusals name it.
    pub folder: PathBuf,
    /// The folder's own name.
    pub name: String,
    /// What was recorded.
    pub kind: Kind,
    /// Modulation frequency, Hz, 10 kHz to 10 GHz.
    pub frequency_hz: f64,
    /// The phase step of each of a set's N frames, rad, without the set's phase offset; not wrapped.
    pub steps_rad: Vec<f64>,
    /// From the start of one frame to the start of the next within a set, s.
    pub frame_period_s: f64,
    /// Raw codes `[set, frame, row, column]`, DN.
    pub raw: RawSets,
    /// One row a set.
    pub sets: Vec<SetRow>,
    /// Names of the columns of `sets.csv` beyond the format's; the cells are in [`SetRow::extra`].
    pub extra_columns: Vec<String>,
    /// `[row, column]`: whether the pixel sees the target; where absent, all do.
    pub mask: Option<Vec<bool>>,
    /// Start of each frame `[set, frame]`, s, from the start of the recording, where `frames.csv` gives it.
    pub frame_times_s: Option<Vec<f64>>,
    /// What is known of the camera.
    pub camera: Option<Camera>,
}

impl Recording {
    /// Reads the recording in `folder`, with the camera of its own or its campaign's `camera.toml`.
    ///
    /// # Errors
    /// Any file that is missing, malformed, out of range or in disagreement with another one.
    pub fn open(folder: &Path) -> Result<Self> {
        let metadata = std::fs::metadata(folder)
            .map_err(|error| Problem::io(folder, "open", &error).expected(CONTENTS))?;
        if !metadata.is_dir() {
            return Err(Problem::in_file(folder, "is not a folder").expected(CONTENTS));
        }
        if let Some(missing) = REQUIRED.iter().find(|file| !folder.join(file).exists()) {
            return Err(not_a_recording(folder, missing));
        }
        let description = description::read(&folder.join("recording.toml"))?;
        let frames_per_set = description.steps_rad.len();
        let camera = Camera::of_recording(folder)?;
        let raw = codes::read_frames(&folder.join("frames.npy"), frames_per_set, camera.as_ref())?;
        let (sets, extra_columns) = sets::read(&folder.join("sets.csv"), raw.sets())?;
        let mask = match folder.join("mask.npy") {
            path if path.exists() => Some(codes::read_mask(&path, raw.geometry())?),
            _ => None,
        };
        let frame_times_s = match folder.join("frames.csv") {
            path if path.exists() => Some(frame_times::read(&path, raw.sets(), frames_per_set)?),
            _ => None,
        };
        Ok(Self {
            folder: folder.to_owned(),
            name: name_of(folder),
            kind: description.kind,
            frequency_hz: description.frequency_hz,
            steps_rad: description.steps_rad,
            frame_period_s: description.frame_period_s,
            raw,
            sets,
            extra_columns,
            mask,
            frame_times_s,
            camera: camera.map(|(camera, _)| camera),
        })
    }

    /// The sensor's pixels.
    pub fn geometry(&self) -> Geometry {
        self.raw.geometry()
    }

    /// Bits of the ADC: the camera's, else the least of 8 to 24 that hold the largest code.
    pub fn adc_bits(&self) -> u32 {
        match &self.camera {
            Some(camera) => camera.adc_bits,
            None => {
                let largest = self.raw.codes().iter().max().copied().unwrap_or(0);
                (u32::BITS - largest.leading_zeros()).clamp(8, MOST_BITS)
            }
        }
    }

    /// Whether the pixel of number `pixel` (row by row) sees the target.
    pub fn sees_target(&self, pixel: usize) -> bool {
        self.mask.as_ref().is_none_or(|mask| mask.get(pixel).copied().unwrap_or(false))
    }

    /// Radial distance in m from the camera to the target in a pixel at the start of a set: the encoder's axial
    /// distance times √(1 + (x² + y²)/focal_length²), x and y in pixels from the sensor's centre.
    ///
    /// `None` without a camera, where the set has no position, and beyond the recording's sets and pixels.
    pub fn range_m(&self, set: usize, row: usize, column: usize) -> Option<f64> {
        let Geometry { width, height } = self.geometry();
        let camera = self.camera.as_ref().filter(|_| row < height && column < width)?;
        Some(self.sets.get(set)?.position_m? * camera.obliquity(row, column))
    }

    /// Start of a frame in s from the start of the recording: recorded, or evenly spaced from the set's start.
    /// `None` beyond the recording's sets and frames.
    pub fn frame_time_s(&self, set: usize, frame: usize) -> Option<f64> {
        let frames = self.steps_rad.len();
        let row = self.sets.get(set).filter(|_| frame < frames)?;
        match &self.frame_times_s {
            Some(times_s) => times_s.get(set * frames + frame).copied(),
            None => Some(row.time_s + frame as f64 * self.frame_period_s),
        }
    }

    /// A further column of `sets.csv` as a coordinate, one number a set; `None` where there is no such column or not
    /// every cell is a finite number.
    pub fn coordinate(&self, column: &str) -> Option<Vec<f64>> {
        let index = self.extra_columns.iter().position(|name| name == column)?;
        let number =
            |row: &SetRow| row.extra.get(index)?.parse().ok().filter(|value: &f64| value.is_finite());
        self.sets.iter().map(number).collect()
    }
}

/// The folder's own name, also where it is given as `.` or ends in `..`.
fn name_of(folder: &Path) -> String {
    let resolved = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let name = folder.file_name().or(resolved.file_name());
    name.map_or_else(|| "recording".to_owned(), |name| name.to_string_lossy().into_owned())
}

/// The refusal of a folder without the file `missing`; a campaign is the likely mistake.
fn not_a_recording(folder: &Path, missing: &str) -> Problem {
    let problem = Problem::in_file(folder, format_args!("{missing} is missing")).expected(CONTENTS);
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut recordings: Vec<String> = entries
        .filter(|entry| entry.path().join("recording.toml").exists())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    recordings.sort();
    if recordings.is_empty() {
        return problem;
    }
    problem.remedy(format_args!("this is a campaign; name one of its recordings: {}", recordings.join(", ")))
}
