//! Effects as a command line names them: `name`, or `name:parameter=value,…`.

use crate::physics::{Active, EFFECTS, Effect, Parameter, effects};
use crate::problem::{Problem, Result};
use crate::recording::{BASELINE, Camera, effect_name};

/// The effect that `text` names. Parameters that it does not name have their off value; where it names none, all are those of
/// [`Effect::example`].
///
/// # Errors
/// An unknown effect or parameter, a value that is no number or beyond the parameter's bounds, and a form without what it is a form of.
pub fn injection(text: &str) -> Result<Active> {
    injection_among(text, &[])
}

/// The same, where the effect may also be one of a `library`.
///
/// # Errors
/// As [`injection`].
pub fn injection_among(text: &str, library: &[&'static Effect]) -> Result<Active> {
    injection_beside(text, library, &[])
}

/// The same beside what a camera has `included` already: where strengths alone tell an effect, so much may be less than is included.
fn injection_beside(text: &str, library: &[&'static Effect], included: &[Active]) -> Result<Active> {
    let (name, settings) = text.split_once(':').unwrap_or((text, ""));
    let effect = effects::named_among(name, library).ok_or_else(|| {
        let names: Vec<&str> = EFFECTS.iter().chain(library).map(|effect| effect.name).collect();
        Problem::at("--effect", format_args!("no effect is called {name}"))
            .expected(names.join(", "))
            .nearest(name, names)
    })?;
    if settings.is_empty() {
        return Ok(Active { effect, values: effect.example() });
    }
    let mut values = effect.off();
    for setting in settings.split(',') {
        let (parameter, value) = setting.split_once('=').ok_or_else(|| {
            Problem::at("--effect", format_args!("{name}: {setting}")).expected("parameter=value")
        })?;
        let number = place(effect, parameter)?;
        let before = Active::in_all(included, effect, number);
        values[number] = within(effect, &effect.parameters[number], before, value)?;
    }
    is_of_something(effect, &values)?;
    Ok(Active { effect, values })
}

/// That a form which is looked for by itself has what it is a form of: settings to round to.
fn is_of_something(effect: &Effect, values: &[f64]) -> Result<()> {
    let numbers = || effect.parameters.iter().zip(values);
    let Some((form, _)) =
        numbers().find(|(parameter, value)| parameter.is_looked_for && **value != parameter.off)
    else {
        return Ok(());
    };
    match numbers().find(|(parameter, _)| parameter.is_choice) {
        Some((of, value)) if *value < 1.0 && of.bounds.1 > 1.0 => {
            let found = format!("{}: {} with {} = {value}", effect.name, form.name, of.name);
            let expected = format!("{} from 1 to {}: it changes nothing with less", of.name, of.bounds.1);
            Err(Problem::at("--effect", found).expected(expected))
        }
        _ => Ok(()),
    }
}

fn place(effect: &Effect, parameter: &str) -> Result<usize> {
    effect.parameters.iter().position(|known| known.name == parameter).ok_or_else(|| {
        let names: Vec<&str> = effect.parameters.iter().map(|known| known.name).collect();
        Problem::at("--effect", format_args!("{} has no parameter {parameter}", effect.name))
            .expected(names.join(", "))
            .nearest(parameter, names)
    })
}

/// What takes away what there is may take away more by so much of it: sums are rounded.
const ROUNDING: f64 = 1e-9;

/// The value that `text` says, which is within bounds by itself or together with what there is `before`.
fn within(effect: &Effect, parameter: &Parameter, before: f64, text: &str) -> Result<f64> {
    let (low, high) = parameter.bounds;
    let (low, high) = (low - before.max(0.0), high - before.min(0.0));
    let rounding = ROUNDING * before.abs();
    // There is no half of a bit.
    let is_whole = parameter.unit == "bit";
    let fits = |value: &f64| {
        (low - rounding..=high + rounding).contains(value)
            && (!is_whole || value.fract() == 0.0)
            && (!parameter.is_of_its_shapes() || parameter.shapes.contains(value))
    };
    text.parse().ok().filter(fits).ok_or_else(|| {
        let found = format!("{}: {} = {text}", effect.name, parameter.name);
        let unit = if parameter.unit == "1" { String::new() } else { format!(" {}", parameter.unit) };
        let number = if is_whole { "a whole number" } else { "a number" };
        if parameter.is_of_its_shapes() {
            let choices: Vec<String> = parameter.shapes.iter().map(f64::to_string).collect();
            return Problem::at("--effect", found).expected(format_args!("one of {}", choices.join(", ")));
        }
        Problem::at("--effect", found).expected(format_args!("{number} from {low} to {high}{unit}"))
    })
}

/// The effects that `camera` includes with values, of the registry or a `library`, those that act in `recording`.
///
/// # Errors
/// An effect that is not known, or a value that it cannot have beside those that stand before it.
pub fn camera_effects(camera: &Camera, recording: &str, library: &[&'static Effect]) -> Result<Vec<Active>> {
    let (mut effects, mut all) = (Vec::new(), Vec::new());
    for text in &camera.effects {
        let (effect, recordings) = text.split_once('@').unwrap_or((text, ""));
        let acts = recordings.is_empty() || recordings.split(',').any(|known| known == recording);
        let beside = if acts { &effects } else { &all };
        let active = injection_beside(effect, library, beside)
            .map_err(|problem| problem.moved_to(format_args!("camera.toml: physics.effects: {text}")))?;
        all.push(active.clone());
        if acts {
            effects.push(active);
        }
    }
    Ok(effects)
}

/// `camera` without what `effects` bring: an effect that the camera's simulation includes could not be found in its recordings.
#[must_use]
pub fn included_without(mut camera: Camera, effects: &[Active]) -> Camera {
    let brought = |name: &str| effects.iter().any(|active| active.effect.name == name);
    for (name, included) in BASELINE.into_iter().filter(|(name, _)| brought(name)) {
        camera.included_physics.retain(|known| known != included);
        camera.effects.retain(|text| effect_name(text) != name);
    }
    camera
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::practice_camera;
    use crate::frames::Geometry;
    use crate::recording::AXIAL_MOTION;

    #[test]
    fn effects_are_named_with_values_or_without() {
        let lag = injection("image_lag").unwrap();
        assert_eq!((lag.effect.name, lag.values), ("image_lag", vec![0.01, 0.0]));
        let crosstalk = injection("electrical_crosstalk:sine_dn=-2.5").unwrap();
        assert_eq!(crosstalk.values, [0.0, -2.5]);
        let two = injection("multipath_interference:relative_amplitude=0.2,wall_distance_m=1.5").unwrap();
        assert_eq!(two.values, [0.2, 0.0, 0.0, 1.5, 0.0, 0.0]);
    }

    #[test]
    fn what_does_not_exist_is_refused_with_what_does() {
        for (text, words) in [
            ("lag", "no effect is called lag"),
            ("image_lag:shares=0.1", "image_lag has no parameter shares"),
            ("image_lag:share=0.9", "image_lag: share = 0.9\n  expected: a number from 0 to 0.5"),
            ("image_lag:share=NaN", "image_lag: share = NaN"),
            ("imagelag", "way out: did you mean image_lag?"),
            ("fixed_point:bits_cut=2.5", "bits_cut = 2.5\n  expected: a whole number from 0 to 16 bit"),
            (
                "image_lag:last_step_before_first=-2.5",
                "last_step_before_first = -2.5\n  expected: one of 0, -1, -2, -3, -4, 1",
            ),
            ("image_lag:share", "parameter=value"),
            (
                "phase_step_errors:rounding=1",
                "rounding with settings_a_turn = 0\n  expected: settings_a_turn from 1 to 4096",
            ),
        ] {
            let refusal = injection(text).unwrap_err().to_string();
            assert!(refusal.contains(words), "{refusal}");
        }
    }

    #[test]
    fn a_camera_takes_away_no_more_than_it_includes() {
        let read = |effects: &[&str], recording: &str| {
            let effects = effects.iter().map(|&effect| effect.to_owned()).collect();
            let camera = Camera { effects, ..practice_camera(Geometry { width: 24, height: 18 }) };
            camera_effects(&camera, recording, &[]).map(|effects| effects.len())
        };
        let (more, less, all) = ("image_lag:share=0.03", "image_lag:share=-0.01", "image_lag:share=-0.03");
        assert_eq!(read(&[more, less], "a").ok(), Some(2));
        assert_eq!(read(&["image_lag:share=0.01", "image_lag:share=0.02", all], "a").ok(), Some(3));
        // What stands after it, in another recording, or is another effect, is not there.
        for effects in [
            &[less, more][..],
            &[more, less, all],
            &["image_lag:share=0.03@b", less],
            &["lens_scatter:share=0.03", less],
        ] {
            let refusal = read(effects, "a").unwrap_err().to_string();
            assert!(refusal.contains("expected: a number from "), "{effects:?}: {refusal}");
        }
        // Where it does not act it is read beside all that there is.
        let only = "image_lag:share=-0.01@b";
        assert_eq!([read(&[more, only], "a").ok(), read(&[more, only], "b").ok()], [Some(1), Some(2)]);
        // Of a path its length is another one's.
        let path = "multipath_interference:relative_amplitude";
        assert!(read(&[&format!("{path}=0.1"), &format!("{path}=-0.05")], "a").is_err());
    }

    #[test]
    fn a_cameras_effects_are_refused_where_they_stand() {
        let camera = |text: &str| Camera {
            effects: vec![text.to_owned()],
            ..practice_camera(Geometry { width: 24, height: 18 })
        };
        for (text, words) in [
            ("image_lug:share=0.1@a", "no effect is called image_lug"),
            ("image_lug:share=0.1@a", "expected: correlation_harmonics, "),
            ("image_lug:share=0.1@a", "way out: did you mean image_lag?"),
            ("image_lag:share=0.9", "image_lag: share = 0.9\n  expected: a number from 0 to 0.5"),
        ] {
            let refusal = camera_effects(&camera(text), "b", &[]).unwrap_err().to_string();
            let place = format!("camera.toml: physics.effects: {text}: ");
            assert!(refusal.starts_with(&place) && refusal.contains(words), "{refusal}");
        }
    }

    /// Whether strengths are off is asked of strengths alone: a shape changes nothing where they are.
    #[test]
    fn off_is_every_strength() {
        for (text, off) in [
            ("image_lag:share=0", true),
            ("image_lag", false),
            ("ambient_flicker:frequency_hz=120", true),
            ("ambient_flicker:sine=0.1", false),
        ] {
            assert_eq!(injection(text).unwrap().is_off(), off, "{text}");
        }
    }

    #[test]
    fn an_injected_falloff_is_not_among_what_the_camera_includes() {
        let camera = || practice_camera(Geometry { width: 24, height: 18 });
        let falloff = [injection("inverse_square_falloff").unwrap()];
        assert_eq!(included_without(camera(), &falloff).included_physics, [AXIAL_MOTION]);
        let lag = [injection("image_lag").unwrap()];
        assert_eq!(included_without(camera(), &lag), camera());
    }
}
