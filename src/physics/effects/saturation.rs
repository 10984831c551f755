//! The pixel's well is full before the converter is.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Share of the full scale that the well lacks.
pub static EFFECT: Effect = Effect {
    name: "saturation",
    sentence: "Pixels saturate below the converter's full scale: the brightest frames are clipped.",
    reference: "I = min(I, I_max)",
    parameters: &[Parameter::strength("missing", "1", 0.0, (0.0, 0.95), 0.6)],
    place: Place::Readout,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Loose,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let full_dn = exposure.pixels.full_scale_dn * (1.0 - values[0]);
    if values[0] > 0.0 {
        exposure.signal_dn.iter_mut().for_each(|signal| *signal = signal.min(full_dn));
    }
}
