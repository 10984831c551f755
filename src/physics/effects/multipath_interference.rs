//! Light that comes back by a longer way too.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};
use crate::units::phase_rad;
use std::sync::Arc;

/// A second return by way of a wall that stands beside the path of the light, at the same distance all along: out directly, back by the
/// wall's mirror image, √(d² + 4 L²) for a target at d. Its amplitude relative to the direct one is the parameter, were the wall close,
/// and less by the longer way. Or, whatever the target's distance, a way longer by as much as the wall is away, out and back together twice that, of
/// light that falls off with it.
pub static EFFECT: Effect = Effect {
    name: "multipath_interference",
    sentence: "Part of the light reaches the pixel by a longer way (a wall, another surface), and its phasor adds to the direct one.",
    reference: "Dorrington et al. 2011; D_n = sum_i A_i cos(theta_n - phi_i)",
    parameters: &[
        Parameter::strength("relative_amplitude", "1", 0.0, (0.0, 0.8), 0.1),
        Parameter::shape("wall_distance_m", "m", 0.6, (0.02, 6.0), &[0.15, 0.4, 0.8, 1.5]),
        Parameter::choice("is_longer_by_a_constant", "1", &[0.0, 1.0]),
    ],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let (share, wall_m) = (values[0], values[1]);
    if share == 0.0 {
        return;
    }
    let pixels = Arc::clone(&exposure.pixels);
    let count = exposure.range_m.len();
    let (mut amplitudes, mut phases) = (vec![0.0; count], vec![0.0; count]);
    let signal_dn: &mut [f64] = &mut exposure.signal_dn;
    for pixel in (0..count).filter(|&pixel| pixels.target[pixel]) {
        let range_m = exposure.range_m[pixel];
        let (back_m, part) = if values[2] > 0.5 {
            (range_m + 2.0 * wall_m, share * (range_m / (range_m + wall_m)).powi(2))
        } else {
            let back_m = (range_m * range_m + 4.0 * wall_m * wall_m).sqrt();
            (back_m, share * range_m / back_m)
        };
        amplitudes[pixel] = part * exposure.amplitude_dn[pixel];
        phases[pixel] =
            exposure.phase_rad[pixel] + phase_rad((back_m - range_m) / 2.0, exposure.frequency_hz);
        signal_dn[pixel] += part * exposure.constant_dn[pixel];
    }
    exposure.add_path(&amplitudes, &phases.into());
}
