//! A named effect as other programs read it.

use super::answer::{EffectRow, EvidenceRow, ParameterRow};
use super::common_part::CommonPart;
use crate::diagnose::fitting::bounds::is_at_bound;
use crate::diagnose::forms::other_camera::{OTHER_CAMERA, spot_sigmas};
use crate::diagnose::forms::other_choices;
use crate::diagnose::forms::roundings::says_of_settings;
use crate::diagnose::judging::judge::Judgement;
use crate::diagnose::naming::alias::{alias_odds, odds_against};
use crate::diagnose::naming::found::Named;
use crate::diagnose::periodic::images::{Image, also_seen, images, spread};
use crate::diagnose::periodic::lamps::FLICKER;
use crate::diagnose::reading::data::Data;
use crate::diagnose::shared_errors::random::{EXCESS_NOISE, Strength};
use crate::diagnose::tangents::pieces::Piece;
use crate::physics::Effect;
use crate::physics::effects::multi_camera_interference::SPOT;
use crate::recording::effect_name;

/// The row of what is `named`.
pub fn effect_row(data: &Data, judgement: &Judgement, named: &Named) -> EffectRow {
    let images = if named.name == FLICKER { images(data, &judgement.fit) } else { Vec::new() };
    let common = CommonPart::of(data, &judgement.fit, named.name);
    let sentence = data.effect(named.name).map_or("", |effect| effect.sentence);
    let names: Vec<&str> = judgement.named.iter().map(|named| named.name).collect();
    let mut also_possible: Vec<String> = Vec::new();
    for rival in &named.rivals {
        if !names.contains(&rival.as_str()) {
            also_possible.push(rival.clone());
        }
    }
    let (chi2, degrees_of_freedom) = named.score;
    let rho = (chi2 - degrees_of_freedom as f64).max(0.0).sqrt();
    // Everything else that is known has what the threshold leaves.
    let alias = alias_odds(rho, named.is_trusted);
    let against = odds_against(rho, named.is_trusted, named.rivals.len());
    let probability = 1.0 / (1.0 + against + (-named.ln_bayes).exp());
    EffectRow {
        name: named.name,
        sentence: format!(
            "{sentence}{}{}{}{}",
            also_seen(&images),
            says_of_settings(&judgement.fit.pieces, named.name),
            common.as_ref().map_or_else(String::new, CommonPart::in_words),
            beside_included(data, &judgement.fit.pieces, named.name)
        ),
        probability,
        alias_risk: alias * probability,
        also_possible,
        parameters: parameters(data, judgement, named.name, &images, common.as_ref()),
        evidence: EvidenceRow {
            delta_chi2: chi2,
            degrees_of_freedom,
            ln_bayes_factor: named.ln_bayes,
            detectability_rho: rho,
        },
    }
}

/// The `strength` of the random effect called `name`, with what the camera includes of it.
pub fn in_all(data: &Data, name: &str, strength: Strength) -> Strength {
    // Of jitters all is found; of noise, what there is beside the included one.
    if name != EXCESS_NOISE || data.unpredicted.square == 0.0 {
        return strength;
    }
    let value = strength.value.hypot(data.unpredicted.square.sqrt());
    Strength { value, sigma: strength.sigma * strength.value / value }
}

/// What a sentence says besides, where the camera includes the effect called `name`, of which these are the `pieces`, with a value.
fn beside_included(data: &Data, pieces: &[Piece], name: &str) -> &'static str {
    let is_included = data.described.effects.iter().any(|text| effect_name(text) == name);
    let mut of = pieces.iter().filter(|piece| piece.effect.name == name).peekable();
    let is_less = of.peek().is_some() && of.all(Piece::takes_away);
    match is_included {
        true if is_less => " The camera includes too much of it: this is what is to be taken away.",
        true if data.effect(name).is_some_and(Effect::is_predicted) => {
            " This is beside what the camera includes of it."
        }
        true => " There is more of it than the camera includes.",
        false => "",
    }
}

/// The fitted values of the effect called `name`, piece by piece, without what they have in `common`; of a line, not better known than which of its `images` it is.
fn parameters(
    data: &Data,
    judgement: &Judgement,
    name: &str,
    images: &[Image],
    common: Option<&CommonPart>,
) -> Vec<ParameterRow> {
    let fit = &judgement.fit;
    let of = |piece: &&Piece| piece.effect.name == name;
    let several = fit.pieces.iter().filter(of).count() > 1;
    let mut rows = Vec::new();
    for (number, piece) in fit.pieces.iter().enumerate().filter(|(_, piece)| of(piece)) {
        let takes: Vec<&str> = piece.takes.iter().map(|&take| data.takes[take].name.as_str()).collect();
        let of_choices = other_choices::spread(data, fit, judgement.noise, number);
        let suffix = if several { format!(" ({})", takes.join(", ")) } else { String::new() };
        for (parameter, known) in piece.effect.parameters.iter().enumerate() {
            let column = fit.column_of(number, parameter);
            let value = piece.values[parameter];
            let (value, sigma) = column.map_or((value, 0.0), |column| {
                let without = common.and_then(|common| common.without(fit, column, value));
                without.unwrap_or((value, fit.sigma(column)))
            });
            let sigma = sigma.hypot(spread(images, fit, number, parameter)).hypot(of_choices[parameter]);
            let in_all = piece.in_all(parameter);
            let at_bound = column.is_some() && is_at_bound(known, in_all, fit.pixels.full_scale_dn);
            // Nor is a shape said of what has none.
            let says = known.is_choice || known.is_shape() && piece.has_shapes();
            if column.is_none() && !says {
                continue;
            }
            rows.push(ParameterRow {
                name: format!("{}{suffix}", known.name),
                value,
                sigma: if sigma.is_finite() { sigma } else { 0.0 },
                unit: known.unit,
                at_bound,
            });
        }
    }
    rows.extend(spot_rows(data, judgement, name));
    if rows.is_empty() {
        // A random effect is not fitted with the others: its strength is from what they leave.
        let random = judgement.random.iter().copied().find(|(random, _)| *random == name);
        let parameter = data.effect(name).and_then(|effect| effect.parameters.first());
        rows.extend(random.zip(parameter).map(|((_, strength), parameter)| {
            let Strength { value, sigma } = in_all(data, name, strength);
            ParameterRow {
                name: parameter.name.to_owned(),
                value,
                sigma,
                unit: parameter.unit,
                at_bound: false,
            }
        }));
    }
    rows
}

/// Where the light of another camera falls, which is the same in all recordings.
fn spot_rows(data: &Data, judgement: &Judgement, name: &str) -> Vec<ParameterRow> {
    let is_it = |piece: &&Piece| piece.effect.name == name && name == OTHER_CAMERA;
    let piece = judgement.fit.pieces.iter().find(is_it);
    let sigmas = || spot_sigmas(data, &judgement.fit, judgement.noise);
    let Some((piece, sigmas)) = piece.and_then(|piece| Some((piece, sigmas()?))) else { return Vec::new() };
    let row = |(number, sigma): (usize, f64)| {
        let parameter = &piece.effect.parameters[number];
        let (name, value) = (parameter.name.to_owned(), piece.values[number]);
        ParameterRow { name, value, sigma, unit: parameter.unit, at_bound: false }
    };
    SPOT.zip(sigmas).map(row).collect()
}
