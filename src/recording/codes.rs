//! `frames.npy` and `mask.npy`: raw codes and the pixels that see the target.

use super::{Camera, npy};
use crate::frames::{Geometry, RawSets};
use crate::problem::{Problem, Result};
use std::path::{Path, PathBuf};

/// Bits of the widest codes that are read: single precision holds them, and sums of frames of 16 bits are among them. The hardware takes 16.
pub const MOST_BITS: u32 = 24;

/// Reads the raw codes at `path`, in agreement with `recording.toml`'s frames a set and with the camera.
pub(super) fn read_frames(
    path: &Path,
    frames_per_set: usize,
    camera: Option<&(Camera, PathBuf)>,
) -> Result<RawSets> {
    let npy::Codes { shape, values } = npy::read(path, &["<u2", "<u4"], "[set, frame, row, column]")?;
    let &[_, frames, height, width] = &shape[..] else { return Err(not_whole_sets(path)) };
    if frames != frames_per_set {
        return Err(Problem::in_file(path, format_args!("its shape {shape:?} has {frames} frames a set"))
            .expected(format_args!("{frames_per_set}, as recording.toml's modulation.frames says"))
            .remedy("correct modulation.frames, or save the array as [set, frame, row, column]"));
    }
    let geometry = Geometry { width, height };
    if let Some((camera, camera_path)) = camera
        && camera.geometry != geometry
    {
        let Geometry { width: known_width, height: known_height } = camera.geometry;
        return Err(Problem::in_file(path, format_args!("its frames are {width} x {height} pixels"))
            .expected(format_args!(
                "sensor.width = {known_width}, sensor.height = {known_height}, as {} says",
                camera_path.display()
            ))
            .remedy("correct camera.toml, or give the recording a camera.toml of its own"));
    }
    let raw = RawSets::new(geometry, frames, values).ok_or_else(|| not_whole_sets(path))?;
    let (bits, why) = match camera {
        Some((camera, path)) => {
            (camera.adc_bits, format!("sensor.adc_bits = {} in {}", camera.adc_bits, path.display()))
        }
        None => (MOST_BITS, "the widest codes that are read".to_owned()),
    };
    let largest = (1u32 << bits) - 1;
    if let Some(index) = raw.codes().iter().position(|&code| code > largest) {
        let (frame, pixel) = (index / geometry.pixels(), index % geometry.pixels());
        let (row, column) = geometry.row_column(pixel);
        return Err(Problem::in_file(
            path,
            format_args!(
                "code {} at set {}, frame {}, row {row}, column {column}",
                raw.codes()[index],
                frame / frames,
                frame % frames
            ),
        )
        .expected(format_args!("codes from 0 to {largest} ({why})"))
        .remedy("correct the number of bits, or save the codes aligned to the lowest bit"));
    }
    Ok(raw)
}

fn not_whole_sets(path: &Path) -> Problem {
    Problem::in_file(path, "does not hold whole sets").expected("an array [set, frame, row, column]")
}

/// Reads the mask at `path`, `[row, column]`: 1 where the pixel sees the target, 0 elsewhere.
pub(super) fn read_mask(path: &Path, geometry: Geometry) -> Result<Vec<bool>> {
    let npy::Codes { shape, values } = npy::read(path, &["|u1"], "[row, column]")?;
    if shape != [geometry.height, geometry.width] {
        return Err(Problem::in_file(path, format_args!("its shape is {shape:?}"))
            .expected(format_args!("[{}, {}], as frames.npy has it", geometry.height, geometry.width)));
    }
    if let Some(pixel) = values.iter().position(|&value| value > 1) {
        let (row, column) = geometry.row_column(pixel);
        let found = format_args!("value {} at row {row}, column {column}", values[pixel]);
        return Err(Problem::in_file(path, found).expected("0 or 1"));
    }
    Ok(values.into_iter().map(|value| value == 1).collect())
}
