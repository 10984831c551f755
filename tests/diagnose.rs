//! `vuris diagnose`: recovery, silence, the unknown, refusals, and the practice campaigns where they are at hand.

mod diagnosed;
mod recorded;
mod rewritten;

use diagnosed::{concealed, names, parameter, simulated, verdict, vuris};
use recorded::at_hand;
use rewritten::{Sample, rewrite, rewrite_recordings, thin_out};
use serde_json::Value;
use std::path::{Path, PathBuf};
use vuris::physics::EFFECTS;

/// A small campaign with `effects`.
fn campaign(folder: &Path, name: &str, effects: &[&str], seed: &str) -> PathBuf {
    let recordings = "four-sweep,four-rail,four-motion,wdft-sweep,wdft-rail,wdft-motion";
    let own = ["--size", "10x8", "--seed", seed, "--recordings", recordings];
    simulated(folder.join(name), &[&own[..], &concealed(effects)].concat())
}

#[test]
fn clean_campaigns_are_clean_and_say_what_they_would_have_shown() {
    let folder = tempfile::tempdir().unwrap();
    for seed in ["1", "2", "3"] {
        let verdict = verdict(&campaign(folder.path(), seed, &[], seed));
        assert_eq!(verdict["verdict"], "clean", "{verdict:#}");
        // Of these recordings nothing that was held out is unknown.
        for number in [
            "chi2_per_dof_before",
            "chi2_per_dof_after",
            "rms_dn_before",
            "rms_dn_after",
            "distance_rms_m_before",
            "distance_rms_m_after",
        ] {
            assert!(verdict["held_out"][number].is_number(), "{number}");
        }
        let chi2 = verdict["held_out"]["chi2_per_dof_before"].as_f64().unwrap();
        assert!((chi2 - 1.0).abs() < 0.02, "{chi2}");
        // Of every effect the answer says what strength would have been seen, or why none; but for those that the camera includes.
        let said = |name: &str| {
            let has_it = |list: &str| verdict[list].as_array().unwrap().iter().any(|row| row["name"] == name);
            [has_it("smallest_detectable"), has_it("invisible")]
        };
        for effect in EFFECTS {
            let is_included = ["axial_motion", "inverse_square_falloff"].contains(&effect.name);
            assert_eq!(
                said(effect.name).iter().filter(|is_said| **is_said).count(),
                usize::from(!is_included),
                "{}",
                effect.name
            );
        }
    }
}

/// An effect with values, and the parameter that must come back.
type Single = (&'static str, &'static str, &'static str, f64);

const SINGLE: [Single; 5] = [
    ("image_lag", "image_lag:share=0.02", "share", 0.02),
    ("electrical_crosstalk", "electrical_crosstalk:cosine_dn=1.5,sine_dn=-1", "sine_dn", -1.0),
    ("phase_step_scale", "phase_step_scale:relative=0.004", "relative", 0.004),
    (
        "multipath_interference",
        "multipath_interference:relative_amplitude=0.1,wall_distance_m=0.7",
        "relative_amplitude",
        0.1,
    ),
    ("ambient_flicker", "ambient_flicker:cosine=0.05,sine=0.02,frequency_hz=103.1", "frequency_hz", 103.1),
];
const SINGLE_TOO: [Single; 5] = [
    // Of five frames another one comes before the first.
    ("image_lag", "image_lag:share=0.02,last_step_before_first=1", "last_step_before_first", 1.0),
    ("image_lag", "image_lag:share=0.02,last_step_before_first=-1", "last_step_before_first", -1.0),
    ("encoder_cyclic", "encoder_cyclic:cosine_m=0.002,sine_m=0.001,period_m=0.137", "period_m", 0.137),
    // The light falls off with the true distance. (A centimetre may be a wall's light, which is more likely before anything is seen: below.)
    ("encoder_offset", "encoder_offset:offset_m=0.02", "offset_m", 0.02),
    // The runs' velocities are off, and differ from set to set: that is no jitter of the frames' times.
    (
        "encoder_cyclic",
        "encoder_cyclic:cosine_m=0.002,sine_m=0.001,period_m=0.337,controls_carriage=1",
        "controls_carriage",
        1.0,
    ),
];

#[test]
fn single_effects_are_named_with_their_strength_and_held_out_sets_agree_better() {
    are_named(&SINGLE);
}

#[test]
#[ignore = "minutes: make slow"]
fn so_are_other_single_effects() {
    are_named(&SINGLE_TOO);
}

fn are_named(effects: &[Single]) {
    let folder = tempfile::tempdir().unwrap();
    for (number, &(name, effect, key, expected)) in effects.iter().enumerate() {
        let verdict = verdict(&campaign(folder.path(), &number.to_string(), &[effect], "5"));
        assert_eq!(names(&verdict), [name], "{verdict:#}");
        assert_eq!(verdict["verdict"], "explained", "{name}");
        let (value, sigma) = parameter(&verdict, key);
        assert!((value - expected).abs() <= 4.0 * sigma, "{name}: {value} +- {sigma}, not {expected}");
        let held = &verdict["held_out"];
        assert!(held["z"].as_f64().unwrap() > 2.0, "{name}: {held}");
        let [before, after] =
            ["chi2_per_dof_before", "chi2_per_dof_after"].map(|key| held[key].as_f64().unwrap());
        assert!(after < before && (after - 1.0).abs() < 0.03, "{name}: {before} {after}");
    }
}

/// A centimetre of the encoder's zero, and a faint wall a hand's breadth away, change a rail's frames in nearly the same way: whichever is named, the other one is
/// also possible.
#[test]
fn a_small_error_of_the_encoders_zero_is_named_or_possible() {
    let folder = tempfile::tempdir().unwrap();
    for seed in ["5", "6"] {
        let verdict = verdict(&campaign(folder.path(), seed, &["encoder_offset:offset_m=0.01"], seed));
        let effects = verdict["effects"].as_array().unwrap();
        assert_eq!((verdict["verdict"].as_str(), effects.len()), (Some("explained"), 1), "{verdict:#}");
        let possible = effects[0]["also_possible"].as_array().unwrap().iter().chain([&effects[0]["name"]]);
        let mut possible: Vec<&str> = possible.map(|name| name.as_str().unwrap()).collect();
        possible.sort_unstable();
        assert_eq!(possible, ["encoder_offset", "multipath_interference"], "{verdict:#}");
    }
}

/// Sums are rounded in the same order however many threads make them: an answer must not hang on it.
/// Of many sets, which are dealt to threads, and of few, whose frames are.
#[test]
fn the_answer_is_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let simulated = |name: &str, recordings: &str, effects: &[&str]| {
        let own = ["--size", "10x8", "--recordings", recordings];
        simulated(folder.path().join(name), &[&own[..], &concealed(effects)].concat())
    };
    let campaign = simulated("campaign", "four-rail,wdft-rail", &["lens_scatter", "clock_jitter"]);
    let stack = simulated("stack", "harmonics", &["illumination_droop:relative=0.05"]);
    let on = |threads: &str, campaign: &Path| {
        let mut command = assert_cmd::Command::cargo_bin("vuris").unwrap();
        command.env("RAYON_NUM_THREADS", threads).args([
            "diagnose",
            campaign.to_str().unwrap(),
            "--json",
            "-",
        ]);
        let output = command.output().unwrap();
        assert!(output.status.success());
        let mut verdict: Value = serde_json::from_slice(&output.stdout).unwrap();
        verdict.as_object_mut().unwrap().remove("provenance");
        verdict
    };
    for campaign in [campaign, stack] {
        let one = on("1", &campaign);
        assert!(!one["effects"].as_array().unwrap().is_empty(), "{one}");
        for threads in ["2", "5"] {
            assert_eq!(on(threads, &campaign), one, "{threads}");
        }
    }
}

#[test]
fn two_effects_are_found_together_and_a_report_shows_them() {
    let folder = tempfile::tempdir().unwrap();
    let effects = ["phase_step_scale:relative=0.01", "electrical_crosstalk:cosine_dn=-1,sine_dn=2"];
    let campaign = campaign(folder.path(), "pair", &effects, "9");
    let (json, html) = (folder.path().join("verdict.json"), folder.path().join("report.html"));
    let answered = |campaign: &Path| {
        let [campaign, json, html] = [campaign, &json, &html].map(|path| path.to_str().unwrap());
        vuris(&["diagnose", campaign, "--json", json, "--report", html])
    };
    // A second run writes over its own files.
    assert!(
        answered(&simulated(folder.path().join("first"), &["--size", "8x6", "--recordings", "four-rail"])).0
    );
    let (good, text) = answered(&campaign);
    assert!(good && text.contains("phase_step_scale") && text.contains("chi squared a sample"), "{text}");
    let verdict: Value = serde_json::from_str(&std::fs::read_to_string(&json).unwrap()).unwrap();
    assert_eq!(names(&verdict), ["electrical_crosstalk", "phase_step_scale"], "{verdict:#}");
    let page = std::fs::read_to_string(&html).unwrap();
    assert!(page.contains("<svg") && page.contains("data:image/png"));
    // What the terminal says, and more: verdict, parameters, both fits, places, evidence, and what could not be seen.
    let effect = &verdict["effects"][0];
    let held = &verdict["held_out"];
    for told in [
        "<span class=\"verdict\">explained</span>".to_owned(),
        "electrical_crosstalk".to_owned(),
        format!("{:.6}", effect["parameters"][0]["value"].as_f64().unwrap()),
        format!("{:.2e}", effect["parameters"][0]["sigma"].as_f64().unwrap()),
        format!("{:.5}", held["chi2_per_dof_before"].as_f64().unwrap()),
        format!("{:.5}", held["chi2_per_dof_after"].as_f64().unwrap()),
        format!("{:.4}", held["frame_mean_rms_dn_after"].as_f64().unwrap()),
        format!("{:.1} times its scatter", held["z"].as_f64().unwrap()),
        verdict["located"][0]["shape"].as_str().unwrap().to_owned(),
        "alone it takes".to_owned(),
        format!("{:.3e}", verdict["smallest_detectable"][0]["value"].as_f64().unwrap()),
        "What these recordings cannot show".to_owned(),
    ] {
        assert!(page.contains(&told), "{told} is not on the page");
    }
    assert!(text.contains("They would have shown, with 95 %: "), "{text}");
    // Nothing is fetched from elsewhere.
    assert!(!page.contains("http://") && !page.contains("https://"), "the page needs nothing else");
}

#[test]
fn a_camera_that_knows_what_was_found_leaves_nothing_to_find() {
    let folder = tempfile::tempdir().unwrap();
    // Effects of unlike numbers of parameters.
    let effects = ["image_lag:share=0.02", "adc_nonlinearity:sine_dn=2,period_dn=64"];
    let campaign = campaign(folder.path(), "known", &effects, "15");
    let camera = campaign.join("camera.toml");
    let (good, text) =
        vuris(&["diagnose", campaign.to_str().unwrap(), "--write-camera", camera.to_str().unwrap()]);
    assert!(good, "{text}");
    let written = std::fs::read_to_string(&camera).unwrap();
    assert!(written.contains("image_lag:share=0.0"), "{written}");
    let verdict = verdict(&campaign);
    assert_eq!(verdict["verdict"], "clean", "{verdict:#}");
    // The next simulation has it, too.
    let options = ["--camera", camera.to_str().unwrap(), "--recordings", "four-rail,wdft-motion"];
    let next = simulated(folder.path().join("next"), &options);
    assert_eq!(self::verdict(&next)["verdict"], "clean");
}

#[test]
fn bad_masks_dead_pixels_and_odd_sets_raise_no_alarm() {
    let folder = tempfile::tempdir().unwrap();
    let odd = campaign(folder.path(), "odd", &[], "17");
    rewrite(&odd, |s| if s.set % 60 == 30 { s.code + 150.0 } else { s.code });
    let found = verdict(&odd);
    assert_eq!(found["verdict"], "clean", "{found:#}");
    assert!(found["provenance"]["sets_left_out"].as_u64().unwrap() > 5);
    // A row that is dead: no light, no noise.
    let dead = campaign(folder.path(), "dead", &[], "19");
    rewrite(&dead, |s| if s.row == 3 { 64.0 } else { s.code });
    assert_eq!(verdict(&dead)["verdict"], "clean");
    for entry in std::fs::read_dir(&dead).unwrap() {
        let mask = entry.unwrap().path().join("mask.npy");
        if mask.exists() {
            std::fs::remove_file(mask).unwrap();
        }
    }
    let unmasked = verdict(&dead);
    assert_eq!(unmasked["verdict"], "clean", "{unmasked:#}");
    assert!(unmasked["provenance"]["pixels_unlike_the_mask"].as_u64().unwrap() > 3);
}

/// A third of the sets is missing, so that places are seen once, twice or never, and some readings of the encoder are decimetres off.
#[test]
fn unequal_repeats_and_wrong_readings_change_no_answer() {
    let folder = tempfile::tempdir().unwrap();
    let kept = |recording: usize, set: usize| (37 * recording + 11 * set + set * set / 7) % 3 != 1;
    for effects in [&[][..], &["image_lag"]] {
        let thinned = campaign(folder.path(), &effects.len().to_string(), effects, "31");
        thin_out(&thinned, kept);
        rewrite_recordings(&thinned, |number, recording| {
            if number.is_multiple_of(3) {
                let wrong = recording.sets.iter_mut().skip(7).step_by(29);
                wrong.for_each(|set| set.position_m = set.position_m.map(|m| m + 0.2));
            }
        });
        let found = verdict(&thinned);
        assert_eq!(names(&found), effects, "{found:#}");
        assert_eq!(found["verdict"], if effects.is_empty() { "clean" } else { "explained" });
        // Readings so far off belong to sets that are left out, and are counted.
        assert!(found["provenance"]["sets_left_out"].as_u64().unwrap() > 3, "{found:#}");
    }
}

#[test]
fn what_no_effect_explains_is_unexplained_and_located() {
    let folder = tempfile::tempdir().unwrap();
    let banded = campaign(folder.path(), "banded", &[], "11");
    // Rows that flicker from frame to frame, with a phase that never repeats.
    rewrite(&banded, |Sample { set, frame, row, code, .. }| {
        let phase = 7.7 * (set * 5 + frame) as f64 + ((set * 31 + frame * 17) as f64).powi(2) * 0.37;
        code + 6.0 * (row as f64 * 1.9 + phase).sin()
    });
    let verdict = verdict(&banded);
    assert_eq!(verdict["verdict"], "unexplained", "{verdict:#}");
    assert_eq!(names(&verdict), Vec::<String>::new());
    assert_eq!(verdict["located"][0]["coordinate"], "row");
}

/// A library of one effect, `row_ripple`.
const LIBRARY: &str = include_str!("data/row-ripple.toml");

#[test]
fn what_is_unexplained_is_named_when_the_user_gives_its_formula() {
    let folder = tempfile::tempdir().unwrap();
    let ripple = campaign(folder.path(), "ripple", &[], "23");
    rewrite(&ripple, |Sample { set, row, code, .. }| {
        code + 3.0 * (1.9 * row as f64).sin() * (1.0 - 2.0 * (set % 2) as f64)
    });
    let before = verdict(&ripple);
    assert_eq!((before["verdict"].as_str(), names(&before).len()), (Some("unexplained"), 0), "{before:#}");
    let library = folder.path().join("library.toml");
    std::fs::write(&library, LIBRARY).unwrap();
    let arguments =
        ["diagnose", ripple.to_str().unwrap(), "--json", "-", "--library", library.to_str().unwrap()];
    let (good, text) = vuris(&arguments);
    assert!(good, "{text}");
    let after: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(names(&after), ["row_ripple"], "{after:#}");
    let (value, sigma) = parameter(&after, "amplitude_dn");
    // Codes are whole numbers, and so is what was added to them: the sine that fits that best.
    let sine = |row: usize| (1.9 * row as f64).sin();
    let fitting = (0..8).map(|row| (3.0 * sine(row)).round() * sine(row)).sum::<f64>();
    let expected = fitting / (0..8).map(|row| sine(row).powi(2)).sum::<f64>();
    assert!((value - expected).abs() < 4.0 * sigma, "{value} +- {sigma}, not {expected}");
    for (from, to, words) in [
        ("row)", "line)", "neither a parameter nor a coordinate"),
        ("row_ripple", "image_lag", "no other effect has"),
        ("\"signal\"", "\"sound\"", "signal, phase, amplitude or ambient"),
        ("sin(", "sin((", "formula"),
        ("amplitude_dn * sin", "amplitude_dn + sin", "0 where every strength is 0"),
        ("cos(PI * set)", "0", "typical values make something of"),
        ("name = \"amplitude_dn\"", "name = \"row\"", "row is a parameter, and a coordinate"),
        ("formula = \"amplitude_dn * ", "formula = \"", "does not use the parameter amplitude_dn"),
    ] {
        std::fs::write(&library, LIBRARY.replacen(from, to, 1)).unwrap();
        let (good, text) = vuris(&arguments);
        assert!(!good && text.contains(words), "{from}: {text}");
    }
}

#[test]
fn codes_without_their_low_bits_are_the_cameras_own_arithmetic() {
    let folder = tempfile::tempdir().unwrap();
    let cut = campaign(folder.path(), "cut", &["fixed_point:bits_cut=2"], "13");
    let verdict = verdict(&cut);
    assert_eq!(names(&verdict), ["fixed_point"], "{verdict:#}");
    assert_eq!(parameter(&verdict, "bits_cut").0, 2.0);
}

#[test]
fn refusals_say_what_would_be_right() {
    let folder = tempfile::tempdir().unwrap();
    let (good, text) = vuris(&["diagnose", folder.path().to_str().unwrap()]);
    assert!(!good && text.contains("recording"), "{text}");
    let (good, text) = vuris(&["diagnose", "a", "b", "--json", "x"]);
    assert!(!good && text.contains("one campaign"), "{text}");
}

#[test]
fn what_is_passed_over_is_said_and_other_cameras_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let campaign = campaign(folder.path(), "a", &[], "1");
    let half = campaign.join("half");
    std::fs::create_dir(&half).unwrap();
    std::fs::copy(campaign.join("four-rail/frames.npy"), half.join("frames.npy")).unwrap();
    let mask = campaign.join("wdft-rail/mask.npy");
    let mut bytes = std::fs::read(&mask).unwrap();
    if let Some(last) = bytes.last_mut() {
        *last = 1 - *last;
    }
    std::fs::write(&mask, bytes).unwrap();
    // All at full scale: a recording that says nothing.
    rewrite(&campaign, |Sample { recording, code, .. }| if recording == 2 { 4095.0 } else { code });
    let diagnosed = || vuris(&["diagnose", campaign.to_str().unwrap()]);
    let (good, text) = diagnosed();
    assert!(good, "{text}");
    for words in [
        "half: left out: it has frames.npy, and no recording.toml",
        "wdft-rail: has another mask.npy than four-motion",
        "four-sweep: says nothing: all its codes are 0, or at full scale",
    ] {
        assert_eq!(text.matches(words).count(), 1, "{words}: {text}");
    }
    let camera = std::fs::read_to_string(campaign.join("camera.toml")).unwrap();
    let other = camera.replacen("read_noise_e = 36", "read_noise_e = 40", 1);
    assert_ne!(camera, other);
    std::fs::write(campaign.join("wdft-rail/camera.toml"), other).unwrap();
    let (good, text) = diagnosed();
    assert!(!good && text.contains("wdft-rail: has another camera.toml than four-motion"), "{text}");
    // A recording that is there twice.
    std::fs::remove_file(campaign.join("wdft-rail/camera.toml")).unwrap();
    std::fs::remove_file(half.join("frames.npy")).unwrap();
    for file in ["frames.npy", "mask.npy", "sets.csv", "recording.toml"] {
        std::fs::copy(campaign.join("four-rail").join(file), half.join(file)).unwrap();
    }
    let (good, text) = diagnosed();
    assert!(!good && text.contains("has the same frames as four-rail, code for code"), "{text}");
}

/// The practice campaigns of the project's recordings, where they are at hand: `VURIS_PRACTICE`, or beside the repository.
#[test]
#[ignore = "minutes: make slow"]
fn practice_campaigns_come_out_as_labelled() {
    let Some(practice) = at_hand("VURIS_PRACTICE", "practice", "") else { return };
    let (mut labels, mut wrong) = (0, Vec::new());
    for entry in std::fs::read_dir(&practice).unwrap() {
        let campaign = entry.unwrap().path();
        let Ok(label) = std::fs::read_to_string(campaign.join("label.json")) else { continue };
        labels += 1;
        let label: Value = serde_json::from_str(&label).unwrap();
        let verdict = verdict(&campaign);
        let listed = |value: &Value| {
            let mut names: Vec<String> =
                value.as_array().unwrap().iter().map(|name| name.as_str().unwrap().to_owned()).collect();
            names.sort();
            names
        };
        let found = names(&verdict);
        let or = label["or"].as_array().cloned().unwrap_or_default();
        let right = match (label["unknown"].as_bool(), found.is_empty()) {
            (Some(true), true) => {
                verdict["verdict"] == "unexplained" && verdict["located"][0]["coordinate"] == label["where"]
            }
            (Some(true), false) => false,
            (_, true) => listed(&label["effects"]).is_empty() && verdict["verdict"] == "clean",
            _ => found == listed(&label["effects"]) || or.iter().any(|or| found == listed(or)),
        };
        if !right {
            wrong.push(format!("{}: {label} but {} {found:?}", campaign.display(), verdict["verdict"]));
        }
    }
    assert!(labels > 0, "no label.json in {}", practice.display());
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Two sweeps without camera.toml, positions and mask: the simulated camera's third harmonic (0.024129, -0.2421 rad) is none of the
/// sinusoidal camera that is taken for granted then.
#[test]
fn recordings_without_camera_and_positions_are_diagnosed() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--size", "12x10", "--seed", "3", "--recordings", "four-sweep,wdft-sweep"];
    let out = simulated(folder.path().join("sweeps"), &options);
    std::fs::remove_file(out.join("camera.toml")).unwrap();
    for recording in ["four-sweep", "wdft-sweep"] {
        std::fs::remove_file(out.join(recording).join("mask.npy")).unwrap();
        let sets = out.join(recording).join("sets.csv");
        let text = std::fs::read_to_string(&sets).unwrap();
        let column = text.lines().next().unwrap().split(',').position(|name| name == "position_m").unwrap();
        let without = |(number, line): (usize, &str)| {
            let mut cells: Vec<&str> = line.split(',').collect();
            if number > 0 {
                cells[column] = "";
            }
            cells.join(",") + "\n"
        };
        std::fs::write(&sets, text.lines().enumerate().map(without).collect::<String>()).unwrap();
    }
    let verdict = verdict(&out);
    assert_eq!(names(&verdict), ["correlation_harmonics"], "{verdict:#}");
    assert_eq!(verdict["provenance"]["assumed"]["camera"], true);
    assert_eq!(verdict["provenance"]["assumed"]["still_scene"], true);
    for (name, expected) in [("cosine_3", 0.024129 * 0.2421f64.cos()), ("sine_3", 0.024129 * 0.2421f64.sin())]
    {
        let (value, sigma) = parameter(&verdict, name);
        assert!((value - expected).abs() <= 4.0 * sigma, "{name}: {value} +- {sigma}, not {expected}");
    }
    // The electrons a code and the read noise that the recordings were made with: 12, and 36.
    let noise = &verdict["provenance"]["noise"];
    let slope = noise["slope_dn"].as_f64().unwrap();
    assert!((slope - 1.0 / 12.0).abs() < 0.03, "{noise}");
}

/// Nothing that is read is lost, and nothing is found out after a long run that could have been said before.
#[test]
fn files_that_cannot_be_written_are_refused_before_anything_is_done() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--size", "8x6", "--recordings", "four-rail", "--seed", "1"];
    let campaign = simulated(folder.path().join("campaign"), &options);
    let place = campaign.to_str().unwrap();
    let path = |name: &str| campaign.join(name).to_str().unwrap().to_owned();
    let (sets, camera) = (path("four-rail/sets.csv"), path("camera.toml"));
    let (same, nowhere) = (path("same"), path("nowhere/a.json"));
    let before = std::fs::read(&sets).unwrap();
    for (options, words) in [
        (&["--json", &sets][..], "a file that is read"),
        (&["--report", &camera], "a file that is read"),
        (&["--write-camera", &sets], "a file that is read"),
        (&["--json", &same, "--report", &same], "the file of --json, too"),
        (&["--report", "-"], "is not a file's name"),
        (&["--report", place], "is a folder"),
        (&["--json", &nowhere], "its folder is not there"),
    ] {
        let (good, text) = vuris(&[&["diagnose", place], options].concat());
        assert!(!good && text.contains(words) && text.contains("way out: "), "{options:?}: {text}");
    }
    assert_eq!(std::fs::read(&sets).unwrap(), before);
    assert!(!campaign.join("same").exists());
    let again = format!("{place}/.");
    let (good, text) = vuris(&["diagnose", place, &again]);
    assert!(!good && text.contains("is given twice"), "{text}");
    let (good, text) = vuris(&["diagnose", place, "--write-camera", &camera]);
    assert!(good, "{text}");
}

/// What a study of so many clean campaigns and so many of each unknown effect says.
fn study(nulls: &str, unknowns: &str) -> String {
    let counts = ["--nulls", nulls, "--unknowns", unknowns, "--repeats", "0", "--pairs", "0"];
    let (good, text) = vuris(&[&["study", "--seed", "901"], &counts[..]].concat());
    assert!(good, "{text}");
    text
}

/// The short form of `make study`: clean campaigns raise no alarm. What is counted as what is tested beside the counting.
#[test]
fn a_short_study_raises_no_alarm() {
    let text = study("3", "0");
    assert!(text.contains("**Clean campaigns** of the usual six recordings: 0 alarms in 3 ("), "{text}");
}

/// Strong effects that nothing in the registry makes get no name.
#[test]
#[ignore = "minutes: make slow"]
fn a_short_study_gives_no_name_to_what_nobody_knows() {
    // With the clean campaigns before them, which the seeds are counted from.
    let text = study("3", "1");
    let row =
        text.lines().find(|line| line.starts_with("| an unknown effect | rho 30 |")).unwrap_or_default();
    let counts: Vec<usize> = row.split('|').filter_map(|cell| cell.trim().parse().ok()).collect();
    // Cases, right, …, wrong.
    assert!(counts.len() == 7 && counts[0] == 7 && counts[1] >= 6 && counts[6] == 0, "{text}");
}
