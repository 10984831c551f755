//! `vuris simulate`: what it writes is what the format says, to this program and to numpy; noise is the photon transfer's; and the bytes
//! are the same for any number of threads.

mod support;

use assert_cmd::Command;
use std::path::Path;
use std::sync::Arc;
use support::{hdl_tool, said};
use vuris::bench::{Course, Plan, Simulation, chain, injection, practice_camera, sensor, simulate};
use vuris::frames::Geometry;
use vuris::physics::{Active, EFFECTS, Place, Stage};
use vuris::recording::{AXIAL_MOTION, Camera, INVERSE_SQUARE_FALLOFF, Kind, Recording, write_camera};

fn vuris(arguments: &[&str], out: &Path, threads: &str) -> (bool, String) {
    let mut command = Command::cargo_bin("vuris").unwrap();
    command.env("RAYON_NUM_THREADS", threads).arg("simulate").args(arguments).arg("--out").arg(out);
    let output = command.output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    (output.status.success(), text.into_owned())
}

const SHORT: &[&str] =
    &["--recordings", "four-rail,wdft-sweep,four-dark,harmonics,wdft-motion", "--seed", "7"];

/// The files below `folder` with their bytes.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            found.extend(files(&path).into_iter().map(|(below, bytes)| (format!("{name}/{below}"), bytes)));
        } else {
            found.push((name, std::fs::read(path).unwrap()));
        }
    }
    found.sort();
    found
}

#[test]
fn the_bytes_do_not_depend_on_threads_but_on_seed_and_effects() {
    let folder = tempfile::tempdir().unwrap();
    let made = |name: &str, more: &[&str], threads: &str| {
        let out = folder.path().join(name);
        let (good, text) = vuris(&[SHORT, more].concat(), &out, threads);
        assert!(good, "{text}");
        files(&out)
    };
    // Effects of every kind: with a memory, with draws a frame and a pixel.
    let effects =
        ["--effect", "image_lag", "--effect", "clock_jitter", "--effect", "excess_noise:relative=0.01"];
    let one = made("one", &effects, "1");
    assert_eq!(one.len(), 1 + 5 * 4);
    assert!(one == made("two", &effects, "2"), "one thread and two differ");
    let without = made("without", &[], "2");
    let differ: Vec<&str> =
        one.iter().zip(&without).filter(|(a, b)| a != b).map(|((name, _), _)| name.as_str()).collect();
    // What the campaign says of itself does not give the effects away.
    let frames = ["four-dark", "four-rail", "harmonics", "wdft-motion", "wdft-sweep"]
        .map(|r| format!("{r}/frames.npy"));
    assert_eq!(differ, frames);
}

#[test]
fn a_campaign_is_read_back_as_it_was_planned() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("campaign");
    let (good, text) =
        vuris(&[SHORT, &["--effect", "inverse_square_falloff", "--size", "20x16"]].concat(), &out, "2");
    assert!(good, "{text}");
    let opened = |name: &str| Recording::open(&out.join(name)).unwrap();
    for (name, kind, sets, frames) in [
        ("four-rail", Kind::Rail, 102, 4),
        ("wdft-sweep", Kind::PhaseSweep, 96, 5),
        ("four-dark", Kind::Dark, 40, 4),
        ("harmonics", Kind::Harmonics, 12, 64),
        ("wdft-motion", Kind::Motion, 378, 5),
    ] {
        let recording = opened(name);
        assert_eq!(
            (recording.kind, recording.raw.sets(), recording.raw.frames_per_set()),
            (kind, sets, frames)
        );
        assert_eq!(recording.geometry(), Geometry { width: 20, height: 16 });
        assert_eq!((recording.frequency_hz, recording.frame_period_s), (30e6, 0.025));
        // Injected, so not what the simulation includes.
        let camera = recording.camera.as_ref().unwrap();
        assert_eq!(camera.included_physics, ["axial_motion_of_recorded_velocity"]);
        // The window of the target: a twelfth and a ninth of the image at each side.
        assert_eq!(recording.mask.as_ref().unwrap().iter().filter(|sees| **sees).count(), 16 * 12);
    }
    let mean = |recording: &Recording| {
        let codes = recording.raw.codes();
        codes.iter().map(|&code| f64::from(code)).sum::<f64>() / codes.len() as f64
    };
    // The ambient light stays: 5 % of the full scale, above the pedestal of 64.
    let dark = mean(&opened("four-dark"));
    assert!((dark - 64.0 - 0.05 * (4095.0 - 64.0)).abs() < 0.5, "{dark}");
    assert!(mean(&opened("four-rail")) > dark + 50.0);
    // The phase that the target's distance says, as a mean over its pixels.
    let rail = opened("four-rail");
    for set in 0..rail.raw.sets() {
        let error = |pixel: usize| {
            let code = |frame| f64::from(rail.raw.frame(set, frame)[pixel]);
            let phase = (code(1) - code(3)).atan2(code(0) - code(2));
            let (row, column) = rail.geometry().row_column(pixel);
            let expected = vuris::units::phase_rad(rail.range_m(set, row, column).unwrap(), 30e6);
            vuris::units::wrap_rad(phase - expected)
        };
        let seen: Vec<f64> = (0..20 * 16).filter(|&pixel| rail.sees_target(pixel)).map(error).collect();
        let mean = seen.iter().sum::<f64>() / seen.len() as f64;
        // Third and fifth harmonic: 24 and 3 mrad. Noise: in the darkest patch at 3.5 m an amplitude of 15 codes, a charge of 250 and a
        // noise of 6 codes, so 0.28 rad; five standard deviations of a mean of 192 such pixels.
        assert!(mean.abs() < 0.0275 + 5.0 * 0.28 / 192f64.sqrt(), "set {set}: {mean}");
    }
    let (good, text) = vuris(SHORT, &out, "2");
    assert!(!good && text.contains("is there already"), "{text}");
}

/// Shapes and units of the format, read by a program that knows only numpy and the format's text.
#[test]
fn numpy_reads_what_the_format_says() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("campaign");
    let (good, text) = vuris(SHORT, &out, "2");
    assert!(good, "{text}");
    let script = r#"
import csv, sys, tomllib
import numpy as np
camera = tomllib.load(open("campaign/camera.toml", "rb"))
w, h, f = (camera["sensor"][k] for k in ("width", "height", "focal_length_px"))
for name in "four-rail wdft-sweep four-dark harmonics wdft-motion".split():
    told = tomllib.load(open(f"campaign/{name}/recording.toml", "rb"))
    frames = np.load(f"campaign/{name}/frames.npy")
    mask = np.load(f"campaign/{name}/mask.npy")
    rows = list(csv.DictReader(open(f"campaign/{name}/sets.csv")))
    n = told["modulation"]["frames"]
    assert told["format"] == "vuris-recording/1"
    assert frames.dtype == np.dtype("<u2") and frames.flags.c_contiguous
    assert frames.shape == (len(rows), n, h, w), frames.shape
    assert mask.dtype == np.dtype("u1") and mask.shape == (h, w) and set(np.unique(mask)) == {0, 1}
    assert [int(r["set"]) for r in rows] == list(range(len(rows)))
    assert frames.max() < 2 ** camera["sensor"]["adc_bits"]
    if told["kind"] == "dark":
        continue
    # I_n = A cos(n delta + offset - phi) + B, phi = 4 pi f d / c, by least squares on the target.
    delta, hz = told["modulation"]["phase_step_rad"], told["modulation"]["frequency_hz"]
    y, x = np.mgrid[0:h, 0:w]
    oblique = np.sqrt(1 + ((x - (w - 1) / 2) ** 2 + (y - (h - 1) / 2) ** 2) / f ** 2)
    errors = []
    for k, row in enumerate(rows):
        t = np.arange(n) * told["timing"]["frame_period_s"]
        theta = np.arange(n) * delta + float(row["phase_offset_rad"])
        v = float(row["velocity_m_s"])
        motion = 4 * np.pi * hz * v * t / 299792458.0
        design = np.stack([np.cos(theta - motion), np.sin(theta - motion), np.ones(n)], axis=1)
        c, s, b = np.linalg.lstsq(design, frames[k].reshape(n, -1).astype(float), rcond=None)[0]
        phi = 4 * np.pi * hz * float(row["position_m"]) * oblique / 299792458.0
        error = np.angle(np.exp(1j * (np.arctan2(s, c) - phi.ravel())))
        errors.append(error[mask.ravel() == 1].mean())
    rms = float(np.sqrt(np.mean(np.square(errors))))
    if told["kind"] == "harmonics":
        # Harmonic m of I_n is A a_m exp(i (p_m - m phi)).
        parts = np.fft.fft(frames[:, :, mask == 1].astype(float), axis=1)
        turned = parts[:, 1] / np.abs(parts[:, 1])
        for m, (a, p) in enumerate(zip(camera["correlation"]["amplitude"], camera["correlation"]["phase_rad"]), 1):
            found = (parts[:, m] / turned ** m).sum() / np.abs(parts[:, 1]).sum()
            assert abs(found - a * np.exp(1j * p)) < 0.001, (m, found, a, p)
    print(name, len(rows), round(1000 * rms, 1))
    assert rms < 0.03, (name, rms)
"#;
    let (good, text) = said(hdl_tool("python", "cocotb", folder.path()).args(["-c", script]));
    assert!(good, "{text}");
    assert_eq!(text.lines().count(), 4, "{text}");
}

/// Repeats of a still target: the variance is (charge + read noise²) / gain² + 1/12, in bins of the charge.
#[test]
fn repeats_have_the_photon_transfers_variance() {
    let camera = practice_camera(Geometry { width: 24, height: 18 });
    let sensor = sensor(&camera);
    let plan = Plan::usual(3);
    let mut course: Course = plan.course("four-rail").unwrap();
    // Near and far, each 100 times.
    let places: Vec<_> =
        [0, 40, 100].into_iter().flat_map(|set| vec![course.sets[set].clone(); 100]).collect();
    course.sets = places;
    let chain = chain(&camera, Arc::new(Stage::bench().pixels(&sensor, 3)), Vec::new());
    let simulation = Simulation { chain: &chain, sensor: &sensor, noise: true, seed: 3, recording: 0 };
    let raw = simulate(&simulation, &course, &|| ()).unwrap();
    let ratio = |read_noise_e: f64, gain_e_per_dn: f64| {
        let mut bins = vec![(0.0, 0u32); 4];
        for place in 0..3 {
            for frame in 0..4 {
                for pixel in 0..raw.geometry().pixels() {
                    let codes: Vec<f64> =
                        (0..100).map(|n| f64::from(raw.frame(place * 100 + n, frame)[pixel])).collect();
                    let mean = codes.iter().sum::<f64>() / 100.0;
                    let variance = codes.iter().map(|c| (c - mean).powi(2)).sum::<f64>() / 99.0;
                    let charge_e = (mean - 64.0) * gain_e_per_dn;
                    let expected =
                        (charge_e + read_noise_e * read_noise_e) / gain_e_per_dn.powi(2) + 1.0 / 12.0;
                    let bin = (((mean - 64.0) / 250.0) as usize).min(3);
                    bins[bin] = (bins[bin].0 + variance / expected, bins[bin].1 + 1);
                }
            }
        }
        bins.into_iter().map(|(sum, count)| (sum / f64::from(count), count)).collect::<Vec<_>>()
    };
    let within = |(ratio, count): &(f64, u32)| {
        // The variance of a variance of 100 draws is 2/99.
        *count > 30 && (ratio - 1.0).abs() < 4.0 * (2.0 / 99.0 / f64::from(*count)).sqrt()
    };
    let found = ratio(36.0, 12.0);
    assert!(found.iter().all(within), "{found:?}");
    // Another read noise or gain would be seen.
    assert!(!ratio(40.0, 12.0).iter().all(within) && !ratio(36.0, 12.5).iter().all(within));
}

/// A frame is the same whether the one before it was just made or is made again for it.
#[test]
fn image_lag_is_the_same_in_any_order() {
    let camera = practice_camera(Geometry { width: 6, height: 5 });
    let sensor = sensor(&camera);
    let effects: Vec<Active> = EFFECTS.iter().map(|effect| injection(effect.name).unwrap()).collect();
    let chain = chain(&camera, Arc::new(Stage::bench().pixels(&sensor, 3)), effects);
    let plan = Plan::usual(3);
    let mut course = plan.course("wdft-motion").unwrap();
    course.sets.truncate(4);
    let simulation = Simulation { chain: &chain, sensor: &sensor, noise: false, seed: 3, recording: 0 };
    let raw = simulate(&simulation, &course, &|| ()).unwrap();
    for index in (0..course.count()).rev() {
        let mut codes = vec![0; 30];
        sensor.read_out(&simulation.signal(&course, index), None, &mut codes);
        assert_eq!(codes, raw.frame(index / 5, index % 5), "frame {index}");
    }
}

#[test]
fn refusals_say_what_would_be_right() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, words) in [
        (vec!["--effect", "lag"], "expected: correlation_harmonics, inverse_square_falloff"),
        (vec!["--recordings", "five-rail"], "expected: four-sweep, four-rail"),
        (vec!["--light", "0.5"], "--demodulation"),
        (vec!["--light", "1.5", "--demodulation", "0.5"], "light: duty = 1.5"),
        (vec!["--size", "0x5"], "columns x rows"),
        (vec!["--frequency-hz", "nan"], "--frequency-hz: NaN"),
        (vec!["--recordings", "four-dark,harmonics,four-dark"], "four-dark is there twice"),
        (vec!["--effect", "image_lag", "--effect", "image_lag:share=0.1"], "image_lag is there twice"),
        (vec!["--effect", "fixed_point:bits_cut=2.5"], "bits_cut = 2.5\n  expected: a whole number"),
        (vec!["--frame-period-s", "1"], "leaves the rail within a set\n  expected: at most 0."),
        (
            vec!["--size", "4096x4096"],
            "four-sweep: 384 frames of 4096 x 4096 are 25.8 GB of codes\n  expected: at most 2 GB a recording\n  way out: ",
        ),
        (
            vec!["--size", "4096x4096", "--recordings", "four-dark"],
            "--size, --recordings: four-dark: 160 frames",
        ),
    ] {
        let out = folder.path().join("campaign");
        let (good, text) = vuris(&arguments, &out, "1");
        assert!(!good && text.contains(words), "{text}");
        assert!(!out.exists(), "{arguments:?} left something");
    }
}

/// docs/simulator.md lists every effect at its place, and the atlas's table is what the command prints.
#[test]
fn the_notes_show_the_registry_and_what_the_atlas_prints() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let notes = std::fs::read_to_string(root.join("docs/simulator.md")).unwrap();
    let places = ["encoder", "clock", "path", "light", "waveform", "correlation", "charge", "read-out"]
        .map(|p| format!("| {p} | "));
    for effect in EFFECTS {
        let place = Place::ALL.iter().position(|place| *place == effect.place).unwrap();
        let row = notes.lines().find(|line| line.starts_with(&places[place])).unwrap();
        assert!(row.contains(&format!("`{}`", effect.name)), "{} is not in the row: {row}", effect.name);
    }
    let folder = tempfile::tempdir().unwrap();
    Command::cargo_bin("vuris").unwrap().arg("atlas").arg("--out").arg(folder.path()).assert().success();
    let page = std::fs::read_to_string(folder.path().join("atlas.md")).unwrap();
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| [")).collect();
    assert_eq!(rows.len(), EFFECTS.len());
    for (row, effect) in rows.iter().zip(EFFECTS) {
        let shown = row.replace(&format!("[{0}](#{0})", effect.name), &format!("`{}`", effect.name));
        assert!(notes.lines().any(|line| line == shown), "docs/simulator.md does not show\n{shown}");
        assert!(folder.path().join(format!("effects/{}.svg", effect.name)).is_file());
    }
}

/// A pipeline of 12 bits behind a camera of 14 is two bits that are cut: the same bytes, and every code a multiple of 4.
#[test]
fn fixed_point_is_read_from_a_specification() {
    let folder = tempfile::tempdir().unwrap();
    let camera = folder.path().join("camera.toml");
    let mut described = practice_camera(Geometry { width: 24, height: 18 });
    described.adc_bits = 14;
    write_camera(&described, folder.path()).unwrap();
    let made = |name: &str, effect: &str| {
        let out = folder.path().join(name);
        let arguments =
            ["--recordings", "four-dark", "--effect", effect, "--camera", camera.to_str().unwrap()];
        let (good, text) = vuris(&arguments, &out, "2");
        assert!(good, "{text}");
        (files(&out), text, Recording::open(&out.join("four-dark")).unwrap())
    };
    let (by_pipeline, text, recording) = made("pipeline", "fixed_point:pipeline=vuris");
    assert!(text.contains("cuts 2 of the camera's 14 bits"), "{text}");
    assert!(by_pipeline == made("bits", "fixed_point:bits_cut=2").0);
    assert!(recording.raw.codes().iter().all(|code| code % 4 == 0));
    assert!(by_pipeline != made("other", "fixed_point:bits_cut=1").0);
    let (good, text) =
        vuris(&["--effect", "fixed_point:pipeline=none.toml"], &folder.path().join("none"), "2");
    assert!(!good && text.contains("none.toml") && text.contains("presets vuris"), "{text}");
}

/// The camera with these included and these effects, its file in `folder`.
fn described(folder: &Path, included: &[&str], effects: &[&str]) -> String {
    let owned = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect();
    let camera = Camera {
        included_physics: owned(included),
        effects: owned(effects),
        ..practice_camera(Geometry { width: 24, height: 18 })
    };
    let file = folder.join("camera.toml");
    std::fs::write(&file, camera.to_toml()).unwrap();
    file.to_str().unwrap().to_owned()
}

/// Raw codes of the recording four-motion.
fn motion_codes(arguments: &[&str]) -> Vec<u32> {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("campaign");
    let (good, text) = vuris(&[&["--recordings", "four-motion"], arguments].concat(), &out, "2");
    assert!(good, "{text}");
    Recording::open(&out.join("four-motion")).unwrap().raw.codes().to_vec()
}

/// Falloff and motion act once, whichever list of camera.toml names them, with the share that stands there; not twice.
#[test]
fn what_the_baseline_can_include_acts_once() {
    let folder = tempfile::tempdir().unwrap();
    let by = |included: &[&str], effects: &[&str]| {
        motion_codes(&["--camera", &described(folder.path(), included, effects)])
    };
    let both = by(&[AXIAL_MOTION, INVERSE_SQUARE_FALLOFF], &[]);
    assert!(both == by(&[AXIAL_MOTION], &["inverse_square_falloff:share=1.0"]), "falloff among the effects");
    assert!(both == by(&[AXIAL_MOTION], &["inverse_square_falloff"]), "falloff at its usual size");
    assert!(both == by(&[INVERSE_SQUARE_FALLOFF], &["axial_motion:share=1.0"]), "motion among the effects");
    let without = by(&[AXIAL_MOTION], &[]);
    assert!(without != both, "falloff changes nothing");
    assert!(without == by(&[AXIAL_MOTION], &["inverse_square_falloff:share=0.0"]), "a falloff of nothing");
    // What the command line injects stands in the place of either.
    let path = described(folder.path(), &[AXIAL_MOTION], &["inverse_square_falloff"]);
    assert!(both == motion_codes(&["--camera", &path, "--effect", "inverse_square_falloff"]), "injected too");
    for (included, effect) in [
        (INVERSE_SQUARE_FALLOFF, "inverse_square_falloff:share=0.5"),
        (INVERSE_SQUARE_FALLOFF, "inverse_square_falloff@four-motion"),
        (AXIAL_MOTION, "axial_motion"),
    ] {
        let path = described(folder.path(), &[included], &[effect]);
        let (good, text) = vuris(&["--camera", &path], &folder.path().join("out"), "1");
        assert!(!good && text.contains(&path) && text.contains("physics.effects"), "{text}");
        assert!(
            text.contains(effect) && text.contains("physics.included") && text.contains("way out"),
            "{text}"
        );
    }
}

/// What a diagnosis writes of a falloff that it found is simulated once: as the recordings that it was found in.
#[test]
fn a_diagnosed_falloff_is_simulated_once() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("campaign");
    let (good, text) =
        vuris(&["--recordings", "four-rail,four-motion", "--effect", "inverse_square_falloff"], &out, "2");
    assert!(good, "{text}");
    let camera = folder.path().join("found.toml");
    let mut diagnose = Command::cargo_bin("vuris").unwrap();
    diagnose.arg("diagnose").arg(&out).arg("--write-camera").arg(&camera).assert().success();
    let found = Camera::read(&camera).unwrap();
    let named = found.included_physics.iter().chain(&found.effects);
    assert_eq!(named.filter(|name| name.starts_with(INVERSE_SQUARE_FALLOFF)).count(), 1, "{found:?}");
    let again = motion_codes(&["--camera", camera.to_str().unwrap()]);
    assert!(
        again == Recording::open(&out.join("four-motion")).unwrap().raw.codes(),
        "not the recorded codes"
    );
}

/// An effect of nothing is said to be one, on standard error; the fixed point's zero bits, too.
#[test]
fn an_effect_that_is_off_is_said_to_be() {
    let folder = tempfile::tempdir().unwrap();
    let noted = |name: &str, effect: &str| {
        let mut command = Command::cargo_bin("vuris").unwrap();
        command.args(["simulate", "--recordings", "four-dark", "--effect", effect, "--out"]);
        let output = command.arg(folder.path().join(name)).output().unwrap();
        assert!(output.status.success());
        String::from_utf8(output.stderr).unwrap()
    };
    assert_eq!(
        noted("off", "image_lag:share=0"),
        "image_lag:share=0: every strength is off, so that this effect is absent\n"
    );
    assert_eq!(noted("on", "image_lag:share=0.02"), "");
}

/// Effects of one place act in the registry's order, whichever the command line has first.
#[test]
fn the_order_on_the_command_line_changes_nothing() {
    for two in [
        ["saturation:missing=0.6", "intensity_nonlinearity"],
        ["adc_nonlinearity", "intensity_nonlinearity"],
        ["multipath_interference", "frame_gain"],
    ] {
        let codes = |one: &str, other: &str| motion_codes(&["--effect", one, "--effect", other]);
        assert!(codes(two[0], two[1]) == codes(two[1], two[0]), "{two:?}");
    }
}
