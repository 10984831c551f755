//! A second path whose strength differs over the image: light that comes by a wall, or by what else is beside, is more of what some pixels see than of what others do.

use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::naming::completed::clearly_better;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::effects::multipath_interference::{SHARE, SLOPES};

/// The effect of a second path.
pub const OF_WALLS: &str = "multipath_interference";
/// At no pixel it takes light away, but for this share of what it adds in the middle: a form that is nearly nothing at an edge may be fitted to be less.
const LEAST: f64 = -0.1;

/// What is `fitted`, with a second path in it whose strength differs over the image, where that fits clearly better.
pub fn with_slopes(data: &Data, fitted: &Fit, noise: Noise) -> Option<Fit> {
    let is_even = |piece: &Piece| piece.effect.name == OF_WALLS && !piece.free.contains(&SLOPES.start);
    if !fitted.pieces.iter().any(is_even) {
        return None;
    }
    let with = |piece: &Piece| {
        let mut uneven = piece.clone();
        if is_even(piece) {
            uneven.free.extend(SLOPES);
            uneven.free.sort_unstable();
        }
        uneven
    };
    let pieces = fitted.pieces.iter().map(with).collect();
    clearly_better(data, fitted, pieces, noise).filter(|with| with.pieces.iter().all(adds_light))
}

/// Whether a second path whose strength differs over the image adds light everywhere.
fn adds_light(piece: &Piece) -> bool {
    if piece.effect.name != OF_WALLS || !piece.free.contains(&SLOPES.start) {
        return true;
    }
    let slopes: f64 = SLOPES.map(|slope| piece.in_all(slope).abs()).sum();
    let middle = piece.in_all(SHARE);
    middle - 0.5 * slopes >= LEAST * middle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_is_added_at_every_edge() {
        let of = |values: [f64; 3]| {
            let mut piece = Piece::off(OF_WALLS, &[0, 1, 2, 3], &[0]);
            piece.values[..3].copy_from_slice(&values);
            adds_light(&piece)
        };
        assert!(of([0.1, 0.1, -0.1]) && of([0.1, 0.0, 0.2]));
        assert!(!of([0.1, 0.15, 0.15]) && !of([-0.1, 0.0, 0.0]));
        assert!(adds_light(&Piece::off("image_lag", &[0], &[0])));
    }
}
