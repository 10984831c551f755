//! Light that starts beside the lens.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};
use crate::units::phase_rad;

/// The square of the distance from the lens to the emitter. From beside the lens by `b` the way out to a target at `d`, straight ahead, is
/// √(d² + b²), longer than the way back by `b² / 2d`; what a pixel's direction adds, `b sin a`, does not depend on the distance and is the pixel's own.
/// Emitters all around the lens make the same, near the axis. Where amplitudes are not calibrated for it, light falls with the square of the way out, too: by
/// `b² / d²`, for which there is a number of its own.
pub static EFFECT: Effect = Effect {
    name: "illumination_baseline",
    sentence: "The light starts beside the lens (bistatic geometry): the way out is longer than the way back, the more the nearer \
               the target is.",
    reference: "phi = 2 pi f (sqrt(d^2 + b^2) + d) / c, geometry",
    parameters: &[
        Parameter::strength("squared_baseline_m2", "m^2", 0.0, (0.0, 0.1), 2.5e-3),
        Parameter::strength("squared_baseline_of_light_m2", "m^2", 0.0, (0.0, 0.1), 2.5e-3).instead(),
    ],
    place: Place::Waveform,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let (squared_m2, of_light_m2) = (values[0] + values[1], values[1]);
    if squared_m2 == 0.0 {
        return;
    }
    let Exposure { phase_rad: phases_rad, range_m, amplitude_dn, constant_dn, frequency_hz, .. } = exposure;
    for (phase, &range_m) in phases_rad.iter_mut().zip(&*range_m) {
        // The mean of both ways is what a range of this phase would be.
        let mean_m = ((range_m * range_m + squared_m2).sqrt() - range_m) / 2.0;
        *phase += phase_rad(mean_m, *frequency_hz);
    }
    if of_light_m2 != 0.0 {
        for light_dn in [amplitude_dn, constant_dn] {
            for (light, &range_m) in light_dn.iter_mut().zip(&*range_m) {
                let squared_range_m2 = range_m * range_m;
                *light *= squared_range_m2 / (squared_range_m2 + of_light_m2);
            }
        }
    }
}
