//! What samples share at random: the encoder's usual noise, noise of rows, columns and frames, noise of single pixels, or an effect.

use super::again::{self, Said};
use super::clusters::Cluster;
use super::described::coordinate;
use super::in_time::{is_line, is_of_few, is_shaken};
use super::jitters::Frame;
use super::levels::{Level, MODES};
use super::steady::is_steady;
use crate::diagnose::fitting::set_errors::Jitter;
use crate::diagnose::locating::location::{Located, Location};
use crate::diagnose::reading::data::Data;
use std::collections::BTreeSet;

/// Evidence (nats) from which on noise that has more than was stated counts, and random errors that effects of the registry make.
pub const CLUSTER_NATS: f64 = 7.0;
/// The same of errors that samples share in other ways: some twenty-five are looked at, at their best strength.
const NAMELESS_NATS: f64 = 8.5;
/// A set's common position error up to this is the encoder's usual noise, m.
const USUAL_JITTER_M: f64 = 0.5e-3;
/// Of what random errors explain, columns of a coordinate must explain so much to be what they are.
pub const ORDERED_SHARE: f64 = 0.2;
/// Of the evidence for a random effect, columns explain less, but for what noise makes of them.
const ORDERED_LEFT: (f64, f64) = (0.02, 4.0);
/// Of the evidence for a random effect, columns that order it have so much, and a part of the rest that numbers have by chance.
const ORDERED_MOST: f64 = 0.5;
/// So many frames at least must show an error before it is known what numbers explain of it by chance.
const FEW_FRAMES: f64 = 20.0;
/// Of what the forms of named effects may leave, so much may look as if it were random.
const AT_RANDOM: f64 = 0.05;
/// Frames that are off with so much of the evidence for noise of rows or columns, at least, are looked at themselves: a weak effect of theirs is found beside it.
const OF_FRAMES: f64 = 0.5;
/// Errors that are none of what noise lets appear have so many times the evidence that it may have.
const MORE_THAN_SHADOW: f64 = 2.0;
/// Frames' errors may have so many times the noise's variance for each set. (Of an error's information the pixels' own numbers take a part of one over the
/// number of sets.)
const TIED: f64 = 0.1;
/// Errors of rows, columns and frames that are less correlated than this, in standard deviations, are white: of eight lags (chi squared) one in two
/// thousand is above it by chance.
const WHITE: f64 = 5.0;

/// Random errors that are none of the encoder's usual noise, nor what that shows as elsewhere; best first.
fn unusual<'a>(data: &Data, location: &'a Location) -> Vec<&'a Cluster> {
    let of_effects = least_of_effects(data, location);
    // That it is rows or columns of sets which are off is asked where sets are.
    let of_sets = || location.clusters.iter().filter(|cluster| coordinate(cluster) == "set");
    let are_sets = |nats: f64| of_sets().any(|set| set.ln_bayes > NAMELESS_NATS && set.ln_bayes < nats);
    let is_asked = |cluster: &Cluster| match cluster.level {
        Level::RowOfSet | Level::ColumnOfSet => are_sets(cluster.ln_bayes),
        _ => true,
    };
    let least = |cluster: &Cluster| match effect_of(cluster) {
        Some(_) => of_effects,
        None => of_effects.max(NAMELESS_NATS),
    };
    location
        .clusters
        .iter()
        .filter(|cluster| cluster.ln_bayes > least(cluster) && is_asked(cluster) && !is_usual(data, cluster))
        .collect()
}

/// Whether an error is the encoder's usual noise.
fn is_usual(data: &Data, cluster: &Cluster) -> bool {
    let metre_rad = data.takes.first().and_then(|take| take.moments.first());
    let metre_rad = metre_rad.map_or(1.0, |moment| crate::units::phase_rad(1.0, moment.frequency_hz));
    let usual_sigma = match MODES[cluster.mode] {
        "phase" => USUAL_JITTER_M * metre_rad,
        "position" => USUAL_JITTER_M,
        _ => 0.0,
    };
    cluster.level == Level::Set && cluster.sigma < usual_sigma
}

/// Evidence (nats) from which on random errors that an effect makes count: at least as much as the encoder's usual noise has.
pub fn least_of_effects(data: &Data, location: &Location) -> f64 {
    let usual = location.clusters.iter().filter(|cluster| is_usual(data, cluster));
    usual.map(|cluster| cluster.ln_bayes).fold(CLUSTER_NATS, f64::max)
}

/// The effect of the registry that makes such errors.
fn effect_of(cluster: &Cluster) -> Option<&'static str> {
    match (cluster.level, MODES[cluster.mode]) {
        (Level::Frame, "phase") => Some(JITTERS[0]),
        (Level::Frame, "position") => Some(JITTERS[1]),
        _ => None,
    }
}

/// Noise beyond what was stated, of pixels, or offsets of rows, columns or frames that are white: a camera has it, and no physics is left
/// out. Rows and columns are white beside their frames, which must not be off about as clearly by what goes on, or repeats, themselves.
pub fn noise<'a>(data: &Data, location: &'a Location) -> Option<&'a Cluster> {
    let all = unusual(data, location);
    let strongest = *all.first()?;
    let is_not = |cluster: &Cluster| cluster.correlation.is_none_or(|correlation| correlation >= WHITE);
    let is_of_frames = |cluster: &&&Cluster| {
        let is_offset = cluster.level == Level::Frame && MODES[cluster.mode] == "offset";
        is_offset && cluster.ln_bayes > OF_FRAMES * strongest.ln_bayes
    };
    let is_white = !is_not(strongest) && !all.iter().find(is_of_frames).is_some_and(|frames| is_not(frames));
    (strongest.level == Level::Pixel || is_white).then_some(strongest)
}

/// Random errors that are no noise; best first. Beside noise those alone are known that an effect makes, that are more than a shadow of it, and that frames or sets show more clearly than
/// any others.
pub fn errors<'a>(data: &Data, location: &'a Location) -> Vec<&'a Cluster> {
    let all = unusual(data, location);
    let Some(noise) = noise(data, location) else { return all };
    let least = CLUSTER_NATS + MORE_THAN_SHADOW * shadow(noise.inflation, location.jitters.frames().len());
    let leads = |errors: &Cluster| {
        all.iter().all(|other| other.level != errors.level || other.ln_bayes <= errors.ln_bayes)
    };
    let is_more =
        |errors: &&&Cluster| effect_of(errors).is_some() && errors.ln_bayes > least && leads(errors);
    all.iter().filter(is_more).copied().collect()
}

/// Evidence (nats) of errors of so many frames that there seem to be where noise raises the variance of what frames say by `inflation`, in all alike: of each the likelihood's mean.
fn shadow(inflation: f64, frames: usize) -> f64 {
    0.5 * frames as f64 * (inflation - 1.0 - inflation.ln()).max(0.0)
}

/// By how much the standard deviation of errors of a `kind` of [`JITTERS`], which seems to be `sigma`, may be too great where noise raises the variance of what frames say by `inflation`.
fn of_shadow(location: &Location, kind: usize, sigma: f64, inflation: f64) -> f64 {
    let information = || location.jitters.frames().iter().map(|frame| SAID[kind](frame).1);
    let (sum, squares) = information().fold((0.0, 0.0), |(sum, squares), k| (sum + k, squares + k * k));
    let variance = sigma * sigma;
    let less = if squares > 0.0 { (inflation - 1.0).max(0.0) * sum / squares } else { 0.0 };
    sigma - (variance - less).max(0.0).sqrt()
}

/// By how much random errors, noise among them, raise the variance of what columns say; 1 where there are none.
pub fn inflation(data: &Data, location: &Location) -> f64 {
    unusual(data, location).iter().map(|cluster| cluster.inflation).fold(1.0, f64::max)
}

/// Whether there is noise of single pixels beyond what was stated, and nothing that orders it.
pub fn is_noisier(data: &Data, location: &Location) -> bool {
    let ordered = location.columns.first().map_or(0.0, |columns| columns.ln_bayes);
    noise(data, location)
        .is_some_and(|noise| noise.level == Level::Pixel && ordered < ORDERED_SHARE * noise.ln_bayes)
}

/// Evidence of columns that explain `chi2`, beside random errors which raise the variance by `inflation`: these make more of columns than
/// noise does.
pub fn deflated(inflation: f64, ln_bayes: f64, chi2: f64) -> f64 {
    ln_bayes - 0.5 * chi2 * (1.0 - 1.0 / inflation)
}

/// What the freedom of a few numbers costs at most, and what that of each of many does, nats.
const FREEDOM_NATS: (f64, f64) = (25.0, 5.0);
/// What that of each number costs at least, beside random errors.
const LEAST_FREEDOM_NATS: f64 = 3.0;

/// Evidence of a name, or of several, that explain `chi2` by so many `numbers`, beside random errors.
pub fn of_name(inflation: f64, ln_bayes: f64, (chi2, numbers): (f64, usize)) -> f64 {
    // A fit may explain much more, or less, than the tangents from which the evidence is.
    let most = FREEDOM_NATS.0.max(FREEDOM_NATS.1 * numbers as f64);
    let least = LEAST_FREEDOM_NATS * numbers as f64;
    let chi2 = chi2.max(2.0 * (ln_bayes + least)).min(2.0 * (ln_bayes + most));
    deflated(inflation, ln_bayes, chi2)
}

/// How strong a random effect is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strength {
    /// Its only parameter: a standard deviation, as a rule.
    pub value: f64,
    /// How exactly that is known, one standard deviation.
    pub sigma: f64,
}

/// A random effect of the registry.
#[derive(Debug, Clone, Copy)]
pub struct RandomEffect {
    /// Its name.
    pub name: &'static str,
    /// How strong it is.
    pub strength: Strength,
    /// Evidence, nats.
    pub ln_bayes: f64,
    /// By how much it raises the variance of what columns say.
    pub inflation: f64,
}

/// Noise in proportion to the signal, by the registry's name.
pub const EXCESS_NOISE: &str = "excess_noise";
/// Random errors of frames that the registry has: of the phase, and of the time.
pub const JITTERS: [&str; 2] = ["clock_jitter", "timing_jitter_of_frames"];
/// Of the evidence for a random effect, a second one beside it must have so much, and so many nats besides.
const SECOND: (f64, f64) = (0.005, 5.0);

/// Coordinate of columns that live where errors of a moving frame's time do: in the fastest frames.
const OF_THE_FASTEST: &str = "velocity_m_s";

/// Evidence of columns beside random errors which raise their variance by `inflation`, or, where these are seen best, by so much `there`, nats.
fn ordered(location: &Location, inflation: f64, there: f64) -> f64 {
    let inflation = |located: &Located| if located.coordinate == OF_THE_FASTEST { there } else { inflation };
    let left = |located: &Located| deflated(inflation(located), located.ln_bayes, located.chi2.0);
    location.columns.iter().map(left).fold(0.0, f64::max)
}

/// Whether columns of this evidence and so many numbers order a random error that so many frames show: what few of them show need not be random.
fn is_most(columns: f64, numbers: usize, ln_bayes: f64, frames: f64) -> bool {
    let by_chance = if frames < FEW_FRAMES { 0.0 } else { (numbers as f64 / frames).min(1.0) };
    columns > (ORDERED_MOST + (1.0 - ORDERED_MOST) * by_chance) * ln_bayes
}

/// Of [`JITTERS`], that of the time.
const TIME: usize = 1;
/// Score and information of a frame, of each of [`JITTERS`].
const SAID: [Said; 2] = [|frame| frame.phase, |frame| frame.time];

/// Whether errors of a `kind` of [`JITTERS`], which scatter by `sigma`, are new in each frame: neither steady, nor a line in time, nor those of a few frames.
fn is_new_in_each(location: &Location, kind: usize, sigma: f64) -> bool {
    let (jitters, of) = (&location.jitters, SAID[kind]);
    let is_in_time = is_line(jitters, of, sigma) || kind == TIME && is_shaken(jitters, of, sigma);
    !is_steady(jitters, kind, sigma) && !is_in_time && !is_of_few(jitters, of, sigma)
}

/// Both jitters, where frames show the other one, too, beside the `first`: more clearly than anything orders them.
pub fn two_jitters(location: &Location, first: RandomEffect) -> Option<[RandomEffect; 2]> {
    let number = JITTERS.iter().position(|name| *name == first.name)?;
    let both = location.jitters.both()?;
    let of = |number: usize, ln_bayes| RandomEffect {
        name: JITTERS[number],
        strength: both.strengths[number],
        ln_bayes,
        ..first
    };
    let least = SECOND.0 * first.ln_bayes + SECOND.1 + ordered(location, first.inflation, first.inflation);
    let other = 1 - number;
    let is_clear = both.beside.iter().all(|nats| *nats > least)
        && !is_steady(&location.jitters, other, both.strengths[other].value);
    is_clear.then(|| [of(number, first.ln_bayes), of(other, both.beside[other])])
}

/// A random effect of the registry, if the strongest errors are what it makes, and nothing orders them, and they have no mean.
pub fn random_effect(data: &Data, location: &Location) -> Option<RandomEffect> {
    let first = *errors(data, location).first()?;
    let Cluster { sigma, known_to, ln_bayes, inflation, inflation_there, .. } = *first;
    // As many as let the variance be known to its scatter.
    let frames = 0.5 * (sigma / known_to).powi(2);
    let orders = |located: &Located| is_most(located.ln_bayes, located.chi2.1, ln_bayes, frames);
    let least = ORDERED_LEFT.0 * ln_bayes + ORDERED_LEFT.1;
    if ordered(location, inflation, inflation_there) > least || location.columns.iter().any(orders) {
        return None;
    }
    let name = effect_of(first)?;
    let kind = JITTERS.iter().position(|jitter| *jitter == name)?;
    if !is_new_in_each(location, kind, sigma) {
        return None;
    }
    let beside = noise(data, location).map_or(0.0, |noise| of_shadow(location, kind, sigma, noise.inflation));
    // Noise adds something between nothing and that.
    let strength = Strength { value: sigma - 0.5 * beside, sigma: known_to.hypot(0.5 * beside) };
    Some(RandomEffect { name, strength, ln_bayes, inflation })
}

/// What frames are off by, phase (rad) and time (s), where the strongest errors of a `location` are those of a jitter of the registry, and not so strong
/// that the pixels' own numbers, which all sets share, tie the errors of different sets to each other.
pub fn jitter(data: &Data, location: &Location) -> Option<Jitter> {
    effect_of(errors(data, location).first()?)?;
    let frames = location.jitters.frames();
    let moves = frames.iter().any(|frame| frame.time.1 > 0.0);
    let (phase_rad, time_s) = location.jitters.likeliest([true, moves]);
    let sets: BTreeSet<usize> = frames.iter().map(|frame| frame.set).collect();
    // Over the noise, on average.
    let variance = |frame: &Frame| frame.phase.1 * phase_rad.powi(2) + frame.time.1 * time_s.powi(2);
    let variance = frames.iter().map(variance).sum::<f64>() / frames.len().max(1) as f64;
    let is_there = phase_rad > 0.0 || time_s > 0.0;
    (is_there && variance < TIED * sets.len() as f64).then_some([phase_rad, time_s])
}

/// Whether a random effect of this evidence, nats, is more than what looks so of the chi squared that the forms of named effects may leave.
pub fn is_beyond_forms(ln_bayes: f64, of_forms: f64) -> bool {
    ln_bayes > 0.5 * AT_RANDOM * of_forms
}

/// Whether frames may be off by as much light as at `random` by phase or time.
pub fn may_be_of_light(location: &Location, random: &RandomEffect) -> bool {
    let is_of_light = |cluster: &&Cluster| {
        cluster.level == Level::Frame && matches!(MODES[cluster.mode], "offset" | "gain" | "light")
    };
    let of_light = location.clusters.iter().filter(is_of_light).map(|cluster| cluster.ln_bayes);
    of_light.fold(0.0, f64::max) + CLUSTER_NATS > random.ln_bayes
}

/// Evidence for a jitter of the registry from how frames differ where the target is again, nats.
pub fn new_each_time(location: &Location, name: &str) -> f64 {
    let number = JITTERS.iter().position(|jitter| *jitter == name);
    number.map_or(0.0, |number| again::new_each_time(&location.jitters, SAID[number]))
}

#[cfg(test)]
mod tests {
    use super::{Location, OF_THE_FASTEST, deflated, is_beyond_forms, is_most, of_name, ordered};
    use crate::diagnose::locating::location::{Kind, Located};
    use crate::diagnose::shared_errors::jitters::Jitters;

    /// A time of frames beside charge crosstalk: 300 of chi squared by fifteen columns of the velocity, 115 nats, where such errors raise the variance 2.8 times
    /// on average, and sixty times in the fastest frames.
    #[test]
    fn columns_of_the_fastest_frames_order_less() {
        let of = |coordinate| {
            let located = Located {
                coordinate,
                shape: String::new(),
                ln_bayes: 115.0,
                chi2: (300.0, 15),
                looked: 1.0,
                kind: Kind::Columns,
            };
            let location = Location {
                columns: vec![located],
                clusters: Vec::new(),
                jitters: Jitters::default(),
                take: 0,
                tone: None,
                period_dn: None,
                curves: Vec::new(),
                map: Vec::new(),
            };
            ordered(&location, 2.8, 60.0)
        };
        assert_eq!((of(OF_THE_FASTEST), of("row")), (0.0, deflated(2.8, 115.0, 300.0)));
        assert!(of("row") > 15.0, "{}", of("row"));
    }

    #[test]
    fn what_a_strong_effect_nearly_explains_looks_random() {
        // A flicker and a phase by amplitude, of 85 781 and 7379, whose forms may leave a twenty-fifth; a falloff of 613 207, which is a law.
        let (flicker, falloff) = (0.04 * (85_781.0 + 7379.0), 1e-4 * 613_207.0);
        assert!(!is_beyond_forms(10.6, flicker));
        assert!(!is_beyond_forms(93.0, flicker) && is_beyond_forms(93.3, flicker));
        assert!(is_beyond_forms(7.0, falloff) && is_beyond_forms(7.0, 0.0));
    }

    #[test]
    fn evidence_is_less_beside_random_errors() {
        assert_eq!(deflated(1.0, 30.0, 70.0), 30.0);
        // 107 of chi squared are 7 beside noise of fifteen times the variance: nothing for ten numbers.
        assert!(deflated(15.0, 31.7, 107.0) < 0.0);
    }

    #[test]
    fn many_numbers_cost_their_share_beside_random_errors() {
        // A line of nine recordings that white frames let appear: 366 of chi squared for 27 numbers, beside four times the variance.
        assert!(of_name(4.0, 126.0, (366.0, 27)) < 0.0);
        // One number keeps a quarter of what it explains.
        assert!(of_name(4.0, 180.0, (366.0, 1)) > 40.0);
        // A fit that keeps more than tangents promise is not free of cost.
        assert!(of_name(237.0, 5788.0, (11000.0, 18)) < 0.0);
        assert_eq!(of_name(1.0, 126.0, (366.0, 27)), 126.0);
    }

    #[test]
    fn what_columns_order_is_not_random() {
        // The paper's bench with a strong multipath: eight frames at the greatest velocity have most of it.
        assert!(is_most(73_666.0, 9, 86_453.0, 8.0));
        // Of a hundred frames thirty numbers have three tenths by chance.
        assert!(!is_most(50_000.0, 30, 86_453.0, 100.0));
        assert!(is_most(73_666.0, 30, 86_453.0, 100.0));
        assert!(!is_most(80_000.0, 100, 86_453.0, 100.0));
    }
}
