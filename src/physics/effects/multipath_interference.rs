//! Light that comes back by a longer way too.

use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Pixels, Place};
use crate::units;
use crate::widest::widest;
use std::ops::Range;

/// A second return by way of a wall that stands beside the path of the light, at the same distance all along: out directly, back by the
/// wall's mirror image, √(d² + 4 L²) for a target at d. Its amplitude relative to the direct one is the parameter, were the wall close,
/// and less by the longer way (0), by its square, out and back (-2), or at any distance the same share of the direct light (-1). Or, whatever the
/// target's distance, a way longer by as much as the wall is away, out and back together twice that, of light that falls off with it (1), or with the distance
/// and not with its square (0.5): an empirical law between that and a room's even light; its strength is the share of the direct light at one metre.
/// A wall beside the path is as far from what all pixels see (0), or stands beyond the last columns (1), the first ones (-1), the last rows (0.5) or the
/// first ones (-0.5), and its mirror image is the nearer the more a pixel looks that way by its angle a: √(d² + 4 L² - 4 L d sin a).
/// What comes by it need not be the same share everywhere: at the right edge of the image it may be more than at the left one, and below more than above, by these differences, evenly.
pub static EFFECT: Effect = Effect {
    name: "multipath_interference",
    sentence: "Part of the light reaches the pixel by a longer way (a wall, another surface), and its phasor adds to the direct one.",
    reference: "Dorrington et al. 2011; D_n = sum_i A_i cos(theta_n - phi_i)",
    parameters: &[
        Parameter::strength("relative_amplitude", "1", 0.0, (0.0, 0.8), 0.1),
        Parameter::strength("more_on_the_right", "1", 0.0, (-0.8, 0.8), 0.1).looked_for(),
        Parameter::strength("more_below", "1", 0.0, (-0.8, 0.8), 0.1).looked_for(),
        Parameter::shape("wall_distance_m", "m", 0.6, (0.02, 6.0), &[0.15, 0.4, 0.8, 1.5]),
        Parameter::choice("is_longer_by_a_constant", "1", &[0.0, -1.0, -2.0, 0.5, 1.0]),
        Parameter::choice("wall_beside", "1", &[0.0, -1.0, -0.5, 0.5, 1.0]),
    ],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Approximate,
    act: Act::Code(act),
};

/// The numbers of its strength: in the image's middle, and how it differs over the image.
pub const SHARE: usize = 0;
/// See [`SHARE`].
pub const SLOPES: Range<usize> = 1..3;
/// Which of its numbers is the wall's distance.
pub const WALL: usize = 3;
const LONGER: usize = 4;
const SIDE: usize = 5;

fn act(values: &[f64], exposure: &mut Exposure) {
    if values[..SLOPES.end].iter().all(|share| *share == 0.0) {
        return;
    }
    let wall_m = values[WALL];
    let (is_constant, falls) = (values[LONGER] > 0.25, Falls::of(values[LONGER]));
    let shares = shares(&values[..SLOPES.end], &exposure.pixels);
    let nearer_m: Vec<f64> = match towards(&exposure.pixels, values[SIDE]) {
        Some(sines) => exposure.range_m.iter().zip(sines).map(|(range_m, sine)| range_m * sine).collect(),
        None => vec![0.0; exposure.range_m.len()],
    };
    let count = exposure.range_m.len();
    let (mut amplitudes_dn, mut phases_rad) = (vec![0.0; count], vec![0.0; count]);
    {
        let (frequency_hz, target) = (exposure.frequency_hz, &exposure.pixels.target[..]);
        let direct = Direct {
            range_m: &exposure.range_m,
            phase_rad: &exposure.phase_rad,
            amplitude_dn: &exposure.amplitude_dn,
            constant_dn: &exposure.constant_dn,
            nearer_m: &nearer_m,
            shares: &shares,
        };
        let signals_dn: &mut [f64] = &mut exposure.signal_dn;
        let (amplitudes_dn, phases_rad) = (&mut amplitudes_dn[..], &mut phases_rad[..]);
        widest!((direct: Direct<'a>, target: &'a [bool], wall_m: f64,
                 is_constant: bool, falls: Falls, frequency_hz: f64,
                 signals_dn: &'a mut [f64], amplitudes_dn: &'a mut [f64], phases_rad: &'a mut [f64]) {
            let light = direct.amplitude_dn.iter().zip(direct.constant_dn);
            let ways = direct.range_m.iter().zip(direct.nearer_m).zip(direct.phase_rad).zip(target).zip(light).zip(direct.shares);
            let back = signals_dn.iter_mut().zip(amplitudes_dn).zip(phases_rad);
            for (way, ((signal, of_path), phase_of_path)) in ways.zip(back) {
                let (((((range_m, nearer_m), phase_rad), is_target), (amplitude, constant)), share) = way;
                let back_m = match is_constant {
                    true => range_m + 2.0 * wall_m,
                    false => (range_m * range_m + 4.0 * wall_m * (wall_m - nearer_m)).sqrt(),
                };
                let part = share * fallen(*range_m, back_m, falls);
                // Light that comes by the wall goes to the target.
                let part = if *is_target { part } else { 0.0 };
                *of_path = part * amplitude;
                *phase_of_path = phase_rad + units::phase_rad((back_m - range_m) / 2.0, frequency_hz);
                *signal += part * constant;
            }
        });
    }
    exposure.add_path(&amplitudes_dn, &phases_rad.into());
}

/// Of every pixel, what comes by the second way relative to the direct light, were the wall close.
fn shares(values: &[f64], pixels: &Pixels) -> Vec<f64> {
    let [middle, right, below] = [values[SHARE], values[SLOPES.start], values[SLOPES.start + 1]];
    if right == 0.0 && below == 0.0 {
        return vec![middle; pixels.count()];
    }
    let of = |pixel: usize| {
        let (column, row) = pixels.place(pixel);
        middle + right * column + below * row
    };
    (0..pixels.count()).map(of).collect()
}

/// How light by the second way falls.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Falls {
    WithTheWay,
    WithTheSquare,
    AsTheDirect,
    WithTheDistance,
}

impl Falls {
    /// By the number of the choice.
    fn of(chosen: f64) -> Self {
        match chosen {
            chosen if !(-1.5..=0.75).contains(&chosen) => Self::WithTheSquare,
            chosen if chosen > 0.25 => Self::WithTheDistance,
            chosen if chosen < -0.5 => Self::AsTheDirect,
            _ => Self::WithTheWay,
        }
    }
}

/// What light that comes back by `back_m` is of the direct light of a target at `range_m`, over its strength.
#[inline(always)]
fn fallen(range_m: f64, back_m: f64, falls: Falls) -> f64 {
    match falls {
        Falls::WithTheWay => range_m / back_m,
        Falls::WithTheSquare => {
            let nearer = 2.0 * range_m / (range_m + back_m);
            nearer * nearer
        }
        Falls::AsTheDirect => 1.0,
        Falls::WithTheDistance => range_m,
    }
}

/// Of every pixel, the sine of the angle by which it looks towards a wall that stands `beside`; nothing where no side is nearer.
fn towards(pixels: &Pixels, beside: f64) -> Option<Vec<f64>> {
    let side = beside.signum();
    (beside != 0.0).then(|| pixels.along(if beside.abs() < 0.75 { [0.0, side] } else { [side, 0.0] }))
}

/// The light that comes directly, a value a pixel each.
struct Direct<'a> {
    /// By how much what the pixel sees is nearer to the wall than what is straight ahead.
    nearer_m: &'a [f64],
    /// What comes by the second way relative to it, were the wall close.
    shares: &'a [f64],
    range_m: &'a [f64],
    phase_rad: &'a [f64],
    amplitude_dn: &'a [f64],
    constant_dn: &'a [f64],
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frames::Geometry;
    use crate::physics::pixels::plain;

    /// By hand, of a way of 2 m back where the direct one is 1 m, and of one of 4 m where that is 3 m.
    #[test]
    fn light_falls_by_its_law() {
        let of =
            |falls: Falls| [(1.0, 2.0), (3.0, 4.0)].map(|(range_m, back_m)| fallen(range_m, back_m, falls));
        assert_eq!(of(Falls::WithTheWay), [0.5, 0.75]);
        assert_eq!(of(Falls::AsTheDirect), [1.0, 1.0]);
        assert_eq!(of(Falls::WithTheDistance), [1.0, 3.0]);
        let [near, far] = of(Falls::WithTheSquare);
        assert!((near - 4.0 / 9.0).abs() < 1e-12 && (far - 36.0 / 49.0).abs() < 1e-12);
        let choices = [0.0, -1.0, -2.0, 0.5, 1.0].map(Falls::of);
        assert_eq!(
            choices,
            [
                Falls::WithTheWay,
                Falls::AsTheDirect,
                Falls::WithTheSquare,
                Falls::WithTheDistance,
                Falls::WithTheSquare
            ]
        );
    }

    /// Of three columns and two rows, by hand: a difference from edge to edge of 0.3 is 0.1 from one of three columns to the next, one of 0.2 is 0.1 from one of two rows to the next.
    #[test]
    fn a_share_may_differ_over_the_image() {
        let pixels = plain(Geometry { width: 3, height: 2 });
        let of = |values: &[f64]| shares(values, &pixels);
        let expected = [0.05, 0.15, 0.25, 0.15, 0.25, 0.35];
        assert!(
            of(&[0.2, 0.3, 0.2]).iter().zip(expected).all(|(share, by_hand)| (share - by_hand).abs() < 1e-12)
        );
        assert_eq!(of(&[0.2, 0.0, 0.0]), [0.2; 6]);
    }

    /// Of three pixels, by hand: what is seen at 2 m under 30 degrees to either side is 1 m nearer to the wall, or further from it.
    #[test]
    fn a_pixel_looks_towards_the_wall_or_away_from_it() {
        let pixels = Pixels {
            obliquity: vec![2.0 / 3.0_f64.sqrt(), 1.0, 2.0 / 3.0_f64.sqrt()],
            ..plain(Geometry { width: 3, height: 1 })
        };
        let near = |beside: f64, expected: [f64; 3]| {
            let sines = towards(&pixels, beside).unwrap();
            assert!(sines.iter().zip(expected).all(|(sine, expected)| (sine - expected).abs() < 1e-12));
        };
        near(1.0, [-0.5, 0.0, 0.5]);
        near(-1.0, [0.5, 0.0, -0.5]);
        near(0.5, [0.0; 3]);
        near(-0.5, [0.0; 3]);
        assert!(towards(&pixels, 0.0).is_none());
    }
}
