//! `vuris diagnose` where the frames are right and what is written beside them is not: frames that follow each other more slowly than is recorded, another focal length.

mod diagnosed;
mod rewritten;

use diagnosed::{names, parameter, simulated, verdict};
use rewritten::rewrite_recordings;
use serde_json::Value;
use std::path::{Path, PathBuf};

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
