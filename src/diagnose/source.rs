//! Whether a flicker has one source: a lamp flickers equally in all recordings, and with nearly the same frequency.

use super::columns::Column;
use super::fit::Fit;
use super::lines::{FLICKER, MAINS_OFF, agree};
use super::pieces::Piece;

/// In standard deviations: where a line is weaker than this its frequency is noise.
const SEEN: f64 = 4.0;

/// What one recording shows of a line.
#[derive(Debug, Clone, Copy)]
pub struct Shown {
    /// The recording.
    pub take: usize,
    /// Frequency, Hz.
    pub hz: f64,
    /// Amplitude, of what it is a share of, and the standard deviation of that.
    pub size: (f64, f64),
}

/// What each recording shows of a flicker, where it has pieces of its own in them; noise has `inflation` times the variance that was stated.
pub fn shown(fit: &Fit, inflation: f64) -> Vec<Shown> {
    let flickers = |piece: &Piece| piece.effect.name == FLICKER;
    let of = |(number, piece): (usize, &Piece)| {
        let values = || piece.effect.parameters.iter().zip(&piece.values);
        let strengths = values().filter(|(parameter, _)| !parameter.is_shape());
        let size = strengths.map(|(parameter, value)| (value - parameter.off).powi(2)).sum::<f64>().sqrt();
        let take = *piece.takes.first()?;
        let hz = values().find(|(parameter, _)| parameter.is_shape()).map(|(_, hz)| *hz)?;
        // Where frames see a line nearly at rest, neither its amplitude nor its frequency is known, but what both make together.
        let along = |parameter: usize| {
            let is_it = |column: &Column| (column.piece, column.parameter) == (number, parameter);
            let place = fit.columns.iter().position(is_it)?;
            let (value, off) = (piece.values[parameter], piece.effect.parameters[parameter].off);
            Some((value - off) / size * fit.sigma[place])
        };
        let all = piece.effect.parameters.iter().enumerate();
        let along = all.filter(|(_, p)| !p.is_shape()).filter_map(|(parameter, _)| along(parameter));
        let fitted = along.map(|sigma| sigma * sigma).sum::<f64>().sqrt();
        let sigma = fit.series.blur(take)?.max(if fitted.is_finite() { fitted } else { 0.0 });
        Some(Shown { take, hz, size: (size, sigma * inflation.sqrt()) })
    };
    fit.pieces.iter().enumerate().filter(|(_, piece)| flickers(piece)).filter_map(of).collect()
}

/// Whether what recordings show of a line may be one.
pub fn is_one(shown: &[Shown]) -> bool {
    let seen = shown.iter().filter(|shown| shown.size.0 > SEEN * shown.size.1).map(|shown| shown.hz);
    let (low, high) =
        seen.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), hz| (low.min(hz), high.max(hz)));
    let sizes: Vec<(f64, f64)> = shown.iter().map(|shown| shown.size).collect();
    high <= low * (1.0 + 2.0 * MAINS_OFF) && agree(&sizes) || low > high
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(lines: &[(f64, f64)]) -> Vec<Shown> {
        lines.iter().enumerate().map(|(take, &(hz, size))| Shown { take, hz, size: (size, 0.1) }).collect()
    }

    #[test]
    fn mains_wander_and_lamps_are_equally_bright() {
        assert!(is_one(&shown(&[(100.02, 1.0), (99.93, 1.1), (100.0, 0.95)])));
        // Of another frequency, and of another strength.
        assert!(!is_one(&shown(&[(100.02, 1.0), (101.2, 1.1)])));
        assert!(!is_one(&shown(&[(100.02, 1.0), (100.02, 0.3)])));
        // What is not seen has no frequency.
        assert!(is_one(&shown(&[(100.02, 0.45), (103.0, 0.3)])));
        assert!(is_one(&shown(&[])) && is_one(&shown(&[(100.0, 5.0)])));
    }
}
