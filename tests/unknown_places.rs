//! `vuris diagnose` on what no library has, in a few pixels for a while, in every other row, in two columns, or wherever the target is at certain places: located, and not named.

mod diagnosed;
mod rewritten;

use diagnosed::{names, parameter, simulated, verdict, verdict_on_changed};
use rewritten::{Sample, rewrite, rewrite_recordings};
use serde_json::Value;
use std::f64::consts::TAU;
use std::path::Path;
use vuris::frames::RawSets;
use vuris::recording::Recording;

/// Code at no light, of the simulated camera.
const PEDESTAL_DN: f64 = 64.0;

/// What is said of a clean campaign of these `recordings`, which `change` has changed.
fn verdict_of(recordings: &str, change: impl Fn(&Path)) -> Value {
    verdict_on_changed(&["--size", "16x12", "--seed", "47", "--recordings", recordings], change)
}

/// Nothing is named, and the mismatch lives in `coordinate` above all, in a shape that says all of `words`.
fn is_located(verdict: &Value, coordinate: &str, words: &[&str]) {
    assert_eq!(verdict["verdict"], "unexplained", "{verdict:#}");
    assert!(names(verdict).is_empty(), "{verdict:#}");
    let located = &verdict["located"][0];
    assert_eq!(located["coordinate"], coordinate, "{verdict:#}");
    let shape = located["shape"].as_str().unwrap();
    assert!(words.iter().all(|word| shape.contains(word)), "{shape}, not {words:?}");
}

/// A fly before the lens takes a two-hundredth of the light of four by four pixels for a third of each recording.
#[test]
fn what_sits_before_a_few_pixels_for_a_while_is_found_where_it_is() {
    let verdict = verdict_of("four-rail,wdft-rail", |campaign| {
        rewrite(campaign, |Sample { set, row, column, code, .. }| {
            let is_there = (3..7).contains(&row) && (8..12).contains(&column) && (30..64).contains(&set);
            if is_there { code - 0.005 * (code - PEDESTAL_DN) } else { code }
        });
    });
    is_located(&verdict, "time_s", &["rows 3 to 6, columns 8 to 11"]);
}

/// Two amplifiers take the rows in turn, and one of them warms up.
#[test]
fn rows_that_take_turns_are_seen_as_such() {
    let verdict =
        verdict_of("four-rail,wdft-rail", |campaign| {
            rewrite(campaign, |Sample { set, row, code, .. }| {
                if row % 2 == 0 { code + 5e-5 * set as f64 * (code - PEDESTAL_DN) } else { code }
            });
        });
    // On a rail the distance grows with the time.
    is_located(&verdict, "row", &["every other line with "]);
}

/// The references of pairs of rows wander from set to set: what is off is no set as a whole, though the mean of its rows is, too.
#[test]
fn rows_that_wander_from_set_to_set_are_rows() {
    let verdict = verdict_of("four-rail,wdft-rail,four-motion", |campaign| {
        rewrite(campaign, |Sample { set, row, code, .. }| {
            // One code in about half of them, at random (SplitMix64).
            let mut bits = ((set * 8 + row / 2 + 1) as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            if bits >> 63 == 0 { code + 1.0 } else { code }
        });
    });
    is_located(&verdict, "row", &["common to a row of a set"]);
}

/// The camera's housekeeping raises every seventh set, and less those after it: a line of another frequency in each recording, as its sets are apart, and another camera's light in none.
#[test]
fn what_comes_with_the_sets_is_of_the_sets() {
    let verdict = verdict_of("four-rail,wdft-rail,wdft-sweep,four-motion,wdft-motion", |campaign| {
        rewrite(campaign, |Sample { set, row, column, code, .. }| {
            // A code in so many of eight pixels, which are others in each row.
            let raised = [6, 3, 2, 1, 0, 0, 0][set % 7];
            if (5 * row + 3 * column) % 8 < raised { code + 1.0 } else { code }
        });
    });
    is_located(&verdict, "set", &["the same every 7 sets"]);
}

/// The converters of two columns sag where the light is bright.
#[test]
fn columns_that_sag_in_bright_light_are_seen_as_such() {
    const BRIGHT_DN: f64 = 500.0;
    let verdict = verdict_of("four-rail,wdft-rail,wdft-sweep", |campaign| {
        rewrite(campaign, |Sample { column, code, .. }| {
            let beyond_dn = if (2..4).contains(&column) { (code - BRIGHT_DN).max(0.0) } else { 0.0 };
            code - 0.02 * beyond_dn
        });
    });
    is_located(&verdict, "column", &["columns 2 to 3", "at signals "]);
}

/// Of every frame (of a recording, of a set, by its number) of a campaign so much `more` of all light than there was.
fn with_more_light(campaign: &Path, more: impl Fn(&Recording, usize, usize) -> f64) {
    rewrite_recordings(campaign, |_, recording| {
        let (geometry, frames) = (recording.geometry(), recording.raw.frames_per_set());
        let anew = |(at, &code): (usize, &u32)| {
            let frame = at / geometry.pixels();
            let light_dn = f64::from(code) - PEDESTAL_DN;
            // A sixteenth of a code is too little to be seen in one: it is there in so many of sixteen.
            let dithered = 0.5 + (((at * 7919) % 16) as f64 - 7.5) / 16.0;
            let more_dn = more(recording, frame / frames, frame % frames) * light_dn;
            (f64::from(code) + more_dn + dithered).floor() as u32
        };
        let codes = recording.raw.codes().iter().enumerate().map(anew).collect();
        recording.raw = RawSets::new(geometry, frames, codes).unwrap();
    });
}

/// The supply gives way whenever the carriage's motor is at a pole: more light is no error of the encoder.
#[test]
fn light_that_goes_with_the_place_is_no_error_of_the_encoder() {
    let verdict = verdict_of("four-rail,wdft-rail,four-motion", |campaign| {
        with_more_light(campaign, |recording, set, _| {
            2e-3 * (TAU * recording.sets[set].position_m.unwrap() / 0.31).cos()
        });
    });
    is_located(&verdict, "position_m", &["a wave of 0.3"]);
}

/// The source's supply ripples: that is no lamp, though frames would see one of the mains' at such a frequency.
#[test]
fn a_source_that_ripples_is_heard_and_no_lamp() {
    const HZ: f64 = 17.1;
    let verdict = verdict_of("four-rail,four-sweep,wdft-motion", |campaign| {
        with_more_light(campaign, |recording, set, frame| {
            let time_s = recording.sets[set].time_s + frame as f64 * recording.frame_period_s;
            3e-3 * (TAU * HZ * time_s + recording.sets.len() as f64).cos()
        });
    });
    is_located(&verdict, "time_s", &["light, a tone of 17.10 Hz", "102.90 Hz"]);
}

/// The driver gives other light at each phase of the shifter, twice a turn: that is no error of single settings, nor another camera.
#[test]
fn light_that_goes_with_the_commanded_phase_is_neither_steps_nor_another_light() {
    let verdict = verdict_of("four-rail,four-sweep,wdft-sweep", |campaign| {
        with_more_light(campaign, |recording, set, frame| {
            let commanded_rad = recording.sets[set].phase_offset_rad + recording.steps_rad[frame];
            4e-3 * (2.0 * commanded_rad + 0.7).cos()
        });
    });
    is_located(&verdict, "phase", &["gain, 2 cycles a turn of the commanded phase"]);
}

/// A lamp that is no filament has an overtone: it is the same lamp.
#[test]
fn a_lamp_may_have_an_overtone() {
    let folder = tempfile::tempdir().unwrap();
    let lamp =
        "ambient_flicker:cosine=0.02,sine=0.01,frequency_hz=99.83,second_cosine=0.006,second_sine=-0.004";
    let options =
        ["--size", "16x12", "--seed", "47", "--recordings", "four-rail,wdft-rail", "--effect", lamp];
    let verdict = verdict(&simulated(folder.path().join("campaign"), &options));
    assert_eq!(names(&verdict), ["ambient_flicker"], "{verdict:#}");
    assert_eq!(verdict["verdict"], "explained", "{verdict:#}");
    for (name, truth) in [("cosine", 0.02), ("second_cosine", 0.006), ("second_sine", -0.004)] {
        let (value, sigma) = parameter(&verdict, name);
        assert!((value - truth).abs() < 4.0 * sigma && sigma < 0.002, "{name}: {value} +- {sigma}");
    }
}
