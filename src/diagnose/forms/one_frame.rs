//! Gains of frames of which only one has any: with a number for each frame they say that less clearly than an offset of the frame does.

use crate::diagnose::fitting::fit::{Fit, fit_below};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::judging::vote::OCCAM_NATS;
use crate::diagnose::naming::candidates::MANY_FRAMES;
use crate::diagnose::naming::found::Named;
use crate::diagnose::reading::data::Data;
use crate::diagnose::reading::included::included_of;
use crate::diagnose::tangents::pieces::Piece;

/// The effect with a gain for each frame.
const OF_FRAMES: &str = "frame_gain";

/// In `current`, gains that are the only one that is `named` become that of one frame in all recordings, where what is left grows by less than the numbers that are saved cost. Far from
/// the `baseline` they are more than that.
pub fn one_frame(data: &Data, noise: Noise, baseline: &Fit, current: &mut Fit, named: &mut [Named]) {
    let [only] = named else { return };
    if only.name != OF_FRAMES || baseline.is_far_from(current) {
        return;
    }
    let frames = current.pieces.iter().flat_map(|piece| &piece.free).filter(|&&frame| frame < MANY_FRAMES);
    let frames = frames.map(|frame| frame + 1).max().unwrap_or(0);
    let of =
        |frame: usize| fit_below(data, current, vec![alone(data, current, frame)], noise, current.cost());
    // A fit that was given up, or that is no number, is not taken.
    let fewer = (0..frames).map(of).filter(|fit| fit.cost() < current.cost());
    if let Some(fitted) = fewer.min_by(|a, b| a.cost().total_cmp(&b.cost())) {
        let explained = (baseline.counted() - fitted.counted()).max(0.0);
        only.score = (explained, 1);
        only.ln_bayes = only.ln_bayes.max(0.5 * explained - OCCAM_NATS);
        *current = fitted;
    }
}

/// The gain of number `frame` alone, in all recordings alike, from what the recordings have of it in `current`.
fn alone(data: &Data, current: &Fit, frame: usize) -> Piece {
    let takes: Vec<usize> = (0..data.takes.len()).collect();
    let with_it = || current.pieces.iter().filter(|piece| piece.free.contains(&frame));
    let sum: f64 = with_it().map(|piece| piece.values[frame]).sum();
    let mut piece = current.pieces[0].with_share(0.0);
    piece.values[frame] = sum / with_it().count().max(1) as f64;
    piece.free = vec![frame];
    piece.included = included_of(data, piece.effect, &takes);
    Piece { takes, ..piece }
}
