//! The simulator against the closed forms of its effects.

use super::*;
use crate::frames::Geometry;
use crate::spec::scheme;
use crate::units::{unambiguous_range_m, wrap_rad};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Four frames or WDFT at 30 MHz and 25 ms a frame, one set.
fn acquisition(name: &str) -> Acquisition {
    Acquisition {
        scheme: scheme(name).unwrap().clone(),
        frames_per_step: 1,
        order: (0..scheme(name).unwrap().steps()).collect(),
        frequency_hz: FREQUENCY_HZ,
        frame_period_s: 0.025,
        sets: 1,
    }
}

/// One pixel on the axis, 16 bits, and light for amplitudes of 20000 DN at 1 m.
fn one_pixel() -> Sensor {
    Sensor {
        geometry: Geometry { width: 1, height: 1 },
        amplitude_1m_e: 2_000_000.0,
        adc_bits: 16,
        ..Sensor::vuris()
    }
}

/// Phase and amplitude (DN) of every pixel of the first set by the scheme's formula, φ = arg Σ c_n I_n.
fn measured(frames: &RawSets, acquisition: &Acquisition) -> Vec<(f64, f64)> {
    let coefficients = acquisition.scheme.characteristic_polynomial();
    (0..frames.geometry().pixels())
        .map(|pixel| {
            let sum: Complex64 = (0..frames.frames_per_set())
                .map(|n| (acquisition.order[n / acquisition.frames_per_step], n))
                .map(|(step, n)| coefficients[step] * f64::from(frames.frame(0, n)[pixel]))
                .sum();
            let gain = acquisition.scheme.gain * acquisition.frames_per_step as f64;
            (sum.arg(), sum.norm() / gain)
        })
        .collect()
}

/// Phase errors in radians at 64 distances over one turn from `start_m` on, of a wall that moves at `velocity_m_s`, with
/// the same light at `start_m` wherever that is.
fn errors_over_a_turn(correlation: &Correlation, name: &str, velocity_m_s: f64, start_m: f64) -> Vec<f64> {
    let acquisition = acquisition(name);
    let mut sensor = one_pixel();
    sensor.amplitude_1m_e *= start_m * start_m;
    (0..64)
        .map(|step| {
            let mut scene = Scene::wall(start_m + unambiguous_range_m(FREQUENCY_HZ) * f64::from(step) / 64.0);
            scene.objects[0].velocity_m_s[2] = velocity_m_s;
            let (frames, true_m) = simulate(&scene, correlation, &sensor, &acquisition, None).unwrap();
            wrap_rad(measured(&frames, &acquisition)[0].0 - phase_rad(true_m[0], FREQUENCY_HZ))
        })
        .collect()
}

/// Amplitude of the cosine and sine of `cycles` a turn in `errors`, from 1 m on.
fn cycles(errors: &[f64], cycles: usize) -> f64 {
    let turn = |n: usize| Complex64::from_polar(2.0, -TAU * (n * cycles) as f64 / errors.len() as f64);
    errors.iter().enumerate().map(|(n, &error)| error * turn(n)).sum::<Complex64>().norm()
        / errors.len() as f64
}

fn rms(errors: &[f64]) -> f64 {
    (errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64).sqrt()
}

#[test]
fn without_harmonics_and_noise_the_range_comes_back_to_the_converters_rounding() {
    let mut scene = Scene::room();
    scene.objects.iter_mut().for_each(|object| object.velocity_m_s = [0.0; 3]);
    for (name, frames_per_step) in [("four_frame", 1), ("wdft", 1), ("wdft", 3)] {
        let acquisition = Acquisition { frames_per_step, ..acquisition(name) };
        let (frames, true_m) =
            simulate(&scene, &Correlation::sinusoidal(), &Sensor::vuris(), &acquisition, None).unwrap();
        let gain: f64 = acquisition.scheme.characteristic_polynomial().iter().map(|c| c.norm()).sum::<f64>()
            / acquisition.scheme.gain;
        for (&(phase, amplitude_dn), &true_m) in measured(&frames, &acquisition).iter().zip(&true_m) {
            let error_rad = wrap_rad(phase - phase_rad(true_m, FREQUENCY_HZ));
            // Every code is off by at most 1/2 DN, so the sum's vector by at most Σ|c_n|/2 over its gain.
            assert!(
                error_rad.abs() <= (0.5 * gain / (amplitude_dn - 0.5 * gain)).asin(),
                "{name} {true_m} m"
            );
        }
    }
}

/// Catalogue, row 1: harmonic 3 gives 4 cycles of its own relative amplitude, and none to the WDFT.
#[test]
fn harmonic_three_is_four_cycles_to_four_frames_and_nothing_to_the_wdft() {
    let third = Harmonic { number: 3, amplitude: 1.0 / 31.0, phase_rad: 0.0 };
    let correlation = Correlation::with_harmonics(&[third]);
    let four = errors_over_a_turn(&correlation, "four_frame", 0.0, 1.0);
    assert!((cycles(&four, 4) * 31.0 - 1.0).abs() < 0.01, "{}", cycles(&four, 4));
    assert!((rms(&four) * 31.0 * 2f64.sqrt() - 1.0).abs() < 0.01, "no other cycles");
    let wdft = errors_over_a_turn(&correlation, "wdft", 0.0, 1.0);
    assert!(rms(&wdft) < rms(&four) / 50.0, "{} rad", rms(&wdft));
}

/// What Table I predicts, worked out beside the paper: 0.0176 m and 0.0042 m.
#[test]
fn the_measured_waveform_gives_the_predicted_linearity() {
    let metres = unambiguous_range_m(FREQUENCY_HZ) / TAU;
    let linearity_m = |name| rms(&errors_over_a_turn(&Correlation::measured(), name, 0.0, 1.0)) * metres;
    let (four_m, wdft_m) = (linearity_m("four_frame"), linearity_m("wdft"));
    assert!((four_m - 0.0176).abs() < 0.0002, "{four_m} m");
    assert!((wdft_m - 0.0042).abs() < 0.0002, "{wdft_m} m");
}

/// Drayton 2012: v t_f / 2 in metres at 2 cycles a turn. A kilometre away the light's falloff within a set is nothing.
#[test]
fn motion_alone_gives_four_frames_two_cycles_of_half_a_frames_path() {
    let metres = unambiguous_range_m(FREQUENCY_HZ) / TAU;
    let errors = errors_over_a_turn(&Correlation::sinusoidal(), "four_frame", 1.0, 1000.0);
    assert!((cycles(&errors, 2) * metres / 0.0125 - 1.0).abs() < 0.01, "{} m", cycles(&errors, 2) * metres);
    let mean_m = errors.iter().sum::<f64>() / errors.len() as f64 * metres;
    assert!(mean_m.abs() < 1e-4, "measured at the middle of the set, but for {mean_m} m");
}

/// With the falloff (catalogue, row 7) four frames get worse, and the WDFT's double roots still hold.
#[test]
fn motion_with_falloff_hurts_four_frames_and_hardly_the_wdft() {
    let error = |name| rms(&errors_over_a_turn(&Correlation::sinusoidal(), name, 1.0, 1.0));
    assert!(error("four_frame") > 0.0125 * TAU / unambiguous_range_m(FREQUENCY_HZ) / 2f64.sqrt());
    assert!(error("wdft") < error("four_frame") / 10.0, "{} {}", error("wdft"), error("four_frame"));
}

#[test]
fn the_same_seed_gives_the_same_codes_and_more_sets_do_not_change_the_first() {
    let run = |seed, sets| {
        let acquisition = Acquisition { sets, ..acquisition("wdft") };
        let sensor = Sensor::vuris().with_geometry(Geometry { width: 16, height: 12 });
        simulate(&Scene::room(), &Correlation::measured(), &sensor, &acquisition, Some(seed)).unwrap().0
    };
    assert_eq!(run(1, 2), run(1, 2));
    assert_eq!(run(1, 2).first_sets(1), run(1, 1));
    assert_ne!(run(1, 1), run(2, 1));
    assert_ne!(run(1, 2).frame(0, 0), run(1, 2).frame(1, 0));
    // What every machine must get; a change here changes every simulated recording.
    assert_eq!(run(1, 1).frame(0, 0)[..4], [419, 438, 466, 849]);
}

/// Phase noise is c_N σ/A (catalogue, row 19).
#[test]
fn phase_noise_is_the_noise_factor_times_noise_over_amplitude() {
    let acquisition = Acquisition { sets: 2000, ..acquisition("four_frame") };
    let sensor = Sensor { amplitude_1m_e: 100_000.0, ..one_pixel() };
    let scene = Scene::wall(1.0);
    let (frames, true_m) =
        simulate(&scene, &Correlation::sinusoidal(), &sensor, &acquisition, Some(7)).unwrap();
    let expected_rad = {
        let light = sensor.light(Some(Surface { object: 0, range_m: 1.0, reflectivity: 1.0 }));
        // Rounding adds a twelfth of a squared code.
        let variance_e2 = light.offset_e + sensor.read_noise_e.powi(2) + sensor.gain_e_per_dn.powi(2) / 12.0;
        acquisition.scheme.noise_factor() * variance_e2.sqrt() / light.amplitude_e
    };
    let errors: Vec<f64> = (0..acquisition.sets)
        .map(|set| {
            let code = |n| f64::from(frames.frame(set, n)[0]);
            let phase = (code(1) - code(3)).atan2(code(0) - code(2));
            wrap_rad(phase - phase_rad(true_m[set], FREQUENCY_HZ))
        })
        .collect();
    assert!((rms(&errors) / expected_rad - 1.0).abs() < 0.06, "{} {expected_rad}", rms(&errors));
}

#[test]
fn too_much_light_clips_at_full_scale() {
    let sensor = Sensor { adc_bits: 12, ..one_pixel() };
    let (frames, _) =
        simulate(&Scene::wall(1.0), &Correlation::measured(), &sensor, &acquisition("wdft"), Some(3))
            .unwrap();
    assert!(frames.codes().contains(&4095));
    assert!(frames.codes().iter().all(|&code| code <= 4095));
}

#[test]
fn a_pixel_that_changes_objects_within_a_set_or_sees_nothing_has_no_true_range() {
    let run = |scene: &Scene, name| {
        let sensor = Sensor::vuris();
        let (frames, true_m) =
            simulate(scene, &Correlation::sinusoidal(), &sensor, &acquisition(name), None).unwrap();
        assert_eq!(true_m.len(), frames.sets() * sensor.geometry.pixels());
        true_m.iter().filter(|range_m| range_m.is_nan()).count()
    };
    let edge = run(&Scene::room(), "wdft");
    assert!((50..1000).contains(&edge), "{edge} pixels at the moving edge");
    assert_eq!(run(&Scene { objects: Vec::new() }, "four_frame"), 160 * 120);
}

/// A scene that stands still, without noise: each place's frame is that of its step.
#[test]
fn frames_are_taken_in_the_order_of_their_steps() {
    let sensor = Sensor { geometry: Geometry { width: 8, height: 6 }, ..Sensor::vuris() };
    let scene = Scene::wall(3.0);
    let ascending = acquisition("wdft");
    let order = vec![3, 1, 4, 0, 2];
    let permuted = Acquisition { order: order.clone(), ..ascending.clone() };
    let take =
        |acquisition| simulate(&scene, &Correlation::sinusoidal(), &sensor, acquisition, None).unwrap().0;
    let (frames, reordered) = (take(&ascending), take(&permuted));
    for (place, &step) in order.iter().enumerate() {
        assert_eq!(reordered.frame(0, place), frames.frame(0, step), "place {place}");
    }
    assert_ne!(frames.frame(0, 1), frames.frame(0, 2));
}

#[test]
fn what_cannot_be_simulated_is_refused() {
    let none = Acquisition { frames_per_step: 0, ..acquisition("wdft") };
    let empty = Sensor { geometry: Geometry { width: 0, height: 3 }, ..one_pixel() };
    let scene = Scene::wall(1.0);
    assert!(simulate(&scene, &Correlation::measured(), &one_pixel(), &none, None).is_err());
    assert!(simulate(&scene, &Correlation::measured(), &empty, &acquisition("wdft"), None).is_err());
}
