//! Bits of wrong weights in the place of a wave over the codes: of several at once a wave is the greatest part, and not what they are.

use super::overtones::is_wave;
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::naming::completed::clearly_better;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::effects::adc_nonlinearity::{FIRST_BIT, PERIOD};

/// What is `fitted`, with the weights of all bits in the place of a wave over the codes, whatever its form, where that fits clearly better.
pub fn with_bits(data: &Data, fitted: Fit, noise: Noise) -> Fit {
    if !fitted.pieces.iter().any(is_wave) {
        return fitted;
    }
    let bits = |piece: &Piece| Piece {
        values: piece.effect.off(),
        free: (FIRST_BIT..PERIOD).collect(),
        ..piece.clone()
    };
    let instead = |piece: &Piece| if is_wave(piece) { bits(piece) } else { piece.clone() };
    let pieces = fitted.pieces.iter().map(instead).collect();
    clearly_better(data, &fitted, pieces, noise).unwrap_or(fitted)
}
