//! The search: baseline, evidence of all candidates at once, fit of the best, and again for what is left.

use super::columns::Tangents;
use super::data::Data;
use super::evidence::{Block, Evidence, Model, is_seen};
use super::fit::{Fit, fit};
use super::gram::{Gram, Noise};
use super::pieces::{Candidate, Piece, candidates, tolerance};
use super::simpler::Simpler;
use std::collections::BTreeSet;

/// Less evidence than this (nats) asserts nothing.
pub const THRESHOLD: f64 = 1.0;
/// A rival within so many nats is possible too.
const RIVAL_NATS: f64 = 3.0;
/// Evidence (nats) that names an effect which explains less than the forms of others may leave.
const CLEAR_NATS: f64 = 8.0;
/// It explains at least this share of that.
const TRUSTED_SHARE: f64 = 0.03;
const MOST_EFFECTS: usize = 4;
/// Where the tangents need not hold, effects whose score is at least this share of the best one's are fitted before one is chosen.
const LEADING_SHARE: f64 = 0.8;
const MOST_LEADERS: usize = 5;
/// Without a camera's description much is left out at once: so much of what their forms may leave keeps further effects out.
const UNDESCRIBED: f64 = 0.1;
/// An effect without which chi squared, halved, rises by less than this and one more for each of its numbers was not needed.
const NEEDED_NATS: f64 = 6.0;
/// Beyond so much evidence (nats) the tangents at the baseline need not hold at the fit.
const STRONG_NATS: f64 = 30.0;

/// An effect that is asserted.
#[derive(Debug, Clone)]
pub struct Named {
    /// Its name.
    pub name: &'static str,
    /// Evidence when it was found, beside those before it, nats.
    pub ln_bayes: f64,
    /// Score statistic and its degrees of freedom when it was found.
    pub score: (f64, usize),
    /// Other effects that do about as well in the place of one that was found with it.
    pub rivals: Vec<String>,
}

/// What the search found.
#[derive(Debug)]
pub struct Found {
    /// The baseline's fit.
    pub baseline: Fit,
    /// The fit with what was found; the baseline where nothing was.
    pub fit: Fit,
    /// The effects, in the order in which they were found.
    pub named: Vec<Named>,
    /// Candidates whose every column is absorbed by the pixels' own numbers.
    pub invisible: Vec<&'static str>,
    /// Smallest strength of each effect's parameters that would be seen at 5 standard deviations: `(effect, parameter, value)`.
    pub detectable: Vec<(&'static str, usize, f64)>,
    /// Score statistic of each candidate alone at the baseline, its degrees of freedom, evidence: for `ruled_out`.
    pub alone: Vec<(&'static str, f64, usize, f64)>,
    /// What simpler methods name at the baseline.
    pub simpler: Simpler,
}

#[derive(Debug, Clone, Default)]
struct Pass {
    models: Vec<Model>,
    blocks: Vec<Block>,
    scores: Vec<Option<(f64, usize)>>,
    invisible: Vec<&'static str>,
    detectable: Vec<(&'static str, usize, f64)>,
    singles: Vec<f64>,
    simpler: Simpler,
}

/// All candidates at the fit `base`, with what it has fitted projected out.
fn pass(data: &Data, base: &Fit, candidates: &[Candidate], noise: Noise, jitter: Option<f64>) -> Pass {
    let (mut tried, mut blocks): (Vec<Piece>, Vec<Block>) = (Vec::new(), Vec::new());
    let mut column = base.columns.len();
    let mut parameters = vec![(usize::MAX, 0); column];
    for (number, candidate) in candidates.iter().enumerate() {
        // What is fitted already is not tried again.
        if base.pieces.iter().any(|piece| piece.effect.name == candidate.effect.name) {
            continue;
        }
        for (variant, of) in candidate.variants.iter().enumerate() {
            let mut columns = Vec::new();
            for piece in &of.pieces {
                for &parameter in &piece.free {
                    columns.push(column);
                    parameters.push((number, parameter));
                    column += 1;
                }
                tried.push(piece.clone());
            }
            blocks.push(Block { candidate: number, variant, variants: candidate.looked, columns });
        }
    }
    let (tangents, _) = Tangents::new(data, &base.pixels, &base.pieces, &tried);
    let gram = Gram::of(data, &tangents, noise, &|_| true);
    let mut projected = gram.project(jitter);
    projected.give_way(base.columns.len());
    let reach = |column: usize| {
        let (number, parameter) = parameters[column];
        candidates
            .get(number)
            .map_or(f64::INFINITY, |candidate| candidate.effect.parameters[parameter].reach())
    };
    let evidence = Evidence::new(
        &projected.matrix,
        &projected.vector,
        &projected.raw,
        &reach,
        &blocks,
        candidates.len(),
    );
    let scores: Vec<_> = (0..blocks.len()).map(|block| evidence.score(block)).collect();
    let unseen = |number: &usize| {
        let mut of = blocks.iter().zip(&scores).filter(|(block, _)| block.candidate == *number).peekable();
        of.peek().is_some() && of.all(|(_, score)| score.is_none())
    };
    let invisible =
        (0..candidates.len()).filter(unseen).map(|number| candidates[number].effect.name).collect();
    let mut detectable: Vec<(&'static str, usize, f64)> = Vec::new();
    for (column, &(number, parameter)) in parameters.iter().enumerate().filter(|(_, p)| p.0 != usize::MAX) {
        let information = projected.matrix[(column, column)];
        if is_seen(information, projected.raw[column], reach(column)) {
            let (name, value) = (candidates[number].effect.name, 5.0 / information.sqrt());
            match detectable.iter_mut().find(|row| row.0 == name && row.1 == parameter) {
                Some(row) => row.2 = row.2.min(value),
                None => detectable.push((name, parameter, value)),
            }
        }
    }
    let singles = (0..blocks.len()).map(|block| evidence.ln_bayes(&[block])).collect();
    let name = |block: &Block| candidates[block.candidate].effect.name;
    let simpler = match base.columns.len() {
        0 => Simpler::of(&evidence, &blocks, gram.samples, &name),
        _ => Simpler::default(),
    };
    Pass { simpler, models: evidence.models(), scores, invisible, detectable, singles, blocks }
}

impl Found {
    /// Whether an effect is named that explains less than the forms of those before it may leave.
    pub fn trusts_forms(&self) -> bool {
        let is_small = |(number, named): (usize, &Named)| named.score.0 < tolerated(&self.named[..number]);
        self.named.iter().enumerate().any(is_small)
    }
}

/// What stands of the named effects' evidence may come from their own form: this much of what they explain is theirs.
fn tolerated(named: &[Named]) -> f64 {
    named.iter().map(|named| tolerance(named.name) * named.score.0).sum()
}

/// Searches `data`, to which `baseline` was fitted without any effect.
///
/// With `trust` in the forms of effects, one that explains less than the others' forms may leave is named nevertheless, on clear evidence.
pub fn search(data: &Data, baseline: Fit, noise: Noise, trust: bool) -> Found {
    let mut alone = Vec::new();
    let mut current = baseline.clone();
    let mut named: Vec<Named> = Vec::new();
    let mut first: Option<Pass> = None;
    let share = if data.assumed.camera { UNDESCRIBED } else { 1.0 };
    loop {
        let candidates = candidates(data, &current.series);
        let pass = pass(data, &current, &candidates, noise, None);
        let next = pass.next(share * tolerated(&named), trust);
        first.get_or_insert_with(|| {
            alone = pass.alone(&candidates);
            pass.clone()
        });
        let Some((best, whole)) = next else { break };
        if best.blocks.len() + named.len() > MOST_EFFECTS {
            break;
        }
        let mut rivals = pass.rivals(&whole, &candidates);
        let with = |blocks: &[usize]| {
            let more = blocks.iter().map(|&block| &pass.blocks[block]);
            let more = more.flat_map(|b| candidates[b.candidate].variants[b.variant].pieces.iter().cloned());
            let pieces = current.pieces.iter().cloned().chain(more).collect();
            fit(data, Some(&current), pieces, noise, &|_| true)
        };
        let leaders = pass.leaders(&whole);
        let (best, fitted) = if leaders.len() < 2 {
            let fitted = with(&best.blocks);
            (best, fitted)
        } else {
            let fits = leaders.into_iter().map(|block| (block, with(&[block])));
            let (best, fitted, near) = pass.fittest(current.chi2, fits, &candidates);
            rivals.extend(near);
            rivals.retain(|rival| rival != pass.name(best.blocks[0], &candidates));
            (best, fitted)
        };
        rivals.extend(pass.near(&best, &candidates));
        let mut known = BTreeSet::new();
        rivals.retain(|rival| known.insert(rival.clone()));
        for &block in &best.blocks {
            let block_of = &pass.blocks[block];
            named.push(Named {
                name: candidates[block_of.candidate].effect.name,
                ln_bayes: best.ln_bayes,
                score: pass.scores[block].unwrap_or((0.0, 0)),
                rivals: rivals.clone(),
            });
        }
        current = fitted;
    }
    drop_needless(data, noise, &mut current, &mut named);
    let Pass { invisible, detectable, simpler, .. } = first.unwrap_or_default();
    Found { baseline, fit: current, named, invisible, detectable, alone, simpler }
}

/// Takes out of `current`, and of what is `named`, what is not needed beside the others, the least needed first.
fn drop_needless(data: &Data, noise: Noise, current: &mut Fit, named: &mut Vec<Named>) {
    while named.len() > 1 {
        let without = |number: usize| {
            let name = named[number].name;
            let pieces: Vec<Piece> =
                current.pieces.iter().filter(|piece| piece.effect.name != name).cloned().collect();
            let left = fit(data, Some(current), pieces, noise, &|_| true);
            let needed = 0.5 * (left.chi2 + left.unreached - current.chi2) - named[number].score.1 as f64;
            (number, needed, left)
        };
        // Of two that are needed as little, the later one.
        let least = (0..named.len()).rev().map(without).min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((number, _, left)) = least.filter(|least| least.1 < NEEDED_NATS) else { return };
        *current = left;
        named.remove(number);
    }
}

impl Pass {
    fn name(&self, block: usize, candidates: &[Candidate]) -> &'static str {
        candidates[self.blocks[block].candidate].effect.name
    }

    /// Blocks that may be the best one when they are fitted; none where `best` is a pair, whose strongest member is the one that fits best
    /// beside the other, and `best` alone where its tangents hold.
    fn leaders(&self, best: &Model) -> Vec<usize> {
        let score = |block: usize| self.scores[block].map_or(0.0, |(chi2, _)| chi2);
        let [block] = best.blocks[..] else { return Vec::new() };
        if self.singles[block] < STRONG_NATS {
            return vec![block];
        }
        let enough = LEADING_SHARE * score(block);
        let mut leaders: Vec<usize> =
            (0..self.blocks.len()).filter(|&block| score(block) >= enough).collect();
        leaders.sort_by(|&a, &b| self.singles[b].total_cmp(&self.singles[a]));
        leaders.truncate(MOST_LEADERS);
        leaders
    }

    /// Of blocks and their fits, to data whose chi squared was `before`: the best one, with its fit, and the effects that come as near as
    /// its form can be trusted.
    fn fittest(
        &self,
        before: f64,
        fits: impl Iterator<Item = (usize, Fit)>,
        candidates: &[Candidate],
    ) -> (Model, Fit, Vec<String>) {
        let judged = |(block, fit): (usize, Fit)| {
            let score = self.scores[block].map_or(0.0, |(chi2, _)| chi2);
            let gain = before - fit.chi2 - fit.unreached;
            (self.singles[block] + 0.5 * (gain - score), block, fit)
        };
        let mut judged: Vec<(f64, usize, Fit)> = fits.map(judged).collect();
        judged.sort_by(|a, b| b.0.total_cmp(&a.0));
        let (ln_bayes, block, fit) = judged.remove(0);
        // What its form may leave does not tell it from others either.
        let form = 0.5 * tolerance(self.name(block, candidates)) * (before - fit.chi2);
        let least = ln_bayes - form.max(RIVAL_NATS);
        let near = judged.iter().filter(|other| other.0 > least).map(|other| self.name(other.1, candidates));
        let near = near.map(str::to_owned).collect();
        (Model { blocks: vec![block], ln_bayes }, fit, near)
    }

    /// Of a clear single effect: others that explain as much by no more numbers, but for what its form may leave.
    fn near(&self, best: &Model, candidates: &[Candidate]) -> Vec<String> {
        let [block] = best.blocks[..] else { return Vec::new() };
        if self.singles[block] < STRONG_NATS {
            return Vec::new();
        }
        let score = |block: usize| self.scores[block].unwrap_or((0.0, usize::MAX));
        let name = self.name(block, candidates);
        let least = (1.0 - tolerance(name)) * score(block).0;
        let is_near = |&other: &usize| {
            self.name(other, candidates) != name && score(other).0 > least && score(other).1 <= score(block).1
        };
        (0..self.blocks.len()).filter(is_near).map(|other| self.name(other, candidates).to_owned()).collect()
    }

    /// The model to be fitted next, if it explains more than what is `tolerated`; and, where that is only a part of the best one, the whole.
    fn next(&self, tolerated: f64, trust: bool) -> Option<(Model, Model)> {
        let explained =
            |block: usize| self.scores[block].map_or(0.0, |(chi2, degrees)| chi2 - degrees as f64);
        let enough = |model: &&Model| {
            let most = model.blocks.iter().map(|&block| explained(block)).fold(0.0, f64::max);
            let trusted = trust && model.ln_bayes > CLEAR_NATS && most > TRUSTED_SHARE * tolerated;
            model.ln_bayes > THRESHOLD && (most > tolerated || trusted)
        };
        let best = self.models.iter().find(enough)?;
        // The simplest of the models within the evidence.
        let within = self.models.iter().filter(enough).filter(|m| m.ln_bayes > best.ln_bayes - RIVAL_NATS);
        let best = within.min_by_key(|model| model.blocks.len())?;
        // Of a pair that has one strong member, that one first: the tangents of the other hold only when it is fitted.
        let strongest =
            best.blocks.iter().copied().max_by(|&a, &b| self.singles[a].total_cmp(&self.singles[b]))?;
        if best.blocks.len() > 1 && self.singles[strongest] > STRONG_NATS {
            let alone = Model { blocks: vec![strongest], ln_bayes: self.singles[strongest] };
            return Some((alone, best.clone()));
        }
        Some((best.clone(), best.clone()))
    }

    /// What could stand in the place of one of the effects of `best`, all else the same.
    fn rivals(&self, best: &Model, candidates: &[Candidate]) -> Vec<String> {
        let candidate = |block: &usize| self.blocks[*block].candidate;
        let own: Vec<usize> = best.blocks.iter().map(candidate).collect();
        let mut rivals: Vec<String> = Vec::new();
        let within = self.models.iter().filter(|model| (model.ln_bayes - best.ln_bayes).abs() < RIVAL_NATS);
        for model in within.filter(|model| model.blocks.len() == best.blocks.len()) {
            let others: Vec<usize> =
                model.blocks.iter().map(candidate).filter(|c| !own.contains(c)).collect();
            if let [other] = others[..] {
                rivals.push(candidates[other].effect.name.to_owned());
            }
        }
        rivals
    }

    /// Each candidate by itself, in its best variant.
    fn alone(&self, candidates: &[Candidate]) -> Vec<(&'static str, f64, usize, f64)> {
        let mut alone = Vec::new();
        for (number, candidate) in candidates.iter().enumerate() {
            let of = (0..self.blocks.len()).filter(|&block| self.blocks[block].candidate == number);
            if let Some(best) = of.max_by(|&a, &b| self.singles[a].total_cmp(&self.singles[b])) {
                let (chi2, degrees) = self.scores[best].unwrap_or((0.0, 0));
                alone.push((candidate.effect.name, chi2, degrees, self.singles[best]));
            }
        }
        alone
    }
}
