//! Flaws of the light and of the waveform.

use super::{Flaw, Hook, Mechanism};
use crate::frames::Geometry;
use crate::time_domain::scene::Scene;
use crate::time_domain::waveform::Waveform;
use crate::time_domain::world::{Moment, Ray};
use std::f64::consts::TAU;

pub const MECHANISMS: &[Mechanism] = &[
    Mechanism::known("correlation_harmonics", "1", 0.005, 0.3, Hook::Waveform(correlation_harmonics), 'c'),
    Mechanism::known("multipath_interference", "1", 0.01, 0.5, Hook::Ray(multipath), 'p'),
    Mechanism::known("mixed_pixels", "1", 0.05, 0.5, Hook::Ray(mixed_pixels), 'p'),
    Mechanism::known("lens_scatter", "1", 0.005, 0.3, Hook::Image(lens_scatter), 'p'),
    Mechanism::known("illumination_baseline", "m", 0.05, 0.25, Hook::Ray(illumination_baseline), 'e'),
    Mechanism::known("intensity_related_phase", "rad", 0.01, 0.5, Hook::Ray(intensity_related_phase), 'i'),
    Mechanism::known("electrical_crosstalk", "DN", 1.0, 100.0, Hook::Ray(electrical_crosstalk), 'a'),
    Mechanism::known(
        "multi_camera_interference",
        "DN",
        2.0,
        200.0,
        Hook::Ray(multi_camera_interference),
        'a',
    ),
];

/// Order and phase (rad) of a ringing.
pub fn ringing(flaw: &Flaw) -> (f64, f64) {
    ([3.0, 3.0, 5.0, 2.0][flaw.draw(0, 0.0, 3.999) as usize], TAU * flaw.draws[1])
}

/// The driver rings at a harmonic of the modulation: 2, 3 or 5.
fn correlation_harmonics(flaw: &Flaw, waveform: &Waveform) -> Waveform {
    let (order, phase_rad) = ringing(flaw);
    waveform.with_wave(order, flaw.size, phase_rad)
}

/// Light that goes by a wall beside the path: out to the wall, to the target, and straight back.
fn multipath(flaw: &Flaw, _: &Moment, _: &Scene, ray: &mut Ray) {
    if ray.sees_target {
        let wall_m = flaw.draw(0, 0.4, 1.5);
        let out_m = ray.range_m.hypot(2.0 * wall_m);
        // The way out spreads over its own length; the way back is the direct one's.
        let amplitude_e = flaw.size * ray.amplitude_e * (ray.range_m / out_m).powi(2);
        ray.echo = Some((amplitude_e, 0.5 * (ray.range_m + out_m)));
    }
}

/// Four emitters stand around the lens: each one's light goes out by a way of its own, and spreads over that.
fn illumination_baseline(flaw: &Flaw, _: &Moment, scene: &Scene, ray: &mut Ray) {
    let Geometry { width, height } = scene.geometry;
    let across = ray.column as f64 - 0.5 * (width as f64 - 1.0);
    let down = ray.row as f64 - 0.5 * (height as f64 - 1.0);
    // The sine of the angle to the axis, a pixel off it.
    let obliquity = scene.pixels[ray.pixel].obliquity;
    let sine = (1.0 - obliquity.powi(-2)).max(0.0).sqrt() / across.hypot(down).max(1e-9);
    let range_m = ray.range_m;
    let out_m = [across, -across, down, -down].map(|along| {
        let squared_m2 = range_m * range_m - 2.0 * range_m * flaw.size * sine * along + flaw.size * flaw.size;
        squared_m2.sqrt()
    });
    let lights = out_m.map(|out_m| (range_m / out_m).powi(2));
    let light: f64 = lights.iter().sum();
    let way_m = out_m.iter().zip(&lights).map(|(out_m, light)| out_m * light).sum::<f64>() / light;
    ray.amplitude_e *= 0.25 * light;
    ray.constant_e *= 0.25 * light;
    // What comes by a longer way is less, and turns the sum less.
    ray.range_m = 0.5 * (range_m + way_m);
}

/// Each side of the target ends within a pixel: one that sees mostly the target, and some background, or the other way round.
fn mixed_pixels(flaw: &Flaw, moment: &Moment, scene: &Scene, ray: &mut Ray) {
    let Geometry { width, height } = scene.geometry;
    let at = |row: usize, column: usize| {
        (row < height && column < width).then(|| &scene.pixels[row * width + column])
    };
    let (row, column) = (ray.row, ray.column);
    let beside = [
        at(row, column.wrapping_sub(1)),
        at(row, column + 1),
        at(row.wrapping_sub(1), column),
        at(row + 1, column),
    ];
    for (direction, other) in beside.into_iter().enumerate() {
        let Some(other) = other.filter(|other| other.sees_target != ray.sees_target) else { continue };
        // The target's left side is to the left of its own pixels, and to the right of the background's.
        let side = if ray.sees_target { direction } else { direction ^ 1 };
        if (flaw.draws[side] < 0.5) == ray.sees_target {
            let share = flaw.size * flaw.draw(4 + side, 0.4, 1.0);
            let distance_m = if other.sees_target { moment.position_m } else { scene.background_m };
            let range_m = distance_m * other.obliquity;
            ray.amplitude_e *= 1.0 - share;
            ray.echo = Some((share * other.amplitude_e / (range_m * range_m), range_m));
        }
    }
}

/// The lens spreads a share of all light evenly over the sensor.
fn lens_scatter(flaw: &Flaw, _: &Moment, scene: &Scene, image: &mut [f64]) {
    // Ambient light is spread, too; it does not change.
    let mean = image.iter().sum::<f64>() / scene.pixels.len() as f64;
    for charge in image {
        *charge += flaw.size * (mean - *charge);
    }
}

/// A pixel's gate is the later the less light it has, or the laser's driver the later the more light it makes.
fn intensity_related_phase(flaw: &Flaw, moment: &Moment, scene: &Scene, ray: &mut Ray) {
    let level = moment.light * ray.amplitude_e / (0.1 * scene.brightest_e);
    let share = if flaw.draws[7] < 0.5 { (1.0 + level).recip() } else { 0.1 * level };
    ray.delay_rad += flaw.sign(0) * flaw.size * share;
}

/// Charge that couples into the read-out, electrons: about ten a code.
pub fn coupled_e(flaw: &Flaw) -> f64 {
    10.0 * flaw.size
}

/// The gate's phase at which it is greatest, rad.
pub fn coupled_rad(flaw: &Flaw) -> f64 {
    TAU * flaw.draws[0]
}

/// The laser driver's current couples into the read-out, with or without light.
fn electrical_crosstalk(flaw: &Flaw, moment: &Moment, _: &Scene, ray: &mut Ray) {
    ray.extra_e += coupled_e(flaw) * (moment.gate_rad - coupled_rad(flaw)).cos();
}

/// Another camera's light beats with this one's gate.
fn multi_camera_interference(flaw: &Flaw, moment: &Moment, scene: &Scene, ray: &mut Ray) {
    let beat_hz = flaw.draw(0, 0.15, 2.0);
    let across = ray.column as f64 / scene.geometry.width as f64 - 0.5;
    let lit = 1.0 + 0.6 * flaw.draw(1, -1.0, 1.0) * across;
    let phase_rad = moment.gate_rad - TAU * (beat_hz * moment.time_s + flaw.draws[2]);
    ray.extra_e += 10.0 * flaw.size * lit * phase_rad.cos();
}
