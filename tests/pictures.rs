//! `vuris diagnose` on stacks of pictures in twelve steps: a projector and a camera of which nothing is told, far from linear, with pixels that saturate.
//! Drawn here, and real ones where they are at hand.

mod diagnosed;
mod recorded;

use diagnosed::{names, parameter, verdict, vuris};
use recorded::at_hand;
use serde_json::Value;
use std::path::{Path, PathBuf};
use vuris::physics::Draws;

const STEPS: usize = 12;
const UNTOLD: &str = "--steps 12 --step-deg 30 --frequency-hz 30e6 --frame-period-s 0.1";

/// Imports `files` as the recording `out`, with more options.
fn import(kind: &str, files: &[&str], options: &str, out: &Path) {
    let options: Vec<&str> = UNTOLD.split(' ').chain(options.split_whitespace()).collect();
    let (good, text) =
        vuris(&[&["import", kind], files, &options, &["--out", out.to_str().unwrap()]].concat());
    assert!(good, "{text}");
}

/// Root mean square of the difference of raw frames that no fit has seen, DN: without what is named, and with it.
fn held_out_dn(verdict: &Value) -> [f64; 2] {
    ["rms_dn_before", "rms_dn_after"].map(|key| verdict["held_out"][key].as_f64().unwrap())
}

// ---------------------------------------------------------------- drawn

const SIZE: (usize, usize) = (40, 60);
/// The light's power, and the code from which on the camera saturates.
const GAMMA: f64 = 2.2;
const CORNER: f64 = 215.0;

/// Pictures of `I = min(255 r (a + b cos(n 30° - phase))^gamma, corner)`, by nothing of this crate but its random numbers. The noise is little in the dark, where
/// codes end; the reflectance r changes from place to place between a twentieth and one and a half, so that some pixels are clipped in most frames.
fn pictures() -> Vec<u8> {
    let mut draws = Draws::of(11, 1);
    let pixels = SIZE.0 * SIZE.1;
    let place = |pixel: usize| ((pixel / SIZE.1) as f64, (pixel % SIZE.1) as f64);
    let reflectance = |(row, column): (f64, f64)| {
        0.05 + 1.45 * (0.5 + 0.25 * ((0.21 * column).sin() + (0.17 * row + 0.05 * column).cos())).powi(2)
    };
    let mut codes = Vec::new();
    for step in 0..STEPS {
        let noise = draws.normal(pixels);
        for (pixel, noise) in noise.into_iter().enumerate() {
            let (row, column) = place(pixel);
            let phase_rad = 0.15 * column + 0.02 * row;
            let angle_rad = step as f64 * std::f64::consts::TAU / STEPS as f64 - phase_rad;
            let light = (0.53 + 0.45 * angle_rad.cos()).powf(GAMMA);
            let signal = (255.0 * reflectance((row, column)) * light).min(CORNER);
            let noise = (0.1 + 0.02 * signal).sqrt() * noise;
            codes.push((signal + noise).round().clamp(0.0, 255.0) as u8);
        }
    }
    codes
}

/// Pixels that are clipped in most frames have numbers that nothing holds: however far these go, what all pixels say is found.
#[test]
fn a_power_and_a_corner_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let [file, out] = ["pictures.bin", "pictures"].map(|name| folder.path().join(name));
    std::fs::write(&file, pictures()).unwrap();
    let shape = format!("--shape {STEPS},{},{} --type u8 --byte-order little", SIZE.0, SIZE.1);
    import("raw", &[file.to_str().unwrap()], &shape, &out);
    let verdict = verdict(&out);
    assert_eq!(names(&verdict), ["intensity_nonlinearity", "saturation"], "{verdict:#}");
    let (exponent, sigma) = parameter(&verdict, "exponent");
    let (missing, _) = parameter(&verdict, "missing");
    assert!((exponent - (GAMMA - 1.0)).abs() < 0.1, "{exponent} +- {sigma}: {verdict:#}");
    assert!((missing - (1.0 - CORNER / 255.0)).abs() < 0.01, "{missing}");
    let [before_dn, after_dn] = held_out_dn(&verdict);
    assert!(before_dn > 8.0 && after_dn < 2.0, "{before_dn} {after_dn}");
}

// ---------------------------------------------------------------- real

/// Scenes of yongleex/CFPE. The first two came with this product's beginnings, the others were first looked at when all was written but
/// the steps of single pixels (src/diagnose/fitting/settling.rs) and the order of candidates far from the data (src/diagnose/naming/completed.rs).
const SCENES: [&str; 4] = ["01", "04", "06", "08"];

/// In every scene the response is named, and frames that the fit has not seen are predicted to 4.5 DN; so they are, with nothing but the pixels' own
/// numbers fitted, by the camera that another scene has told of.
#[test]
fn real_scenes_name_the_response_and_tell_each_other_of_it() {
    let Some(real) = at_hand("VURIS_REAL", "real", "cfpe") else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut cameras: Vec<(&str, PathBuf)> = Vec::new();
    let is_there = |scene: &&str| real.join(format!("{scene}00h.bmp")).exists();
    for scene in SCENES.into_iter().filter(is_there) {
        let files: Vec<String> = (0..STEPS)
            .map(|step| real.join(format!("{scene}{step:02}h.bmp")).to_str().unwrap().to_owned())
            .collect();
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        let out = folder.path().join(scene);
        import("stack", &files, "", &out);
        let camera = folder.path().join(format!("{scene}.toml"));
        let json = folder.path().join(format!("{scene}.json"));
        let [stack, answer, written] = [&out, &json, &camera].map(|path| path.to_str().unwrap());
        let (good, text) = vuris(&["diagnose", stack, "--json", answer, "--write-camera", written]);
        assert!(good, "{text}");
        let alone: Value = serde_json::from_str(&std::fs::read_to_string(&json).unwrap()).unwrap();
        assert!(names(&alone).contains(&"intensity_nonlinearity".to_owned()), "{scene}: {alone:#}");
        let [before_dn, after_dn] = held_out_dn(&alone);
        assert!(before_dn > 8.0 && after_dn < 4.5, "{scene}: {before_dn} {after_dn}");
        for (other, camera) in &cameras {
            let told = folder.path().join(format!("{scene}-told-by-{other}"));
            import("stack", &files, &format!("--camera {}", camera.display()), &told);
            let [told_dn, _] = held_out_dn(&verdict(&told));
            assert!(told_dn < 4.5, "{scene} told by {other}: {told_dn}");
        }
        cameras.push((scene, camera));
    }
    assert!(cameras.len() > 1, "{}: no scenes; expected {SCENES:?}", real.display());
}
