//! The pixel's well is full before the converter is.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// Number of the well's knee among the parameters.
pub const KNEE: usize = 1;

/// Share of the full scale that the well lacks; and how softly it becomes full, a standard deviation of the signal as a share of the full scale (in the mean
/// alone: noise is what it is elsewhere).
pub static EFFECT: Effect = Effect {
    name: "saturation",
    sentence: "Pixels saturate below the converter's full scale: the brightest frames are clipped.",
    reference: "I = min(I, I_max); with a knee, the mean of that where I is normally distributed about its mean",
    parameters: &[
        Parameter::strength("missing", "1", 0.0, (0.0, 0.95), 0.6),
        Parameter::strength("knee", "1", 0.0, (0.0, 0.1), 0.005).looked_for(),
    ],
    place: Place::Readout,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Loose,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let full_scale_dn = exposure.pixels.full_scale_dn;
    let (full_dn, knee_dn) = (full_scale_dn * (1.0 - values[0]), full_scale_dn * values[KNEE]);
    if values[0] > 0.0 || knee_dn > 0.0 {
        exposure.signal_dn.iter_mut().for_each(|signal| *signal = clipped(*signal, full_dn, knee_dn));
    }
}

/// Beyond so many standard deviations of the knee a signal is all below the well's edge, or all above it.
const FAR: f64 = 8.0;

/// The mean of what is below `full_dn` as it is and at that above, of a signal that is normally distributed about `signal_dn` with the standard deviation `knee_dn`.
fn clipped(signal_dn: f64, full_dn: f64, knee_dn: f64) -> f64 {
    let below_dn = full_dn - signal_dn;
    if below_dn.abs() >= FAR * knee_dn {
        return signal_dn.min(full_dn);
    }
    let below = below_dn / knee_dn;
    let density = (-0.5 * below * below).exp() / TAU.sqrt();
    full_dn - 0.5 * below_dn * libm::erfc(-below * FRAC_1_SQRT_2) - knee_dn * density
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against sums over a normal distribution, in steps of a thousandth of its standard deviation.
    #[test]
    fn a_soft_well_holds_the_mean_of_what_is_clipped() {
        let (full_dn, knee_dn) = (3000.0, 20.0);
        for signal_dn in [2800.0, 2950.0, 2990.0, 3000.0, 3015.0, 3100.0, 3400.0] {
            let steps = (-10_000..=10_000).map(|step| f64::from(step) / 1000.0);
            let (sum, weight) = steps.fold((0.0, 0.0), |(sum, weight), sigmas| {
                let share = (-0.5 * sigmas * sigmas).exp();
                (sum + share * f64::min(signal_dn + knee_dn * sigmas, full_dn), weight + share)
            });
            let mean = clipped(signal_dn, full_dn, knee_dn);
            assert!((mean - sum / weight).abs() < 1e-3, "{signal_dn}: {mean}, not {}", sum / weight);
            assert_eq!(clipped(signal_dn, full_dn, 0.0), f64::min(signal_dn, full_dn));
        }
    }
}
