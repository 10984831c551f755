//! What the recordings would have shown: the smallest strength of each effect that 95 of 100 campaigns like this one show.

use super::candidates::Candidate;
use super::pass::THRESHOLD;
use crate::diagnose::fitting::projected::Projected;
use crate::diagnose::statistics::evidence::{Block, is_seen, powerful_rho};
use crate::diagnose::tangents::pieces::Piece;
use std::collections::BTreeMap;

/// What the recordings would show of an effect, in its usual shape.
#[derive(Debug, Clone, Copy)]
pub struct Detectable {
    /// The effect.
    pub name: &'static str,
    /// Its parameter.
    pub parameter: usize,
    /// Standard deviation of that, by the noise alone; none where the effect begins with a corner, below which it does nothing.
    pub sigma: Option<f64>,
    /// Strength at which the effect is found in 95 of 100 campaigns like this one.
    pub value: f64,
}

/// Another choice than the usual one is less usual than any other shape, and so is what has no ratio to it.
const OTHER: f64 = 1e3;

/// Of each number of the `candidates` the smallest strength that would be seen, in the most usual of the `blocks` that show it. Of what is `projected`, each
/// column has its candidate and the number of its parameter (`parameters`), and a number that may reach so far (`reach`); of each block
/// `scores` has the degrees of freedom.
pub fn detectable(
    projected: &Projected,
    parameters: &[(usize, usize)],
    reach: &dyn Fn(usize) -> f64,
    blocks: &[Block],
    scores: &[Option<(f64, usize)>],
    candidates: &[Candidate],
) -> Vec<Detectable> {
    let mut known = BTreeMap::<(usize, u64), f64>::new();
    let mut found: Vec<(f64, Detectable)> = Vec::new();
    for (block, score) in blocks.iter().zip(scores) {
        let Some((_, numbers)) = *score else { continue };
        let powerful = || powerful_rho(numbers, block.variants, candidates.len(), THRESHOLD);
        let rho = *known.entry((numbers, block.variants.to_bits())).or_insert_with(powerful);
        let piece = &candidates[block.candidate].variants[block.variant].pieces[0];
        let how_unusual = unusual(piece);
        for &column in &block.columns {
            let parameter = parameters[column].1;
            let information = projected.matrix[(column, column)];
            if !is_seen(information, projected.raw[column], reach(column)) {
                continue;
            }
            let sigma = information.sqrt().recip();
            let least = rho * sigma;
            let tried = piece.values[parameter];
            // Below its corner it does nothing: what is not seen at this value is not at a smaller one.
            if piece.finite && tried < least {
                continue;
            }
            let (sigma, value) = if piece.finite { (None, tried) } else { (Some(sigma), least) };
            let name = piece.effect.name;
            let row = Detectable { name, parameter, sigma, value };
            match found.iter_mut().find(|(_, found)| found.name == name && found.parameter == parameter) {
                Some(found) if (how_unusual, value) < (found.0, found.1.value) => *found = (how_unusual, row),
                Some(_) => {}
                None => found.push((how_unusual, row)),
            }
        }
    }
    found.into_iter().map(|(_, row)| row).collect()
}

/// How far the shape of `piece` is from its effect's usual one: nothing where it has it, or no shape.
fn unusual(piece: &Piece) -> f64 {
    let parameters = piece.effect.parameters.iter().zip(&piece.values);
    let of = parameters.filter(|(parameter, _)| parameter.is_shape()).map(|(parameter, &value)| {
        let far = (value / parameter.off).ln().abs();
        match value == parameter.off {
            true => 0.0,
            false if parameter.is_choice || !far.is_finite() => OTHER,
            false => far,
        }
    });
    of.sum()
}

#[cfg(test)]
mod tests {
    use crate::bench::taken;
    use crate::diagnose::Data;
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::naming::candidates::candidates;
    use crate::diagnose::naming::pass::Pass;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;
    use crate::physics::{Active, effects};

    /// A rail and a motion, with an effect.
    fn campaign(effects: &[Active]) -> Data {
        let size = Geometry { width: 12, height: 10 };
        Data::of(&taken(size, 4, effects, &["four-rail", "wdft-motion"]).unwrap(), Vec::new()).unwrap()
    }

    /// What the recordings show of an effect is by how much more they differ from a fit without it.
    #[test]
    fn what_is_promised_is_seen() {
        let clean = campaign(&[]);
        let noise = stated_noise(&clean);
        let baseline = unfitted(&clean, noise);
        let candidates = candidates(&clean, &baseline.series);
        let rows = Pass::of(&clean, &baseline, &candidates, noise, 1.0).detectable;
        let row = |name: &str| rows.iter().find(|row| row.name == name).unwrap();
        let seen = |name: &str, value: f64| {
            let (effect, parameter) = (effects::named(name).unwrap(), row(name).parameter);
            let mut values = effect.off();
            values[parameter] = value;
            unfitted(&campaign(&[Active { effect, values }]), noise).chi2 - baseline.chi2
        };
        // Noise adds two standard deviations of the strength. A line of the encoder is taken for its noise in part.
        for (name, is_seen) in
            [("image_lag", 0.7..1.4), ("lens_scatter", 0.7..1.4), ("encoder_cyclic", 0.4..1.4)]
        {
            let row = row(name);
            let value = 4.0 * row.value;
            let (seen, promised) = (seen(name, value), (value / row.sigma.unwrap()).powi(2));
            assert!(is_seen.contains(&(seen / promised)), "{name} {row:?}: {seen} of {promised}");
        }
        // A well's corner is found to a step.
        let well = row("saturation");
        let (there, before) = (seen(well.name, well.value), seen(well.name, well.value - 0.1));
        assert!(there > 100.0 && before < 0.1 * there, "{well:?}: {there}, a step before {before}");
    }
}
