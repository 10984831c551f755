//! An effect that was named in its usual form, in those that are seldom: tried where it is named only, as candidates they would cost more than they find.

use super::bits::with_bits;
use super::lamp_overtones::with_overtone;
use super::other_camera::{OTHER_CAMERA, with_spot};
use super::overtones::{OF_CODES, is_longer};
use super::roundings::OF_SHIFTER;
use super::soft_wells::{OF_WELLS, with_knee};
use super::uneven_walls::{OF_WALLS, with_slopes};
use super::whole_rounding::with_whole_rounding;
use crate::diagnose::fitting::finished::finished;
use crate::diagnose::fitting::fit::{End, Fit, WHOLE, fit_led};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::naming::completed::NEEDED_NATS;
use crate::diagnose::naming::contest::{Entrant, hopeful};
use crate::diagnose::periodic::lamps::FLICKER;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::effects::adc_nonlinearity::FORM;
use rayon::prelude::*;

/// Effects, and of one of their choices what is seldom.
const SELDOM: [(&str, &str, &[f64]); 3] = [
    (OF_CODES, "form", &[1.0, 0.5, -0.5, -1.0]),
    (OF_WALLS, LONGER, &[-2.0, 0.5]),
    (OF_WALLS, SIDE, &[1.0, 0.5, -0.5, -1.0]),
];
const LONGER: &str = "is_longer_by_a_constant";
const SIDE: &str = "wall_beside";
/// A form over the codes repeats among the signals so often at least.
const REPEATS: f64 = 2.0;
/// Among the ways of an effect, the number of that in which it is.
pub const UNCHANGED: usize = 0;

/// Whether `chosen` is what is seldom of the `choice` of the effect `name`, in which it is not looked for from the start.
pub fn is_seldom(name: &str, choice: &str, chosen: f64) -> bool {
    SELDOM.iter().any(|(effect, of, choices)| (*effect, *of) == (name, choice) && choices.contains(&chosen))
}

/// The `piece` with what is `chosen` of its `choice`; nothing where what it has is seldom already: that was the best of all.
fn with_choice(piece: &Piece, choice: &str, chosen: f64) -> Option<Piece> {
    let number = piece.effect.parameters.iter().position(|parameter| parameter.name == choice)?;
    let mut other = piece.clone();
    other.values[number] = chosen;
    // A way that is longer by a constant has no side.
    if (choice, chosen > 0.0) == (LONGER, true) {
        let side = piece.effect.parameters.iter().position(|parameter| parameter.name == SIDE)?;
        other.values[side] = 0.0;
    }
    (!is_seldom(piece.effect.name, choice, piece.values[number])).then_some(other)
}

/// What is `fitted` [as it is](UNCHANGED), and with each of what is seldom of the effect `name`.
fn ways(fitted: &Fit, name: &'static str) -> Vec<Entrant> {
    let is_of = |piece: &Piece| piece.effect.name == name;
    let other = |choice: &str, chosen: f64| -> Option<Vec<Piece>> {
        let anew = |piece: &Piece| {
            if is_of(piece) { with_choice(piece, choice, chosen) } else { Some(piece.clone()) }
        };
        fitted.pieces.iter().any(is_of).then(|| fitted.pieces.iter().map(anew).collect()).flatten()
    };
    let of_effect = SELDOM.iter().filter(|(effect, ..)| *effect == name);
    let others = of_effect
        .flat_map(|&(_, choice, choices)| choices.iter().filter_map(move |&chosen| other(choice, chosen)));
    let all = [fitted.pieces.clone()].into_iter().chain(others).enumerate();
    all.map(|(block, pieces)| Entrant { block, name, pieces, led: None }).collect()
}

/// What is `fitted`, or the same with an effect of which `is_new` in a form that is seldom, where that fits clearly better by no more numbers.
pub fn refined(data: &Data, fitted: Fit, noise: Noise, is_new: &dyn Fn(&str) -> bool) -> Fit {
    let chosen = |mut fitted: Fit| {
        let mut is_other = false;
        while let Some(better) = better(data, &fitted, noise, is_new) {
            (fitted, is_other) = (better, true);
        }
        (fitted, is_other)
    };
    // What differs over the image may look like a wall on one side.
    let uneven =
        is_new(OF_WALLS).then(|| with_slopes(data, &fitted, noise)).flatten().map(|uneven| chosen(uneven).0);
    let (even, is_other) = chosen(fitted);
    let mut fitted = match uneven.filter(|uneven| uneven.cost() < even.cost()) {
        Some(uneven) => uneven,
        None if is_other && is_new(OF_WALLS) => with_slopes(data, &even, noise).unwrap_or(even),
        None => even,
    };
    if is_new(OF_CODES) {
        fitted = with_bits(data, fitted, noise);
    }
    if is_new(FLICKER) {
        fitted = with_overtone(data, fitted, noise);
    }
    if is_new(OTHER_CAMERA) {
        fitted = with_spot(data, fitted, noise);
    }
    if is_new(OF_WELLS) {
        fitted = with_knee(data, fitted, noise);
    }
    if is_new(OF_SHIFTER) { with_whole_rounding(data, fitted, noise) } else { fitted }
}

/// The best of what is one choice away from what is `fitted`, and clearly better.
fn better(data: &Data, fitted: &Fit, noise: Noise, is_new: &dyn Fn(&str) -> bool) -> Option<Fit> {
    let most = fitted.cost() - NEEDED_NATS;
    // A jump that no signal shows again is a step, which repeats nowhere.
    let is_once = |piece: &Piece| is_longer(data, piece, REPEATS) && piece.values[FORM] != 0.0;
    let may_repeat = |way: &Entrant| way.block == UNCHANGED || !way.pieces.iter().any(is_once);
    let ways = |name| ways(fitted, name).into_iter().filter(may_repeat).collect();
    let there = [OF_CODES, OF_WALLS].into_iter().filter(|name| is_new(name));
    let is_better = |fit: &Fit| !fit.pieces.iter().any(is_once);
    best_below(data, fitted, there.map(ways).collect(), noise, most, &is_better)
}

/// Of the `ways` of effects, of which the first is each as it is `fitted`, the best fit that `may_be` and costs less than so many nats, if there is one. They are fitted to a part of the
/// sets first.
pub fn best_below(
    data: &Data,
    fitted: &Fit,
    ways: Vec<Vec<Entrant>>,
    noise: Noise,
    most: f64,
    may_be: &dyn Fn(&Fit) -> bool,
) -> Option<Fit> {
    let hopeful = ways.into_iter().flat_map(|ways| hopeful(data, fitted, ways, noise));
    let tried: Vec<Entrant> = hopeful.filter(|entrant| entrant.block != UNCHANGED).collect();
    let end = End { most, ..WHOLE };
    let of = |Entrant { pieces, led, .. }: Entrant| fit_led(data, fitted, pieces, led, noise, end);
    let fits: Vec<Fit> = tried.into_par_iter().map(of).collect();
    // One that is no number is none.
    let better = fits.into_iter().filter(|fit| fit.cost() < most && may_be(fit));
    better.min_by(|a, b| a.cost().total_cmp(&b.cost())).map(|best| finished(data, best, noise))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::fitting::fit::fit;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;
    use crate::physics::effects::adc_nonlinearity::PERIOD;

    /// What is left of a square wave or a sawtooth by its fundamental is taken by that, not by another form; of a wave nothing is left, and its form stays.
    #[test]
    fn a_wave_over_the_codes_of_another_form_becomes_that() {
        let size = Geometry { width: 16, height: 12 };
        for (form, chosen) in [("1", 1.0), ("0.5", 0.5), ("-0.5", -0.5), ("-1", -1.0), ("0", 0.0)] {
            let truth = injection(&format!("{OF_CODES}:cosine_dn=3,sine_dn=-4,period_dn=200,form={form}"));
            let recordings = taken(size, 2, &[truth.unwrap()], &["four-rail"]).unwrap();
            let data = Data::of(&recordings, Vec::new()).unwrap();
            let noise = stated_noise(&data);
            let baseline = unfitted(&data, noise);
            let mut piece = Piece::off(OF_CODES, &[0, 1], &[0]);
            piece.values[PERIOD] = 200.0;
            let wave = fit(&data, Some(&baseline), vec![piece], noise, &|_| true);
            let fitted = refined(&data, wave.clone(), noise, &|_| true);
            let old = refined(&data, wave.clone(), noise, &|_| false);
            assert_eq!(old.pieces[0].values, wave.pieces[0].values);
            let values = &fitted.pieces[0].values;
            assert!(values[FORM] == chosen && (fitted.left() < wave.left()) == (chosen != 0.0), "{values:?}");
            assert!((values[0] - 3.0).hypot(values[1] + 4.0) < 0.3, "{values:?}");
        }
    }

    #[test]
    fn what_is_seldom_is_no_candidate() {
        assert!(is_seldom(OF_CODES, "form", 1.0) && !is_seldom(OF_CODES, "form", 0.0));
        assert!(!is_seldom(OF_WALLS, LONGER, 1.0) && !is_seldom("image_lag", "form", 1.0));
    }
}
