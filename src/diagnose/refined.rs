//! An effect that was named in its usual form, in those that are seldom: tried where it is named only, as candidates they would cost more than they find.

use super::completed::NEEDED_NATS;
use super::data::Data;
use super::finished::finished;
use super::fit::{Fit, fit_below};
use super::noise::Noise;
use super::overtones::OF_CODES;
use super::pieces::Piece;
use rayon::prelude::*;

/// Effects, and what their choice is where they are seldom.
const SELDOM: [(&str, &[f64]); 2] = [(OF_CODES, &[1.0, -1.0]), ("multipath_interference", &[-2.0])];

/// Whether `chosen` is a choice of the effect `name` in which it is not looked for from the start.
pub fn is_seldom(name: &str, chosen: f64) -> bool {
    SELDOM.iter().any(|(effect, choices)| *effect == name && choices.contains(&chosen))
}

/// The `piece` with its choice.
fn with_choice(piece: &Piece, chosen: f64) -> Piece {
    let mut piece = piece.clone();
    let parameters = piece.effect.parameters.iter();
    let choices = piece.values.iter_mut().zip(parameters).filter(|(_, parameter)| parameter.is_choice);
    choices.for_each(|(value, _)| *value = chosen);
    piece
}

/// What is `fitted`, or the same with an effect of which `is_new` in a form that is seldom, where that fits clearly better by no more numbers.
pub fn refined(data: &Data, fitted: Fit, noise: Noise, is_new: &dyn Fn(&str) -> bool) -> Fit {
    let other = |name: &str, chosen: f64| -> Option<Vec<Piece>> {
        let is_of = |piece: &Piece| piece.effect.name == name;
        (is_new(name) && fitted.pieces.iter().any(is_of)).then(|| {
            let anew = |piece: &Piece| if is_of(piece) { with_choice(piece, chosen) } else { piece.clone() };
            fitted.pieces.iter().map(anew).collect()
        })
    };
    let ways = SELDOM.iter().flat_map(|&(name, choices)| choices.iter().map(move |&chosen| (name, chosen)));
    let tried: Vec<Vec<Piece>> = ways.filter_map(|(name, chosen)| other(name, chosen)).collect();
    let most = fitted.cost() - NEEDED_NATS;
    let fits: Vec<Fit> =
        tried.into_par_iter().map(|pieces| fit_below(data, &fitted, pieces, noise, most)).collect();
    // One that is no number is none.
    let better = fits.into_iter().filter(|fit| fit.cost() < most);
    match better.min_by(|a, b| a.cost().total_cmp(&b.cost())) {
        Some(best) => finished(data, best, noise),
        None => fitted,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::finished::unfitted;
    use crate::diagnose::fit::fit;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// What is left of a square wave by its fundamental is taken by a square wave, not by a triangle; of a wave nothing is left, and its form stays.
    #[test]
    fn a_wave_over_the_codes_that_is_a_square_one_becomes_one() {
        let size = Geometry { width: 16, height: 12 };
        for (form, chosen) in [("1", 1.0), ("-1", -1.0), ("0", 0.0)] {
            let truth = injection(&format!("{OF_CODES}:cosine_dn=3,sine_dn=-4,period_dn=200,form={form}"));
            let recordings = taken(size, 2, &[truth.unwrap()], &["four-rail"]).unwrap();
            let data = Data::of(&recordings, Vec::new()).unwrap();
            let noise = stated_noise(&data);
            let baseline = unfitted(&data, noise);
            let mut piece = Piece::off(OF_CODES, &[0, 1], &[0]);
            piece.values[2] = 200.0;
            let wave = fit(&data, Some(&baseline), vec![piece], noise, &|_| true);
            let fitted = refined(&data, wave.clone(), noise, &|_| true);
            let old = refined(&data, wave.clone(), noise, &|_| false);
            assert_eq!(old.pieces[0].values, wave.pieces[0].values);
            let values = &fitted.pieces[0].values;
            assert!(values[3] == chosen && (fitted.left() < wave.left()) == (chosen != 0.0), "{values:?}");
            assert!((values[0] - 3.0).hypot(values[1] + 4.0) < 0.3, "{values:?}");
        }
    }

    #[test]
    fn what_is_seldom_is_no_candidate() {
        assert!(is_seldom(OF_CODES, 1.0) && !is_seldom(OF_CODES, 0.0) && !is_seldom("image_lag", -1.0));
    }
}
