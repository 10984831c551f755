//! What was named, and is not needed beside what came after it; or came to its bound beside what came before.

use super::completed::NEEDED_NATS;
use super::found::Named;
use crate::diagnose::fitting::bounds::bounded;
use crate::diagnose::fitting::finished::finished;
use crate::diagnose::fitting::fit::{Fit, fit, fit_below};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;
use std::collections::BTreeSet;

/// Takes out of `current`, and of what is `named`, what is not needed beside the others, the least needed first. What is left alone explains all that the `baseline` left.
pub fn drop_needless(data: &Data, noise: Noise, baseline: &Fit, current: &mut Fit, named: &mut Vec<Named>) {
    while named.len() > 1 {
        let without = |number: usize| {
            let pieces = current.pieces_without(named[number].name);
            let numbers = named[number].score.1 as f64;
            // Of numbers that the fit may have, all.
            let shapes = |piece: &Piece| piece.effect.parameters.iter().filter(|row| row.is_shape()).count();
            let fitted: usize = pieces.iter().map(|piece| piece.free.len() + shapes(piece)).sum();
            let most = 0.5 * current.chi2 + NEEDED_NATS + numbers + fitted as f64;
            let left = fit_below(data, current, pieces, noise, most);
            let needed = 0.5 * (left.left() - current.chi2) - numbers;
            (number, needed, left)
        };
        // Of two that are needed as little, the later one.
        let least = (0..named.len()).rev().map(without).min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((number, _, left)) = least.filter(|least| least.1 < NEEDED_NATS) else { return };
        *current = left;
        named.remove(number);
        if let [only] = &mut named[..] {
            only.score.0 = only.score.0.max(baseline.counted() - current.counted());
        }
    }
}

/// What is `fitted` without those effects beside the first one `named` whose strength came to its bound, and the names without them: what a form leaves, or
/// something that nobody knows, needs more of them than there may be. Where no camera is described steps and gains may be anything.
pub fn without_bounded(data: &Data, mut fitted: Fit, noise: Noise, named: &mut Vec<Named>) -> Fit {
    let last = |fitted: &Fit, named: &[Named]| {
        let bounded = if data.assumed.camera { BTreeSet::new() } else { bounded(fitted) };
        (1..named.len()).rev().find(|&number| bounded.contains(named[number].name))
    };
    while let Some(last) = last(&fitted, named) {
        let others = fitted.pieces_without(named.remove(last).name);
        fitted = finished(data, fit(data, Some(&fitted), others, noise, &|_| true), noise);
    }
    fitted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    const SCALE: &str = "phase_step_scale";
    const TAPS: &str = "tap_mismatch";

    /// What is left of these `names`, fitted to steps that are too large and to a tap of this gain, and that again.
    fn left(gain: f64, names: [&'static str; 2]) -> Vec<&'static str> {
        let taps = format!("{TAPS}:gain={gain}");
        let effects = ["phase_step_scale:relative=0.01", &taps, &taps];
        let effects: Vec<_> = effects.into_iter().map(|text| injection(text).unwrap()).collect();
        let size = Geometry { width: 8, height: 6 };
        let data =
            Data::of(&taken(size, 3, &effects, &["four-rail", "wdft-rail"]).unwrap(), Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let pieces = vec![Piece::off(SCALE, &[0], &[0, 1]), Piece::off(TAPS, &[0, 1], &[0, 1])];
        let fitted = fit(&data, Some(&unfitted(&data, noise)), pieces, noise, &|_| true);
        let score = (1e4, 1);
        let named = |name| Named { name, ln_bayes: 1e3, score, rivals: Vec::new(), is_trusted: false };
        let mut named = names.map(named).to_vec();
        let fitted = without_bounded(&data, fitted, noise, &mut named);
        assert_eq!(fitted.pieces.len(), named.len());
        named.iter().map(|named| named.name).collect()
    }

    /// Taps that were named before the scale of the steps, and are not needed beside it.
    #[test]
    fn what_is_left_alone_explains_all() {
        let size = Geometry { width: 8, height: 6 };
        let effects = [injection("phase_step_scale:relative=0.01").unwrap()];
        let recordings = taken(size, 3, &effects, &["four-rail", "wdft-rail"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let pieces = vec![Piece::off(TAPS, &[0, 1], &[0, 1]), Piece::off(SCALE, &[0], &[0, 1])];
        let baseline = unfitted(&data, noise);
        let mut current = fit(&data, Some(&baseline), pieces, noise, &|_| true);
        let of = |(name, score)| Named {
            name,
            ln_bayes: 1e3,
            score: (score, 1),
            rivals: Vec::new(),
            is_trusted: false,
        };
        let mut named = [(TAPS, 150.0), (SCALE, 20.0)].map(of).to_vec();
        drop_needless(&data, noise, &baseline, &mut current, &mut named);
        let [only] = &named[..] else { panic!("{named:?}") };
        assert_eq!((only.name, only.score.0), (SCALE, baseline.counted() - current.counted()));
        assert!(only.score.0 > 100.0, "{}", only.score.0);
    }

    #[test]
    fn a_further_name_at_its_bound_is_none() {
        assert_eq!(left(0.1, [SCALE, TAPS]), [SCALE, TAPS]);
        assert_eq!(left(0.2, [SCALE, TAPS]), [SCALE]);
        assert_eq!(left(0.2, [TAPS, SCALE]), [TAPS, SCALE]);
    }
}
