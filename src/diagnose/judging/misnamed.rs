//! Names that look right and are not: a line of several sources or of no lamp, a step in time that is no drift, a wave over the codes that is none.

use super::hops::{Hop, hop};
use super::steps::{CURVES, step};
use crate::diagnose::fitting::gram::{Gram, Whitened};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::forms::other_camera::{OTHER_CAMERA, is_of_a_part, is_same, without_steps};
use crate::diagnose::forms::overtones::{OF_CODES, is_wave, overtones};
use crate::diagnose::locating::location::Location;
use crate::diagnose::locating::mismatch::Place;
use crate::diagnose::naming::found::{Found, Named};
use crate::diagnose::periodic::images::alike;
use crate::diagnose::periodic::lamps::{FLICKER, FLICKER_HZ};
use crate::diagnose::periodic::lines::{DRIFT_CYCLES, Line, Series};
use crate::diagnose::periodic::source::{Shown, is_one, shown};
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::columns::Tangents;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::effects::ambient_flicker::FREQUENCY;
use crate::physics::effects::multi_camera_interference::{BEAT, GOES_WITH};
use std::f64::consts::TAU;

/// What was named, and is something else.
pub struct Misnamed {
    /// The names.
    pub names: Vec<&'static str>,
    /// Where it lives.
    pub place: Place,
}

/// Of what was `found`, what is not what has its name, and where that lives; noise has `inflation` times the variance that was stated.
pub fn misnamed(
    data: &Data,
    found: &Found,
    baseline: &Location,
    noise: Noise,
    inflation: f64,
) -> Option<Misnamed> {
    // Where nothing of the camera is described, overtones may be anything else that is left.
    let waves = || if data.assumed.camera { None } else { no_wave(data, found, baseline, noise) };
    let drifts = || if data.assumed.camera { None } else { no_drift(data, found, noise) };
    no_lamp(data, found, noise, inflation)
        .or_else(|| no_beat(data, found, baseline))
        .or_else(drifts)
        .or_else(waves)
}

/// Where something changed at once that was taken for a drift.
fn no_drift(data: &Data, found: &Found, noise: Noise) -> Option<Misnamed> {
    let Hop { name, what, take, time_s } = hop(data, found, noise)?;
    let named = found.named.iter().find(|named| named.name == name)?;
    let place = Place {
        coordinate: "time_s",
        shape: format!("{what}, a step at {time_s:.1} s"),
        ln_bayes: stands_for(named),
        chi2: named.score,
        looked: 1.0,
        take,
        is_random: false,
    };
    Some(Misnamed { names: vec![name], place })
}

/// Where something goes with the code that was taken for a wave, but has overtones, or is a step.
fn no_wave(data: &Data, found: &Found, baseline: &Location, noise: Noise) -> Option<Misnamed> {
    found.fit.pieces.iter().find(|piece| is_wave(piece))?;
    // A step has overtones, too, and repeats nowhere.
    let (shape, is_it): (String, &[&str]) = match step(data, found, noise) {
        Some(level_dn) => (format!("a step near a signal of {level_dn:.0} DN above the pedestal"), &CURVES),
        None => {
            let period_dn = overtones(data, found, noise)?;
            (format!("a pattern that repeats every {period_dn:.1} DN and is no wave"), &[OF_CODES])
        }
    };
    let named: Vec<&Named> = found.named.iter().filter(|named| is_it.contains(&named.name)).collect();
    let chi2 = named.iter().fold((0.0, 0), |sum, named| (sum.0 + named.score.0, sum.1 + named.score.1));
    let ln_bayes = named.iter().map(|named| stands_for(named)).sum();
    let place = Place {
        coordinate: "code",
        shape,
        ln_bayes,
        chi2,
        looked: 1.0,
        take: baseline.take,
        is_random: false,
    };
    Some(Misnamed { names: named.iter().map(|named| named.name).collect(), place })
}

/// Evidence of what has this name, nats: no more than the fit kept of it.
fn stands_for(named: &Named) -> f64 {
    named.ln_bayes.min(0.5 * named.score.0)
}

/// What swings by more than this share of the ambient light, for which it is taken, is something else.
const ALL_LIGHT: f64 = 1.0;
/// By so many standard deviations.
const CLEARLY: f64 = 3.0;

/// Where a line is that was taken for a lamp's flicker, but has several sources, or is none that lamps on the mains have.
fn no_lamp(data: &Data, found: &Found, noise: Noise, inflation: f64) -> Option<Misnamed> {
    let named = found.named.iter().find(|named| named.name == FLICKER)?;
    let shown = shown(&found.fit, inflation);
    let clear = |shown: &Shown| shown.size.0 / shown.size.1;
    let clearest = shown.iter().max_by(|a, b| clear(a).total_cmp(&clear(b)))?;
    // What else was named has lines of its own.
    let series = without(data, found, noise, FLICKER);
    if let Some(beat) = series.beats_more(clearest.hz, inflation) {
        return Some(Misnamed { names: vec![FLICKER], place: of_beat(beat, shown.len(), clearest.take) });
    }
    let what = match is_one(&shown) {
        false => "differs from recording to recording",
        true if clearest.size.0 - CLEARLY * clearest.size.1 > ALL_LIGHT => {
            "swings by more than all ambient light"
        }
        true if !series.may_be_lamps(clearest.hz, inflation) => "is not twice the mains' frequency",
        true => return None,
    };
    let shape = format!("offset, a line of {} that {what}", alike(clearest.hz, series.frame_period_s));
    let looked = series.in_time(FLICKER_HZ).map_or(1.0, |line| line.looked);
    let (ln_bayes, chi2, take) = (stands_for(named), named.score, clearest.take);
    let place = Place { coordinate: "time_s", shape, ln_bayes, chi2, looked, take, is_random: false };
    Some(Misnamed { names: vec![FLICKER], place })
}

/// Where something was taken for another camera's light that has not one beat in all recordings, or none that turns; or, where it follows no steps, is no light that comes and goes, or falls on
/// all pixels alike, as a supply's hum does, a screen's light, or the ripple of this camera's own.
fn no_beat(data: &Data, found: &Found, baseline: &Location) -> Option<Misnamed> {
    let named = found.named.iter().find(|named| named.name == OTHER_CAMERA)?;
    let duration_s = |take: usize| {
        let times_s = || data.takes[take].moments.iter().map(|moment| moment.time_s);
        times_s().fold(f64::NEG_INFINITY, f64::max) - times_s().fold(f64::INFINITY, f64::min)
    };
    let pieces = || found.fit.pieces.iter().filter(|piece| piece.effect.name == OTHER_CAMERA);
    let beats: Vec<(f64, f64)> = pieces()
        .map(|piece| {
            let longest_s = piece.takes.iter().map(|&take| duration_s(take)).fold(0.0, f64::max);
            (piece.values[BEAT], longest_s)
        })
        .collect();
    let period_s = found.fit.series.frame_period_s;
    let longest = beats.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0.0, |beat| beat.0);
    let line = || alike(longest.abs(), period_s);
    // An error of the phase or of the place is a line in the offset that goes with the phase steps, too.
    let steps = data.takes.iter().filter_map(|take| match &take.moments[..] {
        [first, second, ..] => Some((second.step_rad - first.step_rad) / TAU),
        _ => None,
    });
    let shifts_hz: Vec<f64> = std::iter::once(0.0)
        .chain(steps.flat_map(|turns| [turns, -turns]))
        .map(|turns| turns / period_s)
        .collect();
    let is_seen_as = |hz: f64| shifts_hz.iter().any(|shift_hz| is_same(hz + shift_hz, longest, period_s));
    let tone =
        baseline.tone.filter(|tone| is_seen_as(tone.hz) && tone.found.chi2.0 > AS_MUCH * named.score.0);
    let is_one = is_one_beat(&beats);
    let shape = if !is_one {
        "offset, what may be a beat of one frequency in each recording, and is none in all".to_owned()
    } else if pieces().any(|piece| !without_steps(piece)) {
        return None;
    } else if let Some(tone) = tone {
        format!("{}, a tone of {}", tone.way, line())
    } else if !pieces().any(|piece| is_of_a_part(piece, &found.fit.pixels)) {
        let goes_with = pieces().next().map_or(0.0, |piece| piece.values[GOES_WITH]);
        let how = if goes_with < 0.0 { "goes with the camera's own light" } else { "all pixels have alike" };
        format!("offset, a line of {} that {how}", line())
    } else {
        return None;
    };
    // A lamp beside it that frames see alike is of the same.
    let is_lamp =
        |piece: &Piece| piece.effect.name == FLICKER && is_same(piece.values[FREQUENCY], longest, period_s);
    let lamp = found.named.iter().find(|named| named.name == FLICKER);
    let lamp = lamp.filter(|_| found.fit.pieces.iter().any(is_lamp));
    let names = std::iter::once(OTHER_CAMERA).chain(lamp.map(|lamp| lamp.name)).collect();
    let (chi2, numbers) = lamp.map_or((0.0, 0), |lamp| lamp.score);
    let ln_bayes = stands_for(named) + lamp.map_or(0.0, stands_for);
    let by_sets = baseline.columns.iter().filter(|located| located.comes_by_sets());
    let by_sets = by_sets.map(|located| located.ln_bayes).fold(0.0, f64::max);
    let place = Place {
        coordinate: "time_s",
        shape,
        ln_bayes: if is_one { ln_bayes } else { beside_sets(ln_bayes, by_sets) },
        chi2: (named.score.0 + chi2, named.score.1 + numbers),
        looked: 1.0,
        take: baseline.take,
        is_random: false,
    };
    Some(Misnamed { names, place })
}

/// What frames are off by together as a line, other than in offset, is no other light where that has so much of the chi squared that such light would explain.
const AS_MUCH: f64 = 0.5;

/// What comes again after so many sets is a line in each recording whose frequency goes with how far its sets are apart: it leads where it says this share of what such lines do.
const BY_SETS: f64 = 0.5;

/// Evidence of lines of which each recording has its own, no more than that of what comes again `by_sets` where that leads.
fn beside_sets(ln_bayes: f64, by_sets: f64) -> f64 {
    if by_sets > BY_SETS * ln_bayes { ln_bayes.min(by_sets) } else { ln_bayes }
}

/// Whether beats, each of a frequency (Hz) in recordings of which the longest takes so long (s), are one that turns.
fn is_one_beat(beats: &[(f64, f64)]) -> bool {
    let turns = beats.iter().any(|(hz, longest_s)| hz.abs() * longest_s > DRIFT_CYCLES);
    // A recording knows its frequency to a cycle over its length.
    let is_same =
        |(hz, s): &(f64, f64), (other, other_s): &(f64, f64)| (hz - other).abs() * s.min(*other_s) < 1.0;
    turns && beats.iter().all(|one| beats.iter().all(|other| is_same(one, other)))
}

/// Numbers of a beat cost so many nats each.
const FREEDOM_NATS: f64 = 3.0;

/// Where a beat is that so many recordings show, most of all this one: each has its own phase.
fn of_beat(beat: Line, recordings: usize, take: usize) -> Place {
    let numbers = 2 * recordings;
    Place {
        coordinate: "time_s",
        shape: format!(
            "offset, a beat of {:.2} Hz that follows the phase steps, as another light's that is modulated",
            beat.frequency.abs()
        ),
        ln_bayes: 0.5 * beat.chi2 - beat.looked.ln() - FREEDOM_NATS * numbers as f64,
        chi2: (beat.chi2, numbers),
        looked: beat.looked,
        take,
        is_random: false,
    }
}

/// What frames and sets say where the effect of this `name` is taken out of what was `found`, and all else is as it was fitted.
fn without(data: &Data, found: &Found, noise: Noise, name: &str) -> Series {
    let others = found.fit.pieces_without(name);
    let (tangents, _) = Tangents::new(data, &found.fit.pixels, &others, &[]);
    let visit = |series: Series, whitened: &Whitened| series.with(data, whitened);
    Gram::visited(data, &tangents, noise, &|_| true, &visit, &Series::and).1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every seventh set of six recordings is off: the sets say 164 nats of the 292 that a line in each recording does.
    #[test]
    fn what_comes_with_the_sets_leads() {
        assert_eq!([292.0, 100.0, 400.0].map(|lines| beside_sets(lines, 164.0)), [164.0, 100.0, 400.0]);
        assert_eq!(beside_sets(292.0, 0.0), 292.0);
    }

    #[test]
    fn a_beat_is_one_and_turns() {
        // Recordings of 10 and of 40 s: what the shorter one says is known to a tenth of a hertz.
        assert!(is_one_beat(&[(1.37, 10.0), (1.42, 40.0)]) && is_one_beat(&[(-1.37, 40.0)]));
        assert!(!is_one_beat(&[(1.37, 10.0), (1.48, 40.0)]) && !is_one_beat(&[(1.37, 40.0), (-1.37, 40.0)]));
        assert!(!is_one_beat(&[(0.07, 40.0), (0.07, 10.0)]));
    }
}
