//! Light that comes back by a longer way too.

use crate::physics::{Chance, Effect, Exposure, Parameter, Place};
use crate::units::phase_rad;

/// A second return: its amplitude relative to the direct one where that is at 1 m, and its longer way (one way, m). It falls off with
/// its own length.
pub static EFFECT: Effect = Effect {
    name: "multipath_interference",
    sentence: "Part of the light reaches the pixel by a longer way (another surface, a wall), and its phasor adds to the direct one.",
    reference: "Dorrington et al. 2011; D_n = sum_i A_i cos(theta_n - phi_i)",
    parameters: &[
        Parameter::strength("relative_amplitude", "1", 0.0, (0.0, 0.8), 0.1),
        Parameter::shape("longer_by_m", "m", 0.6, (0.05, 6.0), &[0.3, 0.7, 1.3, 2.0]),
    ],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    act,
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let (share, longer_m) = (values[0], values[1]);
    if share == 0.0 {
        return;
    }
    let further_rad = phase_rad(longer_m, exposure.frequency_hz);
    let phases: Vec<f64> = exposure.phase_rad.iter().map(|phase| phase + further_rad).collect();
    let falloff = |range_m: f64| share * (range_m / (range_m + longer_m)).powi(2);
    let amplitudes: Vec<f64> =
        exposure.amplitude_dn.iter().zip(&exposure.range_m).map(|(a, &r)| a * falloff(r)).collect();
    let constants = exposure.constant_dn.iter().zip(&exposure.range_m).map(|(b, &r)| b * falloff(r));
    let constants: Vec<f64> = constants.collect();
    exposure.add_path(&amplitudes, &phases);
    exposure.signal_dn.iter_mut().zip(constants).for_each(|(signal, more)| *signal += more);
}
