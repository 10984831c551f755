//! The knee of a well: one that becomes full softly, as what scatters is clipped with the light, keeps a signal near its edge below that on average.

use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::naming::completed::clearly_better;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::effects::saturation::KNEE;

/// The effect whose well may have a knee.
pub const OF_WELLS: &str = "saturation";

/// What is `fitted`, with a knee of a well that is in it, from that of the shot noise on, where that fits clearly better.
pub fn with_knee(data: &Data, fitted: Fit, noise: Noise) -> Fit {
    let is_sharp = |piece: &Piece| piece.effect.name == OF_WELLS && !piece.free.contains(&KNEE);
    if !fitted.pieces.iter().any(is_sharp) {
        return fitted;
    }
    let full_scale_dn = f64::from(data.camera.full_scale()) - data.camera.pedestal_dn;
    let soft = |piece: &Piece| {
        let mut soft = piece.clone();
        let shot_dn = (noise.slope * full_scale_dn * (1.0 - piece.values[0])).max(0.0).sqrt();
        let knee = &piece.effect.parameters[KNEE];
        soft.values[KNEE] = (shot_dn / full_scale_dn).clamp(knee.typical, 0.5 * knee.bounds.1);
        soft.free.push(KNEE);
        soft
    };
    let with = |piece: &Piece| if is_sharp(piece) { soft(piece) } else { piece.clone() };
    let pieces = fitted.pieces.iter().map(with).collect();
    clearly_better(data, &fitted, pieces, noise).unwrap_or(fitted)
}
