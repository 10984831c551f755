//! Harmonics of the waveform that the simulation lacks: wiggling, cyclic error.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

const BOUNDS: (f64, f64) = (-0.3, 0.3);
const fn part(name: &'static str, typical: f64) -> Parameter {
    Parameter::strength(name, "1", 0.0, BOUNDS, typical)
}

/// Amplitudes relative to the fundamental, by the parts of cos(m · angle) and sin(m · angle), m = 2 to 7.
pub static EFFECT: Effect = Effect {
    name: "correlation_harmonics",
    sentence: "The correlation of light and sensor has harmonics that the simulation lacks, so the distance error is periodic \
               in phase (wiggling, cyclic error).",
    reference: "Payne et al. 2008; Drayton, Carnegie, Dorrington 2012, Table I",
    parameters: &[
        part("cosine_2", 0.01),
        part("sine_2", 0.01),
        part("cosine_3", 0.02),
        part("sine_3", 0.02),
        part("cosine_4", 0.003),
        part("sine_4", 0.003),
        part("cosine_5", 0.003),
        part("sine_5", 0.003),
        part("cosine_6", 0.002),
        part("sine_6", 0.002),
        part("cosine_7", 0.002),
        part("sine_7", 0.002),
    ],
    place: Place::Waveform,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    for (parts, number) in values.chunks_exact(2).zip(2..) {
        exposure.correlation.add_harmonic(number, parts[0], parts[1]);
    }
}
