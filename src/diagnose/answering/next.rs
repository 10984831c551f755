//! The recording that would tell apart what these recordings do not.
//!
//! Each proposal is simulated at the fitted pixels, and judged together with the recording that it changes, without the rest of the campaign, by what
//! separates the asserted effect from its rival: 2 D = θ' (K_cc − K_cr K_rr⁻¹ K_rc) θ, with K the information of both effects' parameters, less what
//! their forms may leave of θ' K_cc θ, which is what the asserted effect explains there; √(2 D) standard deviations.

use super::proposals::{PROPOSALS, Proposal, thinned};
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::gram::Gram;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::fitting::projected::Projected;
use crate::diagnose::judging::judge::Judgement;
use crate::diagnose::judging::vote::COLUMNS;
use crate::diagnose::naming::candidates::{Candidate, candidates};
use crate::diagnose::naming::pass::DISBELIEF;
use crate::diagnose::naming::tolerated::tolerance;
use crate::diagnose::reading::data::{Data, Take};
use crate::diagnose::reading::frequencies::Frequency;
use crate::diagnose::statistics::evidence::VISIBLE;
use crate::diagnose::tangents::columns::Tangents;
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::{AtFrequency, Pixels};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use std::sync::Arc;

/// A proposal, for an asserted effect and its rival.
#[derive(Debug, Clone)]
pub struct Next {
    /// The two effects.
    pub between: [String; 2],
    /// The recording.
    pub what: String,
    /// By how many standard deviations it would separate them, together with the recording that it changes.
    pub rho: f64,
}

/// So many rivals of an effect are looked at, and so many recordings proposed for each: not every bench has every device.
const MOST_RIVALS: usize = 3;
const MOST_RECORDINGS: usize = 2;
/// A recording that separates by less does not.
pub const ENOUGH_RHO: f64 = 3.0;

/// An asserted effect against a rival.
struct Contest<'a> {
    name: &'static str,
    own: Vec<Piece>,
    rival: &'a Candidate,
    /// The best take of each proposal.
    proposals: Vec<Next>,
}

impl Contest<'_> {
    fn names(&self) -> [&'static str; 2] {
        [self.name, self.rival.effect.name]
    }

    /// Whether `proposal` can be simulated: sets with other frames say nothing of an effect with a number for each frame.
    fn admits(&self, proposal: &Proposal) -> bool {
        let by_frame = COLUMNS.iter().any(|(name, _)| self.names().contains(name));
        !(proposal.has_other_frames && by_frame)
    }
}

/// The best recordings for each asserted effect and each of its first rivals.
pub fn next(data: &Data, judgement: &Judgement) -> Vec<Next> {
    let candidates = candidates(data, &judgement.found.baseline.series);
    let mut contests: Vec<Contest> = Vec::new();
    for named in &judgement.named {
        let is_own = |piece: &&Piece| piece.effect.name == named.name;
        let own: Vec<Piece> = judgement.fit.pieces.iter().filter(is_own).cloned().collect();
        let rivals = named.rivals.iter();
        let rivals = rivals.filter_map(|rival| candidates.iter().find(|other| other.effect.name == *rival));
        let against = |rival| Contest { name: named.name, own: own.clone(), rival, proposals: Vec::new() };
        contests.extend(rivals.take(MOST_RIVALS).map(against));
    }
    let takes: Vec<Take> = data.takes.iter().map(|take| thinned(take, data.pixels())).collect();
    // Recordings are not copied for each pair.
    let camera = data.with_takes(Vec::new());
    for proposal in PROPOSALS.iter().filter(|proposal| !(proposal.is_of_places && data.assumed.still_scene)) {
        let mut asked: Vec<&mut Contest> =
            contests.iter_mut().filter(|contest| contest.admits(proposal)).collect();
        if asked.is_empty() {
            continue;
        }
        let of_take = |number: usize| -> Vec<Next> {
            let thinned = &takes[number];
            // What all sets say grows with their number.
            let sets = data.takes[number].moments.len() as f64 / thinned.moments.len() as f64;
            let pair = Pair::of(&camera, &judgement.fit, thinned, proposal, number);
            let of = |contest: &&mut Contest| {
                let separation = pair.separation(judgement.noise, &contest.own, contest.rival);
                Next {
                    between: contest.names().map(str::to_owned),
                    what: format!("{}: {}", thinned.name, proposal.what),
                    rho: rho(contest.names(), separation.map(|chi2| sets * chi2)),
                }
            };
            asked.iter().map(of).collect()
        };
        let by_take: Vec<Vec<Next>> = (0..takes.len()).into_par_iter().map(of_take).collect();
        for (place, contest) in asked.iter_mut().enumerate() {
            let of_all = by_take.iter().map(|of_take| &of_take[place]);
            contest.proposals.extend(of_all.max_by(|a, b| a.rho.total_cmp(&b.rho)).cloned());
        }
    }
    contests.into_iter().flat_map(|contest| best(contest.proposals)).collect()
}

/// By how many standard deviations a recording separates effects of these names, which leaves so much of what the first one explains there: without what their
/// forms may leave.
fn rho(names: [&str; 2], [left, explained]: [f64; 2]) -> f64 {
    let form = DISBELIEF * names.map(tolerance).into_iter().fold(0.0, f64::max);
    (left - form * explained).max(0.0).sqrt()
}

/// The best of the `proposals`, and a second one if that is enough, too.
fn best(mut proposals: Vec<Next>) -> Vec<Next> {
    proposals.sort_by(|a, b| b.rho.total_cmp(&a.rho));
    let is_worth = |(place, next): &(usize, Next)| *place == 0 || next.rho > ENOUGH_RHO;
    proposals.into_iter().enumerate().take(MOST_RECORDINGS).filter(is_worth).map(|(_, next)| next).collect()
}

/// A recording and a proposed change of it, as a campaign of their own.
struct Pair<'a> {
    data: Data,
    fit: &'a Fit,
    /// The pixels; where the plan has a modulation frequency of its own, nobody knows where their phases begin there.
    pixels: Arc<Pixels>,
    /// The recording's number in its campaign.
    take: usize,
}

impl<'a> Pair<'a> {
    /// With `recorded`, number `take` of the campaign whose camera `data` has. What would be measured does not matter, only that it would be, and not be clipped: samples of the plan are 0.
    fn of(data: &Data, fit: &'a Fit, recorded: &Take, proposal: &Proposal, take: usize) -> Self {
        let planned = proposal.of(recorded);
        let frames = planned.moments.len();
        let mut pixels = Arc::clone(&fit.pixels);
        if let Some(frequency_hz) = new_hz(&pixels, recorded, &planned) {
            let at = AtFrequency { frequency_hz, times: 1.0, phase_rad: 0.0 };
            Arc::make_mut(&mut pixels).at_frequencies.push(at);
        }
        let mut pair = Self { data: data.with_takes(vec![recorded.clone(), planned]), fit, pixels, take };
        let greatest_dn = f64::from(data.camera.full_scale()) - data.camera.pedestal_dn;
        let seen = |signal: &f64| if *signal < greatest_dn { 0.0 } else { f32::NAN };
        let pieces = pair.acting(&fit.pieces);
        let (model, _) = Tangents::new(&pair.data, &pair.pixels, &pieces, &[]);
        let signals = (0..frames).map(|index| model.base(1, index));
        let signal_dn = signals.flat_map(|signal| signal.iter().map(seen).collect::<Vec<_>>()).collect();
        pair.data.takes[1].signal_dn = signal_dn;
        pair
    }

    /// Of `pieces` those that act in the recording; in the plan, all act.
    fn acting(&self, pieces: &[Piece]) -> Vec<Piece> {
        let acts = |piece: &&Piece| piece.takes.contains(&self.take);
        let both = |piece: &Piece| Piece { takes: vec![0, 1], ..piece.clone() };
        pieces.iter().filter(acts).map(both).collect()
    }

    /// Of the chi squared that the effect of the pieces `own` explains what its `rival` leaves, in whatever shape, and all of it.
    fn separation(&self, noise: Noise, own: &[Piece], rival: &Candidate) -> [f64; 2] {
        let own = self.acting(own);
        let shapes: Vec<Vec<Piece>> =
            rival.variants.iter().map(|variant| self.acting(&variant.pieces)).collect();
        let rival = shapes.concat();
        if own.is_empty() || rival.is_empty() {
            return [0.0; 2];
        }
        let (tangents, columns) = Tangents::new(&self.data, &self.pixels, &own, &rival);
        let gram = Gram::of(&self.data, &tangents, noise, &|_| true);
        let Projected { matrix, raw, .. } = gram.project(Some(self.fit.jitter_m2));
        if matrix.iter().any(|value| !value.is_finite()) {
            return [0.0; 2];
        }
        // Of what the pixels' own numbers absorb altogether, rounding is left.
        let is_seen = |column: usize| matrix[(column, column)] > VISIBLE * raw[column];
        let mut first = 0;
        let mut columns_of = |pieces: usize| -> Vec<usize> {
            let pieces = first..first + pieces;
            first = pieces.end;
            let of = (0..columns.len()).filter(|&column| pieces.contains(&columns[column].piece));
            of.filter(|&column| is_seen(column)).collect()
        };
        let of_own = columns_of(own.len());
        let of_shapes: Vec<Vec<usize>> = shapes.iter().map(|shape| columns_of(shape.len())).collect();
        let strength = |&column: &usize| {
            let (piece, parameter) = (&own[columns[column].piece], columns[column].parameter);
            piece.values[parameter] - piece.effect.parameters[parameter].off
        };
        let theta = DVector::from_vec(of_own.iter().map(strength).collect());
        // A shape between two that were tried does what these do together.
        let pairs = of_shapes.iter().enumerate().flat_map(|(number, shape)| {
            of_shapes[number..].iter().map(move |other| match shape == other {
                true => shape.clone(),
                false => [&shape[..], other].concat(),
            })
        });
        let left_by = |others: &[usize]| left(&matrix, &of_own, others, &theta);
        [pairs.map(|pair| left_by(&pair)).fold(f64::INFINITY, f64::min), left_by(&[])]
    }
}

/// The modulation frequency of a plan, Hz, if the recording has another, and nothing is said of it.
fn new_hz(pixels: &Pixels, recorded: &Take, planned: &Take) -> Option<f64> {
    let (recorded, planned) = (Frequency::of(recorded)?, Frequency::of(planned)?);
    (recorded != planned && pixels.at_frequency(planned.hz).is_none()).then_some(planned.hz)
}

/// Less of a unit number is rounding.
const LEAST_SINGULAR: f64 = 1e-9;
/// Steps of a decomposition, which takes some ten a column.
const MOST_STEPS: usize = 10_000;

/// What is left of the chi squared of the columns `own`, changed by `theta`, beside the columns `others`; nothing where that cannot be computed.
fn left(matrix: &DMatrix<f64>, own: &[usize], others: &[usize], theta: &DVector<f64>) -> f64 {
    let part = |rows: &[usize], columns: &[usize]| {
        DMatrix::from_fn(rows.len(), columns.len(), |row, column| matrix[(rows[row], columns[column])])
    };
    let all = theta.dot(&(part(own, own) * theta));
    if others.is_empty() {
        return all;
    }
    // Each by its own unit: numbers of different units stand side by side.
    let unit = |column: usize| matrix[(column, column)].sqrt().recip();
    let units = DVector::from_vec(others.iter().map(|&column| unit(column)).collect());
    let within = part(others, others).component_mul(&(&units * units.transpose()));
    let shared = (part(others, own) * theta).component_mul(&units);
    // By no more than so many steps: there is no end where something is no number.
    let svd = within.try_svd(true, true, f64::EPSILON, MOST_STEPS);
    let inverse = svd.and_then(|svd| svd.pseudo_inverse(LEAST_SINGULAR).ok());
    let left = inverse.map(|inverse| all - shared.dot(&(inverse * &shared)));
    left.filter(|left| left.is_finite()).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::fit::fit;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;
    use crate::physics::Draws;

    #[test]
    fn what_the_others_do_is_taken_off() {
        let matrix = DMatrix::from_row_slice(3, 3, &[4.0, 2.0, 4.0, 2.0, 2.0, 2.0, 4.0, 2.0, 4.0]);
        let left = |others: &[usize]| left(&matrix, &[0], others, &DVector::from_element(1, 3.0));
        assert_eq!(left(&[]), 36.0);
        assert!((left(&[1]) - 18.0).abs() < 1e-9);
        assert!(left(&[2]).abs() < 1e-6 && left(&[1, 2]).abs() < 1e-6);
        // A column of which nothing is left but rounding, or no number, comes to an end, and promises nothing.
        for rounding in [-1e-18, 0.0, f64::NAN] {
            let matrix = DMatrix::from_row_slice(2, 2, &[4.0, 1e-9, 1e-9, rounding]);
            assert_eq!(super::left(&matrix, &[0], &[1], &DVector::from_element(1, 3.0)), 0.0, "{rounding}");
        }
    }

    /// By hand: of 500 a form of four per cent may leave 60 and one of one per cent 15, whichever of both names has it; of 1000 more than is left.
    #[test]
    fn what_forms_may_leave_separates_nothing() {
        let [exact, loose] = ["frame_gain", "multipath_interference"];
        assert!((rho([exact, loose], [160.0, 500.0]) - 10.0).abs() < 1e-9);
        assert!((rho([loose, exact], [160.0, 500.0]) - 10.0).abs() < 1e-9);
        assert!((rho([exact, exact], [160.0, 500.0]) - 145_f64.sqrt()).abs() < 1e-9);
        assert_eq!(rho([exact, loose], [100.0, 1000.0]), 0.0);
    }

    /// An effect is not told from a rival that has its very shape, whichever of the rival's that is, and hardly from one that has a shape on either side.
    #[test]
    fn a_rival_is_tried_in_every_shape() {
        use crate::physics::effects::multipath_interference::{SHARE, WALL};
        const PATH: &str = "multipath_interference";
        let recordings = taken(Geometry { width: 16, height: 12 }, 7, &[], &["four-rail"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let baseline = fit(&data, None, Vec::new(), noise, &|_| true);
        let candidates = candidates(&data, &baseline.series);
        let rival = candidates.iter().find(|candidate| candidate.effect.name == PATH).unwrap();
        let proposal = PROPOSALS.iter().find(|proposal| proposal.what.contains("reversed")).unwrap();
        let share_left = |wall_m: f64, rival: &Candidate| {
            let mut own = Piece::off(PATH, &[0], &[0]);
            (own.values[SHARE], own.values[WALL]) = (0.01, wall_m);
            let known = Fit { pieces: vec![own], ..baseline.clone() };
            let pair = Pair::of(&data, &known, &data.takes[0], proposal, 0);
            let [left, explained] = pair.separation(noise, &known.pieces, rival);
            left / explained
        };
        let alone = |number: usize| {
            let variants = vec![rival.variants[number].clone()];
            Candidate { variants, ..rival.clone() }
        };
        let least_alone = |wall_m: f64| {
            let each = (0..rival.variants.len()).map(|number| share_left(wall_m, &alone(number)));
            each.fold(f64::INFINITY, f64::min)
        };
        assert!(share_left(0.8, &alone(0)) > 0.1, "the first shape alone is told from it");
        assert!(share_left(0.8, rival).abs() < 1e-9);
        let (of_one, of_two) = (least_alone(0.55), share_left(0.55, rival));
        assert!(of_one > 0.005 && of_two < 0.1 * of_one, "{of_one} {of_two}");
    }

    /// The plan is taken, with noise, as it is with the asserted effect; the rival, fitted to both recordings, is worse by what was promised.
    #[test]
    fn what_is_promised_comes() {
        const SCALE: &str = "phase_step_scale";
        let effects = [injection("phase_step_scale:relative=0.004").unwrap()];
        let recordings = taken(Geometry { width: 16, height: 12 }, 7, &effects, &["four-rail"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let mut own = Piece::off(SCALE, &[0], &[0]);
        own.values[0] = 0.004;
        let known = fit(&data, None, vec![own], noise, &|_| true);
        let candidates = candidates(&data, &known.series);
        let rival = candidates.iter().find(|candidate| candidate.effect.name == "phase_step_errors").unwrap();
        let proposal = PROPOSALS.iter().find(|proposal| proposal.what.contains("reversed")).unwrap();
        let mut pair = Pair::of(&data, &known, &data.takes[0], proposal, 0);
        let [promised, explained] = pair.separation(noise, &known.pieces, rival);
        assert!(promised > 100.0 && promised < explained, "{promised} {explained}");
        let own = pair.acting(&known.pieces);
        let (model, _) = Tangents::new(&pair.data, &known.pixels, &own, &[]);
        let mut draws = Draws::of(11, 0);
        let mut taken = Vec::new();
        for index in 0..pair.data.takes[1].moments.len() {
            let signal = model.base(1, index);
            let noisy = signal.iter().zip(draws.normal(signal.len()));
            taken
                .extend(noisy.map(|(dn, draw)| (dn + (noise.floor + noise.slope * dn).sqrt() * draw) as f32));
        }
        drop(model);
        pair.data.takes[1].signal_dn = taken;
        let chi2 = |pieces: Vec<Piece>| fit(&pair.data, Some(&known), pieces, noise, &|_| true).chi2;
        let shapes = rival.variants.iter().map(|variant| pair.acting(&variant.pieces));
        let least = shapes.map(chi2).fold(f64::INFINITY, f64::min);
        let came = least - chi2(own);
        // A chi squared scatters by twice its root; the rival's numbers take some by chance.
        assert!((came - promised).abs() < 6.0 * promised.sqrt() + 20.0, "{came}, not {promised}");
    }
}
