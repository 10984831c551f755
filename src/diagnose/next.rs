//! The recording that would tell apart what these recordings do not.
//!
//! Each proposal is a recorded one that would be taken otherwise. It is simulated at the fitted pixels, and judged together with the one that
//! it changes, without the rest of the campaign, by what separates the asserted effect from its rival:
//! D = ½ θ' (K_cc − K_cr K_rr⁻¹ K_rc) θ, with K the information of both effects' parameters; √(2 D) standard deviations.

use super::columns::Tangents;
use super::data::{Data, Take};
use super::gram::Gram;
use super::judge::Judgement;
use super::pieces::{Piece, candidates};
use crate::physics::Moment;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// A recording that could be taken.
struct Proposal {
    what: &'static str,
    /// How a recorded frame would be taken instead.
    change: fn(&Moment) -> Moment,
}

const PROPOSALS: [Proposal; 6] = [
    Proposal {
        what: "the same with another modulation frequency (4/3 of it)",
        change: |m| Moment { frequency_hz: m.frequency_hz * 4.0 / 3.0, ..*m },
    },
    Proposal {
        what: "the same with the phase steps in reversed order",
        change: |m| Moment { step_rad: -m.step_rad, ..*m },
    },
    Proposal { what: "the same with the lens covered", change: |m| Moment { lit: false, ..*m } },
    Proposal {
        what: "the same at twice the velocity, or moving where it stood (1 m/s)",
        change: |m| Moment {
            velocity_m_s: if m.velocity_m_s == 0.0 { 1.0 } else { 2.0 * m.velocity_m_s },
            ..*m
        },
    },
    Proposal {
        what: "the same at a third of the distance",
        change: |m| Moment { position_m: m.position_m / 3.0, place_m: m.place_m / 3.0, ..*m },
    },
    Proposal {
        what: "the same with phase offsets over the whole turn",
        change: |m| Moment { offset_rad: TAU * (m.set % 16) as f64 / 16.0, ..*m },
    },
];

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

/// The best recording for each asserted effect that has a rival.
pub fn next(data: &Data, judgement: &Judgement) -> Vec<Next> {
    let candidates = candidates(data, &judgement.found.baseline.series);
    let mut found = Vec::new();
    for named in &judgement.named {
        let own: Vec<Piece> =
            judgement.fit.pieces.iter().filter(|piece| piece.effect.name == named.name).cloned().collect();
        let rival = named.rivals.iter().find_map(|rival| candidates.iter().find(|c| c.effect.name == *rival));
        let Some(rival) = rival.filter(|_| !own.is_empty()) else { continue };
        let Some(variant) = rival.variants.first() else { continue };
        let best = PROPOSALS
            .iter()
            .flat_map(|proposal| (0..data.takes.len()).map(move |take| (proposal, take)))
            .filter(|(_, take)| data.takes[*take].moments.len() <= MOST_FRAMES)
            .map(|(proposal, take)| {
                (proposal, take, separation(data, judgement, &own, &variant.pieces, proposal, take))
            })
            .max_by(|a, b| a.2.total_cmp(&b.2));
        if let Some((proposal, take, rho)) = best {
            found.push(Next {
                between: [named.name.to_owned(), rival.effect.name.to_owned()],
                what: format!("{}: {}", data.takes[take].name, proposal.what),
                rho,
            });
        }
    }
    found
}

/// Longer recordings are not proposed again.
const MOST_FRAMES: usize = 600;

/// By how many standard deviations `own` and `rival` differ in recording `take` and the proposed change of it, without the others.
fn separation(
    data: &Data,
    judgement: &Judgement,
    own: &[Piece],
    rival: &[Piece],
    proposal: &Proposal,
    take: usize,
) -> f64 {
    let recorded = &data.takes[take];
    let moments: Vec<Moment> = recorded.moments.iter().map(proposal.change).collect();
    let planned = Take { moments, ..recorded.clone() };
    let mut with_plan = data.with_takes(vec![recorded.clone(), planned]);
    // In the plan, all act.
    let everywhere = |pieces: &[Piece]| -> Vec<Piece> {
        pieces
            .iter()
            .filter(|piece| piece.takes.contains(&take))
            .map(|piece| Piece { takes: vec![0, 1], ..piece.clone() })
            .collect()
    };
    let (own, rival) = (everywhere(own), everywhere(rival));
    if own.is_empty() || rival.is_empty() {
        return 0.0;
    }
    // What would be measured does not matter, only that it would be, and not be clipped.
    let (model, _) =
        Tangents::new(&with_plan, &judgement.fit.pixels, &everywhere(&judgement.fit.pieces), &[]);
    let greatest_dn = f64::from(data.camera.full_scale()) - data.camera.pedestal_dn;
    let seen = |signal: &f64| if *signal < greatest_dn { 0.0 } else { f32::NAN };
    let frames = (0..recorded.moments.len()).map(|index| model.base(1, index));
    let signal_dn = frames.flat_map(|signal| signal.iter().map(seen).collect::<Vec<_>>()).collect();
    with_plan.takes[1].signal_dn = signal_dn;
    let (tangents, columns) = Tangents::new(&with_plan, &judgement.fit.pixels, &own, &rival);
    let gram = Gram::of(&with_plan, &tangents, judgement.noise, &|_| true);
    let matrix = gram.project(Some(judgement.fit.jitter_m2)).matrix;
    let count = columns.iter().filter(|column| column.piece < own.len()).count();
    let theta = DVector::from_iterator(
        count,
        columns[..count].iter().map(|column| {
            let piece = &own[column.piece];
            piece.values[column.parameter] - piece.effect.parameters[column.parameter].off
        }),
    );
    let others = columns.len() - count;
    let cross = matrix.view((0, count), (count, others)).into_owned();
    let within = matrix.view((count, count), (others, others)).into_owned();
    let inverse =
        within.pseudo_inverse(1e-9 * matrix.norm().max(1e-300)).unwrap_or(DMatrix::zeros(others, others));
    let left = matrix.view((0, 0), (count, count)) - &cross * inverse * cross.transpose();
    (theta.dot(&(left * &theta))).max(0.0).sqrt()
}
