//! A shape that is one of a few: where another one fits about as well, a number is not better known than which of them it is.

use super::data::Data;
use super::fit::{Fit, fit_below};
use super::noise::Noise;
use super::pieces::Piece;

/// Effects, and the choice of each beside which a strength says the same, whatever is chosen.
const CHOICES: [(&str, &str); 1] = [("lens_scatter", "decay_length_of_width")];
/// What costs so many nats more is not what is there.
const UNLIKELY_NATS: f64 = 8.0;

/// Of the parameters of the piece of this `number` of what is `fitted`, how far those of other choices are from them: the root of the mean square, each by its likelihood.
pub fn spread(data: &Data, fitted: &Fit, noise: Noise, number: usize) -> Vec<f64> {
    let piece = &fitted.pieces[number];
    let parameters = piece.effect.parameters;
    let is_open = |place: &usize| CHOICES.contains(&(piece.effect.name, parameters[*place].name));
    let Some(choice) = (0..parameters.len()).find(is_open) else { return vec![0.0; parameters.len()] };
    let other = |&chosen: &f64| {
        let mut pieces: Vec<Piece> = fitted.pieces.clone();
        pieces[number].values[choice] = chosen;
        let most = fitted.cost() + UNLIKELY_NATS;
        let fit = fit_below(data, fitted, pieces, noise, most);
        // What was given up, or is no number, is none.
        (fit.cost() < most).then(|| (fit.cost() - fitted.cost(), fit.pieces[number].values.clone()))
    };
    let others = parameters[choice].shapes.iter().filter(|chosen| **chosen != piece.values[choice]);
    let others: Vec<(f64, Vec<f64>)> = others.filter_map(other).collect();
    let of = |place: usize| {
        let values = others.iter().map(|(more, values)| (*more, values[place] - piece.values[place]));
        if place == choice { 0.0 } else { scatter(values) }
    };
    (0..parameters.len()).map(of).collect()
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
    use crate::diagnose::finished::unfitted;
    use crate::diagnose::fit::fit;
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
