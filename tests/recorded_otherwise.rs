//! `vuris diagnose` where the frames are right and what is written beside them is not: frames that follow each other more slowly than is recorded, another focal length, an
//! encoder that is read late or has play.

mod diagnosed;
mod rewritten;

use diagnosed::{names, parameter, verdict_on_changed};
use rewritten::rewrite_recordings;
use serde_json::Value;
use std::path::Path;

/// What is said of a clean campaign that `change` has changed.
fn verdict_of(recordings: &str, change: impl Fn(&Path)) -> Value {
    verdict_on_changed(&["--size", "14x12", "--seed", "43", "--recordings", recordings], change)
}

#[test]
fn frames_that_follow_more_slowly_than_is_recorded_are_a_timing_error() {
    let verdict = verdict_of("four-motion,wdft-motion", |campaign| {
        rewrite_recordings(campaign, |_, recording| recording.frame_period_s /= 1.05);
    });
    assert_eq!(names(&verdict), ["frame_timing_error"], "{verdict:#}");
    assert_eq!(verdict["verdict"], "explained", "{verdict:#}");
    let (value, sigma) = parameter(&verdict, "relative");
    assert!((value - 0.05).abs() < 4.0 * sigma && sigma < 0.005, "{value} +- {sigma}");
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

/// Weak enough for what frames and rows are late by to say about as much, by more numbers: places that are off by the velocity, or by its sign, are no time of frames, which
/// are late from the second one on, and no rows. No library has them.
#[test]
fn a_place_that_is_read_late_is_no_time_of_frames() {
    let late = |velocity_m_s: f64| 6e-4 * velocity_m_s;
    let play = |velocity_m_s: f64| 6e-4 * velocity_m_s.signum() * f64::from(velocity_m_s != 0.0);
    for (off_m, shape) in [(&late as &dyn Fn(f64) -> f64, "linear in velocity"), (&play, "direction")] {
        let verdict = verdict_of("four-motion,four-rail,wdft-motion", |campaign| {
            rewrite_recordings(campaign, |_, recording| {
                recording.sets.iter_mut().for_each(|set| {
                    set.position_m = set.position_m.map(|position_m| position_m + off_m(set.velocity_m_s));
                });
            });
        });
        assert_eq!(verdict["verdict"], "unexplained", "{verdict:#}");
        assert!(names(&verdict).is_empty(), "{verdict:#}");
        let located = &verdict["located"][0];
        assert_eq!(located["coordinate"], "velocity_m_s", "{verdict:#}");
        assert!(located["shape"].as_str().unwrap().contains(shape), "{verdict:#}");
    }
}
