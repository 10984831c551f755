//! Flaws of charge, read-out and converter.

use super::{Flaw, Hook, Mechanism};
use crate::time_domain::scene::Scene;
use crate::time_domain::world::{Moment, World};
use std::f64::consts::TAU;

pub const MECHANISMS: &[Mechanism] = &[
    Mechanism::known("intensity_nonlinearity", "1", 0.01, 0.5, Hook::Response(intensity_nonlinearity), 'c'),
    Mechanism::known("saturation", "1", 0.1, 0.7, Hook::Response(saturation), 'c'),
    Mechanism::known("image_lag", "1", 0.005, 0.3, Hook::Lag(image_lag), 'l'),
    Mechanism::known("charge_crosstalk", "1", 0.01, 0.2, Hook::Image(charge_crosstalk), 'p'),
    Mechanism::known("lateral_motion", "1/s", 0.3, 2.0, Hook::Image(lateral_motion), 'p'),
    Mechanism::known("tap_mismatch", "1", 0.005, 0.1, Hook::Image(tap_mismatch), 'a'),
    Mechanism::known("adc_nonlinearity", "DN", 1.0, 60.0, Hook::Code(adc_nonlinearity), 'c'),
];

/// Of a response that is not linear, the share of the cubic part.
pub fn cubic_part(flaw: &Flaw) -> f64 {
    flaw.draw(1, 0.0, 0.6)
}

/// The charge's capacity grows or shrinks with it: a quadratic and a cubic part.
fn intensity_nonlinearity(flaw: &Flaw, world: &World, _: usize, charge_e: f64) -> f64 {
    let filled = charge_e / world.sensor.full_scale_e();
    let cubic = cubic_part(flaw);
    charge_e * (1.0 + flaw.sign(0) * flaw.size * ((1.0 - cubic) * filled + cubic * filled * filled))
}

/// The well is smaller than the converter's range, by its size.
fn saturation(flaw: &Flaw, world: &World, _: usize, charge_e: f64) -> f64 {
    charge_e.min((1.0 - flaw.size) * world.sensor.full_scale_e())
}

/// Whether pixels are emptied before a set, of a lag: the first frame has nothing before it. In every fourth camera they are.
pub fn is_emptied(flaw: &Flaw) -> bool {
    flaw.draws[7] < 0.25
}

/// Charge of the frame before is still there.
fn image_lag(flaw: &Flaw, before: &[f64], image: &mut [f64]) {
    for (charge, before) in image.iter_mut().zip(before) {
        *charge += flaw.size * (before - *charge);
    }
}

/// Charge wanders to the four neighbours; in every third camera only to those in the same row, as along a line that runs there.
fn charge_crosstalk(flaw: &Flaw, _: &Moment, scene: &Scene, image: &mut [f64]) {
    let width = scene.geometry.width;
    let before = image.to_vec();
    let is_along_rows = flaw.draws[7] < 1.0 / 3.0;
    for (pixel, charge) in image.iter_mut().enumerate() {
        let column = pixel % width;
        let neighbours = [
            pixel.checked_sub(width).filter(|_| !is_along_rows),
            Some(pixel + width).filter(|_| !is_along_rows),
            (column > 0).then(|| pixel - 1),
            (column + 1 < width).then_some(pixel + 1),
        ];
        let among = neighbours.into_iter().flatten().filter_map(|place| before.get(place));
        *charge += flaw.size / 4.0 * among.map(|neighbour| neighbour - before[pixel]).sum::<f64>();
    }
}

/// The image wanders while a set is taken: evenly, or with a carriage whose way is askew, by so much at a metre a second.
fn lateral_motion(flaw: &Flaw, moment: &Moment, scene: &Scene, image: &mut [f64]) {
    let pixels_a_second = flaw.size * if flaw.draws[7] < 0.5 { 1.0 } else { moment.velocity_m_s };
    let (along, down) = (TAU * flaw.draws[0]).sin_cos();
    let moved = [along, down].map(|part| part * pixels_a_second * moment.within_s);
    let (before, size) = (image.to_vec(), scene.geometry);
    // What a pixel sees now was so many columns and rows before it; between pixels it is in proportion.
    let between = |place: f64, side: usize| {
        let place = place.clamp(0.0, side as f64 - 1.0);
        let first = (place.floor() as usize).min(side.saturating_sub(2));
        (first, (first + 1).min(side - 1), place - first as f64)
    };
    for (pixel, charge) in image.iter_mut().enumerate() {
        let (row, column) = size.row_column(pixel);
        let (left, right, across) = between(column as f64 - moved[0], size.width);
        let (above, below, lower) = between(row as f64 - moved[1], size.height);
        let of_row = |row: usize| {
            let [left, right] = [left, right].map(|column| before[row * size.width + column]);
            left + across * (right - left)
        };
        *charge = of_row(above) + lower * (of_row(below) - of_row(above));
    }
}

/// Even and odd frames are read from two taps, of which one has more gain.
fn tap_mismatch(flaw: &Flaw, moment: &Moment, _: &Scene, image: &mut [f64]) {
    let half = 0.5 * flaw.sign(0) * flaw.size * if moment.frame % 2 == 1 { 1.0 } else { -1.0 };
    image.iter_mut().for_each(|charge| *charge *= 1.0 + half);
}

/// The converter's curve bends like an S, by so many codes.
fn adc_nonlinearity(flaw: &Flaw, _: &Moment, world: &World, _: usize, code: f64) -> f64 {
    let place = code / world.sensor.full_scale_dn();
    code + flaw.sign(0) * flaw.size * (TAU * place).sin()
}
