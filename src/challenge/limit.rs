//! What an observer could say who knows the exact change of every effect: the limit by likelihood ratios.

use super::label::{Label, are_same, texts};
use crate::time_domain::{Flaw, Hook, Known, Movie, Ruler, flaws};
use nalgebra::DMatrix;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Of an effect more, what the logarithm of the likelihood must grow by beside the number of candidates: a nat.
const MARGIN: f64 = 1.0;

/// The names of the effects, at most two, that explain `noisy` best, for an observer who has the exact change of each of the `label`'s
/// flaws and one shape of every other effect, and knows the noise.
///
/// A hypothesis of k effects out of C has ½ zᵀK⁻¹z − k (ln 2C + 1), with the frames' products z with the changes, and the changes' own
/// products K, all beyond the pixels' own numbers; none has 0.
pub fn limit(
    ruler: &Ruler,
    known: Known,
    own: &[Flaw],
    noisy: Movie,
    random: &mut ChaCha8Rng,
) -> Vec<String> {
    let mut names = Vec::new();
    let mut movies = vec![ruler.beyond(known, noisy)];
    for mechanism in flaws::all().filter(|mechanism| !mechanism.is_outside()) {
        let shape = match own.iter().find(|flaw| flaw.mechanism.name == mechanism.name) {
            Some(flaw) => flaw.clone(),
            None => Flaw::drawn(mechanism, random.random()),
        };
        let unknown = Known::without([mechanism.name]);
        let is_told = (unknown.falloff || known.falloff) && (unknown.motion || known.motion);
        match mechanism.hook {
            // What the camera's simulation includes is no candidate.
            Hook::Unknown if is_told => continue,
            Hook::Unknown => movies.push(ruler.change(unknown, &[])),
            _ => movies.push(ruler.change(Known::BOTH, &[&shape])),
        }
        names.push(mechanism.name);
    }
    let products = ruler.products(&movies.iter().collect::<Vec<_>>());
    best(&products).into_iter().map(|index| names[index - 1].to_owned()).collect()
}

/// The best of no, one and two of the changes 1, 2, … whose products among each other and with 0, the frames, are these.
fn best(products: &DMatrix<f64>) -> Vec<usize> {
    let count = products.nrows();
    let price = (2.0 * (count.max(2) - 1) as f64).ln() + MARGIN;
    let z = |index: usize| products[(0, index)];
    let mut best = (0.0, Vec::new());
    let mut offer = |gain: f64, names: &[usize]| {
        if gain > best.0 {
            best = (gain, names.to_vec());
        }
    };
    for one in 1..count {
        let own = products[(one, one)];
        if own <= 0.0 {
            continue;
        }
        offer(0.5 * z(one) * z(one) / own - price, &[one]);
        for other in one + 1..count {
            let (others, both) = (products[(other, other)], products[(one, other)]);
            let rest = own * others - both * both;
            // Two that are the same explain no more than one.
            if rest > 1e-9 * own * others {
                let square = (others * z(one).powi(2) - 2.0 * both * z(one) * z(other)
                    + own * z(other).powi(2))
                    / rest;
                offer(0.5 * square - 2.0 * price, &[one, other]);
            }
        }
    }
    best.1
}

/// Whether the limit says exactly what `label` says.
pub fn is_right(label: &Label) -> bool {
    let named = texts(&label.limit);
    label.right().iter().chain(&label.alike()).any(|names| are_same(names, &named))
}

#[cfg(test)]
mod tests {
    use super::best;
    use nalgebra::dmatrix;

    #[test]
    fn the_best_of_none_one_and_two_is_found() {
        // Changes of norm 1, 1 and 2 of which the first two are orthogonal and the third is along the first.
        let of = |one: f64, two: f64| {
            dmatrix![
                0.0, one, two, 2.0 * one;
                one, 1.0, 0.0, 2.0;
                two, 0.0, 1.0, 0.0;
                2.0 * one, 2.0, 0.0, 4.0
            ]
        };
        assert_eq!(best(&of(1.0, 1.0)), Vec::<usize>::new());
        assert_eq!(best(&of(1.0, 9.0)), [2]);
        assert_eq!(best(&of(9.0, 9.0)), [1, 2]);
    }
}
