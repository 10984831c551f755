//! Light that starts beside the lens.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};
use crate::units::phase_rad;
use std::sync::Arc;

/// The square of the distance from the lens to the emitter. From beside the lens by `b` the way out to a target at `d`, straight ahead, is
/// √(d² + b²), longer than the way back by `b² / 2d`; what a pixel's direction adds, `b sin a`, does not depend on the distance and is the pixel's own.
/// Emitters all around the lens make the same, near the axis. Where amplitudes are not calibrated for it, light falls with the square of the way out, too: by
/// `b² / d²`, for which there is a number of its own, and, where the emitters' middle is beside the lens along the columns and rows, by `2 b sin a / d`: the nearer
/// the target is, the brighter is the side of the image on which they are. A surface is lit here as strongly from aside as from straight ahead, by emitters that shine
/// everywhere alike: of a plane that faces the camera both are half as much again, and so is the length that is found. Where amplitudes are calibrated, such emitters change
/// the phase alone: at one modulation frequency what a pixel's direction adds is its own, at two it is not.
pub static EFFECT: Effect = Effect {
    name: "illumination_baseline",
    sentence: "The light starts beside the lens (bistatic geometry): the way out is longer than the way back, the more the nearer \
               the target is.",
    reference: "phi = 2 pi f (sqrt(d^2 + b^2) + d) / c, geometry",
    parameters: &[
        Parameter::strength("squared_baseline_m2", "m^2", 0.0, (0.0, 0.1), 2.5e-3),
        Parameter::strength("squared_baseline_of_light_m2", "m^2", 0.0, (0.0, 0.1), 2.5e-3).instead(),
        Parameter::strength("middle_along_columns_m", "m", 0.0, (-0.5, 0.5), 0.02).instead(),
        Parameter::strength("middle_along_rows_m", "m", 0.0, (-0.5, 0.5), 0.02).instead(),
        Parameter::choice("of_phase_alone", "1", &[0.0, 1.0]),
    ],
    place: Place::Waveform,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let middle_m = [values[2], values[3]];
    let of_light_m2 = values[1] + middle_m[0].powi(2) + middle_m[1].powi(2);
    if values[0] + of_light_m2 == 0.0 {
        return;
    }
    let pixels = Arc::clone(&exposure.pixels);
    let Exposure { phase_rad: phases_rad, range_m, amplitude_dn, constant_dn, frequency_hz, .. } = exposure;
    // The squared way out, m^2, as the light falls with it: what the pixel's direction says of the emitters' middle goes with the range.
    let aside_m = match middle_m {
        [0.0, 0.0] => vec![0.0; range_m.len()],
        _ => pixels.along(middle_m),
    };
    let squared_out_m2 = |(range_m, aside_m): (&f64, f64)| range_m * (range_m - 2.0 * aside_m) + of_light_m2;
    let squared_out_m2: Vec<f64> = range_m.iter().zip(aside_m).map(squared_out_m2).collect();
    for ((phase, range_m), squared_out_m2) in phases_rad.iter_mut().zip(&*range_m).zip(&squared_out_m2) {
        // The mean of both ways is what a range of this phase would be.
        let out_m = (squared_out_m2 + values[0]).max(0.0).sqrt();
        *phase += phase_rad((out_m - range_m) / 2.0, *frequency_hz);
    }
    if of_light_m2 != 0.0 && values[4] < 0.5 {
        for light_dn in [amplitude_dn, constant_dn] {
            for ((light, range_m), squared_out_m2) in light_dn.iter_mut().zip(&*range_m).zip(&squared_out_m2)
            {
                *light *= range_m * range_m / squared_out_m2;
            }
        }
    }
}
