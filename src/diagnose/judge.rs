//! From a search and a location to a judgement: clean, explained, partly explained, unexplained.

use super::clusters::{Cluster, Level, MODES};
use super::data::Data;
use super::fit::{Fit, fit, unfitted};
use super::gram::Noise;
use super::location::{Located, Location, locate};
use super::pass::DISBELIEF;
use super::pieces::{Piece, tolerance};
use super::search::{Found, Named, search};
use crate::physics::effects;

/// Evidence (nats) from which on a coordinate counts as located.
const LOCATED_NATS: f64 = 4.0;
/// The same for errors that samples share at random: twenty of them are looked at.
const CLUSTER_NATS: f64 = 6.0;
/// A set's common position error up to this is the encoder's usual noise, m.
const USUAL_JITTER_M: f64 = 0.5e-3;
/// Of what random errors explain, columns of a coordinate must explain so much to be what they are.
const ORDERED_SHARE: f64 = 0.2;
/// What an effect's freedom costs, nats, where its evidence is taken from its fit.
const OCCAM_NATS: f64 = 10.0;
/// How often the noise is corrected.
const NOISE_STEPS: usize = 3;

/// Where a mismatch lives.
#[derive(Debug, Clone)]
pub struct Place {
    /// Coordinate of the verdict.
    pub coordinate: &'static str,
    /// What stands out, in words.
    pub shape: String,
    /// Evidence, nats.
    pub ln_bayes: f64,
    /// Chi squared that it explains, and by how many numbers.
    pub chi2: (f64, usize),
    /// The recording that shows it most; of columns, the one with the greatest misfit.
    pub take: usize,
    /// Whether samples share it at random.
    pub is_random: bool,
}

/// The judgement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Simulation and recordings agree.
    Clean,
    /// The named effects bring the fit to the noise.
    Explained,
    /// Something named, something left.
    PartlyExplained,
    /// A mismatch, and nothing known that makes it.
    Unexplained,
}

/// Everything that a diagnosis finds.
#[derive(Debug)]
pub struct Judgement {
    /// In one word.
    pub verdict: Verdict,
    /// Where the recordings differ from the simulation that the camera describes, most significant first.
    pub places: Vec<Place>,
    /// Where they still differ from the fitted model.
    pub left: Vec<Place>,
    /// The effects that are asserted.
    pub named: Vec<Named>,
    /// Of the mismatch, the share that the named effects leave.
    pub remainder: f64,
    /// What is left by the simulation that the camera describes, and by the fit that is asserted.
    pub locations: [Location; 2],
    /// A random effect, and its standard deviation.
    pub random: Option<(&'static str, f64)>,
    /// The search behind it.
    pub found: Found,
    /// The fit that is asserted: the baseline where nothing is.
    pub fit: Fit,
    /// The noise, corrected where the camera's description has it too small.
    pub noise: Noise,
}

/// Diagnoses `data`, whose noise is `stated`, and to which `baseline` was fitted without any effect.
pub fn judge(data: &Data, baseline: Fit, stated: Noise) -> Judgement {
    let mut noise = stated;
    let (mut found, mut end) = searched(data, baseline, noise);
    let mut excess: Option<Cluster> = None;
    for _ in 0..NOISE_STEPS {
        let Some(more) = noise_excess(data, &end) else { break };
        match more.mode {
            0 => noise.floor += more.sigma * more.sigma,
            _ => noise.square += more.sigma * more.sigma,
        }
        // The first says what it is; the others make it exact.
        excess = Some(excess.map_or(more, |first| Cluster { sigma: first.sigma.hypot(more.sigma), ..first }));
        (found, end) = searched(data, unfitted(data, noise), noise);
    }
    let baseline = if found.named.is_empty() { end.clone() } else { locate(data, &found.baseline, noise) };
    let mut places = places(data, &baseline);
    let left = self::places(data, &end);

    // What random errors let appear among the columns is not asserted.
    let inflation = real(data, &end).iter().map(|c| c.inflation).fold(1.0, f64::max);
    let stands = |named: &Named| named.ln_bayes - 0.5 * named.score.0 * (1.0 - 1.0 / inflation) > 1.0;
    let mut named: Vec<Named> = found.named.iter().filter(|named| stands(named)).cloned().collect();
    let explained: f64 = (found.baseline.chi2 - found.fit.chi2).max(0.0);
    let dropped = named.len() < found.named.len();

    // A random effect takes with it what is left at random.
    let random = random_effect(data, &end).or_else(|| {
        let excess = excess.filter(|excess| excess.mode == 1)?;
        Some(("excess_noise", excess))
    });
    let is_left = |place: &&Place| {
        random.as_ref().is_none_or(|(_, cluster)| {
            !place.is_random && deflated(cluster, place.ln_bayes, place.chi2.0) > LOCATED_NATS
        })
    };
    let rest = |place: &Place| place.chi2.0 - place.chi2.1 as f64;
    let rest: f64 = left.iter().filter(is_left).map(rest).fold(0.0, f64::max);
    let remainder = if rest > 0.0 { rest / (rest + explained) } else { 0.0 };
    // One coordinate that says more than several effects together is the simpler answer, whatever makes it.
    let mut evidences: Vec<f64> = found.named.iter().map(|named| named.ln_bayes).collect();
    // Of two that were found together it is that of both.
    evidences.dedup();
    // A fit may keep more than tangents promise.
    let kept = 0.5 * explained - OCCAM_NATS * found.named.len() as f64;
    let together: f64 = evidences.iter().sum::<f64>().max(kept);
    // Far from the baseline columns promise more than there is, and of several effects none is sure.
    let is_far = found.baseline.is_far_from(&found.fit);
    let simpler = found.named.len() > 1
        && !is_far
        && baseline.columns.first().is_some_and(|best| best.ln_bayes > together);
    let believed = named.iter().map(|named| DISBELIEF * tolerance(named.name)).fold(0.0, f64::max);
    let mut strength = None;
    if let Some((name, cluster)) = random {
        strength = Some((name, cluster.sigma));
        let score = (2.0 * cluster.ln_bayes, 1);
        named.push(Named { name, ln_bayes: cluster.ln_bayes, score, rivals: Vec::new() });
    }
    // A simulation of which nothing is described leaves out several things at once: what explains most of them is worth its name.
    let most_left = if data.assumed.camera { 0.5 } else { 0.1 };
    let verdict = if simpler {
        named.clear();
        Verdict::Unexplained
    } else if rest == 0.0 || !named.is_empty() && remainder < believed {
        if named.is_empty() { Verdict::Clean } else { Verdict::Explained }
    } else if random.is_some() && named.len() == 1 {
        Verdict::Explained
    } else if named.is_empty()
        || remainder > 0.5
        || named.len() == 1 && remainder > most_left
        || dropped
        || is_far
    {
        named.clear();
        Verdict::Unexplained
    } else {
        Verdict::PartlyExplained
    };
    // Codes without their low bits need no statistics.
    let verdict = if data.cut_bits > 0 && matches!(verdict, Verdict::Clean | Verdict::Explained) {
        let ln_bayes = found.baseline.samples as f64 * f64::from(data.cut_bits) * std::f64::consts::LN_2;
        strength = Some((effects::FIXED_POINT, f64::from(data.cut_bits)));
        let score = (2.0 * ln_bayes, 1);
        named.push(Named { name: effects::FIXED_POINT, ln_bayes, score, rivals: Vec::new() });
        Verdict::Explained
    } else {
        verdict
    };
    if verdict == Verdict::Clean {
        places.clear();
    }
    let fit = asserted(data, &found, &named, noise);
    let after = if fit.pieces.is_empty() { baseline.clone() } else { end };
    let locations = [baseline, after];
    Judgement { verdict, places, left, named, remainder, locations, random: strength, found, fit, noise }
}

/// The fit of what is `named` alone: the search may have found more than stands.
fn asserted(data: &Data, found: &Found, named: &[Named], noise: Noise) -> Fit {
    let stands = |piece: &&Piece| named.iter().any(|named| named.name == piece.effect.name);
    let pieces: Vec<Piece> = found.fit.pieces.iter().filter(stands).cloned().collect();
    if pieces.len() == found.fit.pieces.len() {
        found.fit.clone()
    } else if pieces.is_empty() {
        found.baseline.clone()
    } else {
        fit(data, Some(&found.baseline), pieces, noise, &|_| true)
    }
}

/// A search that trusts the forms of effects, if that brings the fit to the noise; else one that does not.
fn searched(data: &Data, baseline: Fit, noise: Noise) -> (Found, Location) {
    let found = search(data, baseline.clone(), noise, true);
    let end = locate(data, &found.fit, noise);
    // Far from the baseline no form was trusted.
    if found.baseline.is_far_from(&found.fit) || !found.trusts_forms() || places(data, &end).is_empty() {
        return (found, end);
    }
    let found = search(data, baseline, noise, false);
    let end = locate(data, &found.fit, noise);
    (found, end)
}

/// Noise that pixels do not share, beyond what was stated.
fn noise_excess(data: &Data, location: &Location) -> Option<Cluster> {
    let real = *real(data, location).first()?;
    let ordered = location.columns.first().map_or(0.0, |columns| columns.ln_bayes);
    (real.level == Level::Pixel && ordered < ORDERED_SHARE * real.ln_bayes).then_some(*real)
}

/// Random errors that are none of the encoder's usual noise, nor what that shows as elsewhere; best first.
fn real<'a>(data: &Data, location: &'a Location) -> Vec<&'a Cluster> {
    let metre_rad = data.takes.first().and_then(|take| take.moments.first());
    let metre_rad = metre_rad.map_or(1.0, |moment| crate::units::phase_rad(1.0, moment.frequency_hz));
    let is_usual = |cluster: &&Cluster| {
        let usual_sigma = match MODES[cluster.mode] {
            "phase" => USUAL_JITTER_M * metre_rad,
            "position" => USUAL_JITTER_M,
            _ => 0.0,
        };
        cluster.level == Level::Set && cluster.sigma < usual_sigma
    };
    let usual = location.clusters.iter().filter(is_usual).map(|cluster| cluster.ln_bayes);
    let least = usual.fold(CLUSTER_NATS, f64::max);
    location.clusters.iter().filter(|cluster| cluster.ln_bayes > least && !is_usual(cluster)).collect()
}

/// Evidence of columns that explain `chi2`, beside random errors: these make more of columns than noise does, by as much as they raise the
/// variance.
fn deflated(cluster: &Cluster, ln_bayes: f64, chi2: f64) -> f64 {
    ln_bayes - 0.5 * chi2 * (1.0 - 1.0 / cluster.inflation)
}

/// A random effect of the registry, if the strongest cluster is what it makes, and nothing orders it.
fn random_effect(data: &Data, location: &Location) -> Option<(&'static str, Cluster)> {
    let cluster = *real(data, location).first()?;
    let ordered = |located: &Located| deflated(cluster, located.ln_bayes, located.chi2.0);
    let ordered = location.columns.iter().map(ordered).fold(0.0, f64::max);
    if ordered > 0.02 * cluster.ln_bayes + LOCATED_NATS {
        return None;
    }
    let name = match (cluster.level, MODES[cluster.mode]) {
        (Level::Frame, "phase") => "clock_jitter",
        (Level::Frame, "position") => "timing_jitter_of_frames",
        _ => return None,
    };
    Some((name, *cluster))
}

/// Coordinates that stand out, most significant first.
fn places(data: &Data, location: &Location) -> Vec<Place> {
    let columns = location.columns.iter().filter(|located| located.ln_bayes > LOCATED_NATS);
    let mut places: Vec<Place> = columns
        .map(|located| Place {
            coordinate: located.coordinate,
            shape: located.shape.clone(),
            ln_bayes: located.ln_bayes,
            chi2: located.chi2,
            take: location.take,
            is_random: false,
        })
        .collect();
    let clusters = real(data, location);
    let ordered = places.first().map_or(0.0, |place| place.ln_bayes);
    if let Some(cluster) = clusters.first() {
        let place = Place {
            coordinate: coordinate(cluster),
            shape: format!(
                "random {} of {:.3e}, common to a {}",
                MODES[cluster.mode],
                cluster.sigma,
                common(cluster)
            ),
            ln_bayes: cluster.ln_bayes,
            chi2: (2.0 * cluster.ln_bayes, 1),
            take: cluster.take,
            is_random: true,
        };
        match ordered > ORDERED_SHARE * cluster.ln_bayes {
            true => places.push(place),
            false => places.insert(0, place),
        }
    }
    places
}

fn coordinate(cluster: &Cluster) -> &'static str {
    match cluster.level {
        Level::Set if MODES[cluster.mode] == "velocity" => "velocity_m_s",
        Level::Set if cluster.mode >= 2 => "encoder",
        Level::Set => "set",
        Level::Frame => "frame",
        Level::Row => "row",
        Level::Column => "column",
        Level::Neighbours => "neighbours",
        Level::Pixel => "amplitude",
    }
}

fn common(cluster: &Cluster) -> &'static str {
    match cluster.level {
        Level::Set => "set",
        Level::Frame => "frame",
        Level::Row => "row",
        Level::Column => "column",
        Level::Neighbours => "few neighbours",
        Level::Pixel => "pixel",
    }
}
