//! The candidates that the paper names, in its motion experiment: what each makes of the error, at its usual size and at the size that
//! comes nearest to what was measured.
//!
//! The paper names them for the two ways' disagreement in linearity; nothing says that one of them makes the motion error.

use super::camera::{Camera, Conditions, Method, SQUARE_WAVES_RATIO};
use super::figure::{Table, mm};
use super::figure_07::with_falloff;
use super::linearity::{by_phase_stepping, errors};
use super::motion::{VELOCITY_M_S, error_curve};
use super::open_question::{MEASURED, chi_squared};
use super::quantity::Measured;
use super::residual::{rms, span};
use crate::physics::{Active, Effect, Parameter, effects};

/// Sizes of each parameter that are tried.
const SIZES: u32 = 13;
/// Signals, up to full scale, at which a response must rise.
const SIGNALS: u32 = 50;
/// What the paper measured of four frames' linearity by phase stepping, m.
const LINEARITY: Measured = Measured::new(0.018, 0.002);

/// RMS and range of the motion error of four frames and of the WDFT, m.
fn motion_m(conditions: &Conditions, methods: &[Method; 2]) -> [f64; 4] {
    let camera = Camera::new(conditions.clone());
    let of_curve = |method: &Method| {
        let errors_m = errors(&error_curve(&camera, method, VELOCITY_M_S));
        [rms(&errors_m), span(&errors_m)]
    };
    let [four, wdft] = methods.each_ref().map(of_curve);
    [four[0], four[1], wdft[0], wdft[1]]
}

fn row(what: &str, size: String, conditions: Conditions, methods: &[Method; 2]) -> Vec<String> {
    let motion_m = motion_m(&conditions, methods);
    let linearity_m = rms(&errors(&by_phase_stepping(&Camera::new(conditions), &methods[0])));
    let numbers = std::iter::once(linearity_m).chain(motion_m).map(mm);
    let chi = format!("{:.1}", chi_squared(&motion_m));
    [what.to_owned(), size].into_iter().chain(numbers).chain([chi]).collect()
}

fn with(effect: &'static Effect, values: &[f64]) -> Conditions {
    Conditions { effects: vec![Active { effect, values: values.to_vec() }], ..Conditions::table_1() }
}

/// The first two numbers of `effect` that its usual form has: neither choices nor what is looked for by itself.
fn first_two(effect: &Effect) -> [usize; 2] {
    let is_usual = |parameter: &Parameter| !parameter.is_choice && !parameter.is_looked_for;
    let mut usual = (0..effect.parameters.len()).filter(|&number| is_usual(&effect.parameters[number]));
    [0, 1].map(|number| usual.next().unwrap_or(number))
}

/// Values of the [first two](first_two) parameters of `effect`, from one bound to the other; the others are off.
fn sizes(effect: &Effect) -> Vec<Vec<f64>> {
    let [first, second] = first_two(effect);
    let along = |number: usize| {
        let (low, high) = effect.parameters[number].bounds;
        (0..SIZES).map(move |n| low + (high - low) * f64::from(n) / f64::from(SIZES - 1))
    };
    let pair = |one: f64, other: f64| {
        let mut values = effect.off();
        (values[first], values[second]) = (one, other);
        values
    };
    along(first)
        .flat_map(|one| along(second).map(move |other| (one, other)))
        .map(|(one, other)| pair(one, other))
        .collect()
}

/// Whether a response of these quadratic and cubic parts rises with the light everywhere: a pixel whose does not is none.
fn rises(values: &[f64]) -> bool {
    let slope = |share: f64| 1.0 + 2.0 * values[0] * share + 3.0 * values[1] * share * share;
    (0..=SIGNALS).all(|n| slope(f64::from(n) / f64::from(SIGNALS)) > 0.0)
}

fn told(effect: &Effect, values: &[f64]) -> String {
    let acts =
        |(parameter, value): &(&Parameter, &f64)| **value != parameter.off || !parameter.shapes.is_empty();
    let parts = effect.parameters.iter().zip(values).filter(acts);
    let texts: Vec<String> =
        parts.map(|(parameter, value)| format!("`{}` {value:.2}", parameter.name)).collect();
    texts.join(", ")
}

/// The rows of the effect called `name`: at its usual size, and at that of the sizes which `is_possible` that comes nearest.
fn rows(what: &str, name: &str, is_possible: fn(&[f64]) -> bool, methods: &[Method; 2]) -> Vec<Vec<String>> {
    let Some(effect) = effects::named(name) else { return Vec::new() };
    let tried = sizes(effect).into_iter().filter(|values| is_possible(values));
    let scored = tried.map(|values| (chi_squared(&motion_m(&with(effect, &values), methods)), values));
    let nearest = scored.min_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, values)| values);
    let titled = [("usual size", Some(effect.example())), ("the size that comes nearest", nearest)];
    let rows = titled.into_iter().filter_map(|(title, values)| Some((title, values?)));
    rows.map(|(title, values)| {
        row(&format!("{what}, {title}"), told(effect, &values), with(effect, &values), methods)
    })
    .collect()
}

/// What each candidate alone makes of the motion error.
pub fn table(methods: &[Method; 2]) -> Table {
    let measured = std::iter::once(&LINEARITY).chain(&MEASURED);
    let measured = measured.map(|m| format!("{} \u{b1} {}", mm(m.value), mm(m.error)));
    let first = ["measured (the paper)".to_owned(), String::new()];
    let mut all: Vec<Vec<String>> = vec![first.into_iter().chain(measured).chain([String::new()]).collect()];
    all.push(row("none: phase change and harmonics", String::new(), Conditions::table_1(), methods));
    for (ratio, size) in [(1.0, "ratio 1"), (SQUARE_WAVES_RATIO, "ratio \u{3c0}\u{b2}/8")] {
        all.push(row("falloff within a set", size.to_owned(), with_falloff(ratio), methods));
    }
    all.extend(rows("multi-path", "multipath_interference", |_| true, methods));
    all.extend(rows("non-linear pixel", "intensity_nonlinearity", rises, methods));
    let head = [
        "what acts",
        "size",
        "four linearity RMS, mm",
        "four motion RMS, mm",
        "four motion range, mm",
        "WDFT motion RMS, mm",
        "WDFT motion range, mm",
        "\u{3c7}\u{b2} of the motion",
    ];
    Table {
        name: "candidates",
        title: "The paper's candidates, each alone, in motion at 2 m/s in 125 ms",
        head: head.map(str::to_owned).to_vec(),
        rows: all,
        notes: [
            "Assumed: as for the open question; no noise; linearity by phase stepping at 2 m. Ratio: the light's constant over its modulated part, \
             \u{3c0}\u{b2}/8 where no other is said.",
            "Nearest: the least \u{3c7}\u{b2} of the four motion numbers on a grid of 13 by 13 sizes over the simulator's bounds; of the pixel's responses, \
             those that rise with the light everywhere. It is no fit of the linearity.",
        ]
        .map(str::to_owned)
        .to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_response_that_falls_is_no_pixel() {
        assert!(rises(&[0.0, 0.0, 0.0]) && rises(&[-0.4, 0.0, 0.0]));
        assert!(!rises(&[-0.6, 0.0, 0.0]) && !rises(&[0.0, -0.4, 0.0]));
    }

    /// Without any of them, and with the falloff, the numbers are those of the open question's table.
    #[test]
    fn the_rows_are_those_of_the_open_question() {
        let methods = Method::both().unwrap();
        let fits = super::super::open_question::fits(&methods);
        let none_m = motion_m(&Conditions::table_1(), &methods);
        assert_eq!(none_m.map(mm), fits[0].predicted_m.map(mm));
        let squares_m = motion_m(&with_falloff(SQUARE_WAVES_RATIO), &methods);
        let other = super::super::open_question::square_waves(&methods);
        assert_eq!(squares_m.map(mm), other.predicted_m.map(mm));
    }
}
