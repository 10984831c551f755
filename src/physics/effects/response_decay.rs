//! What the pixels answer fades while they are recorded, in some regions faster than in others.

use crate::physics::{Act, Chance, Effect, Exposure, Parameter, Place};

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
    let time_s = exposure.moment.time_s;
    for pixel in 0..exposure.pixels.count() {
        let (x, y) = exposure.pixels.place(pixel);
        let ((column, right), (row, down)) = (between(x), between(y));
        let rate = |row: usize, column: usize| values[PLACES * row + column];
        let along = |row: usize| rate(row, column) + right * (rate(row, column + 1) - rate(row, column));
        let rate_per_s = along(row) + down * (along(row + 1) - along(row));
        let left = libm::exp(-rate_per_s * time_s);
        exposure.amplitude_dn[pixel] *= left;
        exposure.constant_dn[pixel] *= left;
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
