//! One pass over all candidates beside what is fitted: their evidence, alone and in pairs, which leads, and what comes near.

use super::alone::Alone;
use super::candidates::Candidate;
use super::power::{Detectable, detectable};
use super::tolerated::tolerance;
use super::tried::Tried;
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::gram::Gram;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::reading::data::Data;
use crate::diagnose::shared_errors::random::of_name;
use crate::diagnose::statistics::evidence::{Block, Evidence, Model};
use crate::diagnose::statistics::simpler::Simpler;
use crate::diagnose::tangents::columns::Tangents;
use crate::diagnose::tangents::pieces::Piece;
use std::collections::BTreeMap;

/// A rival within so many nats is possible too.
pub const RIVAL_NATS: f64 = 3.0;
/// Evidence (nats) that names an effect which explains less than the forms of others may leave.
const CLEAR_NATS: f64 = 8.0;
/// Where the tangents need not hold, effects whose score is at least this share of the best one's are fitted before one is chosen.
const LEADING_SHARE: f64 = 0.8;
/// The same for effects of fewer numbers: what a strong one does its tangent at the baseline need not show.
pub const SIMPLER_SHARE: f64 = 0.5;
/// So many at most.
const MOST_LEADERS: usize = 5;
/// The same where the mismatch is greater than the noise: there tangents say little of what a fit will.
const FAR_SHARE: f64 = 0.25;
/// So many effects at most.
const MOST_FAR_LEADERS: usize = 6;
/// Beyond so much evidence (nats) the tangents at the baseline need not hold at the fit.
const STRONG_NATS: f64 = 30.0;
/// A form may leave so many times its tolerance before it is not believed.
pub const DISBELIEF: f64 = 3.0;
/// Less evidence than this (nats) asserts nothing.
pub const THRESHOLD: f64 = 1.0;
/// The same for an effect beside others: a second name is less trustworthy than the first.
const FURTHER_THRESHOLD: f64 = 4.0;

/// Of what one coordinate explains, two effects together must promise so much for any to be looked for.
const HOPEFUL_SHARE: f64 = 1.0 / 3.0;

/// What one pass says of all candidates.
#[derive(Debug, Clone, Default)]
pub struct Pass {
    /// Models, best first.
    models: Vec<Model>,
    /// One way each in which an effect may be there.
    pub blocks: Vec<Block>,
    /// Of each block, what it explains alone, and its degrees of freedom.
    pub scores: Vec<Option<(f64, usize)>>,
    /// Candidates whose every column is absorbed.
    pub invisible: Vec<&'static str>,
    /// Smallest strengths that would be seen in 95 of 100 recordings alike.
    pub detectable: Vec<Detectable>,
    /// Evidence of each block alone, nats.
    pub singles: Vec<f64>,
    /// What simpler methods name.
    pub simpler: Simpler,
    /// Blocks whose effect is there in both of two forms.
    of_both_forms: Vec<bool>,
}

impl Pass {
    /// All candidates at the fit `base`, with what it has fitted projected out; beside noise that samples share, which raises the variance of what
    /// columns say by `inflation`, no models but those that stand.
    pub fn of(data: &Data, base: &Fit, candidates: &[Candidate], noise: Noise, inflation: f64) -> Self {
        let Tried { pieces: tried, blocks, parameters } =
            Tried::beside(&base.pieces, base.columns.len(), candidates);
        let (tangents, _) = Tangents::new(data, &base.pixels, &base.pieces, &tried);
        let gram = Gram::of(data, &tangents, noise, &|_| true);
        let mut projected = gram.project(None);
        projected.give_way(0..base.columns.len());
        let reach = |column: usize| {
            let (number, parameter) = parameters[column];
            candidates.get(number).map_or(f64::INFINITY, |candidate| {
                candidate.effect.parameters[parameter].reach(base.pixels.full_scale_dn)
            })
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
            let mut of =
                blocks.iter().zip(&scores).filter(|(block, _)| block.candidate == *number).peekable();
            of.peek().is_some() && of.all(|(_, score)| score.is_none())
        };
        let invisible =
            (0..candidates.len()).filter(unseen).map(|number| candidates[number].effect.name).collect();
        // What is asked of the recordings as they are.
        let detectable = match base.columns.is_empty() {
            true => detectable(&projected, &parameters, &reach, &blocks, &scores, candidates),
            false => Vec::new(),
        };
        let singles = (0..blocks.len()).map(|block| evidence.ln_bayes(&[block])).collect();
        let name = |block: &Block| candidates[block.candidate].effect.name;
        let simpler = || Simpler::of(&evidence, &blocks, gram.samples, &name);
        let simpler = if base.columns.is_empty() { simpler() } else { Simpler::default() };
        let stands = |model: &Model| {
            let of = model.blocks.iter().filter_map(|&block| scores[block]);
            let score = of.fold((0.0, 0), |sum, score| (sum.0 + score.0, sum.1 + score.1));
            inflation <= 1.0 || of_name(inflation, model.ln_bayes, score) > THRESHOLD
        };
        let models = evidence.models().into_iter().filter(stands).collect();
        let variant = |block: &Block| &candidates[block.candidate].variants[block.variant];
        let of_both_forms = blocks.iter().map(|block| variant(block).is_of_both_forms()).collect();
        Self { simpler, models, scores, invisible, detectable, singles, blocks, of_both_forms }
    }

    /// The effect of a block.
    pub fn name(&self, block: usize, candidates: &[Candidate]) -> &'static str {
        candidates[self.blocks[block].candidate].effect.name
    }

    /// The pieces of some blocks.
    pub fn pieces(&self, blocks: &[usize], candidates: &[Candidate]) -> Vec<Piece> {
        let of = blocks.iter().map(|&block| &self.blocks[block]);
        of.flat_map(|of| candidates[of.candidate].variants[of.variant].pieces.iter().cloned()).collect()
    }

    /// Whether what `best` explains of so many `samples` is more than their noise.
    pub fn is_far(&self, best: &Model, samples: usize) -> bool {
        self.promised(best) > samples as f64
    }

    /// Chi squared that the tangents of the strongest block of `best` promise.
    pub fn promised(&self, best: &Model) -> f64 {
        let scores = best.blocks.iter().filter_map(|&block| self.scores[block]);
        scores.map(|score| score.0).fold(0.0, f64::max)
    }

    /// Blocks that may be the strongest one of `best` when they are fitted, if there is any doubt which, and those that are to be fitted
    /// with each: the others of `best`, unless tangents say little because the mismatch `is_far` above the noise.
    pub fn leaders(&self, best: &Model, is_far: bool) -> Option<(Vec<usize>, Vec<usize>)> {
        let score = |block: usize| self.scores[block].map_or(0.0, |(chi2, _)| chi2);
        let single = |a: &usize, b: &usize| self.singles[*b].total_cmp(&self.singles[*a]);
        let strongest = *best.blocks.iter().min_by(|a, b| single(a, b))?;
        if self.singles[strongest] < STRONG_NATS {
            return None;
        }
        let candidate = |block: usize| self.blocks[block].candidate;
        let numbers = |block: usize| self.scores[block].map_or(usize::MAX, |(_, degrees)| degrees);
        let (share, most) =
            if is_far { (FAR_SHARE, MOST_FAR_LEADERS) } else { (LEADING_SHARE, MOST_LEADERS) };
        let share = |block: usize| match numbers(block) < numbers(strongest) {
            true => share.min(SIMPLER_SHARE),
            false => share,
        };
        let is_leading = |&block: &usize| score(block) >= share(block) * score(strongest);
        let mut leaders: Vec<usize> = (0..self.blocks.len()).filter(is_leading).collect();
        leaders.sort_by(single);
        // The best effects, and of each two ways to be there; far off the way that shows best at the baseline need not be the one that fits, and all stay.
        let mut ways = BTreeMap::<usize, usize>::new();
        leaders.retain(|&block| {
            if !ways.contains_key(&candidate(block)) && ways.len() == most {
                return false;
            }
            let ways = ways.entry(candidate(block)).or_default();
            *ways += usize::from(!self.is_of_both_forms(block));
            self.is_of_both_forms(block) || *ways <= 2
        });
        // What has both of two forms goes with these, and takes the place of none.
        let mut places = if is_far { leaders.len() } else { most };
        leaders.retain(|&block| {
            let (has_place, is_counted) = (places > 0, !self.is_of_both_forms(block));
            places -= usize::from(has_place && is_counted);
            has_place
        });
        let leads = |&block: &usize| leaders.iter().any(|&leader| candidate(leader) == candidate(block));
        let others = best.blocks.iter().copied().filter(|block| !is_far && !leads(block)).collect();
        (leaders.len() > 1).then_some((leaders, others))
    }

    /// Whether no two effects promise together as much as a third of what one coordinate explains, `located`, chi squared besides chance: none of
    /// them would outdo it.
    pub fn is_hopeless(&self, located: f64) -> bool {
        let excess = |&block: &usize| self.scores[block].map_or(0.0, |(chi2, degrees)| chi2 - degrees as f64);
        let alone = |model: &Model| model.blocks.iter().map(excess).sum::<f64>();
        let promised = |model: &Model| alone(model).max(2.0 * model.ln_bayes);
        self.models.iter().map(promised).fold(0.0, f64::max) < HOPEFUL_SHARE * located
    }

    /// Whether the effect of a block is there in both of two forms.
    pub fn is_of_both_forms(&self, block: usize) -> bool {
        self.of_both_forms.get(block).is_some_and(|of_both| *of_both)
    }

    /// What the effect `name` explains besides chance, in the way in which that is most, chi squared.
    pub fn excess(&self, name: &str, candidates: &[Candidate]) -> f64 {
        let of = (0..self.blocks.len()).filter(|&block| self.name(block, candidates) == name);
        let excess = of.filter_map(|block| self.scores[block]).map(|(chi2, degrees)| chi2 - degrees as f64);
        excess.fold(0.0, f64::max)
    }

    /// Of a clear single effect: others that explain as much by no more numbers, but for what its form or theirs may leave.
    pub fn near(&self, best: &Model, candidates: &[Candidate]) -> Vec<String> {
        let [block] = best.blocks[..] else { return Vec::new() };
        if self.singles[block] < STRONG_NATS {
            return Vec::new();
        }
        let score = |block: usize| self.scores[block].unwrap_or((0.0, usize::MAX));
        let name = self.name(block, candidates);
        // Fits of one effect that begin in several shapes may come to the same end: which of them was taken is chance.
        let is_another =
            |&other: &usize| self.name(other, candidates) == name && score(other).1 <= score(block).1;
        let own = (0..self.blocks.len()).filter(is_another).map(|other| score(other).0).fold(0.0, f64::max);
        let least = |rival: &str| (1.0 - tolerance(name).max(tolerance(rival))) * own;
        let is_near = |&other: &usize| {
            let rival = self.name(other, candidates);
            rival != name && score(other).0 > least(rival) && score(other).1 <= score(block).1
        };
        (0..self.blocks.len()).filter(is_near).map(|other| self.name(other, candidates).to_owned()).collect()
    }

    /// The model to be fitted next, `beside` so many effects, if it explains more than what is `tolerated`, or, alone, clearly something and is a
    /// candidate that is trusted with that much of chi squared; and, where that is only a part of the best one, the whole.
    pub fn next(
        &self,
        beside: usize,
        tolerated: f64,
        is_trusted: &dyn Fn(usize, f64) -> bool,
    ) -> Option<(Model, Model)> {
        let threshold = if beside > 0 { FURTHER_THRESHOLD } else { THRESHOLD };
        let explained =
            |block: usize| self.scores[block].map_or(0.0, |(chi2, degrees)| chi2 - degrees as f64);
        let enough = |model: &&Model| {
            let most = model.blocks.iter().map(|&block| explained(block)).fold(0.0, f64::max);
            // Of two at once neither is trusted to be more than what a form leaves.
            let trusted = matches!(model.blocks[..], [block] if is_trusted(self.blocks[block].candidate, most))
                && model.ln_bayes > CLEAR_NATS;
            model.ln_bayes > threshold && (most > tolerated || trusted)
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
    pub fn rivals(&self, best: &Model, candidates: &[Candidate]) -> Vec<String> {
        let candidate = |block: &usize| self.blocks[*block].candidate;
        let own: Vec<usize> = best.blocks.iter().map(candidate).collect();
        let mut rivals: Vec<String> = Vec::new();
        let within = self.models.iter().filter(|model| (model.ln_bayes - best.ln_bayes).abs() < RIVAL_NATS);
        for model in within.filter(|model| model.blocks.len() == best.blocks.len()) {
            let others: Vec<usize> =
                model.blocks.iter().map(candidate).filter(|c| !own.contains(c)).collect();
            if let [other] = others[..] {
                let name = candidates[other].effect.name;
                // It may be there in several ways.
                if !rivals.iter().any(|rival| rival == name) {
                    rivals.push(name.to_owned());
                }
            }
        }
        rivals
    }

    /// Each candidate by itself, in its best variant.
    pub fn alone(&self, candidates: &[Candidate]) -> Vec<Alone> {
        let mut alone = Vec::new();
        for (number, candidate) in candidates.iter().enumerate() {
            let of = (0..self.blocks.len()).filter(|&block| self.blocks[block].candidate == number);
            if let Some(best) = of.max_by(|&a, &b| self.singles[a].total_cmp(&self.singles[b])) {
                let (chi2, degrees) = self.scores[best].unwrap_or((0.0, 0));
                alone.push(Alone {
                    name: candidate.effect.name,
                    chi2,
                    degrees,
                    ln_bayes: self.singles[best],
                });
            }
        }
        alone
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pass over blocks of so many candidates, chi squared and numbers.
    fn pass(blocks: &[(usize, f64, usize)]) -> Pass {
        let block = |&(candidate, ..): &(usize, f64, usize)| Block {
            candidate,
            variant: 0,
            variants: 1.0,
            columns: Vec::new(),
        };
        Pass {
            blocks: blocks.iter().map(block).collect(),
            scores: blocks.iter().map(|&(_, chi2, numbers)| Some((chi2, numbers))).collect(),
            singles: blocks.iter().map(|&(_, chi2, _)| 0.5 * chi2).collect(),
            ..Pass::default()
        }
    }

    fn model(blocks: &[usize]) -> Model {
        Model { blocks: blocks.to_vec(), ln_bayes: 0.0 }
    }

    #[test]
    fn what_comes_near_the_strongest_one_is_fitted_before_one_is_chosen() {
        // Of as many numbers four fifths of its score are near, of fewer a half.
        let of = pass(&[(0, 790.0, 2), (1, 1000.0, 2), (2, 810.0, 2), (3, 510.0, 1), (4, 490.0, 1)]);
        assert_eq!(of.leaders(&model(&[1, 0]), false), Some((vec![1, 2, 3], vec![0])));
        // One that may be the strongest is not fitted beside itself.
        assert_eq!(of.leaders(&model(&[1, 2]), false), Some((vec![1, 2, 3], vec![])));
        // A model's strongest block is measured by itself alone.
        assert_eq!(of.leaders(&model(&[4]), false), Some((vec![1, 2, 0, 3, 4], vec![])));
        // No doubt, or nothing strong.
        assert_eq!(pass(&[(0, 1000.0, 1), (1, 700.0, 1)]).leaders(&model(&[0]), false), None);
        assert_eq!(pass(&[(0, 50.0, 1), (1, 49.0, 1)]).leaders(&model(&[0]), false), None);
    }

    #[test]
    fn far_off_two_ways_of_each_of_six_effects_lead_and_nothing_beside_them() {
        // Eight effects in three ways each, all about as strong, the later the weaker.
        let ways: Vec<(usize, f64, usize)> = (0..24).map(|n| (n / 3, 1000.0 - n as f64, 1)).collect();
        let of = pass(&ways);
        let leading: Vec<usize> = (0..18).filter(|n| n % 3 < 2).collect();
        assert_eq!(of.leaders(&model(&[0, 23]), true), Some((leading, vec![])));
        assert_eq!(of.leaders(&model(&[0, 23]), false), Some((vec![0, 1, 3, 4, 6], vec![23])));
    }

    #[test]
    fn what_promises_less_than_a_third_of_a_coordinate_is_hopeless() {
        let mut of = pass(&[(0, 101.0, 1), (1, 60.0, 10)]);
        let models = |ln_bayes| vec![model(&[0]), Model { blocks: vec![0, 1], ln_bayes }];
        // Besides chance they promise 100 and 50.
        of.models = models(60.0);
        assert!(of.is_hopeless(451.0) && !of.is_hopeless(449.0) && !of.is_hopeless(0.0));
        // Of two that hide each other the evidence says more.
        of.models = models(100.0);
        assert!(of.is_hopeless(601.0) && !of.is_hopeless(599.0));
        of.models.clear();
        assert!(of.is_hopeless(1.0) && !of.is_hopeless(0.0));
    }

    #[test]
    fn what_has_both_of_two_forms_takes_the_place_of_none() {
        // Both forms at once, one and the other, and a third way, which stays behind; then other effects.
        let mut of = pass(&[(0, 1004.0, 3), (0, 1003.0, 2), (0, 1002.0, 1), (0, 1001.0, 1)]);
        of.of_both_forms = vec![true];
        assert_eq!(of.leaders(&model(&[0]), true), Some((vec![0, 1, 2], vec![])));
        let more: Vec<_> = (0..9).map(|n| (n.max(2) - 2, 1000.0 - n as f64, 1)).collect();
        let mut of = pass(&more);
        assert_eq!(of.leaders(&model(&[0]), false).unwrap().0, [0, 1, 3, 4, 5]);
        of.of_both_forms = vec![true];
        assert_eq!(of.leaders(&model(&[0]), false).unwrap().0, [0, 1, 2, 3, 4, 5]);
    }
}
