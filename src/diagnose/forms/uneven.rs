//! A drift of the light that is not the same all over the image: what fades unevenly. Where the target moves that is no candidate from the start, since regions see more
//! and less of it anyway; but once a drift was named, it may be the uneven one.

use crate::diagnose::fitting::fit::{Fit, fit};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::naming::candidates::OF_ONE_PLACE;
use crate::diagnose::naming::found::Named;
use crate::diagnose::reading::data::Data;
use crate::diagnose::reading::included::included_of;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::effects;

/// What fades alike all over the image.
const EVEN: &str = "illumination_drift";
/// Each further number costs so many nats, and all of them so many besides.
const NUMBER_NATS: f64 = 3.0;
const SWITCH_NATS: f64 = 12.0;
/// What is uneven is so much of what the even drift explains, at least: of that, the drift's own form may leave half as much.
const UNEVEN: f64 = 0.08;

/// In `current` and `named`, a drift of the light that is clearly uneven becomes that.
pub fn uneven(data: &Data, noise: Noise, current: &mut Fit, named: &mut [Named]) {
    let Some(even) = named.iter_mut().find(|named| named.name == EVEN) else { return };
    let [name] = OF_ONE_PLACE;
    // Where the target is at one place it was a candidate like others.
    if data.stands_still() {
        return;
    }
    let Some(effect) = effects::named(name) else { return };
    let mut pieces = current.pieces_without(EVEN);
    let takes: Vec<usize> = (0..data.takes.len()).collect();
    let free = (0..effect.parameters.len()).collect();
    let included = included_of(data, effect, &takes);
    pieces.push(Piece { effect, values: effect.off(), free, takes, finite: false, included });
    let fitted = fit(data, Some(current), pieces, noise, &|_| true);
    let more = fitted.columns.len().saturating_sub(current.columns.len());
    let gain = current.left() - fitted.left();
    if 0.5 * gain > SWITCH_NATS + NUMBER_NATS * more as f64 && gain > UNEVEN * even.score.0 {
        even.name = name;
        even.ln_bayes += 0.5 * gain - NUMBER_NATS * more as f64;
        even.score = (even.score.0 + current.counted() - fitted.counted(), even.score.1 + more);
        even.rivals.retain(|rival| rival != name);
        *current = fitted;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// What a drift that was named becomes where `truth` is there.
    fn becomes(truth: &[&str]) -> &'static str {
        let truth: Vec<_> = truth.iter().map(|text| injection(text).unwrap()).collect();
        let size = Geometry { width: 12, height: 9 };
        let recordings = taken(size, 4, &truth, &["four-sweep", "four-rail"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        let drift = Piece::off(EVEN, &[0], &[0, 1]);
        let mut current = fit(&data, Some(&baseline), vec![drift], noise, &|_| true);
        let score = (baseline.counted() - current.counted(), 1);
        let mut named = [Named { name: EVEN, ln_bayes: 100.0, score, rivals: Vec::new(), is_trusted: false }];
        let before = current.left();
        uneven(&data, noise, &mut current, &mut named);
        assert_eq!(current.left() < before, named[0].name != EVEN);
        assert_eq!(current.pieces[0].effect.name, named[0].name);
        named[0].name
    }

    #[test]
    fn a_drift_that_differs_over_the_image_becomes_uneven_and_no_other_does() {
        let rates = ["top_left", "top", "left", "middle"].map(|place| format!("{place}_per_s=0.004"));
        assert_eq!(becomes(&[&format!("response_decay:{}", rates.join(","))]), "response_decay");
        assert_eq!(becomes(&["illumination_drift:relative=-0.03"]), EVEN);
        // Beside what is another effect's.
        let cross = "electrical_crosstalk:cosine_dn=2";
        assert_eq!(becomes(&["illumination_drift:relative=-0.03", cross]), EVEN);
    }
}
