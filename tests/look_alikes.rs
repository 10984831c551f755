//! `vuris diagnose` where one thing is easily taken for another: a strong effect by its tangent, an encoder's error for the encoder's noise, what no
//! effect makes for one that comes near.

mod diagnosed;
mod rewritten;

use diagnosed::{concealed, names, parameter, simulated, verdict};
use rewritten::{Sample, rewrite};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

const SIZE: &str = "12x10";

fn campaign(folder: &Path, size: &str, recordings: &str, effects: &[&str]) -> PathBuf {
    campaign_of(folder, size, recordings, &concealed(effects))
}

/// The same with other `options`.
fn campaign_of(folder: &Path, size: &str, recordings: &str, options: &[&str]) -> PathBuf {
    let own = ["--size", size, "--seed", "31", "--recordings", recordings];
    simulated(folder.join("campaign"), &[&own[..], options].concat())
}

/// `code` with `more`, which need not be whole, rounded up or down as a chance of the sample's own says.
fn with(sample: Sample, more: f64) -> f64 {
    let Sample { recording, set, frame, row, column, code } = sample;
    let places = [recording, set, frame, row, column].map(|place| place as f64);
    let mixed = places.iter().zip([12.9898, 78.233, 37.719, 4.581, 91.17]).map(|(a, b)| a * b).sum::<f64>();
    code + (more + (mixed.sin() * 43_758.545_3).rem_euclid(1.0)).floor()
}

/// What is said of a clean campaign whose codes are changed.
fn verdict_of(recordings: &str, change: impl Fn(Sample) -> f64) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let campaign = campaign(folder.path(), SIZE, recordings, &[]);
    rewrite(&campaign, change);
    verdict(&campaign)
}

/// The same where an effect that nobody is told of, by the formula of a `library`, is concealed.
fn verdict_of_formula(recordings: &str, library: &str, effect: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("library.toml");
    std::fs::write(&file, library).unwrap();
    let options = ["--library", file.to_str().unwrap(), "--effect", effect];
    verdict(&campaign_of(folder.path(), SIZE, recordings, &options))
}

/// Sets begin eleven frames apart.
fn time_s(sample: Sample) -> f64 {
    0.025 * (11 * sample.set + sample.frame) as f64
}

/// Of a quarter of the charge of the frame before, harmonics of the waveform explain more than lag's tangent at no lag.
#[test]
fn a_strong_lag_is_no_harmonics() {
    let folder = tempfile::tempdir().unwrap();
    let campaign = campaign(folder.path(), SIZE, "four-sweep,four-rail", &["image_lag:share=0.25"]);
    let verdict = verdict(&campaign);
    assert_eq!(names(&verdict), ["image_lag"], "{verdict:#}");
    let (share, sigma) = parameter(&verdict, "share");
    assert!((share - 0.25).abs() < 4.0 * sigma, "{share} +- {sigma}");
}

/// Light that sags fast, and then no more, is one droop with its time constant: no droop with other gains of frames.
#[test]
fn a_droop_that_bends_is_one_droop() {
    let folder = tempfile::tempdir().unwrap();
    let droop = ["illumination_droop:relative=0.03,time_constant_s=0.03"];
    let verdict = verdict(&campaign(folder.path(), SIZE, "wdft-sweep,wdft-rail,harmonics", &droop));
    assert_eq!(names(&verdict), ["illumination_droop"], "{verdict:#}");
    let (time_constant_s, sigma_s) = parameter(&verdict, "time_constant_s");
    assert!((time_constant_s - 0.03).abs() < 4.0 * sigma_s, "{time_constant_s} +- {sigma_s}");
}

/// The error of an encoder is found although it could be its noise, whose variance is estimated.
#[test]
fn an_encoders_error_is_no_noise_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let effects = ["phase_step_scale:relative=0.004", "encoder_cyclic:cosine_m=0.0009,period_m=0.24"];
    let verdict = verdict(&campaign(folder.path(), "32x24", "four-sweep,four-rail", &effects));
    assert_eq!(names(&verdict), ["encoder_cyclic", "phase_step_scale"], "{verdict:#}");
    assert_eq!(verdict["verdict"], "explained");
}

/// Asserts that nothing is named, all of the mismatch is left, and both lead in `coordinate`.
#[track_caller]
fn is_unexplained(verdict: &Value, coordinate: &str) {
    assert_eq!((verdict["verdict"].as_str(), names(verdict).len()), (Some("unexplained"), 0), "{verdict:#}");
    assert_eq!(verdict["located"][0]["coordinate"], coordinate, "{verdict:#}");
    assert_eq!(verdict["remainder"], json!({"share": 1.0, "coordinate": coordinate}));
}

/// Bands of rows of a tenth of the noise, that drift: neither a function of the row nor errors of single rows.
#[test]
fn weak_bands_of_rows_are_a_mismatch_in_the_row() {
    let verdict = verdict_of("four-sweep,four-rail", |sample| {
        with(sample, 0.6 * (TAU * (sample.row as f64 / 4.0 + time_s(sample) / 2.3)).cos())
    });
    is_unexplained(&verdict, "row");
    let place = &verdict["located"][0];
    let shape = place["shape"].as_str().unwrap();
    let hz: f64 =
        shape.strip_prefix("a wave of 4.0 rows, ").and_then(|s| s.strip_suffix(" Hz")?.parse().ok()).unwrap();
    // Towards smaller numbers.
    assert!((hz + 1.0 / 2.3).abs() < 0.02, "{shape}");
}

/// An offset of the second frame of each set is found although sets of 64 frames could have one of each.
#[test]
fn a_pulse_in_one_frame_is_a_mismatch_in_the_frame() {
    let verdict = verdict_of("four-sweep,wdft-sweep,harmonics", |sample| {
        with(sample, if sample.frame == 1 { 1.5 } else { 0.0 })
    });
    is_unexplained(&verdict, "frame");
}

/// What comes and goes with a frequency of its own in each recording is no lamp.
#[test]
fn lines_of_different_frequencies_are_no_flicker() {
    let verdict = verdict_of("four-sweep,four-rail", |sample| {
        let frequency_hz = [103.3, 108.9][sample.recording];
        with(sample, 1.2 * (TAU * frequency_hz * time_s(sample)).cos())
    });
    is_unexplained(&verdict, "time_s");
}

/// The mains wander, by less than a lamp's light is known: 0.05 % from one recording to the next.
#[test]
fn a_lamp_is_one_source_although_the_mains_wander() {
    let verdict = verdict_of("four-sweep,four-rail", |sample| {
        let frequency_hz = [103.3, 103.35][sample.recording];
        with(sample, 1.2 * (TAU * frequency_hz * time_s(sample) + sample.recording as f64).cos())
    });
    assert_eq!(names(&verdict), ["ambient_flicker"], "{verdict:#}");
}

/// Light of no lamp on the mains, be it as strong and as even (that of a second camera, a screen): neither it nor what frames every 25 ms see like it, 48.3 and
/// 128.3 Hz and so on, is near twice the mains' frequency.
#[test]
fn light_that_is_not_at_twice_the_mains_frequency_is_no_lamps() {
    let verdict = verdict_of("four-sweep,four-rail", |sample| {
        with(sample, 1.2 * (TAU * 88.3 * time_s(sample) + sample.recording as f64).cos())
    });
    is_unexplained(&verdict, "time_s");
    let shape = verdict["located"][0]["shape"].as_str().unwrap();
    // Which of the lines that frames see alike it is, they cannot tell.
    assert!(shape.contains("88.30 Hz") && shape.contains("111.70 Hz"), "{shape}");
    assert!(shape.ends_with(" that all pixels have alike"), "{shape}");
}

/// So it is beside an effect that repeats from set to set, and has lines wherever sets do: of those near twice the mains' frequency none is a lamp's.
#[test]
fn light_that_is_no_lamps_is_none_beside_what_repeats_from_set_to_set() {
    let folder = tempfile::tempdir().unwrap();
    let droop = ["illumination_droop:relative=0.065"];
    let campaign = campaign(folder.path(), SIZE, "four-sweep,four-rail", &droop);
    rewrite(&campaign, |sample| {
        with(sample, 1.2 * (TAU * 88.3 * time_s(sample) + sample.recording as f64).cos())
    });
    let verdict = verdict(&campaign);
    assert_eq!(names(&verdict), ["illumination_droop"], "{verdict:#}");
    let places = verdict["located"].as_array().unwrap();
    let of_no_lamp = |place: &Value| {
        place["coordinate"] == "time_s"
            && place["shape"].as_str().unwrap().ends_with(" that all pixels have alike")
    };
    assert!(places.iter().any(of_no_lamp), "{verdict:#}");
}

/// A bit of the converter that comes late is one place of each of its periods: a wave over the codes says the most of it, and is not what it is.
#[test]
fn a_bit_that_comes_late_is_no_wave() {
    let place = |sample: Sample| (sample.code / 256.0 + 0.3).fract();
    let late = verdict_of("four-sweep,four-rail", |sample| {
        with(sample, if place(sample) < 0.25 { 0.9 } else { 0.0 })
    });
    is_unexplained(&late, "code");
    let wave = verdict_of("four-sweep,four-rail", |sample| with(sample, 0.45 * (TAU * place(sample)).cos()));
    assert_eq!(names(&wave), ["adc_nonlinearity"], "{wave:#}");
}

/// A step of the offset at one signal, too weak for its overtones: a wave as long as the signals reach says most of it.
#[test]
fn a_step_over_the_signal_is_no_wave() {
    let step = verdict_of("four-rail,four-motion,wdft-rail,wdft-motion", |sample| {
        with(sample, if sample.code > 664.0 { 0.55 } else { 0.0 })
    });
    is_unexplained(&step, "code");
    let place = &step["located"][0];
    assert!(place["shape"].as_str().unwrap().starts_with("a step near a signal of "), "{place:#}");
}

/// A gain that swings with a thermostat, by a fifth of the noise: no function of the time that few numbers say.
#[test]
fn a_swing_is_a_mismatch_in_time() {
    let verdict = verdict_of("four-sweep,four-rail", |sample| {
        with(sample, 0.0012 * (sample.code - 64.0) * (TAU * time_s(sample) / 2.9).cos())
    });
    assert_eq!(verdict["verdict"], "unexplained", "{verdict:#}");
    let place = &verdict["located"][0];
    assert_eq!(place["coordinate"], "time_s", "{place:#}");
    let shape = place["shape"].as_str().unwrap();
    let hz = shape.strip_prefix("gain, a swing of ").and_then(|s| s.strip_suffix(" Hz")?.parse::<f64>().ok());
    assert!(hz.is_some_and(|hz| (hz - 1.0 / 2.9).abs() < 0.01), "{shape}");
}

/// The modulated part alone is less for some seconds: no gain, and no function of the phase.
#[test]
fn a_loss_of_contrast_is_a_mismatch_in_time() {
    let verdict = verdict_of_formula("four-sweep,four-rail", CONTRAST, "contrast_loss");
    is_unexplained(&verdict, "time_s");
    let shape = verdict["located"][0]["shape"].as_str().unwrap();
    assert!(shape.starts_with("contrast, at "), "{shape}");
}

const CONTRAST: &str = r#"
[[effect]]
name = "contrast_loss"
sentence = "The demodulation contrast is less for some seconds."
acts_on = "signal"
formula = "-share * amplitude * cos(angle - phase) * exp(0 - ((time_s - 9) / 3)^2)"
[[effect.parameter]]
name = "share"
unit = "1"
bounds = [0, 1]
typical = 0.05
"#;

/// The source's power is another in each frame, and much of the light is not its own: no gain of all light, and no jitter of the phase.
#[test]
fn a_source_of_another_power_in_each_frame_is_no_jitter() {
    let verdict = verdict_of_formula("four-sweep,four-motion", POWER, "source_power_noise");
    is_unexplained(&verdict, "frame");
    let shape = verdict["located"][0]["shape"].as_str().unwrap();
    assert!(shape.starts_with("random light of ") && shape.ends_with(", common to a frame"), "{shape}");
}

const POWER: &str = r#"
[[effect]]
name = "source_power_noise"
sentence = "The power of the camera's own light is another in each frame."
acts_on = "amplitude"
formula = "share * (sin(12.9898 * set + 78.233 * frame + 4.581) * 43758.5453 - floor(sin(12.9898 * set + 78.233 * frame + 4.581) * 43758.5453) - 0.5)"
[[effect.parameter]]
name = "share"
unit = "1"
bounds = [0, 1]
typical = 0.01
"#;

/// An offset of one frame of each set, which other gains of the frames would nearly make.
#[test]
fn a_weak_pulse_in_one_frame_is_no_other_gain() {
    let verdict =
        verdict_of("four-sweep,wdft-sweep", |sample| with(sample, if sample.frame == 1 { 0.7 } else { 0.0 }));
    assert_eq!(names(&verdict), [""; 0], "{verdict:#}");
    assert_eq!(verdict["located"][0]["coordinate"], "frame", "{verdict:#}");
}

/// What is said of these effects in a campaign of all recordings.
fn verdict_with(effects: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let all = "four-sweep,four-rail,four-motion,wdft-sweep,wdft-rail,wdft-motion";
    verdict(&campaign(folder.path(), "16x12", all, effects))
}

fn names_with(effects: &[&str]) -> Vec<String> {
    names(&verdict_with(effects))
}

fn names_of(effect: &str) -> Vec<String> {
    names_with(&[effect])
}

/// In a moving frame errors of its phase and of its time are the same; but on a rail nothing moves.
#[test]
fn two_jitters_are_two_and_one_is_one() {
    let (clock, timing) = ("clock_jitter:sigma_rad=0.003", "timing_jitter_of_frames:sigma_s=0.003");
    assert_eq!(names_with(&[clock, timing]), ["clock_jitter", "timing_jitter_of_frames"]);
    assert_eq!(names_of(clock), ["clock_jitter"]);
    let verdict = verdict_with(&[timing]);
    assert_eq!(names(&verdict), ["timing_jitter_of_frames"]);
    // Sets that were not seen are likelier with frames of other moments, as strongly as the other sets show them.
    let z = verdict["held_out"]["z"].as_f64().unwrap();
    assert!(z > 3.0, "{z}");
}

/// A strong jitter of frames, which rows of a frame share too, and of which frames that move faster show more.
#[test]
fn a_strong_jitter_is_a_jitter() {
    assert_eq!(names_of("clock_jitter:sigma_rad=0.03"), ["clock_jitter"]);
    assert_eq!(names_of("timing_jitter_of_frames:sigma_s=0.01"), ["timing_jitter_of_frames"]);
}

/// Where frames' errors are known, what they share is no evidence, and what they do not share is all there is.
#[test]
#[ignore = "minutes: make slow"]
fn weak_effects_are_named_beside_a_strong_jitter() {
    let jitter = "timing_jitter_of_frames:sigma_s=0.005";
    let weak = [
        "illumination_droop:relative=0.001",
        "electrical_crosstalk:cosine_dn=0.1,sine_dn=0",
        "phase_step_scale:relative=0.0004",
    ];
    for effect in weak {
        let name = effect.split(':').next().unwrap();
        assert_eq!(names_with(&[jitter, effect]), [name, "timing_jitter_of_frames"]);
    }
}

/// Gains alone are said by errors of each step, too; with gains beside them errors of the steps are their scale.
#[test]
#[ignore = "minutes: make slow"]
fn two_effects_are_those_that_fit_together() {
    let effects = ["frame_gain:frame_1=0.002", "phase_step_scale:relative=0.002"];
    assert_eq!(names_with(&effects), ["frame_gain", "phase_step_scale"]);
}

/// Sixty-four frames that may each have a gain, and show none, do not hide those of sets of a few.
#[test]
fn gains_of_few_frames_are_named_beside_many_frames() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = "four-sweep,four-rail,wdft-sweep,wdft-rail,harmonics";
    let gains = "frame_gain:frame_1=0.0003,frame_2=-0.0003";
    let verdict = verdict(&campaign(folder.path(), "16x12", recordings, &[gains]));
    assert_eq!(names(&verdict), ["frame_gain"], "{verdict:#}");
}

/// Light that falls evenly: a far drift, of which tangents promise more than a fit keeps, is not outvoted by the columns of time.
#[test]
#[ignore = "minutes: make slow"]
fn a_drift_that_goes_on_evenly_is_a_drift() {
    assert_eq!(names_of("illumination_drift:relative=0.5,time_constant_s=700"), ["illumination_drift"]);
}

/// Charge that wanders along rows alone: what mixed pixels at two sides do, but on both sides of the edge alike.
#[test]
#[ignore = "minutes: make slow"]
fn charge_that_wanders_along_rows_is_no_mixed_pixel() {
    assert_eq!(names_of("charge_crosstalk:from_beside=0.005"), ["charge_crosstalk"]);
}

/// A strong phase by one over the amplitude is that form of it, and neither its logarithm nor the frequency error that is nearly the same.
#[test]
#[ignore = "minutes: make slow"]
fn a_phase_by_amplitude_is_alone() {
    assert_eq!(
        names_of("intensity_related_phase:rad_a_factor_e=0.01,exponent=-1"),
        ["intensity_related_phase"]
    );
}

/// The laser's gain of a frame leaves the ambient light as it is.
#[test]
fn a_gain_of_the_lasers_is_a_gain_of_frames() {
    assert_eq!(names_of("frame_gain:frame_1=0.01,of_own_light=1"), ["frame_gain"]);
}

/// A sweep goes through its phase offsets in time, but the rail does not.
#[test]
#[ignore = "minutes: make slow"]
fn a_gain_that_follows_the_offset_is_a_mismatch_in_the_phase() {
    for cycles in [1.0, 3.0] {
        let verdict = verdict_of("four-rail,four-sweep,wdft-sweep", |sample| {
            let offset_rad = if sample.recording == 0 { 0.0 } else { TAU * (sample.set / 2) as f64 / 48.0 };
            with(sample, 0.004 * (sample.code - 64.0) * (cycles * offset_rad).cos())
        });
        assert_eq!(verdict["verdict"], "unexplained", "{verdict:#}");
        assert_eq!(verdict["located"][0]["coordinate"], "phase", "{verdict:#}");
    }
}

/// An S over the converter's whole scale is nearly what a response does that is not linear: both are said.
#[test]
fn a_converters_s_is_told_or_said_to_be_possible() {
    let verdict = verdict_of("four-rail,four-sweep,wdft-sweep", |sample| {
        with(sample, 10.0 * (TAU * sample.code / 4096.0).sin())
    });
    let effects = verdict["effects"].as_array().unwrap();
    assert_eq!(effects.len(), 1, "{verdict:#}");
    let possible = effects[0]["also_possible"].as_array().unwrap();
    let said: Vec<_> = possible.iter().chain([&effects[0]["name"]]).filter_map(Value::as_str).collect();
    assert!(said.contains(&"adc_nonlinearity"), "{verdict:#}");
}

/// What bends the codes by less than a bow over all that is seen is a response: that of the pixels is usual, one of the converter is not.
#[test]
#[ignore = "minutes: make slow"]
fn a_response_that_bends_is_no_converters_error() {
    let bent: [fn(f64) -> f64; 3] = [
        |signal_dn| signal_dn + 8e-6 * signal_dn * signal_dn,
        |signal_dn| 1e5 * -(-signal_dn / 1e5).exp_m1(),
        |signal_dn| signal_dn / (1.0 + signal_dn / 8e4),
    ];
    for (number, bent) in bent.into_iter().enumerate() {
        let verdict = verdict_of("four-rail,four-sweep,wdft-sweep,wdft-motion", |sample| {
            with(Sample { code: 64.0, ..sample }, bent(sample.code - 64.0))
        });
        assert_eq!(names(&verdict), ["intensity_nonlinearity"], "{number}: {verdict:#}");
    }
}

/// Light that goes on drifting between recordings: one drift, that had begun before, and no lamp at a frequency that frames see at rest.
#[test]
fn a_drift_that_began_before_the_recording_is_one_drift() {
    let verdict = verdict_of("four-rail,four-sweep,wdft-sweep", |sample| {
        let time_s = 40.0 * sample.recording as f64 + time_s(sample);
        with(sample, 2.0 * (1.0 - (-time_s / 80.0).exp()))
    });
    assert_eq!(names(&verdict), ["ambient_drift"], "{verdict:#}");
    // Frames 25 ms apart, in sets 275 ms apart, see 120 Hz at rest.
    assert_eq!(verdict["effects"][0]["also_possible"], json!(["ambient_flicker"]), "{verdict:#}");
    let before = verdict["held_out"]["chi2_per_dof_after"].as_f64().unwrap();
    assert!((before - 1.0).abs() < 0.02, "{verdict:#}");
}

/// Light that rises as the square of its time, as at dawn: a drift, and no other camera's beat that frames see nearly at rest, nor what scatters beside it.
#[test]
fn a_drift_that_accelerates_is_one_drift() {
    let verdict = verdict_of("four-sweep,wdft-rail", |sample| {
        let share = time_s(sample) / 30.0;
        with(sample, 3.0 * share * share)
    });
    assert_eq!(names(&verdict), ["ambient_drift"], "{verdict:#}");
    assert_eq!(parameter(&verdict, "course").0, 1.0, "{verdict:#}");
}

/// Ambient light that rises anew within every set: no gains of its frames, nor a droop of the camera's own light, and no lamp.
#[test]
fn a_drift_within_every_set_is_one_drift() {
    let verdict = verdict_of("four-motion,wdft-rail", |sample| with(sample, 0.5 * sample.frame as f64));
    assert_eq!(names(&verdict), ["ambient_drift"], "{verdict:#}");
    assert_eq!(parameter(&verdict, "course").0, -1.0, "{verdict:#}");
    assert_eq!(verdict["effects"][0]["also_possible"], json!([]), "{verdict:#}");
}

/// The same of the camera's own light, and of its phase.
#[test]
#[ignore = "minutes: make slow"]
fn what_fades_or_turns_ever_faster_is_a_drift() {
    for (name, strength) in [("illumination_drift", "relative=0.03"), ("phase_drift", "drift_rad=0.03")] {
        for time_constant_s in [15, 2] {
            let effect = format!("{name}:{strength},time_constant_s={time_constant_s},course=1");
            assert_eq!(names_of(&effect), [name], "{time_constant_s}");
        }
    }
}

/// A phase shifter of which every step is too large makes the sets' phase offsets too large as well, which in a sweep is no drift.
#[test]
fn a_scale_of_steps_and_offsets_is_no_drift() {
    let both = "phase_step_scale:relative=0.004,scales_the_offset=1";
    assert_eq!(names_of(both), ["phase_step_scale"]);
}

/// What moves to the left brings what lies on the right: its tangent is another one than that of what moves to the right.
#[test]
#[ignore = "minutes: make slow"]
fn what_moves_sideways_is_named_to_whichever_side_it_moves() {
    // The way of a carriage that is askew goes to both sides.
    let both_ways =
        ["columns_a_second", "rows_a_second"].into_iter().flat_map(|name| [(name, 0.1), (name, -0.1)]);
    for (name, expected) in both_ways.chain([("columns_a_metre", 0.1), ("rows_a_metre", -0.1)]) {
        let folder = tempfile::tempdir().unwrap();
        let motion = format!("lateral_motion:{name}={expected}");
        let verdict = verdict(&campaign(folder.path(), "16x12", "four-motion,wdft-rail", &[&motion]));
        assert_eq!(verdict["verdict"], "explained", "{motion}: {verdict:#}");
        assert_eq!(names(&verdict), ["lateral_motion"], "{motion}: {verdict:#}");
        let (found, sigma) = parameter(&verdict, name);
        assert!((found - expected).abs() < 4.0 * sigma, "{motion}: {found} +- {sigma}");
    }
}

/// Light of an emitter beside the lens comes further, and is less where amplitudes are not calibrated for it: either way it is that emitter's.
#[test]
fn an_emitter_beside_the_lens_is_named_with_its_light_and_without() {
    for number in ["squared_baseline_m2=0.02", "squared_baseline_of_light_m2=0.01"] {
        let folder = tempfile::tempdir().unwrap();
        let emitter = format!("illumination_baseline:{number}");
        let verdict = verdict(&campaign(folder.path(), "16x12", "wdft-rail,wdft-motion", &[&emitter]));
        assert_eq!(names(&verdict), ["illumination_baseline"], "{number}: {verdict:#}");
        let (name, value) = number.split_once('=').unwrap();
        let (found, sigma) = parameter(&verdict, name);
        assert!((found - value.parse::<f64>().unwrap()).abs() < 4.0 * sigma, "{number}: {found} +- {sigma}");
    }
}

/// Sets with 50 DN more than others are left out beside a falloff that explains a hundred times what they do, and nothing is named for them.
#[test]
#[ignore = "minutes: make slow"]
fn a_strong_effect_hides_no_outliers() {
    const ODD: [(usize, usize); 3] = [(0, 17), (0, 60), (1, 20)];
    let folder = tempfile::tempdir().unwrap();
    let recordings = "four-motion,wdft-motion,wdft-rail";
    let campaign = campaign(folder.path(), "16x12", recordings, &["inverse_square_falloff"]);
    rewrite(&campaign, |sample| {
        let is_odd = ODD.contains(&(sample.recording, sample.set));
        with(sample, if is_odd { 50.0 } else { 0.0 })
    });
    let verdict = verdict(&campaign);
    assert_eq!(verdict["verdict"], "explained", "{verdict:#}");
    assert_eq!(names(&verdict), ["inverse_square_falloff"], "{verdict:#}");
    let left_out: u64 = verdict["provenance"]["sets_left_out"].as_u64().unwrap();
    assert!((3..=5).contains(&left_out), "{verdict:#}");
}

/// Three sets in a row that are off are no outliers, as three of other times are: something lasted that long.
#[test]
fn sets_in_a_row_that_are_off_are_no_outliers() {
    for (odd, word) in [([17, 40, 60], "clean"), ([40, 41, 42], "unexplained")] {
        let folder = tempfile::tempdir().unwrap();
        let campaign = campaign(folder.path(), "16x12", "four-motion,wdft-rail", &[]);
        rewrite(&campaign, |sample| {
            let is_odd = sample.recording == 0 && odd.contains(&sample.set);
            with(sample, if is_odd { 50.0 * sample.frame as f64 } else { 0.0 })
        });
        let verdict = verdict(&campaign);
        assert_eq!(verdict["verdict"], word, "{verdict:#}");
        let left_out = &verdict["provenance"]["sets_left_out_of"]["four-motion"];
        assert!(odd.iter().all(|set| left_out.as_array().unwrap().contains(&(*set).into())), "{verdict:#}");
        let located = verdict["located"].as_array().unwrap();
        assert_eq!(located.len(), usize::from(word != "clean"), "{verdict:#}");
        for place in located {
            let shape = place["shape"].as_str().unwrap();
            assert_eq!(place["coordinate"], "time_s", "{verdict:#}");
            assert!(shape.starts_with("sets 40 to 42, unlike"), "{verdict:#}");
            assert_eq!(place["recording"], "four-motion", "{verdict:#}");
        }
    }
}
