//! A shape that is one of a few, or hardly known: where another one fits about as well, a number is not better known than which of them it is.

use crate::diagnose::fitting::fit::{Fit, at_shapes, fit_below};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;

/// Effects, and the shape of each with which a strength goes: a share of light is more where it comes from near, and a drift where it settles late.
const SHAPES: [(&str, &str); 4] = [
    ("lens_scatter", "decay_length_of_width"),
    ("phase_drift", TIME_CONSTANT),
    ("illumination_drift", TIME_CONSTANT),
    ("ambient_drift", TIME_CONSTANT),
];
const TIME_CONSTANT: &str = "time_constant_s";
/// What costs so many nats more is not what is there.
const UNLIKELY_NATS: f64 = 8.0;
/// Of a time constant, others are looked at by so many steps to a factor of ten, shorter ones and longer ones so many,
const STEPS: f64 = 5.0;
const SHORTER: i32 = 3;
const LONGER: i32 = 5;
/// where its standard deviation is more than this share of it: what tangents say of one that is known better holds.
const HARDLY: f64 = 0.15;

/// Of the parameters of the piece of this `number` of what is `fitted`, how far those beside other shapes are from them, beyond what their standard deviations say: the root of the mean
/// square, each by its likelihood.
pub fn spread(data: &Data, fitted: &Fit, noise: Noise, number: usize) -> Vec<f64> {
    let piece = &fitted.pieces[number];
    let parameters = piece.effect.parameters;
    let is_open = |place: &usize| SHAPES.contains(&(piece.effect.name, parameters[*place].name));
    let Some(shape) = (0..parameters.len()).find(is_open) else { return vec![0.0; parameters.len()] };
    let others = match parameters[shape].is_choice {
        true => other_choices(data, fitted, noise, (number, shape)),
        false => other_times(data, fitted, noise, (number, shape)),
    };
    // Of times the tangent's own standard deviation is among them.
    let known = |place: usize| {
        let column = fitted.column_of(number, place);
        if parameters[shape].is_choice { 0.0 } else { column.map_or(0.0, |column| fitted.sigma(column)) }
    };
    let of = |place: usize| {
        let values = others.iter().map(|(more, values)| (*more, values[place] - piece.values[place]));
        let beyond = scatter(values).powi(2) - known(place).powi(2);
        if parameters[place].is_choice { 0.0 } else { beyond.max(0.0).sqrt() }
    };
    (0..parameters.len()).map(of).collect()
}

/// What other choices of a piece's shape (numbers of both) cost more, nats, and its values with each.
fn other_choices(
    data: &Data,
    fitted: &Fit,
    noise: Noise,
    (number, choice): (usize, usize),
) -> Vec<(f64, Vec<f64>)> {
    let piece = &fitted.pieces[number];
    let other = |&chosen: &f64| {
        let mut pieces: Vec<Piece> = fitted.pieces.clone();
        pieces[number].values[choice] = chosen;
        let most = fitted.cost() + UNLIKELY_NATS;
        let fit = fit_below(data, fitted, pieces, noise, most);
        // What was given up, or is no number, is none.
        (fit.cost() < most).then(|| (fit.cost() - fitted.cost(), fit.pieces[number].values.clone()))
    };
    let shapes = piece.effect.parameters[choice].shapes.iter();
    shapes.filter(|chosen| **chosen != piece.values[choice]).filter_map(other).collect()
}

/// The same of other time constants, where that is one for all recordings and hardly known: much longer than what was recorded, it says next to nothing.
fn other_times(
    data: &Data,
    fitted: &Fit,
    noise: Noise,
    (number, shape): (usize, usize),
) -> Vec<(f64, Vec<f64>)> {
    let piece = &fitted.pieces[number];
    let fitted_s = piece.values[shape];
    let column = fitted.column_of(number, shape);
    let is_known = column.is_none_or(|column| fitted.sigma(column) <= HARDLY * fitted_s);
    let is_one = fitted.pieces.iter().filter(|other| other.effect.name == piece.effect.name).count() == 1;
    if is_known || !is_one {
        return Vec::new();
    }
    let (low, high) = piece.bounds_within(shape, fitted.pixels.full_scale_dn);
    let other = |step: i32| {
        let time_s = fitted_s * 10_f64.powf(f64::from(step) / STEPS);
        let mut pieces: Vec<Piece> = fitted.pieces.clone();
        pieces[number].values[shape] = time_s;
        let (left, pieces) =
            (low..=high).contains(&time_s).then(|| at_shapes(data, fitted, pieces, noise))?;
        let more = 0.5 * (left - fitted.chi2);
        (more < UNLIKELY_NATS).then(|| (more, pieces[number].values.clone()))
    };
    // What comes after one that is unlikely is more so.
    (1..=LONGER).map_while(other).chain((1..=SHORTER).map_while(|step| other(-step))).collect()
}

/// Root of the mean square of distances from a value, of others that each cost so many nats more.
fn scatter(others: impl Iterator<Item = (f64, f64)>) -> f64 {
    let (mut weights, mut squares) = (1.0, 0.0);
    for (more, distance) in others {
        // One that fits far better is all that there is.
        let weight = (-more).min(UNLIKELY_NATS).exp();
        weights += weight;
        squares += weight * distance * distance;
    }
    (squares / weights).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::fitting::fit::fit;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// Standard deviation of this share of light that is scattered over the whole image, and how far it is open beside that.
    fn open(share: f64) -> [f64; 2] {
        let effect = injection(&format!("lens_scatter:share={share}")).unwrap();
        let size = Geometry { width: 16, height: 12 };
        let data = Data::of(&taken(size, 3, &[effect], &["four-rail"]).unwrap(), Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let piece = Piece::off("lens_scatter", &[0], &[0]);
        let fitted = fit(&data, Some(&unfitted(&data, noise)), vec![piece], noise, &|_| true);
        let spread = spread(&data, &fitted, noise, 0);
        assert_eq!(spread[1], 0.0);
        [fitted.sigma(0), spread[0]]
    }

    /// By how many standard deviations a drift is off of a recording of `four-rail` with this seed: by those of the tangents, and with what is open beside them.
    fn off(seed: u64, name: &str, strength: &str, drift: f64, time_constant_s: f64) -> [f64; 2] {
        let effect = format!("{name}:{strength}={drift},time_constant_s={time_constant_s}");
        let size = Geometry { width: 16, height: 12 };
        let recordings = taken(size, seed, &[injection(&effect).unwrap()], &["four-rail"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let mut piece = Piece::off(name, &[0], &[0]);
        (piece.values[0], piece.values[2]) = (drift, 10.0);
        let fitted = fit(&data, Some(&unfitted(&data, noise)), vec![piece], noise, &|_| true);
        let spread = spread(&data, &fitted, noise, 0)[0];
        let column = fitted.column_of(0, 0).unwrap();
        let (sigma, error) = (fitted.sigma(column), (fitted.pieces[0].values[0] - drift).abs());
        [error / sigma, error / sigma.hypot(spread)]
    }

    /// Of a drift that settles after the recording has ended nobody knows where it goes; of one that settles in it the end is known.
    #[test]
    fn a_drift_that_is_seen_to_begin_may_go_far() {
        const SEEDS: u64 = 12;
        let of = |name: &str, strength: &str, drift: f64, time_constant_s: f64| {
            let all: Vec<_> =
                (1..=SEEDS).map(|seed| off(seed, name, strength, drift, time_constant_s)).collect();
            let greatest = [0, 1].map(|n| all.iter().map(|off| off[n]).fold(0.0, f64::max));
            let square = |n: usize| all.iter().map(|off| off[n] * off[n]).sum::<f64>() / SEEDS as f64;
            (greatest, [0, 1].map(|n| square(n).sqrt()))
        };
        let drifts =
            [("phase_drift", "drift_rad", 0.05, 4.0), ("illumination_drift", "relative", -0.05, 2.0)];
        for (name, strength, drift, by_tangents) in drifts {
            let (greatest, rms) = of(name, strength, drift, 40.0);
            assert!(greatest[0] > by_tangents && greatest[1] < 3.0, "{name} {greatest:?}");
            assert!((0.3..1.6).contains(&rms[1]) && rms[1] < 0.95 * rms[0], "{name} {rms:?}");
            let (greatest, rms) = of(name, strength, 2.0 * drift, 3.0);
            assert!(greatest[1] < 4.0 && rms[0] < 1.05 * rms[1], "{name} {greatest:?} {rms:?}");
        }
    }

    /// Of two values a distance of 3 apart that are as likely, the mean square distance from one of them is a half of 9; from one that is likelier by 2 nats, 9 / (1 + e^2).
    #[test]
    fn each_other_value_counts_by_its_likelihood() {
        let is = |others: &[(f64, f64)], square: f64| {
            (scatter(others.iter().copied()).powi(2) - square).abs() < 1e-9
        };
        assert!(is(&[], 0.0) && is(&[(0.0, 3.0)], 4.5) && is(&[(2.0, 3.0)], 9.0 / (1.0 + 2.0_f64.exp())));
        assert!(is(&[(0.0, 3.0), (0.0, -6.0)], 15.0));
        assert!((scatter([(-1e4, 3.0)].into_iter()) - 3.0).abs() < 1e-3);
    }

    /// Of scattered light that is hardly seen nobody knows from how far it comes, and the share is that much more if it comes from near; of much of it, the image tells.
    #[test]
    fn what_another_choice_says_as_well_is_open() {
        let [sigma, spread] = open(0.002);
        assert!(spread > 0.5 * sigma, "{spread} beside {sigma}");
        let [sigma, spread] = open(0.05);
        assert!(spread < 0.01 * sigma, "{spread} beside {sigma}");
    }
}
