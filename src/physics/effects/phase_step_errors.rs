//! Each phase step with an error of its own.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};
use std::f64::consts::TAU;

const fn step(name: &'static str) -> Parameter {
    Parameter::strength(name, "rad", 0.0, (-0.5, 0.5), 0.01)
}

/// Error of setting 0, 1, … of the phase shifter. Its settings are spaced evenly over a turn, and a commanded phase takes the nearest
/// (of two that are equally near, the even one); with none a turn, each frame of a set has a setting of its own, whatever its offset.
pub static EFFECT: Effect = Effect {
    name: "phase_step_errors",
    sentence: "Single settings of the phase shifter are off (PLL or delay-line quanta): whenever a phase step is used again, so is its error.",
    reference: "theta_n -> theta_n + eps_n",
    parameters: &[
        step("setting_0_rad"),
        step("setting_1_rad"),
        step("setting_2_rad"),
        step("setting_3_rad"),
        step("setting_4_rad"),
        step("setting_5_rad"),
        step("setting_6_rad"),
        step("setting_7_rad"),
        step("setting_8_rad"),
        step("setting_9_rad"),
        step("setting_10_rad"),
        step("setting_11_rad"),
        step("setting_12_rad"),
        step("setting_13_rad"),
        step("setting_14_rad"),
        step("setting_15_rad"),
        step("setting_16_rad"),
        step("setting_17_rad"),
        step("setting_18_rad"),
        step("setting_19_rad"),
        step("setting_20_rad"),
        step("setting_21_rad"),
        step("setting_22_rad"),
        step("setting_23_rad"),
        step("setting_24_rad"),
        step("setting_25_rad"),
        step("setting_26_rad"),
        step("setting_27_rad"),
        step("setting_28_rad"),
        step("setting_29_rad"),
        step("setting_30_rad"),
        step("setting_31_rad"),
        step("setting_32_rad"),
        step("setting_33_rad"),
        step("setting_34_rad"),
        step("setting_35_rad"),
        step("setting_36_rad"),
        step("setting_37_rad"),
        step("setting_38_rad"),
        step("setting_39_rad"),
        step("setting_40_rad"),
        step("setting_41_rad"),
        step("setting_42_rad"),
        step("setting_43_rad"),
        step("setting_44_rad"),
        step("setting_45_rad"),
        step("setting_46_rad"),
        step("setting_47_rad"),
        step("setting_48_rad"),
        step("setting_49_rad"),
        step("setting_50_rad"),
        step("setting_51_rad"),
        step("setting_52_rad"),
        step("setting_53_rad"),
        step("setting_54_rad"),
        step("setting_55_rad"),
        step("setting_56_rad"),
        step("setting_57_rad"),
        step("setting_58_rad"),
        step("setting_59_rad"),
        step("setting_60_rad"),
        step("setting_61_rad"),
        step("setting_62_rad"),
        step("setting_63_rad"),
        Parameter::choice("settings_a_turn", "1", &[0.0, SETTINGS, MOST_SETTINGS]),
    ],
    place: Place::Clock,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

/// Steps of 30 degrees, or six bits of a delay line.
const SETTINGS: f64 = 12.0;
const MOST_SETTINGS: f64 = 64.0;
/// Closer than this (in settings) to the middle between two settings is the middle: files round a phase offset.
const MIDDLE: f64 = 1e-6;

fn setting(angle_rad: f64, settings: f64) -> usize {
    let place = (angle_rad / TAU).rem_euclid(1.0) * settings;
    let nearest = if (place.fract() - 0.5).abs() < MIDDLE {
        2.0 * ((place.floor() + 1.0) / 2.0).floor()
    } else {
        place.round()
    };
    (nearest % settings) as usize
}

fn act(values: &[f64], exposure: &mut Exposure) {
    let settings = values[values.len() - 1].round();
    let moment = exposure.moment;
    let number =
        if settings >= 1.0 { setting(moment.offset_rad + moment.step_rad, settings) } else { moment.frame };
    exposure.angle_rad += values[..values.len() - 1].get(number).copied().unwrap_or(0.0);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_commanded_phase_takes_the_nearest_setting_and_the_even_one_of_two() {
        let cases = [
            (0.0, 0),
            (14.0, 0),
            (15.0, 0),
            (16.0, 1),
            (45.0, 2),
            (75.0, 2),
            (345.0, 0),
            (-30.0, 11),
            (725.0, 0),
        ];
        for (degrees, expected) in cases {
            assert_eq!(setting(f64::to_radians(degrees), SETTINGS), expected, "{degrees}");
        }
    }
}
