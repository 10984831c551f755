//! `vuris diagnose` of cameras whose noise is not what their description says: no physics is left out by that, and what is left out is
//! named nevertheless.

mod diagnosed;
mod rewritten;

use diagnosed::{concealed, names, simulated, verdict};
use rewritten::{Sample, rewrite};
use serde_json::Value;
use std::path::{Path, PathBuf};
use vuris::physics::Draws;

const HEIGHT: usize = 10;
const WIDTH: usize = 12;

/// A sample of a campaign: the number of its frame, its row and column.
type Place = (usize, usize, usize);

/// A campaign with `effects`, to whose codes `noise` is added.
fn campaign(folder: &Path, name: &str, effects: &[&str], noise: impl Fn(Place, f64) -> f64) -> PathBuf {
    let size = format!("{WIDTH}x{HEIGHT}");
    let own = ["--size", &size, "--seed", "31", "--recordings", "four-sweep,four-rail,wdft-rail,wdft-motion"];
    let out = simulated(folder.join(name), &[&own[..], &concealed(effects)].concat());
    rewrite(&out, |Sample { recording, set, frame, row, column, code }| {
        // No recording has more frames a set, or more sets, than this.
        code + noise(((((recording << 10) + set) << 6) + frame, row, column), code)
    });
    out
}

/// A standard normal deviate for each of `what`, which is the same whenever it is asked for.
fn draw(stream: u64, what: usize) -> f64 {
    Draws::of(stream, what as u64).normal(1)[0]
}

fn shared(verdict: &Value) -> &str {
    verdict["provenance"]["noise"]["shared"].as_str().unwrap_or_default()
}

/// How much more noise than is stated is said to be there, in words; nothing where none is.
fn understated(verdict: &Value) -> Option<&str> {
    verdict["provenance"]["understated"].as_str()
}

/// The number with which such words begin.
fn times(words: &str) -> f64 {
    words.split(' ').next().unwrap().parse().unwrap()
}

/// What is added to a code.
type Added = fn(Place, f64) -> f64;

/// A noise, and what of it is said to be shared.
type Noise = (&'static str, Added, &'static str);

const NOISES: [Noise; 6] = [
    (
        "rows of a third of the read noise",
        |(frame, row, _), _| draw(1, frame * HEIGHT + row),
        "common to a row",
    ),
    ("rows as noisy as pixels", |(frame, row, _), _| 3.0 * draw(2, frame * HEIGHT + row), "common to a row"),
    ("columns", |(frame, _, column), _| draw(3, frame * WIDTH + column), "common to a column"),
    ("frames", |(frame, ..), _| draw(4, frame), "common to a frame"),
    (
        "more of all noise, by 30 %",
        |(frame, row, column), code| {
            let variance = 9.0 + (code - 64.0).max(0.0) / 12.0;
            (0.69 * variance).sqrt() * draw(5, (frame * HEIGHT + row) * WIDTH + column)
        },
        "",
    ),
    (
        "outliers",
        |(frame, row, column), _| match draw(6, (frame * HEIGHT + row) * WIDTH + column) {
            size if size.abs() > 2.97 => 80.0 * size.signum(),
            _ => 0.0,
        },
        "",
    ),
];

#[test]
fn noise_that_was_not_stated_raises_no_alarm() {
    let folder = tempfile::tempdir().unwrap();
    for (number, (what, noise, words)) in NOISES.into_iter().enumerate() {
        let verdict = verdict(&campaign(folder.path(), &number.to_string(), &[], noise));
        assert_eq!(verdict["verdict"], "clean", "{what}: {verdict:#}");
        assert!(shared(&verdict).contains(words), "{what}: {verdict:#}");
        assert_eq!(shared(&verdict).is_empty(), words.is_empty(), "{what}: {verdict:#}");
        let floor_dn2 = verdict["provenance"]["noise"]["floor_dn2"].as_f64().unwrap();
        // 9 DN² of read noise and 1/12 of rounding, 0.69 of 9 more.
        let is_more = (floor_dn2 - 15.3).abs() < 1.0;
        assert_eq!(is_more, what.starts_with("more of all noise"), "{what}: {floor_dn2}");
        // All of it, shot noise too, has 1.69 times its variance.
        let said = understated(&verdict);
        match is_more {
            true => assert!(said.is_some_and(|said| (times(said) - 1.69).abs() < 0.1), "{what}: {said:?}"),
            false => assert!(said.is_none_or(|said| times(said) < 1.3), "{what}: {said:?}"),
        }
    }
}

/// Offsets of frames many times as great as a pixel's noise let lines, gains and phase steps appear that nobody needs.
#[test]
fn frames_far_noisier_than_pixels_are_noise() {
    let folder = tempfile::tempdir().unwrap();
    let noises: [(&str, Added); 2] =
        [("3 DN", |(frame, ..), _| 3.0 * draw(9, frame)), ("8 DN", |(frame, ..), _| 8.0 * draw(10, frame))];
    for (what, noise) in noises {
        let verdict = verdict(&campaign(folder.path(), what, &[], noise));
        assert_eq!(verdict["verdict"], "clean", "{what}: {verdict:#}");
        assert!(shared(&verdict).contains("common to a frame"), "{what}: {verdict:#}");
    }
}

#[test]
fn an_effect_is_named_beside_noise_that_was_not_stated() {
    is_named_beside(&NOISES[..2]);
}

#[test]
#[ignore = "minutes: make slow"]
fn so_it_is_beside_other_noise() {
    is_named_beside(&NOISES[2..]);
}

fn is_named_beside(noises: &[Noise]) {
    let folder = tempfile::tempdir().unwrap();
    for (number, &(what, noise, words)) in noises.iter().enumerate() {
        let effect = ["image_lag:share=0.03"];
        let verdict = verdict(&campaign(folder.path(), &number.to_string(), &effect, noise));
        assert_eq!(names(&verdict), ["image_lag"], "{what}: {verdict:#}");
        assert!(shared(&verdict).contains(words), "{what}: {verdict:#}");
    }
}

/// A jitter lets all rows of a frame be off together; rows that are noisy besides are noise nevertheless, and the jitter is none.
#[test]
fn a_jitter_is_named_beside_rows_that_are_noisy() {
    let folder = tempfile::tempdir().unwrap();
    let (_, rows, _) = NOISES[0];
    let verdict = verdict(&campaign(folder.path(), "jitter", &["clock_jitter:sigma_rad=0.008"], rows));
    assert_eq!(names(&verdict), ["clock_jitter"], "{verdict:#}");
    let [value, sigma] =
        ["value", "sigma"].map(|of| verdict["effects"][0]["parameters"][0][of].as_f64().unwrap());
    assert!((value - 0.008).abs() < 3.0 * sigma && sigma < 0.001, "{verdict:#}");
}

/// Rows and frames that are both noisy are noise, and no jitter; frames that stay off from one to the next are a mismatch beside rows that are noisy.
#[test]
fn rows_and_frames_may_be_noisy_together() {
    let folder = tempfile::tempdir().unwrap();
    for (what, frames) in [("as rows", 1.0), ("less than rows", 0.4)] {
        let both = |(frame, row, _): Place, _: f64| draw(1, frame * HEIGHT + row) + frames * draw(4, frame);
        let verdict = verdict(&campaign(folder.path(), what, &[], both));
        assert_eq!(names(&verdict), [""; 0], "{what}: {verdict:#}");
        assert_eq!(verdict["verdict"], "clean", "{what}: {verdict:#}");
    }
    let stay = |(frame, row, _): Place, _: f64| draw(1, frame * HEIGHT + row) + draw(4, frame / 2);
    let verdict = verdict(&campaign(folder.path(), "stay", &[], stay));
    assert_eq!(verdict["verdict"], "unexplained", "{verdict:#}");
}

/// Rows that are off by what repeats, or stands still along the rows or in time, are no noise: that is an effect which nobody knows.
#[test]
fn rows_that_are_not_white_are_no_noise() {
    let folder = tempfile::tempdir().unwrap();
    let patterns: [(&str, Added); 2] = [
        ("waves", |(frame, row, _), _| 2.0 * (1.1 * row as f64 + 7.0 * draw(7, frame)).sin()),
        ("rows that stay for two frames", |(frame, row, _), _| 1.5 * draw(8, frame / 2 * HEIGHT + row)),
    ];
    for (what, pattern) in patterns {
        let verdict = verdict(&campaign(folder.path(), what, &[], pattern));
        assert_eq!(verdict["verdict"], "unexplained", "{what}: {verdict:#}");
        assert_eq!(verdict["located"][0]["coordinate"], "row", "{what}: {verdict:#}");
    }
}

/// Noise in proportion to the signal does not take with it what else is wrong.
#[test]
fn rows_that_are_not_white_are_seen_beside_noise_in_proportion() {
    let folder = tempfile::tempdir().unwrap();
    let waves = |(frame, row, _): Place, _| 2.0 * (1.1 * row as f64 + 7.0 * draw(7, frame)).sin();
    let verdict = verdict(&campaign(folder.path(), "both", &["excess_noise:relative=0.02"], waves));
    assert_eq!(verdict["verdict"], "unexplained", "{verdict:#}");
    assert_eq!(verdict["located"][0]["coordinate"], "row", "{verdict:#}");
}

/// Noise in proportion to the signal is an effect of the registry, beside read and shot noise.
#[test]
fn noise_in_proportion_to_the_signal_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let verdict = verdict(&campaign(folder.path(), "excess", &["excess_noise:relative=0.02"], |_, _| 0.0));
    assert_eq!(names(&verdict), ["excess_noise"], "{verdict:#}");
    let relative = verdict["effects"][0]["parameters"][0]["value"].as_f64().unwrap();
    assert!((relative - 0.02).abs() < 0.002, "{relative}");
    // Sets that were not seen are likelier with it.
    let z = verdict["held_out"]["z"].as_f64().unwrap();
    assert!(z > 5.0, "{z}");
}
