//! All that is known of one algorithm, as text.

use super::curves::Bench;
use super::words;
use crate::algorithms::{Algorithm, Disturbance, HarmonicVerdict, Verdict, other_roots};
use num_complex::Complex64;
use std::fmt::Write;

/// The explanation of `algorithm`; velocities are told in mm of range on `bench`.
pub fn algorithm_explanation(algorithm: &Algorithm, bench: &Bench) -> String {
    let verdict = Verdict::new(algorithm);
    let mut text = String::new();
    head(&mut text, algorithm);
    polynomial(&mut text, algorithm, &verdict);
    rules(&mut text, algorithm, &verdict);
    sensitivities(&mut text, algorithm, &verdict, bench);
    text
}

/// Appends a line. Writing to a string cannot fail.
macro_rules! line {
    ($text:expr) => { $text.push('\n') };
    ($text:expr, $($argument:tt)*) => { { let _ = writeln!($text, $($argument)*); } };
}

fn head(text: &mut String, algorithm: &Algorithm) {
    line!(text, "{}: {}", algorithm.name, algorithm.reference);
    if !algorithm.remark.is_empty() {
        line!(text, "{}", algorithm.remark);
    }
    line!(text);
    let angles: Vec<String> = algorithm.angles.iter().map(ToString::to_string).collect();
    line!(text, "frames       {} at {} turn", algorithm.frames(), angles.join(", "));
    line!(text, "weights      {}", words::weights(algorithm));
    if let Some(scheme) = algorithm.scheme.as_ref().filter(|scheme| scheme.steps() <= 16) {
        line!(text, "in-phase     {:?}", scheme.in_phase);
        line!(text, "quadrature   {:?}, times {}", scheme.quadrature, scheme.irrational);
        line!(text, "offset       {:?}", scheme.offset);
    }
}

fn polynomial(text: &mut String, algorithm: &Algorithm, verdict: &Verdict) {
    line!(text);
    let Some(step) = algorithm.equal_step() else {
        line!(
            text,
            "The steps are unequal: no polynomial; the sums that its roots stand for are judged instead."
        );
        return;
    };
    line!(text, "characteristic polynomial, Surrel's sign (conjugate to the paper's):");
    let scale = algorithm.polynomial.coefficients().iter().map(|c| c.norm()).fold(0.0, f64::max);
    let terms = algorithm.polynomial.coefficients().iter().map(Complex64::conj).enumerate();
    let shown: Vec<String> = terms
        .filter(|(_, c)| c.norm() > 1e-12 * scale)
        .map(|(n, c)| match n {
            0 => bracketed(c),
            1 => format!("{} x", bracketed(c)),
            _ => format!("{} x^{n}", bracketed(c)),
        })
        .collect();
    line!(text, "  P(x) = {}", shown.join(" + "));
    line!(text, "  roots exp(i m {step} turn): m = {}", words::roots(algorithm, verdict));
    for root in other_roots(&algorithm.polynomial, step.rad(), step.denominator()) {
        let turns = root.arg() / std::f64::consts::TAU;
        line!(text, "  another root: {:.4} from 0, at {turns:.4} turn", root.norm());
    }
}

fn bracketed(c: Complex64) -> String {
    let plain = |value: f64| {
        let value = (value * 1e4).round() / 1e4;
        format!("{}", if value == 0.0 { 0.0 } else { value })
    };
    if c.im.abs() < 1e-9 * c.norm() {
        return format!("({})", plain(c.re));
    }
    if c.re.abs() < 1e-9 * c.norm() {
        return format!("({}i)", plain(c.im));
    }
    let sign = if c.im < 0.0 { '-' } else { '+' };
    format!("({} {sign} {}i)", plain(c.re), plain(c.im.abs()))
}

fn rules(text: &mut String, algorithm: &Algorithm, verdict: &Verdict) {
    let last = verdict.harmonics.last().map_or(0, |row| row.harmonic);
    line!(text);
    line!(text, "by the roots (harmonics 2 to {last}):");
    line!(text, "  rule 1: insensitive to harmonics {}", words::list(&verdict.rejected(1)));
    line!(text, "  rule 2: under a linear step error, too: {}", words::list(&verdict.rejected(2)));
    let swing = |order: usize| match order {
        0 => "swings without any error: the image is no root".to_owned(),
        1 => "swings with its first power".to_owned(),
        _ => format!("no swing up to its power {}", order - 1),
    };
    line!(text, "  rule 3: of a step error, {}", swing(verdict.step_order));
    if verdict.motion_order != verdict.step_order {
        line!(text, "          of motion, {}", swing(verdict.motion_order));
    }
    line!(
        text,
        "  offset that drifts: {}",
        match verdict.offset_order {
            0 => "even a constant one is seen".to_owned(),
            1 => "seen; a constant one is not".to_owned(),
            order => format!("not seen up to the power {} of time", order - 1),
        }
    );
    line!(
        text,
        "  amplitude that drifts linearly: {}, the phase turns by {:.4} rad for 100 % a frame",
        if verdict.motion_order > 1 { "no swing" } else { "swings" },
        verdict.drift_turn_rad
    );
    for row in verdict.harmonics.iter().filter(|row| row.rejected() == 0) {
        line!(text, "  harmonic {:>2} comes through: {}", row.harmonic, fate(row));
    }
    if let Some(scheme) = algorithm.scheme.as_ref().filter(|_| algorithm.is_rounded()) {
        let worst = verdict
            .rejected(1)
            .into_iter()
            .map(|harmonic| scheme.harmonic_leakage(harmonic as i32))
            .fold(0.0, f64::max);
        line!(
            text,
            "  rounded weights: roots of the true ones; {worst:.1e} of a rejected harmonic at most is let through"
        );
    }
}

/// How a harmonic comes through.
fn fate(row: &HarmonicVerdict) -> String {
    let alias = match row.alias {
        Some(1) => format!(", since {} looks like 1", row.harmonic),
        Some(-1) => format!(", since {} looks like 1", -(row.harmonic as i64)),
        Some(_) => ", looking like constant light".to_owned(),
        None => String::new(),
    };
    let [upper, lower] = row.leakage;
    let parts: Vec<String> = [(upper, row.harmonic - 1), (lower, row.harmonic + 1)]
        .into_iter()
        .filter(|(share, _)| *share > 0.0)
        .map(|(share, cycles)| {
            format!("{cycles} cycle{} of {share:.4} of it", if cycles == 1 { "" } else { "s" })
        })
        .collect();
    format!("{}{alias}", parts.join(", "))
}

fn sensitivities(text: &mut String, algorithm: &Algorithm, verdict: &Verdict, bench: &Bench) {
    line!(text);
    line!(
        text,
        "noise factor {:.4}: standard deviation of the phase, rad, times amplitude over the frames' noise",
        verdict.noise_factor
    );
    line!(text);
    line!(text, "swing of the phase by simulation, mrad (RMS, peak), its mean taken off:");
    let none = Disturbance::default();
    let mut say = |what: String, disturbance: Disturbance, as_range: bool| {
        let error = disturbance.error(algorithm);
        let range = match as_range {
            true => format!("   {:8.3} {:8.3} mm", bench.mm(error.rms_rad), bench.mm(error.peak_rad)),
            false => String::new(),
        };
        line!(text, "  {what:<44} {:9.4} {:9.4}{range}", clean(error.rms_rad), clean(error.peak_rad));
    };
    for row in &verdict.harmonics {
        let harmonic = (row.harmonic, 0.01);
        say(format!("1 % of harmonic {}", row.harmonic), Disturbance { harmonic, ..none }, false);
    }
    for per_cent in [1.0, 5.0] {
        say(
            format!("step error of {per_cent} %"),
            Disturbance { step_error: per_cent / 100.0, ..none },
            false,
        );
    }
    for velocity in [1.0, 2.0] {
        let motion_rad = bench.motion_rad(velocity);
        say(format!("{velocity} m/s, {bench}"), Disturbance { motion_rad, ..none }, true);
    }
    say("amplitude drifts by 1 % a frame".to_owned(), Disturbance { amplitude_drift: 0.01, ..none }, false);
    say(
        "offset drifts by 1 % of the amplitude a frame".to_owned(),
        Disturbance { offset_drift: 0.01, ..none },
        false,
    );
}

/// In mrad; what floating point leaves of nothing is nothing.
fn clean(error_rad: f64) -> f64 {
    if error_rad < 1e-12 { 0.0 } else { 1e3 * error_rad }
}
