//! Names that look right and are not: a line of several sources or of no lamp, a wave over the codes that is none.

use super::columns::Tangents;
use super::data::Data;
use super::gram::{Gram, Whitened};
use super::lamps::{FLICKER, FLICKER_HZ};
use super::lines::Series;
use super::location::Location;
use super::mismatch::Place;
use super::noise::Noise;
use super::overtones::{OF_CODES, overtones};
use super::search::{Found, Named};
use super::source::{Shown, is_one, shown};
use super::steps::step;

/// Of what was `found`, the effect that is not what has its name, and where that lives; noise has `inflation` times the variance that was stated.
pub fn misnamed(
    data: &Data,
    found: &Found,
    baseline: &Location,
    noise: Noise,
    inflation: f64,
) -> Option<(&'static str, Place)> {
    // Where nothing of the camera is described, overtones may be anything else that is left.
    let waves = || if data.assumed.camera { None } else { no_wave(data, found, baseline, noise) };
    no_lamp(data, found, noise, inflation).or_else(waves)
}

/// Where something goes with the code that was taken for a wave, but has overtones, or is a step.
fn no_wave(data: &Data, found: &Found, baseline: &Location, noise: Noise) -> Option<(&'static str, Place)> {
    let named = found.named.iter().find(|named| named.name == OF_CODES)?;
    // A step has overtones, too, and repeats nowhere.
    let shape = match step(data, found, noise) {
        Some(level_dn) => format!("a step near a signal of {level_dn:.0} DN above the pedestal"),
        None => {
            let period_dn = overtones(data, found, noise)?;
            format!("a pattern that repeats every {period_dn:.1} DN and is no wave")
        }
    };
    let (ln_bayes, chi2, take) = (stands_for(named), named.score, baseline.take);
    Some((OF_CODES, Place { coordinate: "code", shape, ln_bayes, chi2, looked: 1.0, take, is_random: false }))
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
fn no_lamp(data: &Data, found: &Found, noise: Noise, inflation: f64) -> Option<(&'static str, Place)> {
    let named = found.named.iter().find(|named| named.name == FLICKER)?;
    let shown = shown(&found.fit, inflation);
    let clear = |shown: &Shown| shown.size.0 / shown.size.1;
    let clearest = shown.iter().max_by(|a, b| clear(a).total_cmp(&clear(b)))?;
    // What else was named has lines of its own.
    let series = without(data, found, noise, FLICKER);
    let what = match is_one(&shown) {
        false => "differs from recording to recording",
        true if clearest.size.0 - CLEARLY * clearest.size.1 > ALL_LIGHT => {
            "swings by more than all ambient light"
        }
        true if !series.may_be_lamps(clearest.hz, inflation) => "is not twice the mains' frequency",
        true => return None,
    };
    let shape = format!("offset, a line of {:.2} Hz that {what}", clearest.hz);
    let looked = series.in_time(FLICKER_HZ).map_or(1.0, |line| line.looked);
    let (ln_bayes, chi2, take) = (stands_for(named), named.score, clearest.take);
    Some((FLICKER, Place { coordinate: "time_s", shape, ln_bayes, chi2, looked, take, is_random: false }))
}

/// What frames and sets say where the effect of this `name` is taken out of what was `found`, and all else is as it was fitted.
fn without(data: &Data, found: &Found, noise: Noise, name: &str) -> Series {
    let others = found.fit.pieces_without(name);
    let (tangents, _) = Tangents::new(data, &found.fit.pixels, &others, &[]);
    let visit = |series: Series, whitened: &Whitened| series.with(data, whitened);
    Gram::visited(data, &tangents, noise, &|_| true, &visit, &Series::and).1
}
