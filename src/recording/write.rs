//! Writing recordings and cameras in the format, as a simulator does.

use super::arrays::{Numbers, write_npy};
use super::staging::Staging;
use super::{Camera, Recording, description, frame_times, sets};
use crate::problem::{Problem, Result};
use std::fs;
use std::path::Path;

/// Writes `recording` as the new folder `folder`, whole or not at all. The camera is the campaign's: [`write_camera`].
///
/// # Errors
/// `folder` is there already or cannot be written; the recording would be refused when read (its codes are checked
/// against the `camera.toml` beside `folder`, too).
pub fn write_recording(recording: &Recording, folder: &Path) -> Result<()> {
    write(recording, None, folder)
}

/// Writes `recording` as the new folder `folder`, whole or not at all, with `camera` as a `camera.toml` of its own.
///
/// # Errors
/// As [`write_recording`].
pub fn write_recording_with_camera(recording: &Recording, camera: &Camera, folder: &Path) -> Result<()> {
    write(recording, Some(camera), folder)
}

/// Writes `recordings` and their `camera`, where it is known, as the new campaign `folder`, whole or not at all; each is a
/// folder called as the recording's name.
///
/// # Errors
/// As [`write_recording`].
pub fn write_campaign(recordings: &[Recording], camera: Option<&Camera>, folder: &Path) -> Result<()> {
    refuse_present(folder)?;
    let staging = Staging::beside(folder)?;
    if let Some(camera) = camera {
        write_camera(camera, staging.path())?;
    }
    for recording in recordings {
        write_recording(recording, &staging.path().join(&recording.name))?;
    }
    staging.publish()
}

fn refuse_present(folder: &Path) -> Result<()> {
    match folder.symlink_metadata() {
        Ok(_) => Err(Problem::in_file(folder, "is there already").expected("a new folder")),
        Err(_) => Ok(()),
    }
}

fn write(recording: &Recording, own: Option<&Camera>, folder: &Path) -> Result<()> {
    refuse_present(folder)?;
    let staging = Staging::beside(folder)?;
    staging.write_text("recording.toml", &description::write(recording))?;
    let text = |name: &str, rows: Vec<Vec<String>>| {
        staging
            .write_text(name, &csv_text(rows).map_err(|error| Problem::in_file(&folder.join(name), error))?)
    };
    text("sets.csv", set_rows(recording))?;
    if let Some(times_s) = &recording.frame_times_s {
        text("frames.csv", frame_rows(times_s, recording.steps_rad.len()))?;
    }
    let (raw, geometry) = (&recording.raw, recording.geometry());
    let array = |name: &str, shape: &[usize], numbers: Numbers| {
        let shape: Vec<u64> = shape.iter().map(|&size| size as u64).collect();
        write_npy(&staging.path().join(name), &shape, &numbers)
            .map_err(|error| Problem::io(&folder.join(name), "write", &error))
    };
    let shape = [raw.sets(), raw.frames_per_set(), geometry.height, geometry.width];
    // A code that is too wide must be refused below, not saturated here.
    let bits = u32::BITS - raw.codes().iter().max().map_or(0, |code| code.leading_zeros());
    array("frames.npy", &shape, Numbers::codes(bits.max(16), raw.codes().iter().map(|&code| code.into())))?;
    if let Some(mask) = &recording.mask {
        let ones = Numbers::codes(1, mask.iter().map(|&sees| sees.into()));
        array("mask.npy", &[geometry.height, geometry.width], ones)?;
    }
    match own {
        Some(camera) => {
            staging.write_text("camera.toml", &camera.to_toml())?;
            readable(&staging, folder)?;
        }
        None => verify(&staging, folder)?,
    }
    staging.publish()
}

/// What has been written can be read: one check of everything, with the reader's own words.
fn verify(staging: &Staging, folder: &Path) -> Result<()> {
    let camera = Camera::of_recording(folder)?.map(|(camera, _)| camera);
    if let Some(camera) = &camera {
        staging.write_text("camera.toml", &camera.to_toml())?;
    }
    let read = readable(staging, folder);
    if camera.is_some() {
        let path = staging.path().join("camera.toml");
        fs::remove_file(&path).map_err(|error| Problem::io(&path, "remove", &error))?;
    }
    read
}

/// What has been written can be read, with the camera that lies beside it.
fn readable(staging: &Staging, folder: &Path) -> Result<()> {
    Recording::open(staging.path()).map(drop).map_err(|problem| {
        Problem::in_file(folder, format_args!("the recording would be refused when read: {problem}"))
    })
}

/// Writes `camera` as the `camera.toml` of the folder `campaign`, which is created where it is not there.
///
/// # Errors
/// `camera.toml` is there already, or cannot be written.
pub fn write_camera(camera: &Camera, campaign: &Path) -> Result<()> {
    let path = campaign.join("camera.toml");
    if path.symlink_metadata().is_ok() {
        return Err(Problem::in_file(&path, "is there already").expected("a new campaign"));
    }
    fs::create_dir_all(campaign).map_err(|error| Problem::io(campaign, "create", &error))?;
    fs::write(&path, camera.to_toml()).map_err(|error| Problem::io(&path, "write", &error))
}

fn set_rows(recording: &Recording) -> Vec<Vec<String>> {
    let names = sets::COLUMNS.iter().map(|name| (*name).to_owned());
    let header = names.chain(recording.extra_columns.iter().cloned()).collect();
    let rows = recording.sets.iter().enumerate().map(|(set, row)| {
        let position = row.position_m.map_or(String::new(), |position_m| position_m.to_string());
        let [time, velocity, offset] =
            [row.time_s, row.velocity_m_s, row.phase_offset_rad].map(|v| v.to_string());
        let own = [set.to_string(), time, position, velocity, offset];
        own.into_iter().chain(row.extra.iter().cloned()).collect()
    });
    std::iter::once(header).chain(rows).collect()
}

fn frame_rows(times_s: &[f64], frames: usize) -> Vec<Vec<String>> {
    let header = frame_times::COLUMNS.iter().map(|name| (*name).to_owned()).collect();
    let rows = times_s.iter().enumerate().map(|(index, time_s)| {
        vec![(index / frames).to_string(), (index % frames).to_string(), time_s.to_string()]
    });
    std::iter::once(header).chain(rows).collect()
}

/// Rows as comma-separated values; refused where they are not equally long.
fn csv_text(rows: Vec<Vec<String>>) -> std::result::Result<String, String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.write_record(row).map_err(|error| error.to_string())?;
    }
    let bytes = writer.into_inner().map_err(|error| error.to_string())?;
    String::from_utf8(bytes).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frames::{Geometry, RawSets};
    use crate::recording::{Kind, SetRow};
    use std::path::PathBuf;

    fn recording(camera: Option<Camera>) -> Recording {
        let geometry = Geometry { width: 3, height: 2 };
        let codes = (0..2 * 4 * 6).map(|n| n * 40).collect();
        let set = |time_s: f64, position_m, temperature_c: &str| SetRow {
            time_s,
            position_m,
            velocity_m_s: -0.1,
            phase_offset_rad: 1.0 / 3.0,
            extra: vec![temperature_c.to_owned(), "cold, dry".to_owned()],
        };
        Recording {
            folder: PathBuf::new(),
            name: "wavy".to_owned(),
            kind: Kind::Motion,
            frequency_hz: 31.7e6,
            steps_rad: vec![0.0, 1.5, 3.2, 4.7],
            frame_period_s: 0.025,
            raw: RawSets::new(geometry, 4, codes).unwrap(),
            sets: vec![set(0.0, Some(1.2345), "20.5"), set(0.1, None, "21")],
            extra_columns: vec!["temperature_c".to_owned(), "weather".to_owned()],
            mask: Some(vec![true, false, true, true, true, false]),
            frame_times_s: Some(vec![0.0, 0.03, 0.05, 0.08, 0.1, 0.13, 0.15, 0.18]),
            camera,
        }
    }

    fn camera() -> Camera {
        Camera {
            geometry: Geometry { width: 3, height: 2 },
            adc_bits: 12,
            pedestal_dn: 64.0,
            gain_e_per_dn: 12.5,
            read_noise_e: 36.0,
            focal_length_px: 4.0,
            correlation_amplitude: vec![1.0, 0.0, 0.024],
            correlation_phase_rad: vec![0.0, 0.0, -0.24],
            included_physics: vec![
                "inverse_square_falloff".to_owned(),
                "axial_motion_of_recorded_velocity".to_owned(),
                "of another program".to_owned(),
            ],
            effects: Vec::new(),
        }
    }

    #[test]
    fn what_is_written_is_what_is_read() {
        let campaign = tempfile::tempdir().unwrap();
        let folder = campaign.path().join("wavy");
        for camera in [None, Some(camera())] {
            if let Some(camera) = &camera {
                fs::remove_dir_all(&folder).unwrap();
                write_camera(camera, campaign.path()).unwrap();
            }
            let written = Recording { folder: folder.clone(), ..recording(camera) };
            write_recording(&written, &folder).unwrap();
            let read = Recording::open(&folder).unwrap();
            assert_eq!(read, written);
            assert_eq!(read.adc_bits(), if read.camera.is_some() { 12 } else { 11 });
            assert_eq!(read.coordinate("temperature_c"), Some(vec![20.5, 21.0]));
            assert_eq!(read.coordinate("weather"), None);
            assert_eq!((read.frame_time_s(1, 2), read.frame_time_s(1, 4)), (Some(0.15), None));
            assert!(!folder.join("camera.toml").exists());
        }
    }

    #[test]
    fn uniform_steps_and_even_frames_are_written_shortly() {
        let campaign = tempfile::tempdir().unwrap();
        let folder = campaign.path().join("even");
        let step_rad = 2.094395102393;
        let written = Recording {
            folder: folder.clone(),
            name: "even".to_owned(),
            steps_rad: (0..4).map(|n| f64::from(n) * step_rad).collect(),
            frame_times_s: None,
            ..recording(None)
        };
        write_recording(&written, &folder).unwrap();
        let text = fs::read_to_string(folder.join("recording.toml")).unwrap();
        assert!(text.contains("phase_step_rad = 2.094395102393"), "{text}");
        let read = Recording::open(&folder).unwrap();
        assert_eq!(read, written);
        assert_eq!(read.frame_time_s(1, 2), Some(0.1 + 2.0 * 0.025));
    }

    #[test]
    fn nothing_is_overwritten_and_nothing_unreadable_is_written() {
        let campaign = tempfile::tempdir().unwrap();
        let folder = campaign.path().join("wavy");
        write_recording(&recording(None), &folder).unwrap();
        let again = write_recording(&recording(None), &folder).unwrap_err();
        assert!(again.to_string().contains("is there already"));
        let bad = Recording { frequency_hz: 1.0, ..recording(None) };
        let refusal = write_recording(&bad, &campaign.path().join("bad")).unwrap_err().to_string();
        assert!(refusal.contains("modulation.frequency_hz"), "{refusal}");
        let mut codes = recording(None).raw.codes().to_vec();
        codes[5] = 20_000_000;
        let raw = RawSets::new(recording(None).geometry(), 4, codes).unwrap();
        let refusal = write_recording(&Recording { raw, ..recording(None) }, &campaign.path().join("bad"))
            .unwrap_err()
            .to_string();
        assert!(refusal.contains("code 20000000 at set 0, frame 0, row 1, column 2"), "{refusal}");
        write_camera(&camera(), campaign.path()).unwrap();
        assert!(write_camera(&camera(), campaign.path()).is_err());
        assert_eq!(fs::read_dir(campaign.path()).unwrap().count(), 2);
    }
}
