//! Phase algorithms: what the roots say against what frames show, published facts, and designed rows.
//!
//! Chain of trust: the verdict comes from exact arithmetic in roots of unity. Here frames are made with cosines, the phase is
//! taken from the integer weights (or the estimator's published equation), and slopes are read off in log-log: no polynomial.

mod support;

use num_complex::Complex64;
use std::f64::consts::TAU;
use vuris::algorithms::{
    Algorithm, Basis, Design, Disturbance, Polynomial, Request, Verdict, design, named, other_roots, table,
    usual_steps,
};
use vuris::spec::{Irrational, Row, SCHEMES, Scheme, SchemeOrigin, StepAngle};

// ---------------------------------------------------------------- frames and phases, by themselves

/// What is wrong with the frames.
#[derive(Clone, Copy, Default)]
struct Wrong {
    harmonic: (usize, f64),
    step: f64,
    motion_rad: f64,
    amplitude_drift: f64,
    offset_drift: f64,
}

fn frames(angles: &[StepAngle], phase: f64, wrong: Wrong) -> Vec<f64> {
    let frame = |(n, angle): (usize, &StepAngle)| {
        let angle = TAU * angle.numerator() as f64 / angle.denominator() as f64 * (1.0 + wrong.step);
        let t = angle - phase - wrong.motion_rad * n as f64;
        let wave = t.cos() + wrong.harmonic.1 * (wrong.harmonic.0 as f64 * t).cos();
        (1.0 + wrong.amplitude_drift * n as f64) * wave + 1.5 + wrong.offset_drift * n as f64
    };
    angles.iter().enumerate().map(frame).collect()
}

/// The phase by a row's integer weights.
fn by_weights(scheme: &Scheme, frames: &[f64]) -> f64 {
    let sum = |weights: &[i64]| -> f64 { weights.iter().zip(frames).map(|(&w, f)| w as f64 * f).sum() };
    let factor = (scheme.irrational.squared() as f64).sqrt();
    f64::atan2(factor * sum(&scheme.quadrature), sum(&scheme.in_phase))
}

/// The phase of a row of the table. Of a DFT whose weights are rounded, by the cosines and sines themselves.
fn phase(row: &Algorithm, frames: &[f64]) -> f64 {
    match (&row.scheme, frames) {
        (Some(scheme), _) if matches!(scheme.origin, SchemeOrigin::Dft { .. }) => {
            let sum = |f: fn(f64) -> f64| -> f64 {
                row.angles.iter().zip(frames).map(|(a, frame)| f(TAU * a.turns()) * frame).sum()
            };
            f64::atan2(sum(f64::sin), sum(f64::cos))
        }
        (Some(scheme), _) => by_weights(scheme, frames),
        // The published equations are for A cos(φ + angle_n), so that the phase is the negative.
        (None, &[i1, i2, i3, i4]) => {
            let square = ((i1 - i4) + (i2 - i3)) * (3.0 * (i2 - i3) - (i1 - i4));
            -f64::atan2((i2 - i3).signum() * square.max(0.0).sqrt(), i2 + i3 - i1 - i4)
        }
        (None, &[i1, i2, i3, i4, i5]) => {
            let square = 4.0 * (i2 - i4).powi(2) - (i1 - i5).powi(2);
            -f64::atan2((i2 - i4).signum() * square.max(0.0).sqrt(), 2.0 * i3 - i1 - i5)
        }
        _ => panic!("{}", row.name),
    }
}

/// Mean, and RMS around it, of the phase with `wrong` less that with `right`, over a turn of phases.
fn swing(phase_of: &dyn Fn(&[f64]) -> f64, angles: &[StepAngle], wrong: Wrong, right: Wrong) -> (f64, f64) {
    swing_over(211, phase_of, angles, wrong, right)
}

fn swing_over(
    phases: u32,
    phase_of: &dyn Fn(&[f64]) -> f64,
    angles: &[StepAngle],
    wrong: Wrong,
    right: Wrong,
) -> (f64, f64) {
    let count = f64::from(phases);
    let off: Vec<f64> = (0..phases)
        .map(|k| {
            let phase = TAU * (f64::from(k) + 0.37) / count;
            let difference =
                phase_of(&frames(angles, phase, wrong)) - phase_of(&frames(angles, phase, right));
            (difference + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU
        })
        .collect();
    let mean = off.iter().sum::<f64>() / count;
    (mean, (off.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / count).sqrt())
}

/// What of `verdict` the frames contradict.
fn contradictions(row: &Algorithm, verdict: &Verdict) -> Vec<String> {
    let mut found = Vec::new();
    let phase_of = |frames: &[f64]| phase(row, frames);
    let swing = |wrong: Wrong, right: Wrong| swing(&phase_of, &row.angles, wrong, right);
    let slope = |one: f64, two: f64| (two / one).log2();
    let none = Wrong::default();
    const SHARE: f64 = 1e-4;
    for harmonic in &verdict.harmonics {
        let m = harmonic.harmonic;
        let with = |step: f64| Wrong { harmonic: (m, SHARE), step, ..none };
        let still = swing(with(0.0), none).1;
        if harmonic.rejected() == 0 {
            // Two swings of different numbers of cycles add up in squares.
            let [upper, lower] = harmonic.leakage;
            let expected = SHARE * ((upper * upper + lower * lower) / 2.0).sqrt();
            if (still / expected - 1.0).abs() > 2e-3 {
                found.push(format!("harmonic {m}: {still:e}, by its leakage {expected:e}"));
            }
            continue;
        }
        if still > 1e-13 {
            found.push(format!("harmonic {m} is said to be rejected: {still:e}"));
        }
        if row.estimator.is_some() {
            continue;
        }
        let at = |step: f64| swing(with(step), Wrong { step, ..none }).1;
        let order = slope(at(1e-3), at(2e-3));
        if (order - harmonic.rejected() as f64).abs() > 0.1 {
            found.push(format!("harmonic {m}: slope {order:.3}, by its roots {}", harmonic.rejected()));
        }
    }
    let clean = |k: u32| {
        let phase = TAU * (f64::from(k) + 0.21) / 50.0;
        Complex64::from_polar(1.0, phase_of(&frames(&row.angles, phase, none)) - phase).arg().abs()
    };
    let clean = (0..50).map(clean).fold(0.0, f64::max);
    if (clean < 1e-10) != (verdict.step_order > 0) {
        found.push(format!("clean frames: off by {clean:e}, by its roots {}", verdict.step_order));
    }
    let step = |step: f64| swing(Wrong { step, ..none }, none).1;
    if row.estimator.is_some() {
        // Both estimate the step: no power of its error is left.
        if step(0.02) > 1e-10 {
            found.push(format!("step error: {:e}", step(0.02)));
        }
    } else {
        let order = slope(step(0.01), step(0.02));
        if (order - verdict.step_order as f64).abs() > 0.1 {
            found.push(format!("step error: slope {order:.3}, by its roots {}", verdict.step_order));
        }
    }
    let offset = swing(Wrong { offset_drift: 1e-4, ..none }, none).1;
    if (offset < 1e-13) != (verdict.offset_order > 1) {
        found.push(format!("offset drift: {offset:e}, by its roots {}", verdict.offset_order));
    }
    let drift = |amplitude_drift: f64| swing(Wrong { amplitude_drift, ..none }, none);
    let (turn, swung) = drift(1e-5);
    // Of those that estimate the step, the linear part is judged: squares remain.
    let square = row.estimator.is_some() && slope(swung, drift(2e-5).1) > 1.9;
    if (swung < 1e-13 || square) != (verdict.motion_order > 1) {
        found.push(format!("amplitude drift: {swung:e}, by its roots {}", verdict.motion_order));
    }
    if (turn / 1e-5 - verdict.drift_turn_rad).abs() > 1e-3 {
        found.push(format!("amplitude drift turns by {:e}, not {:e}", turn / 1e-5, verdict.drift_turn_rad));
    }
    found
}

// ---------------------------------------------------------------- verdicts

#[test]
fn every_rows_verdict_is_what_frames_show() {
    let rows = table().unwrap();
    assert!(rows.len() > 70, "{} rows", rows.len());
    for row in &rows {
        assert_eq!(contradictions(row, &Verdict::new(row)), [""; 0], "{}", row.name);
    }
}

/// A weight that is off by a thousandth: the verdict is another, and the true row's is contradicted by the frames.
#[test]
fn a_perturbed_weight_changes_the_verdict_and_is_seen_in_the_frames() {
    let (mut perturbed, mut fewer) = (0, 0);
    for row in table().unwrap().iter().filter(|row| row.frames() <= 13) {
        let Some(scheme) = row.scheme.as_ref().filter(|scheme| scheme.origin != SchemeOrigin::Named) else {
            continue;
        };
        if matches!(scheme.origin, SchemeOrigin::Dft { .. }) {
            continue;
        }
        let times = |weights: &[i64]| weights.iter().map(|weight| weight * 1000).collect::<Vec<_>>();
        let mut own = Row {
            name: "perturbed".to_owned(),
            angles: scheme.angles.to_vec(),
            in_phase: times(&scheme.in_phase),
            quadrature: times(&scheme.quadrature),
            offset: Some(scheme.offset.to_vec()),
            irrational: scheme.irrational,
            reference: "test".to_owned(),
        };
        let whole = Algorithm::of_scheme(&Scheme::of_row("test", own.clone()).unwrap()).unwrap();
        assert_eq!(Verdict::new(&whole).rejected(1), Verdict::new(row).rejected(1), "{}", row.name);
        // Constant light still must have no phase, or the row is refused.
        own.in_phase[1] += 1;
        own.in_phase[2] -= 1;
        let off = Algorithm::of_scheme(&Scheme::of_row("test", own).unwrap()).unwrap();
        let (verdict, was) = (Verdict::new(&off), Verdict::new(row));
        assert_eq!(verdict.step_order, 0, "{}", row.name);
        // What looks like constant light is rejected still, since the weights add up to 0.
        assert!(verdict.rejected(1).len() <= was.rejected(1).len(), "{}", row.name);
        fewer += usize::from(verdict.rejected(1).len() < was.rejected(1).len());
        assert!(!contradictions(&off, &was).is_empty(), "{}", row.name);
        perturbed += 1;
    }
    assert!(perturbed >= 12 && fewer >= 9, "{perturbed} {fewer}");
}

/// The paper's lists of roots, in Surrel's sign, and what comes through.
#[test]
fn roots_and_aliases_are_the_papers() {
    let verdict = |name: &str| Verdict::new(&named(name).unwrap().unwrap());
    let four = verdict("four_frame");
    assert_eq!(four.roots, [(-1, 1), (0, 1), (2, 1)]);
    assert_eq!(four.rejected(1), [2, 4, 6, 8, 10, 12]);
    let wdft = verdict("wdft");
    assert_eq!(wdft.roots, [(-1, 2), (0, 2)]);
    assert_eq!((wdft.rejected(1), wdft.rejected(2)), (vec![3, 6, 9, 12], vec![3, 6, 9, 12]));
    // Harmonics 3 and 5 of four frames as 4 cycles, 2 and 4 of the WDFT as 3, each by the root that 1 is.
    for (verdict, harmonics, cycles) in [(&four, [3, 5], 4), (&wdft, [2, 4], 3)] {
        for harmonic in harmonics {
            let row = verdict.harmonics[harmonic - 2];
            assert_eq!((row.rejected(), row.cycles()), (0, cycles), "harmonic {harmonic}");
            assert!((row.leakage.into_iter().fold(0.0, f64::max) - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn noise_factors_are_the_published_ones() {
    for (name, published) in [("four_frame", 0.707), ("wdft", 0.685), ("wdft-4", 0.586)] {
        let own = Verdict::new(&named(name).unwrap().unwrap()).noise_factor;
        assert!((own - published).abs() < 5e-4, "{name}: {own}");
    }
    // A plain DFT's is √(2/N), and what a specification says of its schemes is the same.
    for row in table().unwrap() {
        let own = Verdict::new(&row).noise_factor;
        if row.name.starts_with("dft-") {
            assert!((own - (2.0 / row.frames() as f64).sqrt()).abs() < 1e-12, "{}", row.name);
        }
        if let Some(scheme) = &row.scheme {
            assert!((own - scheme.noise_factor()).abs() < 1e-4, "{}", row.name);
        }
    }
}

/// The factored forms that their authors give, roots in Surrel's sign: 4 + 1 and Hariharan (x² − 1)(x + i)², Schmit and Creath
/// (x − 1)(x + i)³, de Groot (x² − 1)(x + i)⁴; N + 1 type B, a DFT's roots with the image's doubled.
#[test]
fn roots_are_those_of_the_published_factors() {
    let roots = |name: &str| {
        let row = named(name).unwrap().unwrap();
        let (verdict, step) = (Verdict::new(&row), row.equal_step().unwrap());
        let known: usize = verdict.roots.iter().map(|root| root.1).sum();
        let others = other_roots(&row.polynomial, step.rad(), step.denominator());
        assert_eq!(known + others.len(), row.frames() - 1, "{name}: {others:?}");
        verdict.roots
    };
    assert_eq!(roots("hariharan"), [(-1, 2), (0, 1), (2, 1)]);
    assert_eq!(roots("schmit-creath"), [(-1, 3), (0, 1)]);
    assert_eq!(roots("de-groot-7"), [(-1, 4), (0, 1), (2, 1)]);
    assert_eq!(roots("n-plus-1-b-3"), [(-1, 2), (0, 1)]);
    assert_eq!(roots("n-plus-1-b-6"), [(-2, 1), (-1, 2), (0, 1), (2, 1), (3, 1)]);
    for (name, parts) in [("wdft", 3_i64), ("wdft-4", 4), ("wdft-6", 6)] {
        let all = (-((parts - 1) / 2)..=parts / 2).filter(|&m| m != 1).map(|m| (m, 2)).collect::<Vec<_>>();
        assert_eq!(roots(name), all);
    }
    // Around a step of a quarter of a turn, Novák's is Hariharan's, and Carré's has the double root that he made it for.
    assert_eq!(roots("novak"), roots("hariharan"));
    assert_eq!(roots("carre"), [(-1, 2), (0, 1)]);
    assert_eq!(roots("carre-110"), [(-1, 2), (0, 1)]);
    // The thirteen frames have the root 3 three times, and not −3.
    let thirteen = roots("thirteen-frame");
    assert!(thirteen.contains(&(3, 3)) && thirteen.iter().all(|root| root.0 != -3), "{thirteen:?}");
}

/// Built-in rows and the test's own collection of published ones have the same roots: two sources of the same weights.
#[test]
fn rows_are_those_of_another_source() {
    for (number, name) in
        [(0, "hariharan"), (1, "schmit-creath"), (2, "de-groot-7"), (3, "n-plus-1-b-3"), (4, "hariharan")]
    {
        let (other, own) = (support::row(number, 1), named(name).unwrap().unwrap());
        let turn = other.angles[0].turns() - own.angles[0].turns();
        let factor = Complex64::from_polar(1.0, TAU * turn);
        for (a, b) in other.characteristic_polynomial().iter().zip(own.polynomial.coefficients()) {
            assert!((a - b * factor).norm() < 1e-9, "{name}: {a} {b}");
        }
    }
}

/// What docs/algorithms.md derives of N+1 type B and of N+3: as many roots as their degree, which leaves no freedom; weights that are conjugate
/// about the middle frame; N+1 type B over the DFT's weights is 1 but for the ends, 1/2 -+ (i/2) cot step; N+3 has no first-order swing by
/// a quadratic error of the steps, of which N+1 type B has some.
#[test]
fn longer_rows_are_what_their_roots_leave() {
    for (name, of) in [
        ("n-plus-1-b-3", 3),
        ("hariharan", 4),
        ("n-plus-1-b-6", 6),
        ("n-plus-3-3", 3),
        ("n-plus-3-4", 4),
        ("n-plus-3-6", 6),
    ] {
        let row = named(name).unwrap().unwrap();
        let verdict = Verdict::new(&row);
        let last = row.frames() - 1;
        assert_eq!(verdict.roots.iter().map(|(_, times)| times).sum::<usize>(), last, "{name}");
        let step_rad = TAU / f64::from(of);
        let turn = |rad: f64| Complex64::from_polar(1.0, rad);
        let weights: Vec<Complex64> = row.polynomial.coefficients().to_vec();
        let largest = weights.iter().map(|c| c.norm()).fold(0.0, f64::max);
        // The phase at the middle frame.
        let middle: Vec<Complex64> =
            weights.iter().map(|c| c * turn(-step_rad * last as f64 / 2.0)).collect();
        for (n, c) in middle.iter().enumerate() {
            assert!((c - middle[last - n].conj()).norm() < 1e-12 * largest, "{name}: {n}");
        }
        // First order of a step error that grows with the square of the frame's number: what the image's term makes.
        let swing = |square: fn(f64) -> f64| -> f64 {
            let terms = weights.iter().enumerate();
            terms.map(|(n, c)| c * turn(n as f64 * step_rad) * square(n as f64)).sum::<Complex64>().norm()
                / largest
        };
        let is_long = name.starts_with("n-plus-3");
        assert!(swing(|n| n) < 1e-12, "{name}");
        assert_eq!(swing(|n| n * n) < 1e-12, is_long, "{name}");
        if !is_long {
            let window: Vec<Complex64> =
                weights.iter().enumerate().map(|(n, c)| c * turn(-(n as f64) * step_rad)).collect();
            let half = Complex64::new(0.5, -0.5 / step_rad.tan());
            assert!((window[0] / window[1] - half).norm() < 1e-12, "{name}");
            assert!((window[last] / window[1] - half.conj()).norm() < 1e-12, "{name}");
            assert!(window[1..last].iter().all(|c| (c / window[1] - 1.0).norm() < 1e-12), "{name}");
        }
    }
}

/// The WDFT's frames in another order: a wrong step is as harmless as before, motion is not.
#[test]
fn motion_is_judged_in_the_order_of_the_frames() {
    let wdft = &SCHEMES[1];
    let order = [0, 3, 1, 4, 2];
    let taken = |weights: &[i64]| order.iter().map(|&n| weights[n]).collect::<Vec<_>>();
    let row = Row {
        name: "reordered".to_owned(),
        angles: order.iter().map(|&n| wdft.angles[n]).collect(),
        in_phase: taken(&wdft.in_phase),
        quadrature: taken(&wdft.quadrature),
        offset: Some(taken(&wdft.offset)),
        irrational: Irrational::Sqrt3,
        reference: "test".to_owned(),
    };
    let reordered = Algorithm::of_scheme(&Scheme::of_row("test", row).unwrap()).unwrap();
    for (row, motion_order) in [(&named("wdft").unwrap().unwrap(), 2), (&reordered, 1)] {
        let verdict = Verdict::new(row);
        assert_eq!((verdict.step_order, verdict.motion_order), (2, motion_order));
        assert_eq!(verdict.rejected(2), [3, 6, 9, 12]);
        assert_eq!(contradictions(row, &verdict), [""; 0]);
        let swing = |motion_rad: f64| {
            let wrong = Wrong { motion_rad, ..Wrong::default() };
            swing(&|frames| phase(row, frames), &row.angles, wrong, Wrong::default()).1
        };
        let slope = (swing(2e-3) / swing(1e-3)).log2();
        assert!((slope - motion_order as f64).abs() < 0.05, "{slope}");
    }
}

/// The paper's motion error of four frames: 2 cycles of amplitude v t_f / 2 in metres, whatever the modulation frequency is.
#[test]
fn four_frames_in_motion_swing_by_half_the_way_of_a_frame() {
    let four = named("four_frame").unwrap().unwrap();
    for frequency_hz in [10e6, 30e6, 40e6] {
        let (way_m, range_m) = (2.0 * 0.031_25, 299_792_458.0 / (2.0 * frequency_hz));
        let motion_rad = TAU * way_m / range_m;
        let error = Disturbance { motion_rad, ..Disturbance::default() }.error(&four);
        let peak_m = error.peak_rad / TAU * range_m;
        assert!((peak_m / (way_m / 2.0) - 1.0).abs() < 0.01, "{frequency_hz}: {peak_m}");
    }
}

/// The program's curves and the frames of this test are two simulations.
#[test]
fn the_programs_swings_are_this_tests() {
    for name in ["four_frame", "wdft", "n-plus-3-4", "carre", "novak", "dft-7", "dft-64"] {
        let row = named(name).unwrap().unwrap();
        let none = Disturbance::default();
        for (theirs, own) in [
            (
                Disturbance { harmonic: (3, 0.01), step_error: 0.05, ..none },
                Wrong { harmonic: (3, 0.01), step: 0.05, ..Wrong::default() },
            ),
            (
                Disturbance { amplitude_drift: 0.01, ..none },
                Wrong { amplitude_drift: 0.01, ..Wrong::default() },
            ),
            (Disturbance { offset_drift: 0.01, ..none }, Wrong { offset_drift: 0.01, ..Wrong::default() }),
        ] {
            let (own, theirs) = (
                swing_over(5003, &|frames| phase(&row, frames), &row.angles, own, Wrong::default()).1,
                theirs.error(&row).rms_rad,
            );
            assert!((own - theirs).abs() < 0.01 * own + 1e-12, "{name}: {own} {theirs}");
        }
    }
}

/// 719 phases of a turn in floating point are no proof: where they see nothing, exact arithmetic still does.
#[test]
fn a_row_that_is_off_by_a_millionth_has_not_the_root() {
    let row = |middle: i64| Row {
        name: "near".to_owned(),
        angles: (0..5).map(|n| StepAngle::new(n, 4).unwrap()).collect(),
        in_phase: vec![65_000, 0, -2 * 65_000 + middle, 0, 65_000 - middle],
        quadrature: vec![0, 130_000, 0, -130_000, 0],
        offset: None,
        irrational: Irrational::One,
        reference: "test".to_owned(),
    };
    let multiplicity = |middle: i64| {
        let scheme = Scheme::of_row("test", row(middle)).unwrap();
        Polynomial::of_scheme(&scheme).unwrap().multiplicity(-1, Basis::Angle)
    };
    assert_eq!((multiplicity(0), multiplicity(1)), (2, 0));
}

// ---------------------------------------------------------------- design

fn request(reject: &[usize], frames: usize, steps: &[(i64, i64)]) -> Request {
    Request {
        reject: reject.to_vec(),
        motion: 0,
        harmonics_in_motion: false,
        drift: false,
        frames,
        growth_bits: 8,
        steps: match steps {
            [] => usual_steps(),
            _ => steps.iter().map(|&(p, q)| StepAngle::new(p, q).unwrap()).collect(),
        },
    }
}

/// The powers of d/dx up to which Σ c_n xⁿ is 0 at exp(i m δ), by Horner's rule in floating point. Surrel's sign.
fn numeric_multiplicity(scheme: &Scheme, m: i64) -> usize {
    let factor = (scheme.irrational.squared() as f64).sqrt();
    let mut c: Vec<Complex64> = scheme
        .in_phase
        .iter()
        .zip(&*scheme.quadrature)
        .map(|(&i, &q)| Complex64::new(i as f64, -factor * q as f64))
        .collect();
    let x = Complex64::from_polar(1.0, m as f64 * (scheme.angles[1].rad() - scheme.angles[0].rad()));
    let mut times = 0;
    while c.len() > 1 {
        let scale: f64 = c.iter().map(|c| c.norm()).sum();
        if c.iter().rev().fold(Complex64::ZERO, |sum, c| sum * x + c).norm() > 1e-9 * scale {
            break;
        }
        c = c.iter().enumerate().skip(1).map(|(n, c)| c * n as f64).collect();
        times += 1;
    }
    times
}

/// Asserts that every row has the roots, sees the fundamental, and measures the phase of clean frames.
fn assert_met(request: &Request, designs: &[Design]) {
    for design in designs {
        let scheme = &design.scheme;
        let what = format!("{:?} {:?} {:?}", scheme.angles, scheme.in_phase, scheme.quadrature);
        assert!(scheme.steps() <= request.frames, "{what}");
        // A sum of frames of w bits stays within w + growth bits.
        for weights in [&scheme.in_phase, &scheme.quadrature] {
            assert!(
                weights.iter().map(|weight| weight.abs()).sum::<i64>() <= 1 << request.growth_bits,
                "{what}"
            );
        }
        assert_eq!(numeric_multiplicity(scheme, 1), 0, "{what}");
        let image = if request.drift { request.motion.max(1) } else { request.motion } + 1;
        assert!(numeric_multiplicity(scheme, -1) >= image, "{what}");
        assert!(numeric_multiplicity(scheme, 0) >= if request.drift { 2 } else { 1 }, "{what}");
        for &harmonic in &request.reject {
            for m in [harmonic as i64, -(harmonic as i64)] {
                let times = if request.harmonics_in_motion { 2 } else { 1 };
                assert!(numeric_multiplicity(scheme, m) >= times, "harmonic {harmonic}: {what}");
            }
        }
        let phase_of = |frames: &[f64]| by_weights(scheme, frames);
        for k in 0..12 {
            let phase = TAU * f64::from(k) / 12.0;
            let off = phase_of(&frames(&scheme.angles, phase, Wrong::default())) - phase;
            assert!(Complex64::from_polar(1.0, off).arg().abs() < 1e-12, "{what}");
        }
        // The offset does not see the fundamental.
        let offset: Complex64 = scheme
            .offset
            .iter()
            .zip(&*scheme.angles)
            .map(|(&w, a)| Complex64::from_polar(w as f64, a.rad()))
            .sum();
        assert!(offset.norm() < 1e-9 && scheme.offset.iter().all(|&weight| weight >= 0), "{what}");
        if request.motion > 0 {
            let step = |step: f64| {
                swing(&phase_of, &scheme.angles, Wrong { step, ..Wrong::default() }, Wrong::default()).1
            };
            assert!((step(0.02) / step(0.01)).log2() > request.motion as f64 + 0.9, "{what}");
        }
    }
}

fn holds(designs: &[Design], scheme: &Scheme) -> bool {
    designs.iter().any(|design| {
        let own = &design.scheme;
        (&own.angles, &own.in_phase, &own.quadrature, own.irrational)
            == (&scheme.angles, &scheme.in_phase, &scheme.quadrature, scheme.irrational)
    })
}

fn weights(name: &str) -> Scheme {
    named(name).unwrap().unwrap().scheme.unwrap()
}

#[test]
fn the_search_recovers_four_frames() {
    let request = request(&[2], 4, &[(1, 4)]);
    let designs = design(&request).unwrap();
    assert_met(&request, &designs);
    assert!(holds(&designs, &SCHEMES[0]));
    assert_eq!(designs[0].rank, 1);
    assert_eq!(designs.len(), 1, "three roots and four frames leave no choice: {designs:?}");
}

#[test]
fn the_search_recovers_the_windowed_dft_and_a_shorter_row() {
    // Harmonic 3 under a linear step error too, and motion: both roots twice, which is the WDFT and no other row of five.
    let all = Request { motion: 1, harmonics_in_motion: true, ..request(&[3], 5, &[(1, 3)]) };
    let designs = design(&all).unwrap();
    assert_met(&all, &designs);
    assert!(designs.len() == 1 && holds(&designs, &SCHEMES[1]), "{designs:?}");
    // Without that, four frames will do: N + 1 type B; and the WDFT is among the rows of five.
    let less = Request { motion: 1, ..request(&[3], 5, &[(1, 3)]) };
    let designs = design(&less).unwrap();
    assert_met(&less, &designs);
    assert!(holds(&designs, &weights("n-plus-1-b-3")) && holds(&designs, &SCHEMES[1]));
    // Wherever the step may be chosen, too.
    let anywhere = Request { motion: 1, ..request(&[3], 5, &[]) };
    let designs = design(&anywhere).unwrap();
    assert_met(&anywhere, &designs);
    assert!(holds(&designs, &weights("n-plus-1-b-3")));
}

#[test]
fn the_search_recovers_published_rows() {
    for (wanted, name) in [
        (Request { motion: 1, ..request(&[2], 5, &[(1, 4)]) }, "hariharan"),
        (Request { motion: 2, ..request(&[], 5, &[(1, 4)]) }, "schmit-creath"),
        (Request { motion: 1, harmonics_in_motion: true, ..request(&[2, 4], 7, &[(1, 4)]) }, "wdft-4"),
        (Request { motion: 1, ..request(&[2, 3, 4], 7, &[(1, 6)]) }, "n-plus-1-b-6"),
        (Request { motion: 2, drift: true, ..request(&[2, 3, 4], 9, &[(1, 6)]) }, "n-plus-3-6"),
    ] {
        let designs = design(&wanted).unwrap();
        assert_met(&wanted, &designs);
        assert!(holds(&designs, &weights(name)), "{name}: {designs:?}");
    }
}

/// The request of the program's own example, and wider ones: every answer, not only the first.
#[test]
fn every_designed_row_has_the_roots_and_ranks_follow_noise_and_cost() {
    for wanted in [
        Request { motion: 1, drift: true, ..request(&[2, 3, 4], 9, &[]) },
        Request { motion: 1, ..request(&[2, 3], 10, &[]) },
        Request { motion: 2, harmonics_in_motion: true, ..request(&[2], 9, &[(1, 4), (3, 8), (1, 3)]) },
    ] {
        let designs = design(&wanted).unwrap();
        assert!(designs.len() > 1);
        assert_met(&wanted, &designs);
        let key = |design: &Design| (design.scheme.steps(), design.digits, design.verdict.noise_factor);
        for first in designs.iter().filter(|design| design.rank == 1) {
            let beaten = designs.iter().any(|other| {
                let ((f, d, n), (own_f, own_d, own_n)) = (key(other), key(first));
                f <= own_f && d <= own_d && n < own_n * (1.0 - 1e-9)
            });
            assert!(!beaten, "{first:?}");
        }
        assert!(designs.windows(2).all(|pair| pair[0].rank <= pair[1].rank));
    }
}

/// More frames never cost noise: the least noise of all rows falls, and never below the DFT's.
#[test]
fn noise_falls_with_frames_and_never_below_the_dfts() {
    let wanted = Request { motion: 1, ..request(&[2], 12, &[(1, 4)]) };
    let designs = design(&wanted).unwrap();
    let least = |frames: usize| {
        let rows = designs.iter().filter(|design| design.scheme.steps() == frames);
        rows.map(|design| design.verdict.noise_factor).fold(f64::INFINITY, f64::min)
    };
    for frames in 5..12 {
        assert!(
            least(frames + 1) <= least(frames) + 1e-9,
            "{frames}: {} {}",
            least(frames),
            least(frames + 1)
        );
    }
    assert!(designs.iter().all(|design| design.noise_over_dft() > 1.0 - 1e-12));
}

#[test]
fn impossible_requests_are_refused_with_the_reason() {
    let motion = |request: Request| Request { motion: 1, ..request };
    for (wanted, reason) in [
        (request(&[3], 9, &[(1, 4)]), "with steps of 1/4 turn, harmonic 3 looks like the fundamental (-3 is"),
        (
            motion(request(&[2, 3, 4], 6, &[(1, 6)])),
            "7 frames are needed: these 6 roots and one frame more: 0, -1 twice",
        ),
        (request(&[2], 9, &[(1, 5)]), "reject the fundamental (roots -1 and 1 are conjugates)"),
        (request(&[3], 16, &[(1, 8)]), "reject the fundamental (roots -3 and 1 are conjugates)"),
        (request(&[1], 9, &[]), "--reject 1"),
        (request(&[13], 9, &[]), "--reject 13"),
        (request(&[2], 2, &[]), "--frames 2"),
        (request(&[2], 17, &[]), "--frames 17"),
        (request(&[2], 9, &[(1, 2)]), "--step 1/2"),
        (Request { growth_bits: 0, ..request(&[2], 4, &[(1, 4)]) }, "no row of small weights"),
    ] {
        let refusal = design(&wanted).unwrap_err().to_string();
        assert!(refusal.contains(reason), "{reason} is not in\n{refusal}");
        assert!(refusal.contains("expected:"), "{refusal}");
    }
}

/// Integer weights need a step whose denominator is a multiple of 3 or 4, and any such will do for the image.
#[test]
fn denominators_with_a_factor_of_3_or_4_are_those_that_integers_can_do() {
    for parts in 3..=24 {
        let refusal = design(&request(&[], 8, &[(1, parts)])).err().map(|problem| problem.to_string());
        let conjugates = refusal.as_ref().is_some_and(|text| text.contains("roots -1 and 1 are conjugates"));
        assert_eq!(conjugates, parts % 3 != 0 && parts % 4 != 0, "{parts}: {refusal:?}");
    }
}
