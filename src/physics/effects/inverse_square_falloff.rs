//! The light falls off while a set is taken.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Share of the way during a set that the light's falloff follows; 1 is physics.
pub static EFFECT: Effect = Effect {
    name: "inverse_square_falloff",
    sentence: "The light falls off with the square of the distance during a set, as the target moves, so amplitude and offset \
               change from frame to frame.",
    reference: "Drayton, Carnegie, Dorrington 2012 name it; amplitude A0 (d0/d)^2",
    parameters: &[Parameter::strength("share", "1", 0.0, (-0.5, 2.0), 1.0)],
    place: Place::Clock,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Law,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    exposure.falloff_share += values[0];
}
