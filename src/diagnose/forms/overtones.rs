//! What repeats with the code and is no wave: its overtones say so. A converter whose bit comes late, or a code that is missing, is one place of each period,
//! of which a wave explains the most, and not what it is.

use crate::diagnose::fitting::gram::Gram;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::naming::found::Found;
use crate::diagnose::reading::data::Data;
use crate::diagnose::statistics::evidence::{Block, Evidence, tail};
use crate::diagnose::tangents::columns::Tangents;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::effects::adc_nonlinearity::PERIOD;

/// The effect that is a wave over the codes.
pub const OF_CODES: &str = "adc_nonlinearity";
/// Its strengths.
pub const PARTS: [usize; 2] = [0, 1];
/// Parts of the period in which overtones are looked for: shorter ones are lost in the noise.
const OVERTONES: [f64; 2] = [2.0, 3.0];
/// Overtones that a wave would leave by chance in so small a share of campaigns are none of a wave.
const BY_CHANCE: f64 = 1e-3;

/// Whether `piece` is a wave over the codes, and not errors of bits.
pub fn is_wave(piece: &Piece) -> bool {
    piece.effect.name == OF_CODES && piece.free.contains(&PARTS[0])
}

/// Whether `piece` is a wave over the codes of which there are fewer than so many `periods` among the signals.
pub fn is_longer(data: &Data, piece: &Piece, periods: f64) -> bool {
    is_wave(piece) && periods * piece.values[PERIOD] > data.span_dn()
}

/// Whether one of these `pieces` is a wave over the codes that has no whole period among the signals: a smooth curve is the response's, as a rule, whatever its
/// form.
pub fn is_bend(data: &Data, pieces: &[Piece]) -> bool {
    pieces.iter().any(|piece| is_longer(data, piece, 1.0))
}

/// Whether the wave over the codes that was `found` has overtones: its period, DN.
pub fn overtones(data: &Data, found: &Found, noise: Noise) -> Option<f64> {
    let wave = found.fit.pieces.iter().find(|piece| is_wave(piece))?;
    let period_dn = wave.values[PERIOD];
    let overtone = |part: f64| {
        let mut values = vec![0.0; wave.values.len()];
        values[PERIOD] = period_dn / part;
        Piece { values, free: PARTS.to_vec(), finite: false, ..wave.clone() }
    };
    let tried = OVERTONES.map(overtone);
    let (tangents, _) = Tangents::new(data, &found.fit.pixels, &found.fit.pieces, &tried);
    let mut projected = Gram::of(data, &tangents, noise, &|_| true).project(None);
    let fitted = found.fit.columns.len();
    projected.give_way(0..fitted);
    let columns = (fitted..projected.vector.len()).collect();
    let blocks = [Block { candidate: 0, variant: 0, variants: 1.0, columns }];
    let reach = |_| f64::INFINITY;
    let evidence = Evidence::new(&projected.matrix, &projected.vector, &projected.raw, &reach, &blocks, 1);
    let (chi2, numbers) = evidence.score(0)?;
    (tail(chi2, numbers) < BY_CHANCE).then_some(period_dn)
}
