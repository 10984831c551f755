//! `frames.csv`: the start of every frame, where frames were not evenly spaced.

use super::table::Table;
use crate::problem::Result;
use std::path::Path;

pub(super) const COLUMNS: [&str; 3] = ["set", "frame", "time_s"];

/// Reads the file at `path`: the start of each frame `[set, frame]` in s, in order, never going back within a set.
pub(super) fn read(path: &Path, sets: usize, frames: usize) -> Result<Vec<f64>> {
    let table = Table::read(path, &COLUMNS, sets * frames, "one for each frame of frames.npy")?;
    let mut times_s: Vec<f64> = Vec::with_capacity(sets * frames);
    for row in 0..sets * frames {
        table.index(row, "set", row / frames)?;
        table.index(row, "frame", row % frames)?;
        let earliest_s = if row % frames == 0 { -1e9 } else { times_s[row - 1] };
        times_s.push(table.number(row, "time_s", &(earliest_s..=1e9), "s, not before the previous frame")?);
    }
    Ok(times_s)
}
