//! Flaws that no library has, with the coordinates where they live.

use super::{Flaw, Hook, Mechanism};
use crate::time_domain::plan::Take;
use crate::time_domain::scene::Scene;
use crate::time_domain::world::{Moment, Ray, World};
use std::f64::consts::TAU;

pub const MECHANISMS: &[Mechanism] = &[
    Mechanism::outside("row_banding", "DN", 1.0, 200.0, Hook::Code(row_banding), &["row"]),
    Mechanism::outside("slow_columns", "rad", 0.05, 1.5, Hook::Ray(slow_columns), &["column", "amplitude"]),
    Mechanism::outside("code_glitch", "DN", 5.0, 200.0, Hook::Code(code_glitch), &["code"]),
    Mechanism::outside("alternating_gain", "1", 0.01, 0.3, Hook::Clock(alternating_gain), &["set"]),
    Mechanism::outside("breathing_phase", "rad", 0.01, 0.5, Hook::Clock(breathing_phase), &["time_s", "set"]),
    Mechanism::outside("post_in_the_beam", "1", 0.05, 0.9, Hook::Ray(post_in_the_beam), &["position_m"]),
    Mechanism::outside("row_load", "1", 0.01, 0.5, Hook::Image(row_load), &["neighbours", "row"]),
    Mechanism::outside(
        "encoder_latency",
        "s",
        5e-4,
        0.05,
        Hook::Clock(encoder_latency),
        &["velocity_m_s", "encoder"],
    ),
    Mechanism::outside("reset_pulse", "DN", 1.0, 200.0, Hook::Code(reset_pulse), &["frame"]),
    Mechanism::outside("weak_contrast", "1", 0.02, 0.7, Hook::Ray(weak_contrast), &["amplitude", "code"]),
    Mechanism::outside("offset_gain", "1", 0.01, 0.5, Hook::Clock(offset_gain), &["phase"]),
];

/// Bands of rows that drift as the supply's ripple meets the row clock.
fn row_banding(flaw: &Flaw, moment: &Moment, world: &World, pixel: usize, code: f64) -> f64 {
    let (row, _) = world.scene.geometry.row_column(pixel);
    let rows = flaw.draw(0, 3.0, 7.0);
    let drift = moment.time_s / flaw.draw(1, 1.5, 6.0);
    code + flaw.size * (TAU * (row as f64 / rows + drift + flaw.draws[2])).cos()
}

/// In a few columns the gate is late, the more the more light there is.
fn slow_columns(flaw: &Flaw, _: &Moment, scene: &Scene, ray: &mut Ray) {
    let width = scene.geometry.width as f64;
    let first = (width * flaw.draw(0, 0.25, 0.6)) as usize;
    if (first..first + 3).contains(&ray.column) {
        ray.delay_rad += flaw.size * ray.amplitude_e / scene.brightest_e;
    }
}

/// One bit of the converter is late: codes in narrow windows are too large.
fn code_glitch(flaw: &Flaw, _: &Moment, _: &World, _: usize, code: f64) -> f64 {
    let period = [64.0, 128.0][flaw.draw(0, 0.0, 1.999) as usize];
    let place = (code / period + flaw.draws[1]).fract();
    code + if place < 0.25 { flaw.size } else { 0.0 }
}

/// Two capacitors take turns: every other set has another gain.
fn alternating_gain(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    moment.gain *= 1.0 + if moment.set.is_multiple_of(2) { flaw.size } else { -flaw.size };
}

/// A thermostat: the phase swings over seconds.
fn breathing_phase(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    let period_s = flaw.draw(0, 4.0, 12.0);
    moment.gate_rad += flaw.size * (TAU * (moment.time_s / period_s + flaw.draws[1])).sin();
}

/// Something shades the target where it passes.
fn post_in_the_beam(flaw: &Flaw, moment: &Moment, _: &Scene, ray: &mut Ray) {
    if ray.sees_target {
        let (middle_m, width_m) = (flaw.draw(0, 1.4, 2.6), flaw.draw(1, 0.1, 0.3));
        let away = (moment.position_m - middle_m) / width_m;
        ray.amplitude_e *= 1.0 - flaw.size * (-away * away).exp();
    }
}

/// A row's supply gives way under the row's charge.
fn row_load(flaw: &Flaw, _: &Moment, scene: &Scene, image: &mut [f64]) {
    for row in image.chunks_mut(scene.geometry.width) {
        let mean = row.iter().sum::<f64>() / row.len() as f64;
        row.iter_mut().for_each(|charge| *charge -= flaw.size * mean);
    }
}

/// The encoder is read late: while the carriage moves, the target is not yet where the reading says.
fn encoder_latency(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    moment.position_m -= flaw.size * moment.velocity_m_s;
    moment.began_m = moment.position_m;
}

/// A pulse reaches the read-out in one frame of each set, the same for every pixel.
fn reset_pulse(flaw: &Flaw, moment: &Moment, _: &World, _: usize, code: f64) -> f64 {
    code + if moment.frame == 1 { flaw.sign(0) * flaw.size } else { 0.0 }
}

/// Bright light is divided less well by the gate.
fn weak_contrast(flaw: &Flaw, _: &Moment, scene: &Scene, ray: &mut Ray) {
    let lost_e = flaw.size * ray.amplitude_e * ray.amplitude_e / scene.brightest_e;
    ray.amplitude_e -= lost_e;
    ray.extra_e += 2.0 * lost_e;
}

/// The gain follows the phase offset register, in a wave of few cycles.
fn offset_gain(flaw: &Flaw, plan: &Take, moment: &mut Moment) {
    let offset_rad = plan.rows[moment.set].offset_rad;
    let cycles = flaw.draw(0, 1.0, 3.999).floor();
    moment.gain *=
        1.0 + flaw.size * ((cycles * offset_rad + TAU * flaw.draws[1]).cos() - (TAU * flaw.draws[1]).cos());
}
