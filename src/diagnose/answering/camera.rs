//! The camera as its next simulation should have it: with the effects that were found.

use super::common_part::CommonPart;
use super::effect_row::in_all;
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::noise::{Noise, ROUNDING_DN2};
use crate::diagnose::judging::judge::Judgement;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::columns::Column;
use crate::physics::Active;
use crate::recording::{BASELINE, Camera, effect_name};

/// Closer to 1, in standard deviations, a share is 1.
const WHOLE_SIGMAS: f64 = 4.0;

/// The camera of `data`, with the effects that `judgement` asserts and their fitted values.
pub fn camera_with(data: &Data, judgement: &Judgement) -> Camera {
    let mut camera = data.described.clone();
    // What nobody has described is what was measured.
    if data.assumed.camera && judgement.noise.slope > 0.0 {
        let Noise { floor, slope, .. } = judgement.noise;
        camera.gain_e_per_dn = slope.recip();
        camera.read_noise_e = (floor - ROUNDING_DN2).max(0.0).sqrt() / slope;
    }
    let named = |name: &str| judgement.named.iter().any(|named| named.name == name);
    let Fit { pieces, columns, .. } = &judgement.fit;
    for (number, piece) in pieces.iter().enumerate().filter(|(_, piece)| named(piece.effect.name)) {
        // By name where it acts wholly, as far as is known; else with its value.
        let is_whole = |(place, column): (usize, &Column)| {
            column.piece == number
                && (piece.values[column.parameter] - 1.0).abs() < WHOLE_SIGMAS * judgement.fit.sigma(place)
        };
        let is_whole = piece.takes.len() == data.takes.len() && columns.iter().enumerate().any(is_whole);
        let by_name = BASELINE.iter().find(|(name, _)| *name == piece.effect.name);
        if let Some((_, included)) = by_name.filter(|_| is_whole) {
            camera.included_physics.push((*included).to_owned());
            continue;
        }
        // A name without values would stand for the usual ones.
        if (Active { effect: piece.effect, values: piece.values.clone() }).is_off() {
            continue;
        }
        // A phase of all would be taken for a distance by the next simulation.
        let common = CommonPart::of(data, &judgement.fit, piece.effect.name);
        let values = common.map_or_else(
            || piece.values.clone(),
            |common| common.values_without(&judgement.fit, number, piece),
        );
        let values: Vec<String> = piece
            .effect
            .parameters
            .iter()
            .zip(&values)
            .filter(|(parameter, value)| **value != parameter.off)
            .map(|(parameter, value)| format!("{}={value:?}", parameter.name))
            .collect();
        let takes: Vec<&str> = piece.takes.iter().map(|&take| data.takes[take].name.as_str()).collect();
        let only =
            if takes.len() == data.takes.len() { String::new() } else { format!("@{}", takes.join(",")) };
        camera.effects.push(format!("{}:{}{only}", piece.effect.name, values.join(",")));
    }
    for (name, strength) in &judgement.random {
        let value = in_all(data, name, *strength).value;
        camera.effects.retain(|text| effect_name(text) != *name);
        let parameter = crate::physics::effects::named(name).and_then(|effect| effect.parameters.first());
        let told = parameter.map(|parameter| {
            let value = value.clamp(parameter.bounds.0, parameter.bounds.1);
            format!("{name}:{}={value:?}", parameter.name)
        });
        camera.effects.extend(told);
    }
    camera
}
