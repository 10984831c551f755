//! Whether a flicker has one source: a lamp flickers equally in all recordings, and with nearly the same frequency.

use super::lamps::{FLICKER, MAINS_OFF};
use super::lines::{FrameSeen, Series};
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::statistics::amplitudes::agree;
use crate::diagnose::tangents::columns::Column;
use crate::diagnose::tangents::pieces::Piece;
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// In standard deviations: where a line is weaker than this its frequency is noise.
const SEEN: f64 = 4.0;

/// Frames whose phases of a line, doubled, are as much alike see one of them.
const ONE_PHASE: f64 = 0.9;

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
        let strengths = values().filter(|(parameter, _)| parameter.is_usual_strength(false));
        let size = strengths.map(|(parameter, value)| (value - parameter.off).powi(2)).sum::<f64>().sqrt();
        let take = *piece.takes.first()?;
        let hz = values().find(|(parameter, _)| parameter.is_shape()).map(|(_, hz)| *hz)?;
        // Where frames see a line nearly at rest, neither its amplitude nor its frequency is known, but what both make together.
        let own = fit.columns.iter().enumerate().filter(|(_, column)| column.piece == number);
        let along = |(place, column): (usize, &Column)| {
            let parameter = &piece.effect.parameters[column.parameter];
            let share = (piece.values[column.parameter] - parameter.off) / size;
            parameter.is_usual_strength(false).then_some((place, share))
        };
        let along: Vec<_> = own.filter_map(along).collect();
        let fitted = sigma_along(&fit.covariance, &along);
        let sigma = fit.series.blur(take)?.max(if fitted.is_finite() { fitted } else { 0.0 });
        // A part of it says how strong it is at least.
        let part = if fit.series.sees_one_phase(take, hz) { size } else { 0.0 };
        Some(Shown { take, hz, size: (size, part.hypot(sigma * inflation.sqrt())) })
    };
    fit.pieces.iter().enumerate().filter(|(_, piece)| flickers(piece)).filter_map(of).collect()
}

impl Series {
    /// Whether the frames of recording `take` see a line of `frequency_hz` at one phase, and half a turn from there, only, as frames every 25 ms see 100 Hz: what
    /// they see of it is a part that depends on when the recording began.
    pub fn sees_one_phase(&self, take: usize, frequency_hz: f64) -> bool {
        let of_take = self.frames.iter().filter(|frame| frame.take == take);
        let add = |(c, s, all): (f64, f64, f64), frame: &FrameSeen| {
            let (sine, cosine) = (2.0 * TAU * (frequency_hz * frame.time_s).fract()).sin_cos();
            let weight = frame.ambient.1;
            (c + weight * cosine, s + weight * sine, all + weight)
        };
        let (c, s, all) = of_take.fold((0.0, 0.0, 0.0), add);
        c.hypot(s) > ONE_PHASE * all
    }
}

/// Standard deviation in a direction, which has so much of each column.
fn sigma_along(covariance: &DMatrix<f64>, direction: &[(usize, f64)]) -> f64 {
    let with = |&(a, of_a): &(usize, f64)| -> f64 {
        direction.iter().map(|&(b, of_b)| of_a * of_b * covariance[(a, b)]).sum()
    };
    direction.iter().map(with).sum::<f64>().max(0.0).sqrt()
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

    /// Of a line of amplitude 5 whose phase is not known, the amplitude is known; at rest it is the other way round.
    #[test]
    fn what_is_not_known_of_the_phase_is_no_amplitude() {
        let (along, across) = ([0.6, 0.8], [-0.8, 0.6]);
        let of = |sigma_along: f64, sigma_across: f64| {
            DMatrix::from_fn(3, 3, |r, c| match (r.checked_sub(1), c.checked_sub(1)) {
                (Some(r), Some(c)) => {
                    sigma_along.powi(2) * along[r] * along[c] + sigma_across.powi(2) * across[r] * across[c]
                }
                _ => 7.0,
            })
        };
        let direction = [(1, along[0]), (2, along[1])];
        assert!((sigma_along(&of(0.1, 3.0), &direction) - 0.1).abs() < 1e-12);
        assert!((sigma_along(&of(3.0, 0.1), &direction) - 3.0).abs() < 1e-12);
        assert_eq!(sigma_along(&of(0.1, 3.0), &[]), 0.0);
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

    #[test]
    fn frames_every_25_ms_see_a_hundred_hertz_at_one_phase() {
        let frame = |n: usize| FrameSeen {
            time_s: 0.003 + 0.025 * (n % 4 + 11 * (n / 4)) as f64,
            ambient: (0.0, 1.0),
            ..FrameSeen::default()
        };
        let series = Series { frames: (0..160).map(frame).collect(), ..Series::default() };
        assert!(series.sees_one_phase(0, 100.0) && series.sees_one_phase(0, 100.002));
        assert!(!series.sees_one_phase(0, 100.1) && !series.sees_one_phase(0, 103.0));
        // What nobody saw has no phase.
        assert!(!series.sees_one_phase(1, 100.0));
    }
}
