//! The light of another camera.

use crate::physics::{
    Act, Chance, Effect, Exposure, Fidelity, Parameter, Pixels, Place, cos_sin, root_mean_square,
};
use std::f64::consts::TAU;
use std::ops::Range;

/// Number of the cosine among the parameters, where the gate takes the phase steps; its sine comes after it.
const OF_GATE: usize = 0;
/// The same where the light takes them.
const OF_LIGHT: usize = 2;
/// Numbers of the parameters that say on which part of the image the light falls.
pub const SPOT: Range<usize> = 4..8;
/// Number of the beat among the parameters.
pub const BEAT: usize = SPOT.end;
/// Number of what it goes with.
pub const GOES_WITH: usize = BEAT + 1;

const fn dn(name: &'static str) -> Parameter {
    Parameter::strength(name, "DN", 0.0, (-300.0, 300.0), 2.0)
}

const fn rise(name: &'static str) -> Parameter {
    Parameter::strength(name, "1", 0.0, (-20.0, 20.0), 1.0).looked_for()
}

const fn fall(name: &'static str) -> Parameter {
    Parameter::strength(name, "1", 0.0, (-10.0, 40.0), 1.0).looked_for()
}

/// Another camera's modulated light beats with this one's demodulation: a phasor that turns with the difference of both frequencies, as frames see it, and from a phase step
/// to the next where the gate takes these; where this camera's light takes them (`without_steps`), it does not. It is the same in all pixels (0), or goes with their ambient light,
/// as what a surface of the scene throws back does (1), or with this camera's own light, with the square of the distance, too (-1), or without (-0.5); and is so large in the root of the mean square
/// (at 1 m). On a part of the image it may be more: as exp(a u + b v - c u^2 - d v^2), over the most of that, of columns and rows from the image's middle as shares of its width and height, a spot where c and d
/// are above 0. What is left after the exposure counts, and it begins anew with every recording.
pub static EFFECT: Effect = Effect {
    name: "multi_camera_interference",
    sentence: "Another camera's modulated light beats with this one's demodulation (multi-camera interference).",
    reference: "D_n += A(u, v) cos(theta_n - 2 pi df t_n + x), or without theta_n where the light is stepped",
    parameters: &[
        dn("cosine_dn"),
        dn("sine_dn"),
        dn("without_steps_cosine_dn").instead(),
        dn("without_steps_sine_dn").instead(),
        rise("rise_along_columns"),
        rise("rise_along_rows"),
        fall("fall_squared_along_columns"),
        fall("fall_squared_along_rows"),
        Parameter::shape("beat_hz", "Hz", 1.0, (-1e4, 1e4), &[1.0]),
        Parameter::choice("goes_with_ambient", "1", &[0.0, OWN_LIGHT, SURFACE, 1.0]),
    ],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

/// The choice of what goes with the camera's own light, and of what goes with that as it would be at 1 m.
const OWN_LIGHT: f64 = -1.0;
const SURFACE: f64 = -0.5;

fn act(values: &[f64], exposure: &mut Exposure) {
    let turned_rad = TAU * values[BEAT] * exposure.taken_s();
    let of = |first: usize, angle_rad: f64| {
        let (cosine, sine) = cos_sin(angle_rad % TAU);
        values[first] * cosine + values[first + 1] * sine
    };
    let dn = of(OF_GATE, exposure.angle_rad - turned_rad) + of(OF_LIGHT, -turned_rad);
    let more_dn = exposure.moment.transmission * dn;
    let pixels = &exposure.pixels;
    let own_dn = &pixels.amplitude_1m_dn;
    let shape: Vec<f64> = match values[GOES_WITH] {
        0.0 => vec![1.0; pixels.count()],
        OWN_LIGHT => {
            let ranges_m = exposure.range_m.iter();
            own_dn.iter().zip(ranges_m).map(|(dn, range_m)| dn / (range_m * range_m)).collect()
        }
        SURFACE => own_dn.clone(),
        _ => pixels.ambient_dn.to_vec(),
    };
    let usual = match values[GOES_WITH] {
        0.0 => 1.0,
        OWN_LIGHT => root_mean_square(own_dn),
        _ => root_mean_square(&shape),
    };
    // Where there is no light, or it is no number, nothing goes with it.
    if usual.is_nan() || usual <= 0.0 {
        return;
    }
    let per = more_dn / usual;
    match spot(&values[SPOT], pixels) {
        Some(falls) => {
            for ((signal, shape), falls) in exposure.signal_dn.iter_mut().zip(shape).zip(falls) {
                *signal += per * shape * falls;
            }
        }
        None => exposure.signal_dn.iter_mut().zip(shape).for_each(|(signal, shape)| *signal += per * shape),
    }
}

/// How much falls on each pixel by how it rises and falls from the image's middle, 1 where that is most; nothing where it is the same in all.
pub fn spot(values: &[f64], pixels: &Pixels) -> Option<Vec<f64>> {
    if values.iter().all(|value| *value == 0.0) {
        return None;
    }
    let rises = |pixel: usize| {
        let (column, row) = pixels.place(pixel);
        values[0] * column + values[1] * row - values[2] * column * column - values[3] * row * row
    };
    let all: Vec<f64> = (0..pixels.count()).map(rises).collect();
    let most = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Some(all.into_iter().map(|rises| (rises - most).exp()).collect())
}
