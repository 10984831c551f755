//! A lamp's flicker that frames see go through few cycles, beside light that drifts: what the form of the drift leaves looks like it.

use super::found::Named;
use crate::diagnose::fitting::finished::finished;
use crate::diagnose::fitting::fit::{Fit, fit};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::periodic::lamps::FLICKER;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::effects::ambient_flicker::FREQUENCY;

/// Light that drifts.
const DRIFTS: [&str; 2] = ["ambient_drift", "illumination_drift"];

/// Whether what has this `name` among the `pieces` goes on from set to set, and does not begin anew with each.
pub fn goes_on(pieces: &[Piece], name: &str) -> bool {
    pieces.iter().any(|piece| piece.effect.name == name && !begins_anew(piece))
}

/// Whether the course of what drifts begins anew with every set.
fn begins_anew(piece: &Piece) -> bool {
    let numbers = piece.effect.parameters.iter().zip(&piece.values);
    numbers.filter(|(parameter, _)| parameter.name == "course").any(|(_, &course)| course < 0.0)
}

/// Takes the flicker out of `current`, and of what is `named`, where a drift of light is named beside it and the frames see less of it than a drift has: it is
/// possible beside that then, and no name of its own.
pub fn drop_resting(data: &Data, noise: Noise, current: &mut Fit, named: &mut Vec<Named>) {
    let Some(flicker) = named.iter().position(|named| named.name == FLICKER) else { return };
    // What begins anew with every set leaves nothing that goes from set to set.
    let going: Vec<&str> = DRIFTS.into_iter().filter(|name| goes_on(&current.pieces, name)).collect();
    let is_drift = |named: &Named| going.contains(&named.name);
    let mut pieces = current.pieces.iter().filter(|piece| piece.effect.name == FLICKER);
    if !named.iter().any(is_drift)
        || !pieces.all(|piece| current.series.sees_at_rest(piece.values[FREQUENCY]))
    {
        return;
    }
    named.remove(flicker);
    named.iter_mut().filter(|named| is_drift(named)).for_each(|drift| drift.may_be(FLICKER));
    let others = current.pieces_without(FLICKER);
    *current = finished(data, fit(data, Some(current), others, noise, &|_| true), noise);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// What is named of a drift and a flicker of this frequency, and what is possible beside the first.
    fn named_beside_drift(drift: &'static str, frequency_hz: f64) -> (Vec<&'static str>, Vec<String>, usize) {
        let size = Geometry { width: 8, height: 6 };
        let effect = injection("ambient_drift:relative_a_second=0.002").unwrap();
        let recordings = taken(size, 2, &[effect], &["four-rail", "wdft-motion"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        let mut flicker = Piece::off(FLICKER, &[0, 1], &[0, 1]);
        flicker.values[FREQUENCY] = frequency_hz;
        let pieces = vec![Piece::off(drift, &[0], &[0, 1]), flicker];
        let mut current = fit(&data, Some(&baseline), pieces, noise, &|_| true);
        // Where its frequency went is no question here.
        current.pieces[1].values[FREQUENCY] = frequency_hz;
        let name =
            |name| Named { name, ln_bayes: 50.0, score: (100.0, 2), rivals: Vec::new(), is_trusted: false };
        let mut named = vec![name(drift), name(FLICKER)];
        drop_resting(&data, noise, &mut current, &mut named);
        (named.iter().map(|named| named.name).collect(), named[0].rivals.clone(), current.pieces.len())
    }

    /// Frames 25 ms apart see 119.97 Hz go through a cycle in half a minute, and 101 Hz move.
    #[test]
    fn a_flicker_that_hardly_moves_is_no_name_beside_a_drift() {
        let possible = vec![FLICKER.to_owned()];
        for drift in DRIFTS {
            assert_eq!(named_beside_drift(drift, 119.97), (vec![drift], possible.clone(), 1));
            assert_eq!(named_beside_drift(drift, 101.0), (vec![drift, FLICKER], Vec::new(), 2));
        }
        let other = "phase_drift";
        assert_eq!(named_beside_drift(other, 119.97), (vec![other, FLICKER], Vec::new(), 2));
    }
}
