//! What the pixels answer fades while they are recorded, in some regions faster than in others.

use crate::physics::powers::exp;
use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};
use crate::widest::widest;

const fn rate(name: &'static str) -> Parameter {
    Parameter::strength(name, "1/s", 0.0, (-0.5, 0.5), 0.01)
}

/// Relative loss a second at three by three places of the image, and between them by their distance (bilinear).
pub static EFFECT: Effect = Effect {
    name: "response_decay",
    sentence: "What comes back of the camera's light fades during the recording, in some regions of the image faster than in others \
               (photobleaching, emitters that warm unevenly).",
    reference: "A(t) = A exp(-k(x, y) t), B likewise",
    parameters: &[
        rate("top_left_per_s"),
        rate("top_per_s"),
        rate("top_right_per_s"),
        rate("left_per_s"),
        rate("middle_per_s"),
        rate("right_per_s"),
        rate("bottom_left_per_s"),
        rate("bottom_per_s"),
        rate("bottom_right_per_s"),
    ],
    place: Place::Light,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

/// Places a side.
const PLACES: usize = 3;

/// The place before `share` (-0.5 to 0.5), and how far it is on to the next.
fn between(share: f64) -> (usize, f64) {
    let along = ((share + 0.5) * PLACES as f64 - 0.5).clamp(0.0, (PLACES - 1) as f64);
    let before = (along as usize).min(PLACES - 2);
    (before, along - before as f64)
}

fn act(values: &[f64], exposure: &mut Exposure) {
    let Exposure { pixels, amplitude_dn, constant_dn, moment, .. } = exposure;
    let (width, time_s) = (pixels.geometry.width, moment.time_s);
    // Along each row of places, at every column.
    let of_row = |rates: &[f64]| -> Vec<f64> {
        let rate_per_s = |pixel: usize| {
            let (column, right) = between(pixels.place(pixel).0);
            rates[column] + right * (rates[column + 1] - rates[column])
        };
        (0..width).map(rate_per_s).collect()
    };
    let along: Vec<Vec<f64>> = values.chunks_exact(PLACES).map(of_row).collect();
    let rows = amplitude_dn.chunks_exact_mut(width).zip(constant_dn.chunks_exact_mut(width));
    for (number, (amplitudes, constants)) in rows.enumerate() {
        let (row, down) = between(pixels.place(number * width).1);
        let (above, below) = (&along[row][..], &along[row + 1][..]);
        widest!((amplitudes: &'a mut [f64], constants: &'a mut [f64], above: &'a [f64], below: &'a [f64], down: f64, time_s: f64) {
            let rates = above.iter().zip(below);
            for ((amplitude, constant), (above, below)) in amplitudes.iter_mut().zip(constants).zip(rates) {
                let rate_per_s = above + down * (below - above);
                let left = exp(-rate_per_s * time_s);
                *amplitude *= left;
                *constant *= left;
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_the_middles_of_thirds() {
        for (share, expected) in [
            (-0.5, (0, 0.0)),
            (-1.0 / 3.0, (0, 0.0)),
            (0.0, (1, 0.0)),
            (1.0 / 3.0, (1, 1.0)),
            (0.5, (1, 1.0)),
        ] {
            let (before, on) = between(share);
            assert!((before as f64 + on - (expected.0 as f64 + expected.1)).abs() < 1e-12, "{share}");
        }
    }
}
