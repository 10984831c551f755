//! Ranges of recorded campaigns against their encoder, by the reference in floating point.

mod recorded;

use recorded::at_hand;
use std::path::{Path, PathBuf};
use vuris::frames::RawSets;
use vuris::problem::Result;
use vuris::ranging::{RangeErrors, range_errors};
use vuris::recording::Recording;
use vuris::recording::matching::{SchemeChoice, pipeline_for};
use vuris::reference::{DifferenceStatistics, reference_images};
use vuris::spec::Pipeline;
use vuris::units::phase_rad;

/// Errors of the recording in `folder`, processed with whichever scheme fits it.
fn errors(folder: &Path) -> Result<RangeErrors> {
    errors_of(&Recording::open(folder)?)
}

fn errors_of(recording: &Recording) -> Result<RangeErrors> {
    let (pipeline, _) = pipeline_for(recording, &Pipeline::named("vuris")?, SchemeChoice::Auto)?;
    let images = reference_images(&pipeline, &recording.raw)?;
    range_errors(recording, &images.range_m, &images.valid)
}

fn committed() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/practice-01")
}

/// What the camera's correlation waveform alone makes of `recording`: the same sets without noise.
fn predicted(recording: &Recording) -> Recording {
    let camera = recording.camera.as_ref().unwrap();
    let harmonics: Vec<(f64, f64, f64)> = (1..)
        .zip(camera.correlation_amplitude.iter().zip(&camera.correlation_phase_rad))
        .map(|(m, (&amplitude, &phase_rad))| (f64::from(m), amplitude, phase_rad))
        .collect();
    let geometry = recording.geometry();
    let mut codes = Vec::new();
    for (set, row) in recording.sets.iter().enumerate() {
        for step_rad in &recording.steps_rad {
            for pixel in 0..geometry.pixels() {
                let (r, c) = geometry.row_column(pixel);
                let range_m = recording.range_m(set, r, c).unwrap();
                let angle_rad = step_rad + row.phase_offset_rad - phase_rad(range_m, recording.frequency_hz);
                let sum: f64 = harmonics.iter().map(|&(m, a, p)| a * (m * angle_rad + p).cos()).sum();
                codes.push((1800.0 * sum + 2048.0).round() as u32);
            }
        }
    }
    let raw = RawSets::new(geometry, recording.steps_rad.len(), codes).unwrap();
    Recording { raw, ..recording.clone() }
}

/// Holds the errors of a recording of a still target to those of its camera's waveform, but for noise: the means over
/// the pixels differ by the single pixels' noise over the root of their number. Gives the prediction's RMS in m.
fn assert_explained_by_waveform(recording: &Recording) -> f64 {
    let name = &recording.name;
    let measured = errors_of(recording).unwrap();
    let predicted = errors_of(&predicted(recording)).unwrap();
    let both = measured.set_mean_m.iter().flatten().zip(predicted.set_mean_m.iter().flatten());
    let rest = DifferenceStatistics::of(both.map(|(measured, predicted)| measured - predicted)).unwrap();
    let pixels_a_set = measured.pixels.count as f64 / measured.set_means.count as f64;
    let noise_m = (measured.pixels.rms.powi(2) - predicted.pixels.rms.powi(2)).sqrt() / pixels_a_set.sqrt();
    // About a hundred sets: the RMS of pure noise is known to 1/sqrt(2 * 100) = 7 %.
    assert!((rest.rms / noise_m - 1.0).abs() < 0.25, "{name}: {rest:?} against noise of {noise_m} m");
    predicted.set_means.rms
}

/// With four frames the third harmonic is an error of 4 cycles a turn; the windowed DFT rejects it, and keeps the fifth
/// and seventh.
#[test]
fn linearity_errors_of_the_committed_campaign_are_those_of_its_waveform() {
    for (name, mm) in [("four-rail", 10.0..13.0), ("wdft-rail", 0.5..2.0)] {
        let recording = Recording::open(&committed().join(name)).unwrap();
        let rms_mm = 1e3 * assert_explained_by_waveform(&recording);
        assert!(mm.contains(&rms_mm), "{name}: {rms_mm} mm");
    }
}

#[test]
fn the_committed_campaign_is_read_in_full() {
    let recording = Recording::open(&committed().join("wdft-rail")).unwrap();
    assert_eq!(recording.name, "wdft-rail");
    assert_eq!((recording.raw.sets(), recording.raw.frames_per_set(), recording.adc_bits()), (102, 5, 12));
    assert_eq!((recording.geometry().width, recording.geometry().height), (24, 18));
    // The corner pixel of 24 x 18 at focal length 33: x = 11.5, y = 8.5.
    let corner_m = 1.00009 * (1.0f64 + (11.5f64.powi(2) + 8.5f64.powi(2)) / 33f64.powi(2)).sqrt();
    assert!((recording.range_m(0, 0, 0).unwrap() - corner_m).abs() < 1e-12);
    assert_eq!((recording.range_m(102, 0, 0), recording.range_m(0, 18, 0)), (None, None));
}

/// Larger recordings that are not part of the package.
fn recordings(part: &str) -> Option<PathBuf> {
    at_hand("VURIS_RECORDINGS", "", part)
}

/// Prints the table of errors (`cargo test -- --nocapture`), and holds the campaigns without a mismatch to it.
#[test]
fn every_practice_campaign_is_ranged() {
    let Some(practice) = recordings("practice") else { return };
    const NAMES: [&str; 6] =
        ["four-rail", "wdft-rail", "four-sweep", "wdft-sweep", "four-motion", "wdft-motion"];
    println!("RMS in mm: mean over the pixels of each set | single pixels");
    println!("campaign {}", NAMES.map(|name| format!("{name:>16}")).concat());
    for campaign in 1..=12 {
        let rms_mm = NAMES.map(|name| {
            let errors = errors(&practice.join(format!("{campaign:02}")).join(name)).unwrap();
            (errors.set_means.rms * 1e3, errors.pixels.rms * 1e3)
        });
        let cells = rms_mm.map(|(means, pixels)| format!("{means:>8.2} |{pixels:>6.2}"));
        println!("{campaign:>8} {}", cells.concat());
        // The first two have no mismatch. The sweeps hold only with the right sign of the phase offset.
        for name in NAMES.iter().filter(|name| campaign <= 2 && !name.ends_with("motion")) {
            let folder = practice.join(format!("{campaign:02}")).join(name);
            assert_explained_by_waveform(&Recording::open(&folder).unwrap());
        }
    }
}

/// A recording without encoder, camera or mask, with many frames a set and a table of their times.
#[test]
fn a_real_recording_of_many_frames_is_read_and_taken_as_a_plain_dft() {
    let Some(real) = recordings("real/flimfast") else { return };
    let recording = Recording::open(&real).unwrap();
    assert_eq!((recording.raw.sets(), recording.raw.frames_per_set()), (1, 32));
    assert_eq!((recording.sets[0].position_m, recording.camera.is_none()), (None, true));
    assert_eq!(recording.frame_time_s(0, 2), Some(0.271));
    let base = Pipeline::named("vuris").unwrap();
    let (pipeline, _) = pipeline_for(&recording, &base, SchemeChoice::Auto).unwrap();
    let scheme = &pipeline.modulation.scheme;
    assert_eq!((scheme.name.as_ref(), scheme.steps()), ("dft", 32));
    for (step, commanded_rad) in recording.steps_rad.iter().enumerate() {
        assert!((scheme.angle_rad(step) - commanded_rad).abs() < 1e-4, "step {step}");
    }
}
