//! `vuris diagnose` on stacks of pictures in few steps, of which nothing is told: three to six frames, of which each pixel's own numbers take most.

mod diagnosed;

use diagnosed::{names, verdict, vuris};
use serde_json::Value;
use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};
use vuris::physics::Draws;

const SIZE: (usize, usize) = (64, 70);

/// A stack of `I = b + a cos(n 360°/N - phase)` bent by `bent`, by nothing of this crate but its random numbers, with a variance of `0.5 + 0.022 I`, as eight bits.
fn stack(folder: &Path, steps: usize, seed: u64, bent: impl Fn(f64) -> f64) -> PathBuf {
    let mut draws = Draws::of(seed, steps as u64);
    let mut codes = Vec::new();
    for step in 0..steps {
        for (pixel, noise) in draws.normal(SIZE.0 * SIZE.1).into_iter().enumerate() {
            let (row, column) = ((pixel / SIZE.1) as f64, (pixel % SIZE.1) as f64);
            let light = 110.0 + 40.0 * (column / 40.0).sin() * (row / 50.0).cos();
            let phase_rad = TAU * column / 23.0 + 0.5 * (row / 30.0).sin();
            let angle_rad = TAU * step as f64 / steps as f64 - phase_rad;
            // The same power bends what is modulated more to more of a harmonic.
            let contrast = 0.3 + 0.2 * ((row + column) / 15.0).cos();
            let signal = bent(light * (1.0 + contrast * angle_rad.cos()));
            codes.push((signal + (0.5 + 0.022 * signal).sqrt() * noise).round() as u8);
        }
    }
    let [file, out] = ["frames.bin", "stack"].map(|name| folder.join(name));
    std::fs::write(&file, codes).unwrap();
    let shape = format!("{steps},{},{}", SIZE.0, SIZE.1);
    let [count, step_deg] = [steps.to_string(), (360.0 / steps as f64).to_string()];
    let mut arguments = vec!["import", "raw", file.to_str().unwrap(), "--shape", &shape, "--type", "u8"];
    arguments.extend(["--byte-order", "little", "--steps", &count, "--step-deg", &step_deg]);
    arguments.extend(["--frequency-hz", "30e6", "--frame-period-s", "0.1", "--out", out.to_str().unwrap()]);
    let (good, text) = vuris(&arguments);
    assert!(good, "{text}");
    out
}

fn of_stack(steps: usize, seed: u64, bent: impl Fn(f64) -> f64) -> Value {
    let folder = tempfile::tempdir().unwrap();
    verdict(&stack(folder.path(), steps, seed, bent))
}

/// What residuals show of the noise is what the pixels' own numbers leave: of four frames a quarter. What is predicted from few frames has their noise, too.
#[test]
fn sinusoids_in_few_steps_are_clean() {
    for (steps, seed) in [4, 5, 6, 8].into_iter().flat_map(|steps| [1, 2, 3].map(|seed| (steps, seed))) {
        let verdict = of_stack(steps, seed, |light| light);
        assert_eq!(verdict["verdict"], "clean", "{steps}: {verdict:#}");
        let [chi2, rms_dn] =
            ["chi2_per_dof_before", "rms_dn_before"].map(|key| verdict["held_out"][key].as_f64().unwrap());
        // The noise itself is measured on as few. Of four frames each is told by three of other brightness, and their noise is not its own.
        let more = if steps == 4 { 0.3 } else { 0.1 };
        assert!((-0.1..more).contains(&(chi2 - 1.0)), "{steps}: {chi2}");
        assert!(rms_dn < 5.0, "{steps}: {rms_dn} DN");
    }
}

/// A power of the light is seen, in four steps and in more: no wave over the codes, whose period is longer than the signals reach. Pixels absorb nearly all of
/// it, and a fit that does not let them follow stays where it began.
#[test]
fn a_power_is_the_responses_in_any_number_of_steps() {
    for (steps, seed) in [6, 12].into_iter().flat_map(|steps| [1, 2, 3].map(|seed| (steps, seed))) {
        let verdict = of_stack(steps, seed, |light| 255.0 * (light / 255.0).powf(0.6));
        assert_eq!(names(&verdict), ["intensity_nonlinearity"], "{steps}, {seed}: {verdict:#}");
    }
    let verdict = of_stack(4, 4, |light| 255.0 * (light / 255.0).powf(0.6));
    assert_eq!(names(&verdict), ["intensity_nonlinearity"], "{verdict:#}");
    let [before, after] =
        ["chi2_per_dof_before", "chi2_per_dof_after"].map(|key| verdict["held_out"][key].as_f64().unwrap());
    assert!(before > 1.2 && after < 1.1, "{before} {after}");
}

/// One set is not unlike another one, and of a still scene nothing is at several places; what nobody has described is assumed, and that is said.
#[test]
fn of_a_single_set_no_other_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let stack = stack(folder.path(), 12, 1, |light| 255.0 * (light / 255.0).powf(0.6));
    let [json, camera] = ["a.json", "camera.toml"].map(|name| folder.path().join(name));
    let (good, text) = vuris(&[
        "diagnose",
        stack.to_str().unwrap(),
        "--json",
        json.to_str().unwrap(),
        "--write-camera",
        camera.to_str().unwrap(),
    ]);
    assert!(good, "{text}");
    let verdict: Value = serde_json::from_slice(&std::fs::read(&json).unwrap()).unwrap();
    let located: Vec<&str> = verdict["located"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["coordinate"].as_str().unwrap())
        .collect();
    assert!(located.contains(&"code") && !located.contains(&"set"), "{located:?}");
    assert!(!located.contains(&"position_m"), "{located:?}");
    for words in [
        "(probability of a mismatch above 0.99)",
        "intensity_nonlinearity (probability ",
        "On one set that the fit has not seen",
        "no camera.toml describes the camera: 8 bits",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
}

/// Three frames are three numbers: any three agree with any simulation.
#[test]
fn three_steps_test_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let out = stack(folder.path(), 3, 5, |light| 255.0 * (light / 255.0).powf(0.5));
    let (good, text) = vuris(&["diagnose", out.to_str().unwrap()]);
    assert!(!good && text.contains("no pixel has more than 3 samples"), "{text}");
    assert!(text.contains("record at least four steps a set"), "{text}");
}

/// Phases of which there are fewer than three do not tell amplitude, phase and offset, however many frames there are; three do, and so do steps that are a little apart.
#[test]
fn steps_at_two_phases_test_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let out = stack(folder.path(), 12, 5, |light| light);
    let recording = out.join("recording.toml");
    let text = std::fs::read_to_string(&recording).unwrap();
    let line = text.lines().find(|line| line.starts_with("phase_step_rad")).unwrap();
    let with = |step_rad: f64| {
        std::fs::write(&recording, text.replace(line, &format!("phase_step_rad = {step_rad}"))).unwrap();
        vuris(&["diagnose", out.to_str().unwrap()])
    };
    for (step_rad, says) in
        [(0.0, "at 0.000\u{b0}"), (TAU, "at 0.000\u{b0}"), (PI, "at 0.000\u{b0} and 180.000\u{b0}")]
    {
        let (good, said) = with(step_rad);
        assert!(!good && said.contains(says) && said.contains("way out: "), "{step_rad}: {said}");
    }
    assert!(with(TAU / 3.0).0 && with(0.02).0);
}
