//! `sets.csv`: where the target was, when, how fast, at which phase offset.

use super::table::Table;
use crate::problem::Result;
use std::ops::RangeInclusive;
use std::path::Path;

/// One set: the N raw frames of one phase measurement.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SetRow {
    /// Start of the first frame, s, from the start of the recording.
    pub time_s: f64,
    /// The encoder's reading at that time, m: axial distance from the camera to the target plane; `None` where there was
    /// no encoder.
    pub position_m: Option<f64>,
    /// The carriage's commanded velocity, m/s, positive away from the camera; 0 where it stands.
    pub velocity_m_s: f64,
    /// What is added to every frame's phase step, rad.
    pub phase_offset_rad: f64,
    /// Cells of the further columns, as they stand in the file, in the order of
    /// [`Recording::extra_columns`](super::Recording::extra_columns).
    pub extra: Vec<String>,
}

/// The format's columns.
pub(super) const COLUMNS: [&str; 5] = ["set", "time_s", "position_m", "velocity_m_s", "phase_offset_rad"];

const TIME_S: RangeInclusive<f64> = -1e9..=1e9;
const POSITION_M: RangeInclusive<f64> = 0.0..=1e6;
const VELOCITY_M_S: RangeInclusive<f64> = -1e4..=1e4;
const PHASE_OFFSET_RAD: RangeInclusive<f64> = -1e6..=1e6;

/// Reads the file at `path`, which must have one row for each of `sets`; also gives the names of further columns.
pub(super) fn read(path: &Path, sets: usize) -> Result<(Vec<SetRow>, Vec<String>)> {
    let table = Table::read(path, &COLUMNS, sets, "one for each set of frames.npy")?;
    let extra_columns = table.others(&COLUMNS);
    let row = |set: usize| {
        table.index(set, "set", set)?;
        Ok(SetRow {
            time_s: table.number(set, "time_s", &TIME_S, "s")?,
            position_m: match table.text(set, "position_m") {
                "" => None,
                _ => {
                    Some(table.number(set, "position_m", &POSITION_M, "m, or nothing without an encoder")?)
                }
            },
            velocity_m_s: table.number(set, "velocity_m_s", &VELOCITY_M_S, "m/s")?,
            phase_offset_rad: table.number(set, "phase_offset_rad", &PHASE_OFFSET_RAD, "rad")?,
            extra: extra_columns.iter().map(|column| table.text(set, column).to_owned()).collect(),
        })
    };
    Ok(((0..sets).map(row).collect::<Result<_>>()?, extra_columns))
}
