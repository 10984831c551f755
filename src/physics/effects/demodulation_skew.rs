//! The demodulation signal reaches columns and rows at different times.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};
use std::f64::consts::TAU;

/// Delay from the first to the last column, and from the first to the last row.
pub static EFFECT: Effect = Effect {
    name: "demodulation_skew",
    sentence: "The demodulation signal takes time to cross the sensor, so the phase has a slope over columns or rows.",
    reference: "fixed-pattern phase: phi_0 = 2 pi f (t_x x + t_y y)",
    parameters: &[
        Parameter::strength("columns_s", "s", 0.0, (-5e-9, 5e-9), 2e-10),
        Parameter::strength("rows_s", "s", 0.0, (-5e-9, 5e-9), 2e-10),
    ],
    place: Place::Path,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let turns_a_second = TAU * exposure.frequency_hz;
    for (pixel, phase_rad) in exposure.phase_rad.iter_mut().enumerate() {
        let (x, y) = exposure.pixels.place(pixel);
        *phase_rad += turns_a_second * (values[0] * x + values[1] * y);
    }
}
