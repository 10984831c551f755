//! The open question of the paper, asked of the diagnosis on its simulated bench: docs/open-question.md in small.

mod diagnosed;

use diagnosed::{concealed, names, vuris};
use serde_json::Value;
use std::path::Path;

const CAMERA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/paper-bench/camera.toml");
/// The paper's velocity, and its 125 ms a measurement of four frames.
const BENCH: [&str; 10] = [
    "simulate",
    "--camera",
    CAMERA,
    "--size",
    "12x9",
    "--constant-ratio",
    "1.2337",
    "--frame-period-s",
    "0.03125",
    "--velocities-m-s",
];

/// What is said of the four-frame motion recording, with `effect` concealed.
fn verdict(folder: &Path, effect: Option<&str>) -> Value {
    let out = folder.join(effect.unwrap_or("nothing"));
    let own = ["2", "--recordings", "four-motion", "--out", out.to_str().unwrap()];
    let (good, text) = vuris(&[&BENCH, &own[..], &concealed(effect.as_slice())].concat());
    // Three runs of nine sets from 1 to 3 m.
    assert!(good && text.contains("four-motion: 27 sets of 4 frames"), "{text}");
    diagnosed::verdict(&out)
}

#[test]
fn a_concealed_falloff_is_named_from_four_frame_motion_alone() {
    let folder = tempfile::tempdir().unwrap();
    let verdict = verdict(folder.path(), Some("inverse_square_falloff"));
    assert_eq!(names(&verdict), ["inverse_square_falloff"], "{verdict:#}");
    let effect = &verdict["effects"][0];
    let [share, sigma] = ["value", "sigma"].map(|key| effect["parameters"][0][key].as_f64().unwrap());
    assert!((share - 1.0).abs() < 4.0 * sigma && sigma < 0.05, "{share} +- {sigma}");
    assert_eq!(effect["also_possible"].as_array().unwrap().len(), 0, "{effect}");
    for candidate in ["multipath_interference", "intensity_nonlinearity"] {
        let mut ruled_out = verdict["ruled_out"].as_array().unwrap().iter();
        assert!(ruled_out.any(|row| row["name"] == candidate), "{candidate} is not ruled out: {verdict:#}");
    }
}

/// The paper's other candidates are not taken for the falloff, and without any of them there is nothing to find.
#[test]
fn the_papers_other_candidates_are_not_taken_for_it() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(verdict(folder.path(), None)["verdict"], "clean");
    for candidate in ["multipath_interference", "intensity_nonlinearity:quadratic=0.1"] {
        let verdict = verdict(folder.path(), Some(candidate));
        assert_eq!(names(&verdict), [candidate.split(':').next().unwrap()], "{verdict:#}");
        let also = verdict["effects"][0]["also_possible"].as_array().unwrap();
        assert!(also.iter().all(|name| name != "inverse_square_falloff"), "{verdict:#}");
    }
}

#[test]
fn a_velocity_that_no_run_has_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("none");
    let (good, text) = vuris(&[&BENCH, &["3", "--out", out.to_str().unwrap()][..]].concat());
    assert!(!good && text.contains("--velocities-m-s: four-motion has no run at [3.0] m/s"), "{text}");
    assert!(!out.exists());
}
