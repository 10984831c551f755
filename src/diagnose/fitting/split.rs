//! The light of pixels that do not tell what of it is the camera's own and what is ambient light.

use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::columns::{OWN, own_values, own_values_mut};
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::{Moment, Pixels, Place};

/// Range at which the still background is put, m: what it is does not matter, its amplitude and phase are fitted.
pub const BACKGROUND_M: f64 = 1.0;
/// The constant part of the camera's own light over its amplitude, where no pixel tells it: that of pixels which take back half of what the light is modulated by.
const USUAL_RATIO: f64 = 2.0;

/// A background that never moves does not tell its constant light from the ambient light, nor does a target that is always at one place: it is given the usual
/// ratio of constant light to amplitude of pixels that do, as far as there is so much light. Of a scene that stands still all light is taken for the camera's own.
pub fn split_light(data: &Data, numbers: &mut [Vec<f64>; OWN]) {
    let [amplitudes, _, constants, _] = &*numbers;
    let mut ratios: Vec<f64> = (0..data.pixels())
        .filter(|&pixel| data.target[pixel] && data.tells_constant(pixel) && amplitudes[pixel] > 0.0)
        .map(|pixel| constants[pixel] / amplitudes[pixel])
        .collect();
    ratios.sort_by(f64::total_cmp);
    let untold = if data.assumed.still_scene { f64::INFINITY } else { USUAL_RATIO };
    let ratio = ratios.get(ratios.len() / 2).copied().unwrap_or(untold).max(0.0);
    for (pixel, light) in lights(data) {
        // Without any light there is none to split.
        let share = if numbers[0][pixel] == 0.0 { 0.0 } else { ratio * numbers[0][pixel].abs() };
        let constant = share.min(numbers[3][pixel].max(0.0) / light);
        numbers[2][pixel] = constant;
        numbers[3][pixel] -= constant * light;
    }
}

/// The pixels that do not tell their constant light from the ambient light, and how much of the light that they get of the camera at 1 m they get where they are.
fn lights(data: &Data) -> Vec<(usize, f64)> {
    let place_m = data.lit().next().map_or(BACKGROUND_M, Moment::commanded_m);
    let obliquities = data.obliquities();
    let untold = (0..data.pixels()).filter(|&pixel| !data.tells_constant(pixel));
    let light = |pixel: usize| {
        // Ambient light is what it is at the pixel, the camera's own that at 1 m.
        let range_m = if data.target[pixel] { place_m * obliquities[pixel] } else { BACKGROUND_M };
        (pixel, (range_m * range_m).recip())
    };
    untold.map(light).collect()
}

/// `pixels` whose light is split anew where they do not tell it, by what the others say by now: before an effect of the ambient light was known, these said something else.
/// Nothing where no pixel tells it, or all do, and where neither `pieces` nor what the camera includes acts on light.
pub fn split_anew(data: &Data, pixels: &Pixels, pieces: &[Piece]) -> Option<Pixels> {
    let lights = lights(data);
    if data.assumed.still_scene || lights.is_empty() || lights.len() == data.pixels() {
        return None;
    }
    let included = data.takes.iter().flat_map(|take| &take.included).map(|active| active.effect);
    if !pieces.iter().map(|piece| piece.effect).chain(included).any(|effect| effect.place == Place::Light) {
        return None;
    }
    let mut numbers = own_values(pixels).map(<[f64]>::to_vec);
    for (pixel, light) in lights {
        numbers[3][pixel] += numbers[2][pixel] * light;
    }
    split_light(data, &mut numbers);
    let mut anew = pixels.clone();
    own_values_mut(&mut anew).into_iter().zip(&numbers).for_each(|(own, number)| own.copy_from_slice(number));
    Some(anew)
}
