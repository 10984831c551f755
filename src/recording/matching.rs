//! Which hardware fits a recording: sensor, ADC, frequency and frames a step are the recording's, the rest is the
//! specification's.
//!
//! The phase scheme is recognised by the frames' phase steps, in whatever order they were taken: a named one, or the plain DFT of
//! any number of equal parts of a turn. A set's phase offset is not among them: the hardware adds
//! nothing to a phase, so whoever reads the phase adds the offset.

use super::Recording;
use super::plain_dft::dft_of;
use crate::problem::{Problem, Result};
use crate::spec::{
    ADC_BITS, DFT_FRAMES, Modulation, Pipeline, SCHEMES, Scheme, Specification, Word, normalised_order,
    scheme,
};
use crate::units::wrap_rad;

/// Steps that differ by less, modulo 2π, are the same, rad. Steps written with five digits are (1.5708), and what is then
/// left in the phase, under 0.1 mrad, is below any camera's noise; a step that is really wrong is off by more.
pub const STEP_TOLERANCE_RAD: f64 = 1e-4;

/// Steps that a refusal lists before it says how many there are.
const MOST_STEPS_SHOWN: usize = 40;

/// Which scheme a recording is processed with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SchemeChoice {
    /// The specification's; a recording of other steps is refused.
    #[default]
    Specified,
    /// The specification's where it has the recording's steps, else the first of [`SCHEMES`] that has them, else the plain DFT
    /// where they are equal parts of a turn.
    Auto,
}

/// The pipeline of `base` for `recording`, and one sentence for each thing that differs from `base`.
///
/// # Errors
/// The recording's phase steps are another scheme's (or no scheme's), or the adapted pipeline cannot work.
pub fn pipeline_for(
    recording: &Recording,
    base: &Pipeline,
    choice: SchemeChoice,
) -> Result<(Pipeline, Vec<String>)> {
    let Steps { scheme, frames_per_step, order } = steps_of(recording, base, choice)?;
    let bits = recording.adc_bits();
    let most = *ADC_BITS.end();
    if i64::from(bits) > most {
        return Err(Problem::in_file(&recording.folder, format_args!("its codes have {bits} bits"))
            .expected(format_args!("{most} at most: the hardware takes no more"))
            .remedy("shift the codes down; `vuris diagnose` takes them as they are"));
    }
    let source = format!("{} adapted to {}", base.name, recording.folder.display());
    let pipeline = base.adapted(&source, |specification| {
        let Specification { sensor, modulation, unwrapping, .. } = specification;
        sensor.width = recording.geometry().width;
        sensor.height = recording.geometry().height;
        sensor.adc_bits = match recording.camera {
            Some(_) => recording.adc_bits(),
            // Without a camera.toml only the codes speak: they may need more bits than specified, but a dim recording
            // does not make the converter narrower, nor its brightest pixel saturated.
            None => recording.adc_bits().max(base.sensor.adc_bits),
        };
        // A threshold beyond the new full scale would never be met.
        sensor.saturation_dn = sensor.saturation_dn.min(Word::unsigned(sensor.adc_bits).max());
        modulation.order = normalised_order(&scheme, order);
        modulation.scheme = scheme;
        modulation.frames_per_step = frames_per_step;
        modulation.frequency_hz = recording.frequency_hz;
        // A recording has one frequency.
        *unwrapping = None;
    })?;
    let sentences = differences(recording, base, &pipeline);
    Ok((pipeline, sentences))
}

/// One sentence for each thing in which `pipeline` differs from `base`.
fn differences(recording: &Recording, base: &Pipeline, pipeline: &Pipeline) -> Vec<String> {
    let adc_source = if recording.camera.is_some() { "camera.toml" } else { "the largest code" };
    let size = |pipeline: &Pipeline| format!("{} x {}", pipeline.sensor.width, pipeline.sensor.height);
    type Shown<'a> = &'a dyn Fn(&Pipeline) -> String;
    let rows: [(&str, &str, Shown); 8] = [
        ("sensor", "frames.npy", &size),
        ("ADC", adc_source, &|p| format!("{} bits", p.sensor.adc_bits)),
        ("saturation", "the ADC's bits", &|p| format!("{} DN", p.sensor.saturation_dn)),
        ("scheme", "the phase steps", &|p| shown_scheme(&p.modulation.scheme)),
        ("frames per step", "the phase steps", &|p| p.modulation.frames_per_step.to_string()),
        ("order of the steps", "the phase steps", &shown_order),
        ("modulation", "recording.toml", &|p| format!("{} MHz", p.modulation.frequency_hz / 1e6)),
        ("unwrapping", "its one frequency", &|p| match &p.unwrapping {
            None => "none".to_owned(),
            Some(unwrapping) => format!("{:?}", unwrapping.ratio),
        }),
    ];
    rows.into_iter()
        .map(|(what, source, shown)| (what, source, shown(pipeline), shown(base)))
        .filter(|(_, _, here, specified)| here != specified)
        .map(|(what, source, here, specified)| format!("{what} {here} from {source} instead of {specified}"))
        .collect()
}

/// The order of the steps; of ascending ones only that, so that another scheme is not another order.
fn shown_order(pipeline: &Pipeline) -> String {
    match &pipeline.modulation.order {
        None => "ascending".to_owned(),
        Some(order) => format!("{order:?}"),
    }
}

/// The name of `scheme`; a DFT's with its frames.
fn shown_scheme(scheme: &Scheme) -> String {
    if scheme.name == "dft" { format!("dft of {} frames", scheme.steps()) } else { scheme.name.to_string() }
}

/// What a recording's phase steps say.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Steps {
    scheme: Scheme,
    /// Consecutive frames of one step.
    frames_per_step: usize,
    /// The scheme's steps as the recording has them.
    order: Vec<usize>,
}

/// The scheme of `recording`, its frames a step and the order of its steps.
fn steps_of(recording: &Recording, base: &Pipeline, choice: SchemeChoice) -> Result<Steps> {
    let steps_rad = &recording.steps_rad;
    let file = recording.folder.join("recording.toml");
    let specified = &base.modulation;
    if let Some(own) = matched(&specified.scheme, specified, steps_rad) {
        return Ok(own);
    }
    let found = SCHEMES
        .iter()
        .find_map(|scheme| matched(scheme, specified, steps_rad))
        .or_else(|| matched(&dft_of(steps_rad, base)?, specified, steps_rad));
    match (choice, found) {
        (SchemeChoice::Auto, Some(steps)) => Ok(steps),
        (SchemeChoice::Specified, Some(Steps { scheme: other, .. })) => {
            let other = shown_scheme(&other);
            Err(Problem::in_file(&file, format_args!("its phase steps are those of the scheme {other}"))
                .expected(format_args!(
                    "those of the specified scheme {}: {}",
                    specified.scheme.name,
                    shown_rad(&scheme_steps_rad(&specified.scheme))
                ))
                .remedy(format_args!("`--scheme auto` picks {other}")))
        }
        (_, None) => {
            let own = Some(&specified.scheme).filter(|own| scheme(&own.name).is_none());
            let known = SCHEMES.iter().chain(own).map(|scheme| {
                let steps = shown_rad(&scheme_steps_rad(scheme));
                format!("\n    {}: {steps}", scheme.name)
            });
            Err(Problem::in_file(
                &file,
                format_args!("no scheme has its phase steps {}", shown_rad(steps_rad)),
            )
            .expected(format_args!(
                "modulo 2 pi, within {STEP_TOLERANCE_RAD:e} rad, in any order, one of the following, each step held for the same \
                 number of consecutive frames{}
    dft: {} to {} equal parts of a turn",
                known.collect::<String>(),
                DFT_FRAMES.start(),
                DFT_FRAMES.end()
            ))
            .remedy("select the frames of each set, or record with the steps of a scheme"))
        }
    }
}

/// How `steps_rad` are the steps of `scheme`, each held for the same number of consecutive frames.
///
/// Steps that are whole turns apart look the same (the first and the fourth of the WDFT do). Then the specified order decides, where
/// the frames can have it, and else each place has the lowest step that is left: of steps that look the same, the earlier frame has
/// the lower one.
pub(super) fn matched(scheme: &Scheme, specified: &Modulation, steps_rad: &[f64]) -> Option<Steps> {
    let frames_per_step = steps_rad.len() / scheme.steps();
    if frames_per_step == 0 || !steps_rad.len().is_multiple_of(scheme.steps()) {
        return None;
    }
    let places: Vec<&[f64]> = steps_rad.chunks(frames_per_step).collect();
    let has = |place: &[f64], step: usize| {
        let off_rad = |step_rad: &f64| wrap_rad(step_rad - scheme.angle_rad(step));
        place.iter().all(|step_rad| off_rad(step_rad).abs() < STEP_TOLERANCE_RAD)
    };
    let order = specified.steps_in_order();
    if specified.scheme == *scheme && places.iter().zip(&order).all(|(place, &step)| has(place, step)) {
        return Some(Steps { scheme: scheme.clone(), frames_per_step, order });
    }
    let mut left: Vec<usize> = (0..scheme.steps()).collect();
    let mut order = Vec::new();
    for place in places {
        order.push(left.remove(left.iter().position(|&step| has(place, step))?));
    }
    Some(Steps { scheme: scheme.clone(), frames_per_step, order })
}

fn scheme_steps_rad(scheme: &Scheme) -> Vec<f64> {
    (0..scheme.steps()).map(|n| scheme.angle_rad(n)).collect()
}

/// Steps for a refusal.
fn shown_rad(steps_rad: &[f64]) -> String {
    let shown: Vec<_> =
        steps_rad.iter().take(MOST_STEPS_SHOWN).map(|step_rad| format!("{step_rad:.6}")).collect();
    let rest = if steps_rad.len() > MOST_STEPS_SHOWN { ", ..." } else { "" };
    format!("[{}{rest}] rad ({} frames)", shown.join(", "), steps_rad.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frames::{Geometry, RawSets};
    use crate::recording::Camera;
    use crate::recording::plain_dft::COEFFICIENT_SHARE;
    use crate::recording::{Kind, SetRow};
    use std::f64::consts::{FRAC_PI_2, TAU};
    use std::path::PathBuf;

    fn recording(steps_rad: Vec<f64>, largest: u32) -> Recording {
        let geometry = Geometry { width: 24, height: 18 };
        let mut codes = vec![100; geometry.pixels() * steps_rad.len()];
        codes[7] = largest;
        Recording {
            folder: PathBuf::from("bench"),
            name: "bench".to_owned(),
            kind: Kind::Rail,
            frequency_hz: 30e6,
            raw: RawSets::new(geometry, steps_rad.len(), codes).unwrap(),
            steps_rad,
            frame_period_s: 0.025,
            sets: vec![SetRow::default()],
            extra_columns: vec![],
            mask: None,
            frame_times_s: None,
            camera: None,
        }
    }

    fn steps(name: &str, frames_per_step: usize, extra_rad: f64) -> Vec<f64> {
        let steps_rad = scheme_steps_rad(crate::spec::scheme(name).unwrap());
        let each = |step_rad: f64| std::iter::repeat_n(step_rad + extra_rad, frames_per_step);
        steps_rad.into_iter().flat_map(each).collect()
    }

    #[test]
    fn every_scheme_is_recognised_with_any_frames_a_step_and_modulo_two_pi() {
        let base = Pipeline::named("vuris").unwrap();
        for scheme in SCHEMES {
            for frames_per_step in [1, 3] {
                for extra_rad in [0.0, TAU, -2.0 * TAU, 4e-7] {
                    let recording = recording(steps(&scheme.name, frames_per_step, extra_rad), 4000);
                    let (pipeline, _) = pipeline_for(&recording, &base, SchemeChoice::Auto).unwrap();
                    assert_eq!(pipeline.modulation.scheme.name, scheme.name);
                    assert_eq!(pipeline.modulation.frames_per_step, frames_per_step);
                    assert_eq!(pipeline.derived().frames_per_set, recording.steps_rad.len());
                }
            }
        }
    }

    #[test]
    fn each_difference_is_one_sentence() {
        let base = Pipeline::named("vuris-four-frame").unwrap();
        let mut recording = recording(steps("wdft", 2, 0.0), 16_000);
        recording.frequency_hz = 80.652e6;
        let (pipeline, sentences) = pipeline_for(&recording, &base, SchemeChoice::Auto).unwrap();
        assert_eq!(
            sentences,
            [
                "sensor 24 x 18 from frames.npy instead of 160 x 120",
                "ADC 14 bits from the largest code instead of 12 bits",
                "saturation 16383 DN from the ADC's bits instead of 4095 DN",
                "scheme wdft from the phase steps instead of four_frame",
                "frames per step 2 from the phase steps instead of 1",
                "modulation 80.652 MHz from recording.toml instead of 30 MHz",
            ]
        );
        let (_, again) = pipeline_for(&recording, &pipeline, SchemeChoice::Specified).unwrap();
        assert_eq!(again, Vec::<String>::new());
    }

    /// The steps that the recording's places have are its own, whatever the specification's order is.
    #[test]
    fn every_order_of_the_steps_is_recognised_and_said() {
        let base = Pipeline::named("vuris-four-frame").unwrap();
        for frames_per_step in [1, 2] {
            for order in [[0, 2, 1, 3], [3, 2, 1, 0], [1, 2, 3, 0]] {
                let ascending = scheme_steps_rad(&base.modulation.scheme);
                let step_rad = |place: usize| ascending[order[place / frames_per_step]];
                let recording = recording((0..4 * frames_per_step).map(step_rad).collect(), 4000);
                for choice in [SchemeChoice::Specified, SchemeChoice::Auto] {
                    let (pipeline, sentences) = pipeline_for(&recording, &base, choice).unwrap();
                    assert_eq!(pipeline.modulation.order, Some(order.to_vec()));
                    assert_eq!(pipeline.modulation.frames_per_step, frames_per_step);
                    let expected =
                        format!("order of the steps {order:?} from the phase steps instead of ascending");
                    assert!(sentences.contains(&expected), "{sentences:?}");
                }
            }
        }
    }

    /// Of the WDFT the steps 0 and 3, and 1 and 4, are whole turns apart: the specified order decides, else the earlier frame has
    /// the lower step.
    #[test]
    fn steps_that_look_the_same_are_told_apart_by_the_specified_order() {
        let wdft = Pipeline::named("vuris").unwrap();
        let of = |order: [usize; 5]| recording(order.map(|step| step as f64 * TAU / 3.0).to_vec(), 4000);
        let order = |recording: &Recording, base: &Pipeline| {
            pipeline_for(recording, base, SchemeChoice::Specified).unwrap().0.modulation.order.clone()
        };
        let specified =
            wdft.adapted("test", |specification| specification.modulation.order = Some(vec![3, 1, 2, 0, 4]));
        let specified = specified.unwrap();
        // All of these have the phases 0, 1/3, 2/3, 0, 1/3 of a turn.
        for same in [[0, 1, 2, 3, 4], [3, 1, 2, 0, 4], [0, 4, 2, 3, 1]] {
            assert_eq!(order(&of(same), &wdft), None);
            assert_eq!(order(&of(same), &specified), Some(vec![3, 1, 2, 0, 4]));
        }
        // 2/3, 0, 0, 1/3, 1/3.
        for base in [&wdft, &specified] {
            assert_eq!(order(&of([2, 3, 0, 4, 1]), base), Some(vec![2, 0, 3, 1, 4]));
        }
    }

    #[test]
    fn a_threshold_of_saturation_stays_within_the_adc() {
        let base = Pipeline::named("vuris-four-frame").unwrap();
        let base = Pipeline::parse("test", &base.to_toml().replace("_dn = 4095", "_dn = 4000")).unwrap();
        let wide = recording(steps("four_frame", 1, 0.0), 16_000);
        let (pipeline, _) = pipeline_for(&wide, &base, SchemeChoice::Specified).unwrap();
        assert_eq!(pipeline.sensor.saturation_dn, 4000);
        let mut narrow = recording(steps("four_frame", 1, 0.0), 200);
        // Without a camera a dim recording does not make the converter narrower; a camera says what it has.
        let (pipeline, _) = pipeline_for(&narrow, &base, SchemeChoice::Specified).unwrap();
        assert_eq!((pipeline.sensor.adc_bits, pipeline.sensor.saturation_dn), (12, 4000));
        narrow.camera = Some(Camera {
            focal_length_px: 33.0,
            included_physics: vec![],
            ..Camera::assumed(narrow.geometry(), 8)
        });
        let (pipeline, sentences) = pipeline_for(&narrow, &base, SchemeChoice::Specified).unwrap();
        assert_eq!((pipeline.sensor.adc_bits, pipeline.sensor.saturation_dn), (8, 255));
        assert!(sentences.iter().any(|sentence| sentence.starts_with("saturation 255 DN")), "{sentences:?}");
    }

    #[test]
    fn steps_written_with_five_digits_are_recognised() {
        let base = Pipeline::named("vuris").unwrap();
        let steps_rad = (0..5).map(|n| f64::from(n) * 2.0944).collect();
        let (pipeline, _) = pipeline_for(&recording(steps_rad, 4000), &base, SchemeChoice::Auto).unwrap();
        assert_eq!(pipeline.modulation.scheme.name, "wdft");
    }

    #[test]
    fn equal_parts_of_a_turn_that_no_named_scheme_has_are_a_dft() {
        let base = Pipeline::named("vuris").unwrap();
        let code_rad = TAU / f64::from(base.output.phase_bits).exp2();
        for (parts, frames_per_step) in [(3, 1), (6, 1), (7, 2), (64, 1)] {
            let step_rad = |frame: usize| TAU * (frame / frames_per_step) as f64 / parts as f64;
            let recording = recording((0..parts * frames_per_step).map(step_rad).collect(), 4000);
            let (pipeline, sentences) = pipeline_for(&recording, &base, SchemeChoice::Auto).unwrap();
            let scheme = &pipeline.modulation.scheme;
            assert_eq!((&*scheme.name, scheme.steps()), ("dft", parts));
            assert_eq!(pipeline.modulation.frames_per_step, frames_per_step);
            assert!(scheme.weight_error_rad <= COEFFICIENT_SHARE * code_rad, "{scheme:?}");
            let sentence = format!("scheme dft of {parts} frames from the phase steps instead of wdft");
            assert!(sentences.contains(&sentence), "{sentences:?}");
            // A specification of that DFT takes it as it is; one of another says which.
            let again = pipeline_for(&recording, &pipeline, SchemeChoice::Specified).unwrap().0;
            assert_eq!(again.modulation.scheme, *scheme);
            let refusal = pipeline_for(&recording, &base, SchemeChoice::Specified).unwrap_err().to_string();
            assert!(refusal.contains(&format!("picks dft of {parts} frames")), "{refusal}");
        }
    }

    #[test]
    fn steps_of_another_scheme_or_of_none_are_refused() {
        let base = Pipeline::named("vuris").unwrap();
        let refusal = |steps_rad: Vec<f64>, choice| {
            pipeline_for(&recording(steps_rad, 4000), &base, choice).unwrap_err().to_string()
        };
        let other = refusal(steps("four_frame", 1, 0.0), SchemeChoice::Specified);
        for part in ["recording.toml", "four_frame", "wdft", "`--scheme auto`"] {
            assert!(other.contains(part), "{other}");
        }
        // Two cycles of four frames: the steps are right, but a step's frames are not consecutive.
        let cycles = (0..8).map(|n| f64::from(n) * FRAC_PI_2).collect();
        for steps_rad in [cycles, steps("wdft", 1, 2e-4), vec![0.0], vec![0.0, 1.0, 2.0]] {
            let none = refusal(steps_rad, SchemeChoice::Auto);
            for part in ["recording.toml", "no scheme", "four_frame", "wdft", "0.000", "consecutive"] {
                assert!(none.contains(part), "{none}");
            }
        }
    }
}
