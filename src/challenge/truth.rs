//! The registry's parameters in a campaign, where the generator's own numbers say exactly what they are.

use crate::time_domain::{Flaw, World, flaws};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// A parameter's true value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// Its name in the registry.
    pub name: String,
    /// The value, in `unit`.
    pub value: f64,
    /// The registry's unit.
    pub unit: String,
}

/// Parameter, unit, and its value; nothing where this flaw has another shape.
type Row = (&'static str, &'static str, fn(&Flaw, &World) -> Option<f64>);

/// The effects whose frames the registry's form gives exactly, at these values (`tests/challenge.rs` compares the frames).
///
/// Not here: where the two forms differ (echo, lag, crosstalk of charge, droop, converter's curve, phase by intensity, mixed pixels,
/// encoder's errors while the carriage moves, emitters around the lens, motion to the side), where photons are clipped and not their mean (saturation), where only differences
/// of the parameters show (a gain or an error of each frame), and strengths of chance, whose stated deviation is a rule of thumb.
const TRUTHS: &[(&str, &[Row])] = &[
    ("axial_motion", &[("share", "1", |_, _| Some(1.0))]),
    ("inverse_square_falloff", &[("share", "1", |_, _| Some(1.0))]),
    ("phase_step_scale", &[("relative", "1", |flaw, _| Some(signed(flaw)))]),
    // The registry's drift is one of the light: the gate's is the other way round.
    (
        "phase_drift",
        &[
            ("drift_rad", "rad", |flaw, _| Some(-signed(flaw))),
            ("time_constant_s", "s", |flaw, _| Some(flaws::phase_warm_up_s(flaw))),
        ],
    ),
    ("modulation_frequency_error", &[("relative", "1", |flaw, _| Some(signed(flaw)))]),
    ("encoder_offset", &[("offset_m", "m", |flaw, _| Some(signed(flaw)))]),
    ("tap_mismatch", &[("gain", "1", |flaw, _| Some(signed(flaw)))]),
    (
        "illumination_drift",
        &[
            ("relative", "1", |flaw, _| flaws::light_warm_up_s(flaw).map(|_| flaw.size)),
            ("time_constant_s", "s", |flaw, _| flaws::light_warm_up_s(flaw)),
        ],
    ),
    (
        "ambient_drift",
        &[
            ("relative_a_second", "1/s", |flaw, _| Some(signed(flaw) / flaws::ambient_drift_s(flaw))),
            ("course", "1", |flaw, _| flaws::begins_anew(flaw).then_some(-1.0)),
        ],
    ),
    // cos(a + x) = cos x cos a - sin x sin a, here and below.
    (
        "ambient_flicker",
        &[
            ("cosine", "1", |flaw, _| Some(flaw.size * flaws::flicker(flaw).1.cos())),
            ("sine", "1", |flaw, _| Some(-flaw.size * flaws::flicker(flaw).1.sin())),
            ("frequency_hz", "Hz", |flaw, _| Some(flaws::flicker(flaw).0)),
        ],
    ),
    (
        "correlation_harmonics",
        &[
            ("cosine_2", "1", |flaw, world| wave(flaw, world, 2.0, f64::cos)),
            ("sine_2", "1", |flaw, world| wave(flaw, world, 2.0, |x| -x.sin())),
            ("cosine_3", "1", |flaw, world| wave(flaw, world, 3.0, f64::cos)),
            ("sine_3", "1", |flaw, world| wave(flaw, world, 3.0, |x| -x.sin())),
            ("cosine_5", "1", |flaw, world| wave(flaw, world, 5.0, f64::cos)),
            ("sine_5", "1", |flaw, world| wave(flaw, world, 5.0, |x| -x.sin())),
        ],
    ),
    ("lens_scatter", &[("share", "1", |flaw, _| Some(flaw.size))]),
    (
        "electrical_crosstalk",
        &[
            ("cosine_dn", "DN", |flaw, world| Some(coupled_dn(flaw, world) * flaws::coupled_rad(flaw).cos())),
            ("sine_dn", "DN", |flaw, world| Some(coupled_dn(flaw, world) * flaws::coupled_rad(flaw).sin())),
        ],
    ),
    (
        "intensity_nonlinearity",
        &[
            ("quadratic", "1", |flaw, _| Some(signed(flaw) * (1.0 - flaws::cubic_part(flaw)))),
            ("cubic", "1", |flaw, _| Some(signed(flaw) * flaws::cubic_part(flaw))),
        ],
    ),
];

/// The size of a flaw of either sign.
fn signed(flaw: &Flaw) -> f64 {
    flaw.sign(0) * flaw.size
}

/// The part of a ringing of `order`, whose phase is the correlation's in the generator, and the crest's in the registry.
fn wave(flaw: &Flaw, world: &World, order: f64, part: fn(f64) -> f64) -> Option<f64> {
    let (own, phase_rad) = flaws::ringing(flaw);
    let from_crest_rad = (phase_rad - order * world.waveform.crest_rad()) % TAU;
    (own == order).then(|| flaw.size * part(from_crest_rad))
}

/// What couples into the read-out, DN.
fn coupled_dn(flaw: &Flaw, world: &World) -> f64 {
    flaws::coupled_e(flaw) / world.sensor.gain_e_per_dn
}

/// The true values of the parameters of `flaw` in `world`, in the registry's words; nothing of a flaw whose form the registry has otherwise.
pub fn truths(flaw: &Flaw, world: &World) -> Vec<Truth> {
    let rows = TRUTHS.iter().find(|row| row.0 == flaw.mechanism.name).map_or(&[][..], |row| row.1);
    let truth = |&(name, unit, value): &Row| {
        let value = value(flaw, world)?;
        Some(Truth { name: name.to_owned(), value: told(value), unit: unit.to_owned() })
    };
    rows.iter().filter_map(truth).collect()
}

/// Ten significant digits: a frequency is found that well.
fn told(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}
