//! A campaign to be examined: drawn, with its label.

use super::draw::{Scale, world};
use super::label::{Hidden, Label, NEAR};
use super::limit::limit;
use super::truth::truths;
use crate::problem::{Problem, Result};
use crate::recording::Recording;
use crate::time_domain::{Flaw, Hook, Known, Mechanism, Movie, Ruler, World, flaws, movie, recordings};
use rand::seq::{IndexedRandom, SliceRandom};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use std::fmt;

/// How a campaign is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CaseKind {
    /// No effect.
    Clean,
    /// One.
    Single,
    /// Two, of different groups of look-alikes.
    Pair,
    /// Two of one group.
    Alike,
    /// One under another that is several times as strong.
    Under,
    /// One under another that is so strong that what its form leaves might be as much.
    FarUnder,
    /// One that no library has.
    Outside,
}

/// Every kind with its share of the cases, its range of strengths, how many times as strong the first of two effects is, and its name in a table.
const KINDS: &[(CaseKind, usize, [f64; 2], f64, &str)] = &[
    (CaseKind::Clean, 20, [0.0, 0.0], 1.0, "clean"),
    (CaseKind::Single, 34, [4.0, 60.0], 1.0, "one effect"),
    (CaseKind::Pair, 13, [8.0, 60.0], 1.0, "two effects"),
    (CaseKind::Alike, 7, [12.0, 60.0], 1.0, "two look-alikes"),
    (CaseKind::Under, 5, [8.0, 15.0], 5.0, "one under a larger"),
    (CaseKind::FarUnder, 6, [15.0, 30.0], 40.0, "one far under"),
    (CaseKind::Outside, 15, [6.0, 60.0], 1.0, "outside the library"),
];
/// Worlds that are tried until an effect has its strength in one: few effects can be as strong as a thousand standard deviations.
const TRIALS: usize = 400;
/// So much of how many times as strong the first one is to be, it is.
const LARGER_SHARE: f64 = 0.5;
/// Below this strength an effect is not worth a case.
const FAINTEST: f64 = 4.0;
/// Shapes of another effect that are tried for likeness.
const SHAPES: usize = 3;
/// Names that no recording at one modulation frequency tells apart.
const SAME: [(&str, &str); 1] = [("encoder_scale", "modulation_frequency_error")];

impl fmt::Display for CaseKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = KINDS.iter().find(|row| row.0 == *self).map_or("", |row| row.4);
        f.write_str(name)
    }
}

/// A case that has been drawn and not yet made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Case {
    number: usize,
    digits: usize,
    kind: CaseKind,
    seed: u64,
    scale: Scale,
}

/// `count` cases that follow from `seed`, kinds by their shares in an order of chance; `tiny` ones for tests.
pub fn drawn(count: usize, seed: u64, tiny: bool) -> Vec<Case> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let all: usize = KINDS.iter().map(|row| row.1).sum();
    // The share of each kind of the first n cases, n = 1 … count: whole numbers that differ from the shares by less than one.
    let mut kinds: Vec<CaseKind> = (0..count)
        .map(|number| {
            let mut place = (2 * number + 1) * all / (2 * count).max(1);
            KINDS
                .iter()
                .find(|row| {
                    let found = place < row.1;
                    place = place.saturating_sub(row.1);
                    found
                })
                .map_or(CaseKind::Clean, |row| row.0)
        })
        .collect();
    kinds.shuffle(&mut random);
    let digits = count.max(1).to_string().len().max(3);
    let scale = if tiny { Scale::Tiny } else { Scale::Any };
    let case = |(number, kind)| Case { number: number + 1, digits, kind, seed: random.random(), scale };
    kinds.into_iter().enumerate().map(case).collect()
}

/// What is wrong in a campaign, and how strong it is.
struct Drawn {
    world: World,
    known: Known,
    /// With its strength alone, and beside the other one.
    flaws: Vec<(Flaw, f64, f64)>,
    rho: f64,
    near: Vec<Vec<String>>,
}

impl Case {
    /// The campaign's folder.
    pub fn name(&self) -> String {
        format!("{:0digits$}", self.number, digits = self.digits)
    }

    /// How it is drawn.
    pub fn kind(&self) -> CaseKind {
        self.kind
    }

    /// Its label and its recordings.
    ///
    /// # Errors
    /// No world in which the effects have their strengths was found.
    pub fn made(&self) -> Result<(Label, Vec<Recording>)> {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        for _ in 0..TRIALS {
            let mechanisms = self.mechanisms(&mut random);
            if let Some(drawn) = self.trial(&mechanisms, &mut random) {
                let flaws: Vec<&Flaw> = drawn.flaws.iter().map(|(flaw, ..)| flaw).collect();
                let seed = random.random();
                let recordings = recordings(&drawn.world, drawn.known, &flaws, seed);
                let noisy = movie(&drawn.world, Known::BOTH, &flaws, Some(seed));
                let own: Vec<Flaw> = flaws.into_iter().cloned().collect();
                let ruler = Ruler::of(&drawn.world);
                let limit = limit(&ruler, drawn.known, &own, noisy, &mut random);
                return Ok((Label { limit, ..self.label(&drawn) }, recordings));
            }
        }
        Err(Problem::at(
            format_args!("case {}", self.name()),
            format_args!("no campaign of the kind \"{}\" in {TRIALS} trials", self.kind),
        )
        .expected("a random world in which the effects have their strengths")
        .remedy("take another seed"))
    }

    /// Which mechanisms are at work.
    fn mechanisms(&self, random: &mut ChaCha8Rng) -> Vec<&'static Mechanism> {
        let inside: Vec<&'static Mechanism> = flaws::all().filter(|row| !row.is_outside()).collect();
        let Some(first) = inside.choose(random).copied() else { return Vec::new() };
        let second = |random: &mut ChaCha8Rng, alike: bool| {
            let fits = |row: &&&Mechanism| {
                row.name != first.name && (row.group == first.group) == alike && !same(row.name, first.name)
            };
            let others: Vec<&'static Mechanism> = inside.iter().filter(fits).copied().collect();
            others.choose(random).copied()
        };
        match self.kind {
            CaseKind::Clean => Vec::new(),
            CaseKind::Single => vec![first],
            CaseKind::Pair | CaseKind::Under | CaseKind::FarUnder => {
                std::iter::once(first).chain(second(random, false)).collect()
            }
            CaseKind::Alike => std::iter::once(first).chain(second(random, true)).collect(),
            CaseKind::Outside => {
                let outside: Vec<&'static Mechanism> = flaws::all().filter(|row| row.is_outside()).collect();
                outside.choose(random).copied().into_iter().collect()
            }
        }
    }

    /// A world with `mechanisms` at drawn strengths; nothing where one cannot have its strength there.
    fn trial(&self, mechanisms: &[&'static Mechanism], random: &mut ChaCha8Rng) -> Option<Drawn> {
        use CaseKind::{Alike, FarUnder, Pair, Under};
        let two = matches!(self.kind, Pair | Alike | Under | FarUnder);
        if two && mechanisms.len() != 2 {
            return None;
        }
        let wants_motion = |row: &&Mechanism| {
            matches!(row.hook, Hook::Unknown)
                || ["encoder_latency", "timing_jitter_of_frames"].contains(&row.name)
        };
        let world = world(random, mechanisms.iter().any(wants_motion), self.scale);
        let known = Known::without(mechanisms.iter().map(|row| row.name));
        let row = KINDS.iter().find(|row| row.0 == self.kind);
        let ([low, high], larger) = row.map_or(([0.0; 2], 1.0), |row| (row.2, row.3));
        let draws: Vec<(f64, u64)> =
            mechanisms.iter().map(|_| (low * (high / low).powf(random.random()), random.random())).collect();
        if mechanisms.is_empty() {
            return Some(Drawn { world, known, flaws: Vec::new(), rho: 0.0, near: Vec::new() });
        }
        let ruler = Ruler::of(&world);
        let mut found = Vec::new();
        let mut changes = Vec::new();
        for (index, (mechanism, &(rho, seed))) in mechanisms.iter().zip(&draws).enumerate() {
            let times = if index == 0 { larger } else { 1.0 };
            let flaw = Flaw::drawn(mechanism, seed);
            // There is only one size of what is the world's own.
            let is_own = matches!(mechanism.hook, Hook::Unknown);
            let flaw = if is_own { flaw } else { ruler.sized(&flaw, times * rho)? };
            changes.push(ruler.change(Known::without([mechanism.name]), &[&flaw]));
            found.push(flaw);
        }
        let rhos: Vec<f64> = changes.iter().map(|change| ruler.norm(change)).collect();
        let beside: Vec<f64> = match &changes[..] {
            [one, other] => vec![ruler.norm_beside(one, &[other]), ruler.norm_beside(other, &[one])],
            _ => rhos.clone(),
        };
        // What has only the world's size may be anything.
        let is_larger = larger == 1.0 || rhos[0] >= LARGER_SHARE * larger * rhos[1];
        if beside.iter().any(|rho| *rho < FAINTEST) || !is_larger {
            return None;
        }
        let near = near(&ruler, &found, &changes, random);
        let flaws: Vec<&Flaw> = found.iter().collect();
        let rho = ruler.norm(&ruler.change(known, &flaws));
        drop(ruler);
        let strengths = rhos.into_iter().zip(beside);
        let flaws =
            found.into_iter().zip(strengths).map(|(flaw, (rho, beside))| (flaw, rho, beside)).collect();
        Some(Drawn { world, known, flaws, rho, near })
    }

    fn label(&self, drawn: &Drawn) -> Label {
        let hidden = |(flaw, rho, beside): &(Flaw, f64, f64)| Hidden {
            name: flaw.mechanism.name.to_owned(),
            size: short(flaw.size),
            unit: flaw.mechanism.unit.to_owned(),
            rho: short(*rho),
            rho_beside: short(*beside),
            parameters: truths(flaw, &drawn.world),
        };
        let (outside, inside): (Vec<_>, Vec<_>) =
            drawn.flaws.iter().partition(|(flaw, ..)| flaw.mechanism.is_outside());
        let effects: Vec<Hidden> = inside.into_iter().map(hidden).collect();
        let lives = outside.iter().flat_map(|(flaw, ..)| flaw.mechanism.lives);
        let or = SAME.iter().filter_map(|&(one, other)| {
            let swap = |name: &str| match name {
                name if name == one => other.to_owned(),
                name if name == other => one.to_owned(),
                name => name.to_owned(),
            };
            let names: Vec<String> = effects.iter().map(|hidden| swap(&hidden.name)).collect();
            let differs = names.iter().zip(&effects).any(|(name, hidden)| *name != hidden.name);
            differs.then_some(names)
        });
        Label {
            case: self.name(),
            kind: self.kind,
            or: or.collect(),
            near: drawn.near.clone(),
            limit: Vec::new(),
            lives: lives.map(|&name| name.to_owned()).collect(),
            outside: outside.first().map(|&flaw| hidden(flaw)),
            effects,
            rho: short(drawn.rho),
        }
    }
}

/// Sets of names in which one of the flaws is another effect, some sum of whose shapes would leave next to nothing of its change.
fn near(ruler: &Ruler, flaws: &[Flaw], changes: &[Movie], random: &mut ChaCha8Rng) -> Vec<Vec<String>> {
    let names: Vec<&str> = flaws.iter().map(|flaw| flaw.mechanism.name).collect();
    let mut sets = Vec::new();
    if flaws.iter().any(|flaw| flaw.mechanism.is_outside()) {
        return sets;
    }
    let others = flaws::all().filter(|row| {
        let is_own = names.iter().any(|name| row.name == *name || same(row.name, name));
        !row.is_outside() && !is_own && !matches!(row.hook, Hook::Unknown)
    });
    for other in others {
        let shapes: Vec<Movie> =
            (0..SHAPES).map(|_| ruler.change(Known::BOTH, &[&Flaw::drawn(other, random.random())])).collect();
        for (place, change) in changes.iter().enumerate() {
            let beside = changes.iter().enumerate().filter(|(index, _)| *index != place);
            let all: Vec<&Movie> = shapes.iter().chain(beside.map(|(_, change)| change)).collect();
            if ruler.norm_beside(change, &all) < NEAR {
                let name = |index| if index == place { other.name } else { names[index] };
                sets.push((0..names.len()).map(|index| name(index).to_owned()).collect());
            }
        }
    }
    sets
}

fn same(one: &str, other: &str) -> bool {
    SAME.iter().any(|&pair| pair == (one, other) || pair == (other, one))
}

/// Four significant digits: enough to know, and few enough to be read back as the same number.
fn short(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
