//! `vuris diagnose` on what is known by one form, and comes in another: wells that few samples fill, or that have a knee, shifters of many settings, encoders that control what they
//! measure, noise of few samples, emitters on one side, scatter nearby, taps of half a turn, bits of a wrong weight, walls by another law or on one side, light that
//! fades unevenly, walls that give more light on one side.

mod diagnosed;
mod rewritten;

use diagnosed::{concealed, names, parameter, simulated, verdict};
use num_complex::Complex64;
use rewritten::{rewrite, rewrite_recordings};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use vuris::frames::RawSets;
use vuris::recording::{Recording, write_recording};

fn campaign(folder: &Path, recordings: &str, effects: &[&str]) -> PathBuf {
    let own = ["--size", "16x12", "--seed", "31", "--recordings", recordings];
    simulated(folder.join("campaign"), &[&own[..], &concealed(effects)].concat())
}

/// What is said where an `effect` is concealed.
fn verdict_of(recordings: &str, effect: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    verdict(&campaign(folder.path(), recordings, &[effect]))
}

/// The same where that effect explains all, and is named alone.
fn explained(recordings: &str, effect: &str) -> Value {
    let verdict = verdict_of(recordings, effect);
    let name = effect.split_once(':').map_or(effect, |(name, _)| name);
    assert_eq!(names(&verdict), [name], "{verdict:#}");
    assert_eq!(verdict["verdict"], "explained", "{verdict:#}");
    verdict
}

/// A number that looks as if it were drawn, from 0 to 1, of a sample's or a setting's own.
fn drawn(places: &[usize]) -> f64 {
    let factors = [12.9898, 78.233, 37.719, 4.581, 91.17];
    let mixed: f64 = places.iter().zip(factors).map(|(&place, factor)| place as f64 * factor).sum();
    (mixed.sin() * 43_758.545_3).rem_euclid(1.0)
}

/// Wherever the brightest samples are: a well that clips a few in a thousand of them is found, and where it is full.
#[test]
fn a_well_that_few_samples_fill_is_found() {
    const RECORDINGS: &str = "four-rail,wdft-rail";
    let folder = tempfile::tempdir().unwrap();
    let clean = campaign(folder.path(), RECORDINGS, &[]);
    let recording = Recording::open(&clean.join("four-rail")).unwrap();
    let camera = recording.camera.as_ref().unwrap();
    let mut codes = recording.raw.codes().to_vec();
    codes.sort_unstable();
    for share in [0.002, 0.02] {
        let code = f64::from(codes[((1.0 - share) * codes.len() as f64) as usize]);
        let full_dn = f64::from(camera.full_scale()) - camera.pedestal_dn;
        let missing = 1.0 - (code - camera.pedestal_dn) / full_dn;
        let verdict = verdict_of(RECORDINGS, &format!("saturation:missing={missing:.4}"));
        assert_eq!(names(&verdict), ["saturation"], "{share}: {verdict:#}");
        assert!(!verdict["effects"][0]["parameters"].to_string().contains("knee"), "{share}: {verdict:#}");
        // However few the sets are that show it.
        assert_eq!(verdict["verdict"], "explained", "{share}: {verdict:#}");
        let (found, sigma) = parameter(&verdict, "missing");
        // The number of samples that are beyond it is whole, and its slope has steps: 4 DN.
        assert!((found - missing).abs() < 1e-3 && sigma < 1e-3, "{share}: {found} +- {sigma}, not {missing}");
    }
}

/// A well that becomes full softly: where it is full is found in spite of that.
#[test]
fn a_well_that_is_not_full_at_once_has_a_knee() {
    for knee in [0.015, 0.04] {
        let verdict =
            explained("four-rail,wdft-rail,four-sweep", &format!("saturation:missing=0.75,knee={knee}"));
        for (name, truth) in [("missing", 0.75), ("knee", knee)] {
            let (value, sigma) = parameter(&verdict, name);
            assert!(
                (value - truth).abs() < 4.0 * sigma && sigma < 1e-3,
                "{name}: {value} +- {sigma}, not {truth}"
            );
        }
    }
}

/// Of an encoder that controls the carriage a scale error is one of the modulation frequency, in whatever recording.
#[test]
fn an_encoder_that_controls_the_carriage_may_be_another_frequency() {
    let verdict = verdict_of("wdft-rail,wdft-motion", "encoder_scale:relative=0.01,controls_carriage=1");
    let both = ["encoder_scale", "modulation_frequency_error"];
    let [name] = &names(&verdict)[..] else { panic!("{verdict:#}") };
    assert!(both.contains(&&name[..]), "{verdict:#}");
    let also = verdict["effects"][0]["also_possible"].as_array().unwrap();
    assert!(both.iter().all(|other| other == name || also.contains(&json!(other))), "{verdict:#}");
}

/// A shifter of six bits has 64 settings, of which a sweep over the turn sees all.
#[test]
fn a_shifter_has_an_error_of_each_of_its_settings() {
    let error = |setting: usize| 0.012 * (drawn(&[setting]) - 0.5);
    let settings = (0..64).map(|setting| format!("setting_{setting}_rad={:.6}", error(setting)));
    let settings = settings.chain(["settings_a_turn=64".to_owned()]).collect::<Vec<_>>().join(",");
    let verdict = explained("four-sweep,four-rail", &format!("phase_step_errors:{settings}"));
    assert_eq!(parameter(&verdict, "settings_a_turn").0, 64.0);
    // What all have in common is the pixels' own phase. The sweep's offsets leave every fourth setting out.
    let known = (0..64).map(|setting| parameter(&verdict, &format!("setting_{setting}_rad"))).enumerate();
    let taken: Vec<(usize, (f64, f64))> = known.filter(|(_, (_, sigma))| *sigma < 0.1).collect();
    let common = taken.iter().map(|(setting, _)| error(*setting)).sum::<f64>() / taken.len() as f64;
    let pulls = taken.iter().map(|(setting, (found, sigma))| (found - (error(*setting) - common)) / sigma);
    let greatest = pulls.fold(0.0, |greatest: f64, pull| greatest.max(pull.abs()));
    let well = taken.iter().filter(|(_, (_, sigma))| *sigma < 4e-3).count();
    assert!(greatest < 4.5 && taken.len() == 48 && well > 24, "{greatest}, {well} of {}", taken.len());
    let sentence = verdict["effects"][0]["sentence"].as_str().unwrap();
    assert!(sentence.contains("stated without it"), "{sentence}");
}

/// A shifter that has only so many settings, each where it should be: how many is found, with one number, whether it takes the nearest or the last before a phase.
#[test]
fn a_shifter_rounds_to_the_settings_that_it_has() {
    for (settings, down) in [(100.0, 0.0), (238.4, 1.0)] {
        let effect = format!("phase_step_errors:rounding=1,settings_a_turn={settings},rounds_down={down}");
        let verdict = explained("four-sweep,four-rail,wdft-sweep,wdft-motion", &effect);
        let (rounding, sigma) = parameter(&verdict, "rounding");
        assert!((rounding - 1.0).abs() < 4.0 * sigma && sigma < 0.05, "{rounding} +- {sigma}");
        let found = parameter(&verdict, "settings_a_turn").0;
        assert!((found - settings).abs() < 0.05 && parameter(&verdict, "rounds_down").0 == down, "{found}");
        assert_eq!(verdict["effects"][0]["evidence"]["degrees_of_freedom"], 1);
        let sentence = verdict["effects"][0]["sentence"].as_str().unwrap();
        assert!(sentence.contains(&format!(" The shifter has {settings} settings a turn")), "{sentence}");
    }
}

/// One sample in 500 is 80 DN off, whatever it shows: that is no noise of all.
#[test]
fn samples_that_are_hit_are_no_noise() {
    let folder = tempfile::tempdir().unwrap();
    let campaign = campaign(folder.path(), "four-rail,wdft-motion", &[]);
    rewrite(&campaign, |sample| {
        let places = [sample.recording, sample.set, sample.frame, sample.row, sample.column];
        let is_hit = drawn(&places) < 0.002;
        let sign = if drawn(&[sample.set, sample.row, sample.column]) < 0.5 { 1.0 } else { -1.0 };
        sample.code + if is_hit { 80.0 * sign } else { 0.0 }
    });
    let verdict = verdict(&campaign);
    assert_eq!(verdict["verdict"], "clean", "{verdict:#}");
    assert!(names(&verdict).is_empty());
}

/// Charge waits in the pixels while the camera rests: before a set's first frame was the last one of the set before, wherever the target was then. That is no
/// jitter.
#[test]
fn a_lag_over_the_pause_between_sets_is_no_jitter() {
    let verdict = explained("four-motion,wdft-rail", "image_lag:share=0.01,last_step_before_first=-2");
    let (found, sigma) = parameter(&verdict, "share");
    assert!((found - 0.01).abs() < 4.0 * sigma, "{found} +- {sigma}");
}

/// Pixels that are emptied in the pauses of a rail keep charge from set to set where these come back to back.
#[test]
fn a_lag_may_know_the_pauses() {
    let verdict = explained("four-motion,wdft-rail", "image_lag:share=0.01,last_step_before_first=-4");
    assert_eq!(parameter(&verdict, "last_step_before_first").0, -4.0, "{verdict:#}");
    let (found, sigma) = parameter(&verdict, "share");
    assert!((found - 0.01).abs() < 4.0 * sigma, "{found} +- {sigma}");
}

/// A sweep alone does not tell ambient light, which is even, from the constant light of a target with a texture: an even flicker is none in proportion to both, nor another camera's.
#[test]
fn a_flicker_in_a_sweep_alone_is_a_lamps() {
    let lamp = "ambient_flicker:cosine=0.05,sine=0.03,frequency_hz=100.03,is_even=1";
    let verdict = explained("wdft-sweep", lamp);
    assert_eq!(parameter(&verdict, "is_even").0, 1.0, "{verdict:#}");
}

/// A texture that moves within the target's outline, which stays.
#[test]
fn a_texture_that_moves_is_named() {
    let verdict = verdict_of("four-motion,wdft-motion", "lateral_motion:columns_a_metre=0.4,of_texture=1");
    assert_eq!(names(&verdict), ["lateral_motion"], "{verdict:#}");
    let (found, sigma) = parameter(&verdict, "columns_a_metre");
    assert!((found - 0.4).abs() < 4.0 * sigma, "{found} +- {sigma}");
}

/// Emitters above the lens light the upper half of the image more, the nearer the target is: by more than the way out is longer.
#[test]
fn emitters_on_one_side_light_that_side() {
    let verdict = explained("four-rail,wdft-rail", "illumination_baseline:middle_along_rows_m=-0.05");
    let (found, sigma) = parameter(&verdict, "middle_along_rows_m");
    assert!((found + 0.05).abs() < 4.0 * sigma && sigma < 0.01, "{found} +- {sigma}");
}

/// Scatter that stays near what is bright is no light of the pixels beside the target's edge.
#[test]
fn light_that_is_scattered_nearby_is_scattered_light() {
    let verdict = explained("four-rail,wdft-rail", "lens_scatter:share=0.06,decay_length_of_width=0.2");
    let (found, sigma) = parameter(&verdict, "share");
    assert!((found - 0.06).abs() < 4.0 * sigma, "{found} +- {sigma}");
    assert_eq!(parameter(&verdict, "decay_length_of_width").0, 0.2);
}

/// At 1 and 2 m/s a set goes over a wave of the encoder that controls the carriage: that is no jitter.
#[test]
fn an_encoder_that_errs_within_a_set_is_no_jitter() {
    let verdict = explained(
        "four-motion,four-rail",
        "encoder_cyclic:cosine_m=0.002,sine_m=0.001,period_m=0.13,controls_carriage=1",
    );
    assert_eq!(parameter(&verdict, "controls_carriage").0, 1.0);
}

/// Taps that exchange the halves of a turn: frames 2 and 3 of four, and the third of the steps of a third of a turn. Seven gains of frames say no more. Or the halves
/// of the whole setting, with the set's phase offset: other frames from set to set.
#[test]
fn taps_of_half_a_turn_are_taps() {
    for by in ["1", "0.5"] {
        let verdict =
            explained("four-sweep,wdft-rail", &format!("tap_mismatch:gain=0.004,by_half_turn={by}"));
        let (found, sigma) = parameter(&verdict, "gain");
        assert!((found - 0.004).abs() < 4.0 * sigma && sigma < 0.001, "{found} +- {sigma}");
        assert_eq!(parameter(&verdict, "by_half_turn").0.to_string(), by);
    }
}

/// A bit of a wrong weight is a square wave over the codes, a stage of a wrong gain a sawtooth.
#[test]
fn a_bit_of_a_wrong_weight_is_the_converters_and_so_is_a_stage_of_a_wrong_gain() {
    for form in ["1", "0.5", "-0.5"] {
        let wave = format!("adc_nonlinearity:cosine_dn=0,sine_dn=1.5,period_dn=256,form={form}");
        let verdict = explained("four-rail,wdft-rail", &wave);
        let (found, sigma) = parameter(&verdict, "sine_dn");
        assert!((found - 1.5).abs() < 4.0 * sigma, "{form}: {found} +- {sigma}");
        assert_eq!(parameter(&verdict, "form").0.to_string(), form);
    }
}

/// Weights of several bits that are off at once, each by its own amount, are neither a wave nor a response.
#[test]
fn bits_of_wrong_weights_are_told_one_by_one() {
    let verdict =
        explained("four-rail,wdft-rail", "adc_nonlinearity:bit_3_dn=-0.9,bit_4_dn=0.7,bit_5_dn=-0.6");
    // Of the first ones a response does nearly the same.
    for (name, truth, known_to) in
        [("bit_3_dn", -0.9, 1.0), ("bit_4_dn", 0.7, 0.5), ("bit_5_dn", -0.6, 0.2), ("bit_6_dn", 0.0, 0.1)]
    {
        let (value, sigma) = parameter(&verdict, name);
        assert!((value - truth).abs() < 4.0 * sigma && sigma < known_to, "{name}: {value} +- {sigma}");
    }
}

/// Light that fades unevenly, of a target on a rail that does not move: no drift of all light alike beside emitters that are far aside. (Without frames of no light its
/// constant part is not told from ambient light, which does not fade.)
#[test]
fn what_fades_unevenly_is_told_where_the_rail_rests() {
    let rates = "top_left_per_s=0.004,left_per_s=0.004,middle_per_s=0.002";
    let verdict = explained("four-sweep,wdft-sweep,four-dark", &format!("response_decay:{rates}"));
    let (found, sigma) = parameter(&verdict, "left_per_s");
    assert!((found - 0.004).abs() < 4.0 * sigma && sigma < 0.001, "{found} +- {sigma}");
}

/// A wall of which this `choice` is `chosen` is found, and where it stands, with nothing left to a second name.
fn is_found(share: f64, choice: &str, chosen: &str) {
    let way = format!("relative_amplitude={share},wall_distance_m=0.8,{choice}={chosen}");
    let verdict = explained("four-motion,four-rail,wdft-rail", &format!("multipath_interference:{way}"));
    assert_eq!(parameter(&verdict, choice).0.to_string(), chosen);
    let (found, sigma) = parameter(&verdict, "wall_distance_m");
    assert!((found - 0.8).abs() < 4.0 * sigma, "{chosen}: {found} +- {sigma}");
}

/// Light that comes by a wall may be more of what the right of the image sees than of what its left does: nothing is left to emitters aside.
#[test]
fn a_second_path_may_be_stronger_on_one_side() {
    let way = "relative_amplitude=0.1,more_on_the_right=0.1,wall_distance_m=0.8";
    let verdict = explained("four-motion,four-rail,wdft-rail", &format!("multipath_interference:{way}"));
    for (name, truth) in [("relative_amplitude", 0.1), ("more_on_the_right", 0.1), ("more_below", 0.0)] {
        let (found, sigma) = parameter(&verdict, name);
        assert!((found - truth).abs() < 4.0 * sigma && sigma < 0.02, "{name}: {found} +- {sigma}");
    }
}

/// A wall on one side of the image has its mirror image nearer to what that side sees: nothing is left to emitters aside.
#[test]
fn a_wall_may_stand_on_one_side() {
    ["1", "-0.5"].into_iter().for_each(|side| is_found(0.1, "wall_beside", side));
}

/// Light by way of a wall that is the same share at any distance, or falls with the square of its way, or a room's, which falls less than the direct light, leaves nothing to a
/// second name.
#[test]
fn a_longer_way_is_one_however_its_light_falls() {
    ["-1", "-2", "0.5"].into_iter().for_each(|fall| is_found(0.05, "is_longer_by_a_constant", fall));
}

/// Codes without their four low bits are off by what repeats every 16 of them.
#[test]
fn codes_without_four_bits_are_explained() {
    let verdict = explained("four-rail,wdft-rail", "fixed_point:bits_cut=4");
    assert_eq!(verdict["remainder"]["share"], 0.0, "{verdict:#}");
}

/// A simulated recording of 40 MHz beside others of 30 MHz, as `change` has it.
fn at_two_frequencies(folder: &Path, effects: &[&str], change: impl Fn(&mut Recording)) -> PathBuf {
    const OTHER: &str = "four-motion";
    let at = |frequency_hz: &str, recordings: &str| {
        let own =
            ["--size", "16x12", "--seed", "31", "--recordings", recordings, "--frequency-hz", frequency_hz];
        simulated(folder.join(frequency_hz), &[&own[..], &concealed(effects)].concat())
    };
    let campaign = at("30e6", "four-sweep,four-rail");
    let mut other = Recording::open(&at("40e6", OTHER).join(OTHER)).unwrap();
    change(&mut other);
    other.camera = None;
    write_recording(&other, &campaign.join(OTHER)).unwrap();
    campaign
}

/// Nobody states how far the background is. At one frequency its pixels' own phases say it, and another frequency's are not asked.
#[test]
fn two_modulation_frequencies_are_clean_beside_a_background() {
    let folder = tempfile::tempdir().unwrap();
    let campaign = at_two_frequencies(folder.path(), &[], |other| {
        // The background is elsewhere than the simulator's: a quarter of a turn nearer, at this frequency.
        let (pixels, frames) = (other.geometry().pixels(), other.raw.frames_per_set());
        let codes = other.raw.codes();
        let shifted = |at: usize| {
            let (set, frame, pixel) = (at / pixels / frames, at / pixels % frames, at % pixels);
            let seen = if other.sees_target(pixel) { frame } else { (frame + 1) % frames };
            codes[(set * frames + seen) * pixels + pixel]
        };
        let codes: Vec<u32> = (0..codes.len()).map(shifted).collect();
        assert!(codes != other.raw.codes());
        other.raw = RawSets::new(other.geometry(), frames, codes).unwrap();
    });
    let verdict = verdict(&campaign);
    assert_eq!(verdict["verdict"], "clean", "{verdict:#}");
    assert_eq!(verdict["provenance"]["recordings"].as_array().unwrap().len(), 3, "{verdict:#}");
}

/// Where the phases of all pixels begin is another at each frequency, and nobody states it: that is no mismatch, and what there is beside it is named.
#[test]
fn phases_begin_anywhere_at_another_frequency() {
    const RAD: f64 = 1.0;
    let folder = tempfile::tempdir().unwrap();
    let of = |name: &str, effects: &[&str]| {
        let turned =
            |other: &mut Recording| other.sets.iter_mut().for_each(|set| set.phase_offset_rad += RAD);
        verdict(&at_two_frequencies(&folder.path().join(name), effects, turned))
    };
    let clean = of("clean", &[]);
    assert_eq!(clean["verdict"], "clean", "{clean:#}");
    let [own] = &clean["provenance"]["own_phases"].as_array().unwrap()[..] else { panic!("{clean:#}") };
    let found = own["phase_rad"].as_f64().unwrap();
    assert!((found + RAD).abs() < 0.01 && own["times"] == 1.0 && own["frequency_hz"] == 30e6, "{own:#}");
    let scaled = of("scaled", &["phase_step_scale:relative=0.01"]);
    assert_eq!((names(&scaled), &scaled["verdict"]), (vec!["phase_step_scale".into()], &json!("explained")));
    let (found, sigma) = parameter(&scaled, "relative");
    assert!((found - 0.01).abs() < 4.0 * sigma && sigma < 0.001, "{found} +- {sigma}");
}

/// Where amplitudes are calibrated for emitters on one side, they change the phase alone; what that adds over the columns, two frequencies see: it is no skew.
#[test]
fn emitters_on_one_side_may_change_the_phase_alone() {
    let folder = tempfile::tempdir().unwrap();
    let effect = "illumination_baseline:middle_along_columns_m=0.25,of_phase_alone=1";
    let verdict = verdict(&at_two_frequencies(folder.path(), &[effect], |_| {}));
    assert_eq!(names(&verdict), ["illumination_baseline"], "{verdict:#}");
    let (found, sigma) = parameter(&verdict, "middle_along_columns_m");
    assert!((found - 0.25).abs() < 4.0 * sigma && sigma < 0.05, "{found} +- {sigma}");
    assert_eq!(parameter(&verdict, "of_phase_alone").0, 1.0);
}

/// How much light there is, DN, by this camera's own.
type Light = fn(f64) -> f64;

/// Adds to a campaign the light of another camera that lights a part of the scene, as bright where it is brightest as `light_dn` makes of this camera's own there, at the phase `angle_rad` of the
/// commanded phase and the time.
fn with_another_light(campaign: &Path, light_dn: Light, angle_rad: impl Fn(f64, f64) -> f64) {
    rewrite_recordings(campaign, |number, recording| {
        let (geometry, frames) = (recording.geometry(), recording.raw.frames_per_set());
        let pixels = geometry.pixels();
        // What a set shows of this camera's own light, by so many frames as go once round.
        let turn = (TAU / (recording.steps_rad[1] - recording.steps_rad[0])).round() as usize;
        let own_dn = |set: &[u32], pixel: usize| {
            let of = |frame: usize| {
                Complex64::from_polar(f64::from(set[pixels * frame + pixel]), recording.steps_rad[frame])
            };
            2.0 / turn as f64 * (0..turn).map(of).sum::<Complex64>().norm()
        };
        let spot = |pixel: usize| {
            let (row, column) = geometry.row_column(pixel);
            let column = (column as f64 + 0.5) / geometry.width as f64 - 0.5;
            let row = (row as f64 + 0.5) / geometry.height as f64 - 0.5;
            (-0.5 * (((column - 0.15) / 0.4).powi(2) + ((row + 0.1) / 0.3).powi(2))).exp()
        };
        let mut codes = Vec::with_capacity(recording.raw.codes().len());
        for (set, row) in recording.raw.codes().chunks(pixels * frames).zip(&recording.sets) {
            for (at, code) in set.iter().enumerate() {
                let (frame, pixel) = (at / pixels, at % pixels);
                let time_s = row.time_s + frame as f64 * recording.frame_period_s;
                let commanded_rad = recording.steps_rad[frame] + row.phase_offset_rad;
                let cosine = (angle_rad(commanded_rad, time_s) + number as f64).cos();
                let more_dn = light_dn(own_dn(set, pixel)) * spot(pixel) * cosine;
                codes.push((f64::from(*code) + more_dn).round() as u32);
            }
        }
        recording.raw = RawSets::new(geometry, frames, codes).unwrap();
    });
}

/// The light of another camera that lights a part of the scene, whichever of light and gate takes this camera's phase steps: its beat, and where it falls.
#[test]
fn another_camera_may_light_a_part_of_the_scene() {
    const BEAT_HZ: f64 = 7.31;
    let lights: [(f64, Light); 3] = [(0.0, |own_dn| 0.04 * own_dn), (0.0, |_| 8.0), (1.0, |_| 8.0)];
    for (steps, light_dn) in lights {
        let folder = tempfile::tempdir().unwrap();
        let campaign = campaign(folder.path(), "four-rail,wdft-rail,four-sweep", &[]);
        with_another_light(&campaign, light_dn, |commanded_rad, time_s| {
            steps * commanded_rad - TAU * BEAT_HZ * time_s
        });
        let verdict = verdict(&campaign);
        assert_eq!(names(&verdict), ["multi_camera_interference"], "{steps}: {verdict:#}");
        assert_eq!(verdict["verdict"], "explained", "{steps}: {verdict:#}");
        let falls = [0.4_f64, 0.3].map(|width| 0.5 / width.powi(2));
        let truths = [
            ("beat_hz (four-rail)", BEAT_HZ),
            ("rise_along_columns", 2.0 * falls[0] * 0.15),
            ("rise_along_rows", 2.0 * falls[1] * -0.1),
            ("fall_squared_along_columns", falls[0]),
            ("fall_squared_along_rows", falls[1]),
        ];
        for (name, truth) in truths {
            let (value, sigma) = parameter(&verdict, name);
            assert!(
                (value - truth).abs() < 4.0 * sigma && sigma < 0.2 * truth.abs(),
                "{steps}, {name}: {value} +- {sigma}, not {truth}"
            );
        }
    }
}

/// A gain of one frame is one number, and no offset of that frame.
#[test]
fn one_frame_of_each_set_may_have_a_gain() {
    let verdict = explained("four-rail,four-motion,wdft-rail", "frame_gain:frame_2=0.0012");
    let (gain, sigma) = parameter(&verdict, "frame_2");
    assert!((gain - 0.0012).abs() < 4.0 * sigma && sigma < 0.0002, "{gain} +- {sigma}");
    assert_eq!(verdict["effects"][0]["evidence"]["degrees_of_freedom"], 1, "{verdict:#}");
}
