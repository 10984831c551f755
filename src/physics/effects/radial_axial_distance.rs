//! Distances along a pixel's own direction, and along the axis.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};
use crate::units::phase_rad;
use std::sync::Arc;

/// By how much, relatively, a pixel's range goes up more towards the image's corners than the camera's focal length says: -1 where it does not at all, as if pixels measured along the
/// axis. Of a target at one place that is each pixel's own phase; of one that moves it is a bowl that grows with the distance.
pub static EFFECT: Effect = Effect {
    name: "radial_axial_distance",
    sentence: "Ranges towards the image's corners are longer or shorter than the focal length says (radial against axial distance): a bowl that grows with the distance.",
    reference: "d = z sqrt(1 + (x^2 + y^2) / f^2), geometry",
    parameters: &[Parameter::strength("relative", "1", 0.0, (-1.5, 3.0), 0.2)],
    place: Place::Path,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let pixels = Arc::clone(&exposure.pixels);
    let Exposure { phase_rad: phases_rad, range_m: ranges_m, frequency_hz, .. } = exposure;
    let seen = pixels.target.iter().zip(&pixels.obliquity);
    let ranges = phases_rad.iter_mut().zip(ranges_m);
    for ((phase, range_m), (_, obliquity)) in ranges.zip(seen).filter(|(_, (target, _))| **target) {
        // Of the range this much is beyond the way along the axis.
        let more_m = values[0] * *range_m * (1.0 - obliquity.recip());
        *range_m += more_m;
        *phase += phase_rad(more_m, *frequency_hz);
    }
}
