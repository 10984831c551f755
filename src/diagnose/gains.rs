//! A drift that only tells recordings apart: what is constant within each is no drift.

use super::data::Data;
use super::fit::{Fit, fit};
use super::noise::Noise;
use super::pieces::Piece;
use super::search::Found;

/// A drift of the light, and its number that is each recording's own.
const DRIFT: &str = "illumination_drift";
const BEFORE: &str = "relative_before";
/// What a drift does within recordings takes so many nats away, or it is none.
const WITHIN_NATS: f64 = 8.0;
/// And so much of what all of it explains.
const WITHIN: f64 = 0.1;
/// Why it is not believed.
pub const WHY: &str =
    "what it says is constant within each recording: gains of whole recordings, and no drift";

/// The name of a drift among what was `found` that is none.
pub fn gain_of_recordings(data: &Data, found: &Found, noise: Noise) -> Option<&'static str> {
    let named = found.named.iter().find(|named| named.name == DRIFT)?;
    let constant = |piece: &Piece| {
        let parameters = piece.effect.parameters;
        let before = parameters.iter().position(|parameter| parameter.name == BEFORE)?;
        let is_free = piece.free.contains(&before);
        let mut constant = Piece { values: piece.effect.off(), free: vec![before], ..piece.clone() };
        for (number, parameter) in parameters.iter().enumerate() {
            if number == before || parameter.is_shape() {
                constant.values[number] = piece.values[number];
            }
        }
        is_free.then_some(constant)
    };
    let drifts = || found.fit.pieces.iter().filter(|piece| piece.effect.name == DRIFT);
    let constants: Vec<Piece> = drifts().map(constant).collect::<Option<_>>()?;
    let pieces = [found.fit.pieces_without(DRIFT), constants].concat();
    let without: Fit = fit(data, Some(&found.fit), pieces, noise, &|_| true);
    let within = 0.5 * (without.left() - found.fit.left());
    (within < WITHIN_NATS || within < WITHIN * 0.5 * named.score.0).then_some(DRIFT)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::finished::unfitted;
    use crate::diagnose::searched::searched;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// What is named, and what of that is none, where `effect` acts in some recordings, and not in others.
    fn named(effect: &str, with: &[&str], without: &[&str]) -> (Vec<&'static str>, Option<&'static str>) {
        let size = Geometry { width: 10, height: 8 };
        let mut recordings = taken(size, 4, &[injection(effect).unwrap()], with).unwrap();
        recordings.extend(taken(size, 4, &[], without).unwrap());
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let found = searched(&data, unfitted(&data, noise), noise, 0.0).0.found;
        let names = found.named.iter().map(|named| named.name).collect();
        (names, gain_of_recordings(&data, &found, noise))
    }

    #[test]
    fn what_recordings_have_of_their_own_is_no_drift() {
        let all = ["four-sweep", "four-rail", "four-motion"];
        assert_eq!(named("illumination_drift:relative=0.05", &all, &[]), (vec![DRIFT], None));
        let (names, none) = named("illumination_drift:relative_before=0.03", &all[2..], &all[..2]);
        assert!(names == [DRIFT] && none == Some(DRIFT), "{names:?} {none:?}");
    }
}
