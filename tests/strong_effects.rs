//! `vuris diagnose` where the mismatch is so strong that tangents at the baseline say little, and where something weak stands beside it.

mod diagnosed;

use diagnosed::{concealed, names, parameter, simulated};
use serde_json::Value;
use std::path::Path;

const CAMERA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/paper-bench/camera.toml");

/// What is said of these recordings, simulated with `options`.
fn verdict(folder: &Path, recordings: &str, options: &[&str]) -> Value {
    diagnosed::verdict(&simulated(
        folder.join("campaign"),
        &[&["--recordings", recordings], options].concat(),
    ))
}

/// Twelve sets of 64 frames by a response of the power 2.2: many numbers of other effects explain most of it, one explains all.
#[test]
fn a_response_that_is_a_power_is_named_by_its_exponent() {
    let folder = tempfile::tempdir().unwrap();
    let effect = ["--size", "10x8", "--effect", "intensity_nonlinearity:exponent=1.2"];
    let verdict = verdict(folder.path(), "harmonics", &effect);
    assert_eq!(names(&verdict), ["intensity_nonlinearity"], "{verdict:#}");
    assert!(verdict["held_out"]["chi2_per_dof_before"].as_f64().unwrap() > 5.0, "too weak for this test");
    let row = &verdict["effects"][0]["parameters"][0];
    let [exponent, sigma] = ["value", "sigma"].map(|key| row[key].as_f64().unwrap());
    assert!((exponent - 1.2).abs() < 4.0 * sigma, "{exponent} +- {sigma}");
}

/// A third of the ambient light flickers at just the pace at which the frames of a rail see it: its frequency is an extremum, and the first step of a fit halfway.
#[test]
fn a_strong_flicker_at_the_frames_own_pace_is_named_on_a_rail_alone() {
    let folder = tempfile::tempdir().unwrap();
    let effect = ["--size", "12x9", "--effect", "ambient_flicker:cosine=0.23,sine=0.23"];
    let verdict = verdict(folder.path(), "four-rail", &effect);
    assert_eq!(verdict["verdict"], "explained", "{verdict:#}");
    assert_eq!(names(&verdict), ["ambient_flicker"], "{verdict:#}");
    let [cosine, hz] = ["cosine", "frequency_hz"].map(|name| parameter(&verdict, name));
    assert!((cosine.0 - 0.23).abs() < 4.0 * cosine.1, "{cosine:?}");
    assert!((hz.0 - 100.0).abs() < 4.0 * hz.1 && hz.1 < 0.02, "{hz:?}");
}

/// A response that is a power and a polynomial, of nine per cent at full scale together: neither alone says it, nor does a wave of the converter.
#[test]
fn a_response_that_is_neither_a_power_nor_a_polynomial_is_a_response() {
    let folder = tempfile::tempdir().unwrap();
    let response = "intensity_nonlinearity:quadratic=0.035,cubic=0.035,exponent=0.035";
    let verdict = verdict(folder.path(), "four-motion,wdft-rail", &["--size", "16x12", "--effect", response]);
    assert_eq!(verdict["verdict"], "explained", "{verdict:#}");
    assert_eq!(names(&verdict), ["intensity_nonlinearity"], "{verdict:#}");
    assert_eq!(numbers(&verdict), 3, "{verdict:#}");
}

/// One form alone is all that a response needs that has that form.
#[test]
fn a_response_of_one_form_is_named_by_that() {
    for (response, expected) in [("exponent=0.05", 1), ("quadratic=0.06,cubic=0.03", 2)] {
        let folder = tempfile::tempdir().unwrap();
        let response = format!("intensity_nonlinearity:{response}");
        let options = ["--size", "16x12", "--effect", &response];
        let verdict = verdict(folder.path(), "four-motion,wdft-rail", &options);
        assert_eq!(verdict["verdict"], "explained", "{verdict:#}");
        assert_eq!(names(&verdict), ["intensity_nonlinearity"], "{verdict:#}");
        assert_eq!(numbers(&verdict), expected, "{verdict:#}");
    }
}

/// How many numbers the first effect has.
fn numbers(verdict: &Value) -> usize {
    verdict["effects"][0]["parameters"].as_array().unwrap().len()
}

/// The light's falloff within a set, at 2 m/s, explains hundreds of times what errors of single phase steps do: both are named.
#[test]
fn what_is_weak_beside_a_strong_effect_is_named_too() {
    let folder = tempfile::tempdir().unwrap();
    let options =
        ["--camera", CAMERA, "--size", "12x9", "--velocities-m-s", "2", "--frame-period-s", "0.03125"];
    let effects = [
        "--effect",
        "inverse_square_falloff",
        "--effect",
        "phase_step_errors:setting_1_rad=0.003,setting_2_rad=-0.003",
    ];
    let recordings = "four-motion,four-rail,four-sweep";
    let verdict = verdict(folder.path(), recordings, &[&options[..], &effects].concat());
    assert_eq!(verdict["verdict"], "explained", "{verdict:#}");
    assert_eq!(names(&verdict), ["inverse_square_falloff", "phase_step_errors"], "{verdict:#}");
    let weak = &verdict["effects"][1]["evidence"]["delta_chi2"];
    let strong = &verdict["effects"][0]["evidence"]["delta_chi2"];
    assert!(strong.as_f64().unwrap() > 20.0 * weak.as_f64().unwrap(), "{strong} {weak}");
}

/// Fourteen times the noise of all samples is a sixth of the ambient light that flickers: what blurs edges by 2 % is no error of that, nor is a step that is off.
#[test]
#[ignore = "minutes: make slow"]
fn what_is_weak_beside_a_flicker_far_above_the_noise_is_named_too() {
    const FLICKER: &str = "ambient_flicker:cosine=0.15,sine=0.1";
    for weak in ["charge_crosstalk:share=0.02", "phase_step_scale:relative=0.002"] {
        let folder = tempfile::tempdir().unwrap();
        let options = ["--size", "16x12", "--effect", FLICKER, "--effect", weak];
        let verdict = verdict(folder.path(), "four-motion,wdft-rail,wdft-motion", &options);
        assert!(
            verdict["held_out"]["chi2_per_dof_before"].as_f64().unwrap() > 10.0,
            "too weak for this test"
        );
        assert_eq!(verdict["verdict"], "explained", "{verdict:#}");
        let name = weak.split(':').next().unwrap();
        assert_eq!(names(&verdict), ["ambient_flicker", name], "{verdict:#}");
        assert_eq!(verdict["effects"][0]["name"], "ambient_flicker");
    }
}

/// One name is trusted beside a flicker whose form may leave more, and only if nothing is left: of two weak effects none is named, and what is left is told.
#[test]
#[ignore = "minutes: make slow"]
fn what_would_leave_something_is_not_trusted() {
    let folder = tempfile::tempdir().unwrap();
    let effects = [
        "ambient_flicker:cosine=0.15,sine=0.1",
        "charge_crosstalk:share=0.02",
        "phase_step_scale:relative=0.002",
    ];
    let options = [&["--size", "16x12"][..], &concealed(&effects)].concat();
    let verdict = verdict(folder.path(), "four-motion,wdft-rail,wdft-motion", &options);
    assert_eq!(names(&verdict), ["ambient_flicker"], "{verdict:#}");
    assert_eq!(verdict["remainder"]["coordinate"], "neighbours", "{verdict:#}");
}

/// A background that never moves does not tell how much of its light flickers: it has as much of the camera's own as other pixels have by the time that the flicker is known.
#[test]
fn a_strong_flicker_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--size", "16x12", "--effect", "ambient_flicker:cosine=0.3,sine=0.1"];
    let verdict = verdict(folder.path(), "four-motion,wdft-rail,wdft-motion", &options);
    assert_eq!(verdict["verdict"], "explained", "{verdict:#}");
    assert_eq!(names(&verdict), ["ambient_flicker"], "{verdict:#}");
    assert!(verdict["remainder"]["coordinate"].is_null(), "{verdict:#}");
    let (cosine, sigma) = parameter(&verdict, "cosine");
    assert!((cosine - 0.3).abs() < 4.0 * sigma, "{cosine} +- {sigma}");
}

/// A lamp that is no pure sine, by 0.7 %: what a flicker leaves of it is some 300 of chi squared in the ambient light, and no drift of that, though a drift would leave
/// nothing.
#[test]
#[ignore = "minutes: make slow"]
fn what_the_form_of_a_strong_flicker_leaves_is_no_drift() {
    const LAMP: &str = r#"
        [[effect]]
        name = "lamp_of_two_lines"
        sentence = "A lamp behind a rectifier: twice the mains frequency, and four times."
        acts_on = "ambient"
        formula = "first * cos(2 * PI * 100.003 * time_s) + second * cos(4 * PI * 100.003 * time_s + 1.0)"
        [[effect.parameter]]
        name = "first"
        unit = "1"
        bounds = [-1, 1]
        typical = 0.1
        [[effect.parameter]]
        name = "second"
        unit = "1"
        bounds = [-1, 1]
        typical = 0.1
    "#;
    let folder = tempfile::tempdir().unwrap();
    let library = folder.path().join("lamp.toml");
    std::fs::write(&library, LAMP).unwrap();
    let effect = ["--size", "16x12", "--effect", "lamp_of_two_lines:first=0.18,second=0.00128"];
    let options = [&["--library", library.to_str().unwrap()], &effect[..]].concat();
    let verdict = verdict(folder.path(), "four-motion,wdft-rail,wdft-motion", &options);
    assert_eq!(names(&verdict), ["ambient_flicker"], "{verdict:#}");
}

/// A camera that includes a strong flicker splits the light of its background beside that.
#[test]
fn a_strong_flicker_that_is_included_leaves_nothing() {
    const FLICKER: &str = "ambient_flicker:cosine=0.15,sine=0.1,frequency_hz=100";
    let folder = tempfile::tempdir().unwrap();
    let options =
        ["--recordings", "four-motion,wdft-rail,wdft-motion", "--size", "16x12", "--effect", FLICKER];
    let campaign = simulated(folder.path().join("campaign"), &options);
    let camera = campaign.join("camera.toml");
    let described = std::fs::read_to_string(&camera).unwrap();
    std::fs::write(&camera, described.replace("[physics]", &format!("[physics]\neffects = [\"{FLICKER}\"]")))
        .unwrap();
    let verdict = diagnosed::verdict(&campaign);
    assert_eq!(verdict["verdict"], "clean", "{verdict:#}");
    assert!(verdict["probability_of_mismatch"].as_f64().unwrap() < 0.5, "{verdict:#}");
}

/// A law of geometry has no other form: what explains a thousandth of what the falloff does is no error of that.
#[test]
fn what_is_a_thousandth_of_the_falloff_is_named_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--camera", CAMERA, "--size", "12x9", "--effect", "inverse_square_falloff"];
    let effects = ["--effect", "image_lag:share=0.003"];
    let recordings = "four-motion,four-rail,wdft-motion,wdft-rail";
    let verdict = verdict(folder.path(), recordings, &[&options[..], &effects].concat());
    assert_eq!(names(&verdict), ["image_lag", "inverse_square_falloff"], "{verdict:#}");
    let [strong, weak] =
        [0, 1].map(|number: usize| verdict["effects"][number]["evidence"]["delta_chi2"].as_f64().unwrap());
    assert!(weak < 1e-3 * strong, "{strong} {weak}");
}

/// A drift that goes on nearly evenly has a time constant far from where its fit begins: what is asserted is where the fit ends, not where its first steps do.
#[test]
#[ignore = "minutes: make slow"]
fn a_fit_that_is_asserted_is_gone_on_with_to_its_end() {
    let folder = tempfile::tempdir().unwrap();
    let effect = ["--size", "8x6", "--seed", "3", "--effect", "ambient_drift:relative_a_second=0.005"];
    let verdict = verdict(folder.path(), "four-sweep,four-rail,four-motion", &effect);
    assert_eq!(names(&verdict), ["ambient_drift"], "{verdict:#}");
    let number = |row: usize, key: &str| verdict["effects"][0]["parameters"][row][key].as_f64().unwrap();
    let [rate, sigma, time_constant_s] = [number(0, "value"), number(0, "sigma"), number(1, "value")];
    assert!((rate - 0.005).abs() < 4.0 * sigma, "{rate} +- {sigma}");
    assert!(time_constant_s > 5e3, "{time_constant_s}");
}

/// Light of 80 % that comes by a second way, seen in three runs at 2 m/s alone: errors of frames as large as no jitter is named for, since they come again wherever the target
/// is again.
#[test]
fn errors_that_come_again_at_the_same_place_are_no_jitter() {
    let folder = tempfile::tempdir().unwrap();
    let bench = ["--camera", CAMERA, "--constant-ratio", "1.2337", "--velocities-m-s", "2"];
    let wall = "multipath_interference:relative_amplitude=0.8,wall_distance_m=3.51";
    let options = [&bench[..], &["--frame-period-s", "0.03125", "--effect", wall]].concat();
    let strong = verdict(folder.path(), "four-motion", &options);
    let named = names(&strong);
    assert!(named.iter().all(|name| !name.contains("jitter")), "{strong:#}");
    assert!(strong["verdict"] != "explained" || named == ["multipath_interference"], "{strong:#}");
}

/// What a form leaves is nearly the same where the target is again, or near; a jitter is new each time, and is named beside scatter whose form may leave a thousand times as much.
#[test]
#[ignore = "minutes: make slow"]
fn a_jitter_is_named_beside_a_strong_effect() {
    let folder = tempfile::tempdir().unwrap();
    let effects = ["lens_scatter:share=0.1", "clock_jitter:sigma_rad=0.004"];
    let options = [&["--size", "16x12"][..], &concealed(&effects)].concat();
    let verdict = verdict(folder.path(), "four-motion,wdft-rail,wdft-motion", &options);
    assert_eq!(verdict["verdict"], "explained", "{verdict:#}");
    assert_eq!(names(&verdict), ["clock_jitter", "lens_scatter"], "{verdict:#}");
    let (sigma_rad, known_to) = parameter(&verdict, "sigma_rad");
    assert!((sigma_rad - 0.004).abs() < 4.0 * known_to, "{sigma_rad} +- {known_to}");
}
