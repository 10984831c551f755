//! The search: baseline, evidence of all candidates at once, fit of the best, and again for what is left.

use super::alias::odds_against;
use super::alone::Alone;
use super::candidates::{Candidate, candidates};
use super::chosen_anew::chosen_anew;
use super::completed::Completed;
use super::contest::{self, Entrant, hopeful};
use super::exchange::exchange;
use super::found::{Found, Named, are_many};
use super::needless::{drop_needless, without_bounded};
use super::pass::{Pass, THRESHOLD};
use super::promised::Promised;
use super::resting::{drop_resting, goes_on};
use super::tolerated::tolerated;
use super::trust::Trust;
use crate::diagnose::fitting::finished::finished;
use crate::diagnose::fitting::fit::{Fit, fit};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::forms::in_common::in_common;
use crate::diagnose::forms::one_frame::one_frame;
use crate::diagnose::forms::overtones::is_bend;
use crate::diagnose::forms::refined::refined;
use crate::diagnose::forms::uneven::uneven;
use crate::diagnose::periodic::lamps::FLICKER;
use crate::diagnose::reading::data::Data;
use crate::diagnose::statistics::evidence::Model;
use crate::diagnose::tangents::pieces::Piece;
use std::collections::BTreeSet;

const MOST_EFFECTS: usize = 4;
/// What a flicker is that all frames see at rest.
const DRIFT: &str = "ambient_drift";
/// Beside so many, what the forms of these may leave is no further one.
const MOST_TRUSTED: usize = 2;
/// Without a camera's description much is left out at once: so much of what their forms may leave keeps further effects out.
pub const UNDESCRIBED: f64 = 0.1;
/// A fit keeps at least so much of what the tangents promise.
const KEPT_SHARE: f64 = 0.5;

/// A search, as far as it has come.
#[derive(Debug)]
pub struct Search<'a> {
    data: &'a Data,
    noise: Noise,
    /// By how much white noise that samples share raises the variance of what columns say.
    inflation: f64,
    /// Chi squared that the forms of effects which the camera includes may leave.
    of_included: f64,
    /// Chi squared, besides chance, that one coordinate explains of what the baseline leaves; 0 where that does not matter.
    located: f64,
    baseline: Fit,
    /// The fit with what is named.
    current: Fit,
    named: Vec<Named>,
    /// What the tangents at the baseline promised, where that was two effects.
    promised: Option<Promised>,
    /// The fit with all numbers of an effect that has one instead of others, as long as another effect may say the same.
    completed: Option<Completed>,
    /// The pass at the baseline, and what it says of each candidate alone.
    first: Option<(Pass, Vec<Alone>)>,
    is_over: bool,
}

impl<'a> Search<'a> {
    /// Of `data`, to which `baseline` was fitted without any effect, beside noise that samples share, which raises the variance of what columns say
    /// by `inflation`, and where the forms of effects that the camera includes may leave so much of chi squared. Of chi squared, `located` is what one
    /// coordinate explains: where effects come nowhere near that, whatever they explain is not what is there.
    pub fn new(
        data: &'a Data,
        baseline: Fit,
        noise: Noise,
        inflation: f64,
        of_included: f64,
        located: f64,
    ) -> Self {
        let current = baseline.clone();
        Self {
            data,
            noise,
            inflation,
            of_included,
            located,
            baseline,
            current,
            named: Vec::new(),
            promised: None,
            completed: None,
            first: None,
            is_over: false,
        }
    }

    /// What it finds when the forms of effects are trusted: what explains less than the others' forms may leave is named nevertheless, on clear
    /// evidence. And the search without trust, as far as both are the same, where they are not.
    pub fn with_trust(mut self) -> (Found, Option<Self>) {
        let mut without = None;
        while !self.is_over {
            if let Some(other) = self.go_on(true) {
                without.get_or_insert(other);
            }
        }
        (self.found(), without)
    }

    /// What it finds without trust.
    pub fn without_trust(mut self) -> Found {
        while !self.is_over {
            self.go_on(false);
        }
        self.found()
    }

    fn found(mut self) -> Found {
        in_common(self.data, self.noise, &mut self.current, &mut self.named);
        let series = &self.baseline.series;
        let candidates = if self.named.len() > 1 { candidates(self.data, series) } else { Vec::new() };
        // Of more names than may be there it is asked whether they are fewer before it is asked whether they are simpler, which takes long.
        let were_many = self.are_many();
        if were_many {
            self.leave_needed();
        }
        let is_exchanged = !self.are_many() && self.exchange(&candidates);
        if !were_many || is_exchanged {
            self.leave_needed();
        }
        drop_resting(self.data, self.noise, &mut self.current, &mut self.named);
        if !self.are_many() {
            self.choose_anew(&candidates);
        }
        let (Pass { invisible, detectable, simpler, .. }, alone) = self.first.unwrap_or_default();
        let Self { data, noise, baseline, current, mut named, .. } = self;
        let current = without_bounded(data, finished(data, current, noise), noise, &mut named);
        // However a drift was named, and if a flicker is not named beside it.
        let is_named = named.iter().any(|named| named.name == FLICKER);
        let rests = match goes_on(&current.pieces, DRIFT) {
            true => baseline.series.flicker_rests(),
            false => baseline.series.flicker_comes_back(),
        };
        if !is_named && Alone::of(&alone, FLICKER).is_some() && rests {
            named.iter_mut().filter(|named| named.name == DRIFT).for_each(|drift| drift.may_be(FLICKER));
        }
        Found { baseline, fit: current, named, invisible, detectable, alone, simpler }
    }

    /// Whether there are more names than were left out of a camera that is described.
    fn are_many(&self) -> bool {
        are_many(!self.data.assumed.camera, self.named.len())
    }

    /// Leaves what is needed beside the others, a drift in the form that it has.
    fn leave_needed(&mut self) {
        uneven(self.data, self.noise, &mut self.current, &mut self.named);
        drop_needless(self.data, self.noise, &self.baseline, &mut self.current, &mut self.named);
    }

    /// Puts a simpler effect in the place of one that has more numbers than it needs, near the baseline; whether there was one.
    fn exchange(&mut self, candidates: &[Candidate]) -> bool {
        let exchanges = self.named.len() > 1 && !self.baseline.is_far_from(&self.current);
        let Some((first, _)) = self.first.as_ref().filter(|_| exchanges) else { return false };
        exchange(self.data, self.noise, (first, candidates), &mut self.current, &mut self.named)
    }

    /// Gives each of several effects the shape that fits best beside the others, drifts one time constant where recordings need none of their own, and gains one frame.
    fn choose_anew(&mut self, candidates: &[Candidate]) {
        one_frame(self.data, self.noise, &self.baseline, &mut self.current, &mut self.named);
        let Some((first, _)) = self.first.as_ref().filter(|_| self.named.len() > 1) else { return };
        chosen_anew(self.data, self.noise, (first, candidates), &mut self.current, &mut self.named);
        in_common(self.data, self.noise, &mut self.current, &mut self.named);
    }

    /// Names what comes next, if anything does. Where that is a question of `trust`: the search without it.
    fn go_on(&mut self, trust: bool) -> Option<Self> {
        let (data, noise) = (self.data, self.noise);
        let candidates = candidates(data, &self.current.series);
        let pass = Pass::of(data, &self.current, &candidates, noise, self.inflation);
        let (_, alone) = self.first.get_or_insert_with(|| (pass.clone(), pass.alone(&candidates)));
        if self.named.is_empty() && pass.is_hopeless(self.located) {
            self.is_over = true;
            return None;
        }
        // Far from the baseline forms are not that well known, and what nobody described is not trusted there.
        let is_far = self.baseline.is_far_from(&self.current);
        let share = if data.assumed.camera && !is_far { UNDESCRIBED } else { 1.0 };
        // Nor is anything trusted while a fit with more numbers of an effect waits, which may say the same.
        let trusts = trust
            && !(is_far && data.assumed.camera)
            && self.named.len() < MOST_TRUSTED
            && self.completed.is_none();
        let tolerated = share * tolerated(&self.named) + self.of_included;
        let trust = Trust {
            named: &self.named,
            tolerated,
            alone: &|name| Alone::of(alone, name).map_or(0.0, |alone| alone.chi2),
            is_described: !data.assumed.camera && self.of_included == 0.0,
        };
        let least = |candidate: &Candidate| match trusts {
            true => trust.least_chi2(candidate.effect.name),
            false => f64::INFINITY,
        };
        let least: Vec<f64> = candidates.iter().map(least).collect();
        let is_trusted = |candidate: usize, chi2: f64| chi2 > least[candidate];
        // Beside a jitter, which is among the noise, a name is a second one.
        let beside = self.named.len() + usize::from(noise.jitter != data.unpredicted.jitter);
        let next = pass.next(beside, tolerated, &is_trusted);
        let without = pass.next(beside, tolerated, &|_, _| false);
        let is_by_trust = without != next;
        let without = is_by_trust.then(|| Self {
            baseline: self.baseline.clone(),
            current: self.current.clone(),
            named: self.named.clone(),
            promised: self.promised.clone(),
            completed: self.completed.clone(),
            first: self.first.clone(),
            is_over: without.is_none() && self.promised.is_none() && self.completed.is_none(),
            ..*self
        });
        let completed =
            self.completed.take().map(|completed| (completed, self.current.clone(), self.named.clone()));
        match next {
            Some((best, whole)) if best.blocks.len() + self.named.len() <= MOST_EFFECTS => {
                // Far from the baseline tangents promise more than there is, and of several effects the simplest is believed.
                let is_believed = !data.assumed.camera && !pass.is_far(&whole, self.current.samples);
                if is_believed && self.named.is_empty() && best.blocks.len() < whole.blocks.len() {
                    self.promise(&pass, &candidates, &whole);
                }
                // Nor is what wins a contest that one opens which is trusted, nor what is as likely something else.
                let may_be_named = |candidate: usize, chi2: f64, rivals: &[String]| {
                    let is_rival = |other: &Candidate| rivals.iter().any(|name| name == other.effect.name);
                    let mut all = candidates.iter().zip(&least);
                    let has_worse = all.any(|(other, least)| least.is_infinite() && is_rival(other));
                    let is_likely = !has_worse && odds_against(chi2.sqrt(), true, rivals.len()) < 1.0;
                    !is_by_trust || chi2 > tolerated || is_trusted(candidate, chi2) && is_likely
                };
                let before = self.named.len();
                let is_named = self.name(&pass, &candidates, best, &whole, &may_be_named);
                self.named.iter_mut().skip(before).for_each(|named| named.is_trusted = is_by_trust);
                self.is_over = !is_named && completed.is_none() && !self.reconsiders(&pass, &candidates);
            }
            _ => self.is_over = completed.is_none() && !self.reconsiders(&pass, &candidates),
        }
        if let Some((completed, before, named)) = completed {
            let is_said = self.named.len() > named.len() && completed.is_said_by(&self.current, &before);
            if !is_said {
                self.complete(completed, &before, named);
            }
        }
        without
    }

    /// Whether two effects that tangents at the baseline promised, of which one did not come, fit clearly better than what came: if so, these are named
    /// instead. The strongest one alone may take on another shape, and leave to others what that cannot say.
    fn reconsiders(&mut self, pass: &Pass, candidates: &[Candidate]) -> bool {
        let Some(promised) = self.promised.take() else { return false };
        if promised.is_hopeless(&self.current.pieces, &|name| pass.excess(name, candidates)) {
            return false;
        }
        let came = (&self.current, &self.named[..]);
        let Some(better) = promised.better_than(self.data, self.noise, &self.baseline, came) else {
            return false;
        };
        (self.current, self.named) = better;
        true
    }

    /// Goes on from the fit `completed` and what was `named` before it was, at the fit `before`.
    fn complete(&mut self, Completed { name, fit }: Completed, before: &Fit, named: Vec<Named>) {
        self.named = named;
        // Numbers that it needed besides are its own, too.
        let more = fit.columns.len().saturating_sub(before.columns.len());
        for named in self.named.iter_mut().filter(|named| named.name == name) {
            named.ln_bayes += 0.5 * (before.chi2 - fit.chi2) - more as f64;
            named.score.1 += more;
            named.score.0 = (named.score.0 + before.counted() - fit.counted()).max(0.0);
        }
        self.current = fit;
        self.completed = None;
    }

    /// Keeps the two effects of the model `whole` in mind, whose strongest one comes first, alone.
    fn promise(&mut self, pass: &Pass, candidates: &[Candidate], whole: &Model) {
        let rivals = pass.rivals(whole, candidates);
        let named = |&block: &usize| Named {
            name: pass.name(block, candidates),
            ln_bayes: whole.ln_bayes,
            score: pass.scores[block].unwrap_or((0.0, 0)),
            rivals: rivals.clone(),
            is_trusted: false,
        };
        self.promised = Some(Promised {
            pieces: pass.pieces(&whole.blocks, candidates),
            named: whole.blocks.iter().map(named).collect(),
        });
    }

    /// Fits what a `pass` says is `best` next, where that is a part of the model `whole`, and names it, if the fit keeps it, and if its candidate
    /// `may_be_named` for so much of chi squared, beside its rivals.
    fn name(
        &mut self,
        pass: &Pass,
        candidates: &[Candidate],
        best: Model,
        whole: &Model,
        may_be_named: &dyn Fn(usize, f64, &[String]) -> bool,
    ) -> bool {
        let Self { data, noise, ref current, .. } = *self;
        let mut rivals = pass.rivals(whole, candidates);
        let pieces = |blocks: &[usize]| -> Vec<Piece> {
            [&current.pieces[..], &pass.pieces(blocks, candidates)].concat()
        };
        let fitted = |pieces: Vec<Piece>| fit(data, Some(current), pieces, noise, &|_| true);
        let with = |blocks: &[usize]| fitted(pieces(blocks));
        let lead = |is_far: bool| {
            let (leaders, others) = pass.leaders(whole, is_far)?;
            let contest = |others: &[usize]| {
                let entrant = |&block: &usize| Entrant {
                    block,
                    name: pass.name(block, candidates),
                    pieces: pieces(&[&[block], others].concat()),
                    led: None,
                };
                let entrants = hopeful(data, current, leaders.iter().map(entrant).collect(), noise);
                let fits = contest::fitted(data, current, entrants, noise);
                let more = |fit: &Fit| fit.columns.len().saturating_sub(current.columns.len());
                // Nor is a form exact beside what nobody described: what says the same by much fewer numbers is believed.
                let is_simpler = |fit: &Fit, best: &Fit| {
                    2 * more(fit) <= more(best) || is_bend(data, &best.pieces[current.pieces.len()..])
                };
                let may_stand_for =
                    |fit: &Fit, best: &Fit| is_far || data.assumed.camera && is_simpler(fit, best);
                pass.fittest(current, fits, candidates, &may_stand_for)
            };
            let (mut single, mut fitted, mut near) = contest(&others)?;
            if !others.is_empty() && single.ln_bayes < THRESHOLD {
                // Not even the best one bears the others.
                (single, fitted, near) = contest(&[])?;
            } else if !others.is_empty() {
                // Of a pair the strongest member comes first, with its own evidence.
                fitted = with(&single.blocks);
                let ln_bayes = pass.fitted_ln_bayes(
                    single.blocks[0],
                    pass.name(single.blocks[0], candidates),
                    current.chi2,
                    &fitted,
                );
                single = Model { ln_bayes, ..single };
            }
            Some((single, fitted, near))
        };
        let is_far = pass.is_far(whole, current.samples);
        let first_choice = lead(is_far).unwrap_or_else(|| (best.clone(), with(&best.blocks), Vec::new()));
        // A fit that does not keep half of what tangents promise is too far from them.
        let kept = current.counted() - first_choice.1.counted();
        let is_broken = kept < KEPT_SHARE * pass.promised(&first_choice.0);
        let far_choice = if is_broken && !is_far { lead(true) } else { None };
        let is_far = is_far || far_choice.is_some();
        let (best, fitted, near) = far_choice.unwrap_or(first_choice);
        let is_new = |name: &str| best.blocks.iter().any(|&block| pass.name(block, candidates) == name);
        let fitted = refined(data, finished(data, fitted, noise), noise, &is_new);
        rivals.extend(near);
        let own = |rival: &String| best.blocks.iter().any(|&block| pass.name(block, candidates) == rival);
        rivals.retain(|rival| !own(rival));
        rivals.extend(pass.near(&best, candidates));
        let mut known = BTreeSet::new();
        rivals.retain(|rival| known.insert(rival.clone()));
        // What its tangents promise, and its form cannot keep.
        if current.chi2 - fitted.chi2 < 2.0 * THRESHOLD {
            return false;
        }
        // Of one alone it is known what it explains.
        let all = (current.counted() - fitted.counted()).max(0.0);
        // Near the noise, what takes something away from nothing but a few samples that are far off is no effect.
        if all < 2.0 * THRESHOLD && !current.is_far() {
            return false;
        }
        let explained = |chi2: f64| if best.blocks.len() == 1 { all } else { chi2.min(all) };
        let score =
            |block: usize| pass.scores[block].map_or((0.0, 0), |(chi2, degrees)| (explained(chi2), degrees));
        if !best
            .blocks
            .iter()
            .all(|&block| may_be_named(pass.blocks[block].candidate, score(block).0, &rivals))
        {
            return false;
        }
        for &block in &best.blocks {
            let block_of = &pass.blocks[block];
            self.named.push(Named {
                name: candidates[block_of.candidate].effect.name,
                ln_bayes: best.ln_bayes,
                score: score(block),
                rivals: rivals.clone(),
                is_trusted: false,
            });
        }
        self.completed = if is_far { Completed::of(self.data, &fitted, self.noise) } else { None };
        self.current = fitted;
        true
    }
}
