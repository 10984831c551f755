//! Which frames of a few sets may be held out together: those that the others still tell.

use crate::diagnose::reading::data::Data;
use crate::physics::Moment;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

/// A prediction may be as noisy as what it predicts.
const AS_NOISY: f64 = 1.0 + 1e-9;
/// Phases that tell more of a waveform than its three numbers.
const PHASES: usize = 4;
/// Phases nearer than this, rad, are one.
const ONE_PHASE_RAD: f64 = 0.02;

/// A way to hold out frames.
#[derive(Debug, Clone)]
pub struct Holding {
    /// Every so many-th frame is held at a time.
    pub every: usize,
    /// Of each frame, the variance of the difference from what the others say of it, in variances of its own noise: 1, and theirs.
    pub variances: Vec<f64>,
    /// The fewest phases that are left.
    phases: usize,
}

impl Holding {
    /// For `data` the one with as few frames at a time as the others need to have phases enough, and to tell the pixels' numbers no noisier than a frame is; else
    /// the one that tells them best. Nothing where the others never tell them. As if all frames were of one place.
    pub fn of(data: &Data) -> Option<Self> {
        let angle = |m: &Moment| m.lit.then_some(m.step_rad + m.offset_rad);
        let angles_rad: Vec<Option<f64>> =
            data.takes.iter().flat_map(|take| &take.moments).map(angle).collect();
        let most = data.takes.iter().map(|take| take.frames).max().unwrap_or(0);
        let ways = || (2..=most).map(|every| Self::every(&angles_rad, every));
        let needed = PHASES.min(phases(angles_rad.iter().copied().flatten()).saturating_sub(1));
        let good = ways().find(|way| way.worst() <= 1.0 + AS_NOISY && way.phases >= needed);
        let told = || ways().filter(|way| way.worst().is_finite());
        good.or_else(|| told().min_by(|a, b| a.worst().total_cmp(&b.worst())))
    }

    /// Where `every` so many-th frame is held.
    fn every(angles_rad: &[Option<f64>], every: usize) -> Self {
        // Without the camera's light there is the rest of it.
        let row = |frame: usize| {
            let (sine, cosine) = angles_rad[frame].map_or((0.0, 0.0), f64::sin_cos);
            Vector3::new(cosine, sine, 1.0)
        };
        let (mut variances, mut fewest) = (vec![f64::INFINITY; angles_rad.len()], usize::MAX);
        for part in 0..every {
            let (held, others): (Vec<usize>, Vec<usize>) =
                (0..angles_rad.len()).partition(|frame| frame % every == part);
            fewest = fewest.min(phases(others.iter().filter_map(|&other| angles_rad[other])));
            let normal: Matrix3<f64> = others.iter().map(|&other| row(other) * row(other).transpose()).sum();
            let is_told = normal.symmetric_eigenvalues().min() > 1e-6 * normal.trace();
            if let Some(inverse) = normal.try_inverse().filter(|_| is_told) {
                for frame in held {
                    variances[frame] = 1.0 + row(frame).dot(&(inverse * row(frame)));
                }
            }
        }
        Self { every, variances, phases: fewest }
    }

    fn worst(&self) -> f64 {
        self.variances.iter().copied().fold(0.0, f64::max)
    }
}

/// How many different phases there are.
fn phases(angles_rad: impl Iterator<Item = f64>) -> usize {
    let mut phases: Vec<f64> = angles_rad.map(|angle| angle.rem_euclid(TAU)).collect();
    phases.sort_by(f64::total_cmp);
    let Some((&first, &last)) = phases.first().zip(phases.last()) else { return 0 };
    let apart = phases.windows(2).filter(|pair| pair[1] - pair[0] > ONE_PHASE_RAD).count();
    // The last one and the first, a turn on.
    if apart > 0 && first + TAU - last <= ONE_PHASE_RAD { apart } else { apart + 1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(count: usize, of_turn: f64) -> Vec<Option<f64>> {
        (0..count).map(|step| Some(TAU * of_turn * step as f64)).collect()
    }

    /// By hand: N equal steps over a turn tell a prediction to 3 / N of the held half, and one of four frames is told by the three others with three times
    /// its variance: it is the sum of two less the third.
    #[test]
    fn what_is_left_tells_what_is_held() {
        let worst = |count, of_turn, every| Holding::every(&steps(count, of_turn), every).worst();
        let close = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(close(worst(12, 1.0 / 12.0, 2), 1.5));
        assert!(close(worst(4, 0.25, 4), 4.0));
        assert!(close(worst(6, 1.0 / 6.0, 6), 2.0));
        // Two frames half a turn apart say nothing of those between, and two of three leave a number open.
        assert_eq!([worst(4, 0.25, 2), worst(3, 1.0 / 3.0, 3)], [f64::INFINITY; 2]);
        // Every other step of two turns in twelve has three phases.
        assert_eq!(Holding::every(&steps(12, 1.0 / 6.0), 2).phases, 3);
        // Four frames without the camera's light have no phase, and tell but one number.
        let dark = [steps(4, 0.25), vec![None; 4]].concat();
        assert_eq!(Holding::every(&dark, 2).worst(), f64::INFINITY);
        assert_eq!(Holding::every(&dark, 4).phases, 3);
        let of = |angles_rad: &[f64]| phases(angles_rad.iter().copied());
        let two_turns: Vec<f64> = steps(12, 1.0 / 6.0).into_iter().flatten().collect();
        assert_eq!([of(&two_turns), of(&[0.0, 1.0, 2.0]), of(&[0.0, TAU - 0.01]), of(&[])], [6, 3, 1, 0]);
    }
}
