//! The camera as its next simulation should have it: with the effects that were found.

use super::data::Data;
use super::judge::Judgement;
use crate::recording::{AXIAL_MOTION, Camera, INVERSE_SQUARE_FALLOFF};

/// Effects that are all of what a camera's simulation can include by name.
const BY_NAME: [(&str, &str); 2] =
    [("axial_motion", AXIAL_MOTION), ("inverse_square_falloff", INVERSE_SQUARE_FALLOFF)];

/// The camera of `data`, with the effects that `judgement` asserts and their fitted values.
pub fn camera_with(data: &Data, judgement: &Judgement) -> Camera {
    let mut camera = data.described.clone();
    let named = |name: &str| judgement.named.iter().any(|named| named.name == name);
    for piece in judgement.fit.pieces.iter().filter(|piece| named(piece.effect.name)) {
        if let Some((_, included)) = BY_NAME.iter().find(|(name, _)| *name == piece.effect.name) {
            camera.included_physics.push((*included).to_owned());
            continue;
        }
        let values: Vec<String> = piece
            .effect
            .parameters
            .iter()
            .zip(&piece.values)
            .filter(|(parameter, value)| **value != parameter.off)
            .map(|(parameter, value)| format!("{}={value:?}", parameter.name))
            .collect();
        let takes: Vec<&str> = piece.takes.iter().map(|&take| data.takes[take].name.as_str()).collect();
        let only =
            if takes.len() == data.takes.len() { String::new() } else { format!("@{}", takes.join(",")) };
        camera.effects.push(format!("{}:{}{only}", piece.effect.name, values.join(",")));
    }
    if let Some((name, strength)) = judgement.random {
        let parameter = crate::physics::effects::named(name).and_then(|effect| effect.parameters.first());
        camera.effects.extend(parameter.map(|parameter| format!("{name}:{}={strength:?}", parameter.name)));
    }
    camera
}
