//! Another camera's light: its line, which follows the phase steps where the gate takes these, and none where this camera's light does; and on which part of the image it falls.

use crate::diagnose::fitting::bounds::is_bounded;
use crate::diagnose::fitting::finished::finished;
use crate::diagnose::fitting::fit::{Fit, fit, fit_below};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::naming::completed::NEEDED_NATS;
use crate::diagnose::naming::periods::Found;
use crate::diagnose::periodic::beats::MOST_PRODUCTS;
use crate::diagnose::periodic::lamps::{NEAR_MAINS, is_seen_as_lamps};
use crate::diagnose::periodic::lines::{Line, Series, SetSeen, are_alike};
use crate::diagnose::reading::data::Data;
use crate::diagnose::shared_errors::swings::usual;
use crate::diagnose::statistics::periodogram::{FINENESS, longest, power};
use crate::diagnose::tangents::pieces::{Piece, Variant};
use crate::physics::effects::multi_camera_interference::{self, BEAT, EFFECT, GOES_WITH, SPOT};
use crate::physics::{Parameter, Pixels};
use nalgebra::{SMatrix, SVector};

/// Its name.
pub const OTHER_CAMERA: &str = "multi_camera_interference";

/// A line within this share of twice the mains' frequency is a lamp's. One that is as near as a generator off the grid may be is so many times less likely another light's.
const MAINS: f64 = 0.01;
const OF_LAMPS: f64 = 1e3;
/// A line is of the sets where recordings in which it comes again with them have this share of what it explains.
const OF_SETS: f64 = 0.5;
/// Lines are one whose frequencies differ, but for whole turns, by less than so many turns from a frame to the next.
const SAME_TURNS: f64 = 2e-3;

/// Whether frames that are a period (s) apart see two lines, Hz, alike.
pub fn is_same(one_hz: f64, other_hz: f64, period_s: f64) -> bool {
    are_alike(one_hz, other_hz, period_s, SAME_TURNS)
}

/// Frequencies of what frames see that follows the phase steps, and of what does not, the `still` line, if there is either.
pub fn found(series: &Series, still: Option<Line>) -> Option<Found> {
    let beat = series.turning_beat();
    let looked = [&beat, &still].into_iter().flatten().map(|line| line.looked).sum();
    let of = |line: Option<Line>| line.into_iter().map(|line| line.frequency).collect::<Vec<_>>();
    let (usual, instead) = (of(beat), of(still));
    let shapes = [&usual[..], &instead].concat();
    (!shapes.is_empty()).then_some(Found { shapes, instead, looked, own: Vec::new() })
}

impl Series {
    /// The strongest line of the ambient light in time that is no lamp's on the mains, if it is no drift, nothing that comes again with sets or their frames, and is seen above the noise and what else is there; in two recordings
    /// at least.
    pub fn line_of_no_lamp(&self) -> Option<Line> {
        let takes = self.by_take();
        let longest_s = longest(&takes);
        let step = 1.0 / (FINENESS * longest_s);
        let most_hz = (0.5 / self.frame_period_s).min(MOST_PRODUCTS * step / self.frames.len() as f64);
        let least_hz = 1.0 / longest_s;
        // In one recording a bench may shake: what it shakes is told by recordings that move differently.
        if takes.len() < 2 || !(least_hz > 0.0 && least_hz < most_hz && most_hz.is_finite()) {
            return None;
        }
        let line = self.in_time((least_hz, most_hz))?;
        let hz = line.frequency;
        let of_sets = takes.iter().enumerate().filter(|(take, _)| self.comes_again(*take, hz, least_hz));
        let of_sets: f64 = of_sets.map(|(_, take)| power(take, hz)).sum();
        let is_other = of_sets < OF_SETS * line.chi2 && !is_seen_as_lamps(hz, self.frame_period_s, MAINS);
        (is_other && self.is_clear(&line)).then_some(line)
    }

    /// Whether a line of so many hertz, known to `within_hz`, comes again with the sets of a recording, or with so many frames as these have: what single frames of each set have is such a line.
    fn comes_again(&self, take: usize, hz: f64, within_hz: f64) -> bool {
        let frames = self.frames.iter().filter(|frame| frame.take == take).count();
        let sets: Vec<&SetSeen> = self.sets.iter().filter(|set| set.take == take).collect();
        let of_frames_s = frames as f64 / sets.len() as f64 * self.frame_period_s;
        let of_sets_s = usual(sets.windows(2).map(|pair| pair[1].time_s - pair[0].time_s).collect());
        std::iter::once(of_frames_s).chain(of_sets_s).any(|period_s| {
            let turns = hz * period_s;
            (turns - turns.round()).abs() < within_hz * period_s
        })
    }
}

/// Of the `variants` those whose line is `found` for their form; what goes with the ambient light and follows no steps is a lamp.
pub fn sort_out(variants: &mut Vec<Variant>, found: &Found, series: &Series) {
    variants.retain_mut(|variant| {
        let Some(piece) = variant.pieces.first() else { return false };
        let beat_hz = piece.values[BEAT];
        let is_of_line = found.instead.contains(&beat_hz);
        // What follows the steps and goes with the camera's own light is a part of that which comes late, too.
        if !without_steps(piece) {
            return !is_of_line && piece.values[GOES_WITH] >= 0.0;
        }
        let is_near = is_seen_as_lamps(beat_hz, series.frame_period_s, NEAR_MAINS);
        let is_light = piece.values[GOES_WITH] <= 0.0;
        variant.rarity *= if is_near { OF_LAMPS } else { 1.0 };
        is_of_line && is_light
    });
}

/// Whether what is fitted of a piece of it does not follow the phase steps.
pub fn without_steps(piece: &Piece) -> bool {
    let strengths = piece.free.iter().map(|&number| &piece.effect.parameters[number]);
    strengths.filter(|parameter| parameter.has_shapes()).all(|parameter| parameter.is_instead)
}

/// So many standard deviations of a strength show light.
const SEEN: f64 = 4.0;

/// How many numbers say where it falls.
const NUMBERS: usize = SPOT.end - SPOT.start;
type Spot = SVector<f64, NUMBERS>;
type SpotCovariance = SMatrix<f64, NUMBERS, NUMBERS>;

/// What is `fitted`, with a part of the image on which another camera's light that is in it falls, the same in all recordings, where that fits clearly better.
pub fn with_spot(data: &Data, fitted: Fit, noise: Noise) -> Fit {
    let Some((each, spot, _)) = spot(data, &fitted, noise, &|piece| !has_spot(piece)) else { return fitted };
    // At a bound it is something else.
    let is_within = |(value, known): (&f64, &Parameter)| *value > known.bounds.0 && *value < known.bounds.1;
    if !spot.iter().zip(&EFFECT.parameters[SPOT]).all(is_within) {
        return fitted;
    }
    let mut pieces = each.pieces.clone();
    for piece in pieces.iter_mut().filter(|piece| piece.effect.name == OTHER_CAMERA) {
        piece.values[SPOT].copy_from_slice(spot.as_slice());
        piece.free.retain(|number| !SPOT.contains(number));
    }
    let most = fitted.cost() - NEEDED_NATS - SPOT.len() as f64;
    let with = fit_below(data, &each, pieces, noise, most);
    let better = (with.cost() < most).then(|| finished(data, with, noise)).filter(|with| !is_bounded(with));
    better.unwrap_or(fitted)
}

/// Standard deviations of the numbers that say where another camera's light falls, if what is `fitted` has them.
pub fn spot_sigmas(data: &Data, fitted: &Fit, noise: Noise) -> Option<[f64; NUMBERS]> {
    let (.., covariance) = spot(data, fitted, noise, &has_spot)?;
    Some(std::array::from_fn(|number| covariance[(number, number)].max(0.0).sqrt()))
}

/// Whether it has another brightness in each part of the image.
fn has_spot(piece: &Piece) -> bool {
    piece.values[SPOT].iter().any(|value| *value != 0.0)
}

/// Light falls on a part of an image where its darkest place has less than this share of its brightest.
const PART: f64 = 0.5;

/// Whether it falls on a part of the image of so many `pixels`.
pub fn is_of_a_part(piece: &Piece, pixels: &Pixels) -> bool {
    let falls = multi_camera_interference::spot(&piece.values[SPOT], pixels);
    falls.is_some_and(|falls| falls.into_iter().fold(1.0, f64::min) < PART)
}

/// What is `fitted` where each recording has a spot of its own, the spot that these say together, each as far as it knows, and its covariance; nothing where there are none of which `is_it`.
fn spot(
    data: &Data,
    fitted: &Fit,
    noise: Noise,
    is_it: &dyn Fn(&Piece) -> bool,
) -> Option<(Fit, Spot, SpotCovariance)> {
    let mut pieces = fitted.pieces.clone();
    let is_own = |&number: &usize| pieces[number].effect.name == OTHER_CAMERA && is_it(&pieces[number]);
    let own: Vec<usize> = (0..pieces.len()).filter(is_own).collect();
    own.first()?;
    own.iter().for_each(|&number| pieces[number].free.extend(SPOT));
    let each = fit(data, Some(fitted), pieces, noise, &|_| true);
    let (mut matrix, mut vector) = (SpotCovariance::zeros(), Spot::zeros());
    for number in own {
        let piece = &each.pieces[number];
        let columns: Vec<usize> = SPOT.map(|of| each.column_of(number, of)).collect::<Option<_>>()?;
        // A recording in which nothing is seen has a spot anywhere.
        let is_clear = |&of: &usize| {
            let column = each.column_of(number, of).filter(|_| piece.effect.parameters[of].has_shapes());
            column.is_some_and(|column| piece.values[of].abs() > SEEN * each.sigma(column))
        };
        if !piece.free.iter().any(is_clear) {
            continue;
        }
        let covariance = SpotCovariance::from_fn(|a, b| each.covariance[(columns[a], columns[b])]);
        let values = Spot::from_column_slice(&piece.values[SPOT]);
        if let Some(information) = covariance.try_inverse().filter(|of| of.iter().all(|of| of.is_finite())) {
            matrix += information;
            vector += information * values;
        }
    }
    let covariance = matrix.try_inverse()?;
    let spot = covariance * vector;
    spot.iter().all(|value| value.is_finite()).then_some((each, spot, covariance))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::periodic::lines::FrameSeen;
    use crate::physics::Draws;
    use std::f64::consts::TAU;

    /// What two recordings of 120 sets of four frames, so many seconds apart, that begin every so many, show of the offset by time and number of the frame.
    fn series((frame_s, set_s): (f64, f64), offset: &dyn Fn(f64, usize) -> f64) -> Series {
        let mut series = Series { frame_period_s: frame_s, ..Series::default() };
        for take in 0..2 {
            let noise = Draws::of(take as u64, 3).normal(480);
            for (number, noise) in noise.into_iter().enumerate() {
                let (set, frame) = (number / 4, number % 4);
                let time_s = set_s * set as f64 + frame_s * frame as f64;
                if frame == 0 {
                    series.sets.push(SetSeen { take, time_s, ..SetSeen::default() });
                }
                let ambient = (offset(time_s, frame) + noise, 1.0);
                series.frames.push(FrameSeen { take, time_s, ambient, ..FrameSeen::default() });
            }
        }
        series
    }

    const TIMES: [(f64, f64); 4] = [(0.025, 0.1), (0.025, 0.275), (0.002, 1.0 / 30.0), (0.025, 0.3)];

    #[test]
    fn a_line_of_another_light_is_heard() {
        for times in TIMES {
            let line = series(times, &|time_s, _| (TAU * 7.31 * time_s).cos()).line_of_no_lamp();
            assert!(line.is_some_and(|line| (line.frequency - 7.31).abs() < 0.05), "{times:?} {line:?}");
        }
    }

    /// Neither a lamp's line, nor noise, nor what a frame of each set has, whether sets follow one another or not.
    #[test]
    fn a_lamp_and_what_sets_have_alike_are_no_other_light() {
        for times in TIMES {
            let silent = |offset: &dyn Fn(f64, usize) -> f64| {
                let line = series(times, offset).line_of_no_lamp();
                assert!(line.is_none(), "{times:?} {line:?}");
            };
            silent(&|_, _| 0.0);
            silent(&|_, frame| [5.0, -5.0, 5.0, -5.0][frame]);
            silent(&|_, frame| [0.0, 0.0, 5.0, 0.0][frame]);
            if times.0 > 0.01 {
                silent(&|time_s, _| (TAU * 100.3 * time_s).cos());
            }
        }
        assert!(Series::default().line_of_no_lamp().is_none());
        // Not all frequencies of frames that are a nanosecond apart are looked at.
        let quick = series((1e-9, 0.1), &|_, _| 0.0).line_of_no_lamp();
        assert!(quick.is_none(), "{quick:?}");
    }
}
