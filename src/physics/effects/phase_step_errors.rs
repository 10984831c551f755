//! Each phase step with an error of its own.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};
use std::f64::consts::TAU;

const fn step(name: &'static str) -> Parameter {
    Parameter::strength(name, "rad", 0.0, (-0.5, 0.5), 0.01)
}

/// Error of setting 0, 1, … of the phase shifter. Its settings are spaced evenly over a turn, and a commanded phase takes the nearest
/// (of two that are equally near, the even one); with none a turn, each frame of a set has a setting of its own, whatever its offset.
///
/// Or the settings are where they should be, but there are only so many: `rounding` is how much of the way from a commanded phase to the nearest of
/// them, or, where it `rounds_down`, to the last one before it, a phase goes that was thought to be exact: 1 as a rule. They need not be a whole
/// number a turn then, and go on over whole turns from a phase of 0, as those of a counter do.
pub static EFFECT: Effect = Effect {
    name: "phase_step_errors",
    sentence: "Settings of the phase shifter are off, or there are only so many (PLL or delay-line quanta): whenever a phase is used again, so is its error.",
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
        Parameter::strength("rounding", "1", 0.0, (-1.5, 1.5), 1.0).looked_for(),
        Parameter {
            bounds: (0.0, MOST_A_TURN),
            ..Parameter::choice("settings_a_turn", "1", &[0.0, SETTINGS, MOST_SETTINGS])
        },
        Parameter::choice("rounds_down", "1", &[0.0, 1.0]),
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
/// So many settings a turn the forward model stands for: a milliradian and a half each.
pub const MOST_A_TURN: f64 = 4096.0;
/// Which of the parameters is the rounding: those before it are errors of single settings.
pub const ROUNDING: usize = MOST_SETTINGS as usize;
/// Which of them is the number of settings a turn.
pub const A_TURN: usize = ROUNDING + 1;
/// Which of them says whether phases go down.
pub const DOWN: usize = A_TURN + 1;
/// Closer than this, in turns, to the middle between two settings is the middle, and to a setting is the setting: files round a phase offset.
const MIDDLE: f64 = 1e-6 / TAU;

/// The setting that a phase takes, in settings, of which it is this one and a part, where there are so many a turn.
fn taken(place: f64, settings: f64, rounds_down: bool) -> f64 {
    let middle = MIDDLE * settings;
    if rounds_down {
        (place + middle).floor()
    } else if (place - place.floor() - 0.5).abs() < middle {
        2.0 * ((place.floor() + 1.0) / 2.0).floor()
    } else {
        place.round()
    }
}

/// By how many turns a commanded phase changes when it becomes one of so many `settings` a turn, which are counted on over whole turns.
pub fn rounded_by(turns: f64, settings: f64, rounds_down: bool) -> f64 {
    let place = turns * settings;
    (taken(place, settings, rounds_down) - place) / settings
}

fn setting(angle_rad: f64, settings: f64, rounds_down: bool) -> usize {
    (taken((angle_rad / TAU).rem_euclid(1.0) * settings, settings, rounds_down) % settings) as usize
}

fn act(values: &[f64], exposure: &mut Exposure) {
    let (settings, rounds_down) = (values[A_TURN], values[DOWN] > 0.5);
    let moment = exposure.moment;
    let angle_rad = moment.offset_rad + moment.step_rad;
    let is_of_shifter = settings >= 1.0;
    let number = if is_of_shifter { setting(angle_rad, settings, rounds_down) } else { moment.frame };
    exposure.angle_rad += values[..ROUNDING].get(number).copied().unwrap_or(0.0);
    if is_of_shifter && values[ROUNDING] != 0.0 {
        exposure.angle_rad += values[ROUNDING] * TAU * rounded_by(angle_rad / TAU, settings, rounds_down);
    }
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
            assert_eq!(setting(f64::to_radians(degrees), SETTINGS, false), expected, "{degrees}");
        }
    }

    /// 240 settings a turn are 1.5 degrees each: what is left of a phase is at most half of that, or, where it goes down, all of it.
    #[test]
    fn a_phase_that_is_rounded_goes_to_a_setting() {
        for (degrees, nearest, down) in
            [(0.0, 0.0, 0.0), (90.0, 0.0, 0.0), (1.0, 0.5, -1.0), (7.6, -0.1, -0.1), (-0.5, 0.5, -1.0)]
        {
            for (rounds_down, expected) in [(false, nearest), (true, down)] {
                let by = 360.0 * rounded_by(degrees / 360.0, 240.0, rounds_down);
                assert!((by - expected).abs() < 1e-9, "{degrees}: {by}");
            }
        }
        // Of 12 settings the 30 degrees of a file that rounds are no less than that: it stays where it is.
        let turns = 30.0_f64.to_radians() / TAU - 0.9e-7;
        assert!((rounded_by(turns, 12.0, true) - 0.9e-7).abs() < 1e-12);
    }
}
