//! The encoder errs periodically.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place, cos_sin};
use std::f64::consts::TAU;

/// Parts of the error, and its period. The carriage moves as it is commanded (0), or, controlled by this very encoder, as its readings say, faster and slower
/// in time with its error (1), or in each set as fast as its error has it where the set begins (-1).
pub static EFFECT: Effect = Effect {
    name: "encoder_cyclic",
    sentence: "The encoder's error is periodic in position (lead screw, interpolation).",
    reference: "d = reading + a cos(2 pi reading / p) + b sin(2 pi reading / p)",
    parameters: &[
        Parameter::strength("cosine_m", "m", 0.0, (-0.05, 0.05), 1e-3),
        Parameter::strength("sine_m", "m", 0.0, (-0.05, 0.05), 1e-3),
        Parameter::shape("period_m", "m", 0.1, (0.004, 1.5), &[0.02, 0.05, 0.1, 0.25, 0.5, 1.0]),
        Parameter::choice("controls_carriage", "1", &[0.0, -1.0, 1.0]),
    ],
    place: Place::Encoder,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Exact,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let turn_per_m = TAU / values[2];
    let at = |reading_m: f64| {
        let (cosine, sine) = cos_sin(turn_per_m * reading_m);
        (values[0] * cosine + values[1] * sine, turn_per_m * (values[1] * cosine - values[0] * sine))
    };
    let reading_m = exposure.moment.place_m;
    let (error_m, slope) = at(reading_m);
    exposure.position_m += error_m;
    if values[3] < -0.5 {
        exposure.velocity_m_s *= 1.0 + slope;
    } else if values[3] > 0.5 {
        // Of the way since the set's start the mean velocity is what counts: errors may come and go within a set.
        let way_m = exposure.way_m();
        let faster = if way_m == 0.0 { slope } else { (at(reading_m + way_m).0 - error_m) / way_m };
        exposure.velocity_m_s *= 1.0 + faster;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{practice_camera, sensor};
    use crate::frames::Geometry;
    use crate::physics::{Correlation, Included, Moment, Stage};
    use std::sync::Arc;

    /// At 2 m/s five frames see half of a wave of half a metre: each sees the target where the reading of that time and its error say.
    #[test]
    fn an_encoder_that_controls_the_carriage_errs_within_a_set() {
        let camera = sensor(&practice_camera(Geometry { width: 4, height: 3 }));
        let pixels = Arc::new(Stage::bench().pixels(&camera, 5));
        let included = Included { axial_motion: true, inverse_square_falloff: true };
        let (cosine_m, sine_m, period_m) = (0.004, -0.003, 0.5);
        for frame in 0..5 {
            let in_set_s = f64::from(frame) * 0.033;
            let moment = Moment {
                set: 0,
                frame: frame as usize,
                frames: 5,
                time_s: in_set_s,
                in_set_s,
                frame_period_s: 0.033,
                step_rad: 0.0,
                offset_rad: 0.0,
                position_m: 1.3,
                place_m: 1.3,
                velocity_m_s: 2.0,
                frequency_hz: 30e6,
                lit: true,
                transmission: 1.0,
            };
            let mut exposure = Exposure::new(moment, &pixels, included, &Correlation::sinusoidal());
            EFFECT.act_on(&[cosine_m, sine_m, period_m, 1.0], &mut exposure);
            let reading_m = 1.3 + 2.0 * in_set_s;
            let turns = TAU * reading_m / period_m;
            let expected_m = reading_m + cosine_m * turns.cos() + sine_m * turns.sin();
            let found_m = exposure.position_m + exposure.way_m();
            assert!((found_m - expected_m).abs() < 1e-12, "frame {frame}: {found_m}, not {expected_m}");
        }
    }
}
