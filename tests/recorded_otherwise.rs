//! `vuris diagnose` where the frames are right and what is written beside them is not, or where something is added to them that no effect's file has made: frames that follow each
//! other more slowly than is recorded, another focal length, another camera's light, a pedestal where there is much light.

mod diagnosed;
mod rewritten;

use diagnosed::{names, parameter, simulated, verdict};
use rewritten::rewrite_recordings;
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::path::{Path, PathBuf};
use vuris::frames::RawSets;

fn campaign(folder: &Path, recordings: &str) -> PathBuf {
    simulated(folder.join("campaign"), &["--size", "14x12", "--seed", "43", "--recordings", recordings])
}

/// What is said of a clean campaign that `change` has changed.
fn verdict_of(recordings: &str, change: impl Fn(&Path)) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let campaign = campaign(folder.path(), recordings);
    change(&campaign);
    verdict(&campaign)
}

/// Its one effect is `name`, which explains all, with this number as it is.
fn is_explained(verdict: &Value, name: &str, key: &str, expected: f64) {
    assert_eq!(names(verdict), [name], "{verdict:#}");
    assert_eq!(verdict["verdict"], "explained", "{verdict:#}");
    let (value, sigma) = parameter(verdict, key);
    assert!((value - expected).abs() < 4.0 * sigma, "{key}: {value} +- {sigma}, not {expected}");
    assert!(sigma < 0.1 * expected.abs(), "{key}: {value} +- {sigma}");
}

#[test]
fn frames_that_follow_more_slowly_than_is_recorded_are_a_timing_error() {
    let verdict = verdict_of("four-motion,wdft-motion", |campaign| {
        rewrite_recordings(campaign, |_, recording| recording.frame_period_s /= 1.05);
    });
    is_explained(&verdict, "frame_timing_error", "relative", 0.05);
}

#[test]
fn another_focal_length_is_a_bowl_that_grows_with_the_distance() {
    let verdict = verdict_of("four-rail,wdft-rail", |campaign| {
        let path = campaign.join("camera.toml");
        let camera = std::fs::read_to_string(&path).unwrap();
        let line = camera.lines().find(|line| line.starts_with("focal_length_px")).unwrap();
        let focal_length: f64 = line.split(['=', '#']).nth(1).unwrap().trim().parse().unwrap();
        let other = format!("focal_length_px = {}", 1.2 * focal_length);
        std::fs::write(&path, camera.replace(line, &other)).unwrap();
    });
    assert_eq!(names(&verdict), ["radial_axial_distance"], "{verdict:#}");
    // Near the axis the bowl is as deep as the focal length's square is small: 1.44 times, and a little less further out.
    let (value, sigma) = parameter(&verdict, "relative");
    assert!((value - 0.42).abs() < 0.03 && sigma < 0.03, "{value} +- {sigma}");
}

#[test]
fn another_cameras_light_is_named_with_its_beat() {
    let verdict = verdict_of("four-rail,four-motion", |campaign| {
        rewrite_recordings(campaign, |number, recording| {
            let (geometry, frames) = (recording.geometry(), recording.raw.frames_per_set());
            let code = |(at, &code): (usize, &u32)| {
                let (index, pixel) = (at / geometry.pixels(), at % geometry.pixels());
                let (set, frame) = (index / frames, index % frames);
                let time_s = recording.sets[set].time_s + 0.025 * frame as f64;
                let angle = FRAC_PI_2 * frame as f64 - TAU * 1.37 * time_s + number as f64;
                // Codes are whole: what is between two of them comes by chance.
                let chance = ((pixel * 31 + set * 7 + frame * 3) % 10) as f64 / 10.0;
                (f64::from(code) + 2.0 * angle.cos() + chance).floor() as u32
            };
            let codes = recording.raw.codes().iter().enumerate().map(code).collect();
            recording.raw = RawSets::new(geometry, frames, codes).unwrap();
        });
    });
    assert_eq!(names(&verdict), ["multi_camera_interference"], "{verdict:#}");
    let rows = verdict["effects"][0]["parameters"].as_array().unwrap();
    let beats = rows.iter().filter(|row| row["name"].as_str().unwrap().starts_with("beat_hz"));
    for beat in beats {
        assert!((beat["value"].as_f64().unwrap() - 1.37).abs() < 0.01, "{beat}");
    }
}

#[test]
fn a_pedestal_where_there_is_much_light_is_background_suppression() {
    const THRESHOLD_DN: f64 = 420.0;
    let verdict = verdict_of("four-rail", |campaign| {
        rewrite_recordings(campaign, |_, recording| {
            let (geometry, frames) = (recording.geometry(), recording.raw.frames_per_set());
            let pixels = geometry.pixels();
            let mut codes = recording.raw.codes().to_vec();
            for set in codes.chunks_mut(frames * pixels) {
                for pixel in 0..pixels {
                    // Of four frames the mean is what does not follow the phase.
                    let sum: u32 = (0..frames).map(|frame| set[frame * pixels + pixel]).sum();
                    if f64::from(sum) / frames as f64 - 64.0 > THRESHOLD_DN {
                        (0..frames).for_each(|frame| set[frame * pixels + pixel] += 4);
                    }
                }
            }
            recording.raw = RawSets::new(geometry, frames, codes).unwrap();
        });
    });
    assert_eq!(names(&verdict), ["background_light_suppression"], "{verdict:#}");
    let (threshold, _) = parameter(&verdict, "threshold_of_full_scale");
    assert!((threshold * (4095.0 - 64.0) / THRESHOLD_DN - 1.0).abs() < 0.05, "{threshold}");
}
