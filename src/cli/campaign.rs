//! A recording, or a campaign of recordings, with the pipeline that fits each; what is said of its camera.

use super::SchemeArgument;
use super::print::{remark, say};
use crate::problem::{Problem, Result};
use crate::recording::matching::{SchemeChoice, pipeline_for};
use crate::recording::{AXIAL_MOTION, Camera, INVERSE_SQUARE_FALLOFF, Recording};
use crate::spec::Pipeline;
use std::path::{Path, PathBuf};

/// A recording with its pipeline.
pub(super) struct Fitted {
    pub recording: Recording,
    pub pipeline: Pipeline,
    /// What the recording brought that differs from the specification, a sentence each.
    pub notes: Vec<String>,
}

/// `folder` itself, or the recordings in it where it is a campaign: a folder without recording.toml whose folders have one.
pub(super) fn recordings_in(folder: &Path) -> Result<Vec<PathBuf>> {
    let is_recording = |folder: &Path| folder.join("recording.toml").is_file();
    if is_recording(folder) || !folder.is_dir() {
        return Ok(vec![folder.to_owned()]);
    }
    let recordings = folders_with(folder, is_recording)?;
    // A folder that is neither is refused as the recording that it should be.
    Ok(if recordings.is_empty() { vec![folder.to_owned()] } else { recordings })
}

/// Folders of a campaign that have frames, and are none of its recordings.
pub(super) fn unfinished_in(campaign: &Path) -> Result<Vec<PathBuf>> {
    let is_unfinished =
        |folder: &Path| folder.join("frames.npy").is_file() && !folder.join("recording.toml").is_file();
    let is_campaign = campaign.is_dir() && !campaign.join("recording.toml").is_file();
    if is_campaign { folders_with(campaign, is_unfinished) } else { Ok(Vec::new()) }
}

/// What is in `folder` that `is` so, by name.
fn folders_with(folder: &Path, is: impl Fn(&Path) -> bool) -> Result<Vec<PathBuf>> {
    let cannot = |error: std::io::Error| Problem::io(folder, "list", &error);
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(cannot)? {
        let path = entry.map_err(cannot)?.path();
        if is(&path) {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// Opens the recording or campaign in `folder`. Of a campaign, recordings whose phase steps do not fit are left out, with a line
/// that says so, unless none is left.
pub(super) fn open(folder: &Path, base: &Pipeline, scheme: SchemeArgument) -> Result<Vec<Fitted>> {
    let folders = recordings_in(folder)?;
    let campaign = folders != [folder];
    let mut fitted = Vec::new();
    let mut refusal = None;
    for folder in folders {
        let recording = Recording::open(&folder)?;
        match pipeline_for(&recording, base, scheme.into()) {
            Ok((pipeline, notes)) => fitted.push(Fitted { recording, pipeline, notes }),
            Err(problem) => {
                if campaign {
                    say!("{}: left out: {}", recording.name, problem.found());
                    if pipeline_for(&recording, base, SchemeChoice::Auto).is_ok() {
                        say!("{}: `--scheme auto` takes it", recording.name);
                    }
                }
                refusal = Some(problem);
            }
        }
    }
    match refusal {
        Some(problem) if fitted.is_empty() => Err(problem),
        _ => Ok(fitted),
    }
}

/// A remark on everything that `camera` is said to include and that is not simulated.
pub(super) fn remark_on_physics(camera: &Camera) {
    for name in camera.unknown_physics() {
        remark(format_args!(
            "camera.toml includes {name}, which is not simulated (by name, {AXIAL_MOTION} and {INVERSE_SQUARE_FALLOFF} are; \
             others stand with values in physics.effects)"
        ));
    }
}
