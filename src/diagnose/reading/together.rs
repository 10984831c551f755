//! Whether recordings can be looked at together.

use crate::problem::{Problem, Result};
use crate::recording::{Camera, Kind, Recording};

/// Refuses recordings that are not of one camera, or whose target was at no distance.
///
/// # Errors
/// Another number of pixels than the first recording or the `camera` has; another description of the camera; the same frames twice; a position of 0.
pub fn check_together(recordings: &[Recording], camera: &Camera) -> Result<()> {
    let Some(first) = recordings.first() else { return Ok(()) };
    let geometry = first.geometry();
    for recording in recordings {
        if recording.geometry() != geometry || camera.geometry != geometry {
            return Err(Problem::in_file(&recording.folder, "has another number of pixels")
                .expected(format_args!("{} x {}", geometry.width, geometry.height)));
        }
    }
    if let Some(other) = recordings.iter().find(|recording| recording.camera != first.camera) {
        return Err(Problem::in_file(
            &other.folder,
            format_args!("has another camera.toml than {}, or none where that has one", first.name),
        )
        .expected("recordings of one camera, described once")
        .remedy("keep camera.toml beside the recordings' folders alone, or diagnose them one by one"));
    }
    for (number, recording) in recordings.iter().enumerate() {
        // Noise is never the same twice; what has none is.
        let codes = recording.raw.codes();
        let has_noise = || codes.iter().any(|code| *code != codes[0]);
        let is_same = |other: &&Recording| other.raw.codes() == codes;
        if let Some(other) = recordings[..number].iter().find(is_same).filter(|_| has_noise()) {
            let found = format!("has the same frames as {}, code for code", other.name);
            return Err(Problem::in_file(&recording.folder.join("frames.npy"), found)
                .expected("each recording once: seen twice, its noise would look like physics")
                .remedy("take one of the two out of the campaign"));
        }
    }
    for recording in recordings.iter().filter(|recording| recording.kind != Kind::Dark) {
        if let Some(set) = recording.sets.iter().position(|row| row.position_m == Some(0.0)) {
            return Err(Problem::in_file(
                &recording.folder.join("sets.csv"),
                format_args!("position_m = 0 in set {set}"),
            )
            .expected("a distance: light falls with its square")
            .remedy(
                "correct the encoder's zero, or leave the cell empty in all sets where it is not known",
            ));
        }
    }
    Ok(())
}
