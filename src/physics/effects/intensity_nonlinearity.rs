//! The pixel's response is not linear in the light.

use crate::physics::powers::power;
use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};
use crate::widest::widest;

/// Quadratic and cubic part, relative to the linear one at full scale; and by how much the exponent of a response that is a power of the
/// light differs from 1 (the gamma of cameras and projectors: 2.2 is 1.2).
pub static EFFECT: Effect = Effect {
    name: "intensity_nonlinearity",
    sentence: "The pixel's response is not linear in the light, so harmonics appear that grow with the amplitude.",
    reference: "I -> I + alpha I^2 + beta I^3, up to where that turns back; I -> I0 (I / I0)^(1 + gamma), I0 a quarter of full scale",
    parameters: &[
        Parameter::strength("quadratic", "1", 0.0, (-0.6, 0.6), 0.02),
        Parameter::strength("cubic", "1", 0.0, (-0.6, 0.6), 0.02),
        Parameter::strength("exponent", "1", 0.0, (-0.6, 4.0), 0.02).instead(),
    ],
    place: Place::Readout,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

/// Signal that a power leaves as it is, over full scale: a usual one, so that a pixel's own light hardly depends on the exponent.
const UNMOVED: f64 = 0.25;

fn act(values: &[f64], exposure: &mut Exposure) {
    let full_scale_dn = exposure.pixels.full_scale_dn;
    let (quadratic, cubic, exponent) = (values[0], values[1], values[2]);
    let signals: &mut [f64] = &mut exposure.signal_dn;
    if exponent != 0.0 {
        let (signals, unmoved_dn) = (&mut *signals, UNMOVED * full_scale_dn);
        widest!((signals: &'a mut [f64], unmoved_dn: f64, exponent: f64) {
            for signal in signals {
                // No light is no light by any power.
                let level = if *signal > 0.0 { *signal / unmoved_dn } else { 1.0 };
                *signal *= power(level, exponent);
            }
        });
    }
    bend(signals, full_scale_dn, quadratic, cubic);
}

/// The polynomial, up to where it turns back.
fn bend(signals: &mut [f64], full_scale_dn: f64, quadratic: f64, cubic: f64) {
    let most = full_scale_dn * turning(quadratic, cubic);
    widest!((signals: &'a mut [f64], full_scale_dn: f64, quadratic: f64, cubic: f64, most: f64) {
        for signal in signals {
            let linear = if *signal > most { most } else { *signal };
            let share = linear / full_scale_dn;
            *signal = linear + linear * share * (quadratic + cubic * share);
        }
    });
}

/// Where the curve turns back, over full scale: no pixel shows less of more light, so it stays there.
fn turning(quadratic: f64, cubic: f64) -> f64 {
    // 1 + 2 a s + 3 b s^2 = 0, of which the first place beyond darkness counts.
    let square = quadratic.powi(2) - 3.0 * cubic;
    let place = (square.max(0.0).sqrt() - quadratic).recip();
    if square > 0.0 && place > 0.0 { place } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 - 1.2 s - 1.8 s^2 is nothing at s = 0.483: the polynomial up to there, and never less of more light.
    #[test]
    fn a_response_stays_at_its_top() {
        let light = |step: usize| step as f64 / 100.0;
        let mut shown: Vec<f64> = (0..=500).map(light).collect();
        bend(&mut shown, 1.0, -0.6, -0.6);
        assert!(shown.windows(2).all(|pair| pair[0] <= pair[1]));
        let curve = |share: f64| share - 0.6 * share.powi(2) - 0.6 * share.powi(3);
        assert!((0..=48).all(|step| (shown[step] - curve(light(step))).abs() < 1e-12));
        assert!((49..=500).all(|step| (shown[step] - curve(0.483_163_248)).abs() < 1e-9));
        assert!(curve(5.0) < -80.0);
    }

    /// By hand: 1 - 0.6 s is nothing at 5/3, 1 - 0.3 s^2 at 1.826, 1 - 2 s + 0.75 s^2 at 2/3 and 2.
    #[test]
    fn a_response_turns_back_where_its_slope_is_nothing() {
        let is = |quadratic: f64, cubic: f64, place: f64| (turning(quadratic, cubic) - place).abs() < 1e-3;
        assert!(is(-0.3, 0.0, 5.0 / 3.0) && is(0.0, -0.1, 1.826) && is(-1.0, 0.25, 2.0 / 3.0));
        // At 1 - 2 s + s^2 it stands, and goes on.
        for never in [[0.0, 0.0], [0.3, 0.0], [0.0, 0.1], [-0.1, 0.2], [0.5, 0.05], [-1.0, 1.0 / 3.0]] {
            assert_eq!(turning(never[0], never[1]), f64::INFINITY, "{never:?}");
        }
    }
}
