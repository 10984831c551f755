//! What the recordings would have shown: the smallest strength of each effect that 95 of 100 campaigns like this one show.

use super::evidence::{Block, is_seen, powerful_rho};
use super::gram::Projected;
use super::pass::THRESHOLD;
use super::pieces::{Candidate, Piece};
use std::collections::BTreeMap;

/// What the recordings would show of an effect, in its usual shape.
#[derive(Debug, Clone, Copy)]
pub struct Detectable {
    /// The effect.
    pub name: &'static str,
    /// Its parameter.
    pub parameter: usize,
    /// Standard deviation of that, by the noise alone.
    pub sigma: f64,
    /// Strength at which the effect is found in 95 of 100 campaigns like this one.
    pub value: f64,
}

/// Another choice than the usual one is less usual than any other shape.
const OTHER_CHOICE: f64 = 1e3;

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
            let mut sigma = information.sqrt().recip();
            let mut value = rho * sigma;
            if piece.finite {
                // Below its corner it does nothing: what was not seen at that value may not be seen at any smaller one.
                if piece.values[parameter] < value {
                    continue;
                }
                value = piece.values[parameter];
                sigma = value / rho;
            }
            let name = piece.effect.name;
            let row = Detectable { name, parameter, sigma, value };
            match found.iter_mut().find(|(_, known)| known.name == name && known.parameter == parameter) {
                Some(known) if (how_unusual, value) < (known.0, known.1.value) => *known = (how_unusual, row),
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
        if parameter.is_choice {
            if value == parameter.off { 0.0 } else { OTHER_CHOICE }
        } else if value > 0.0 && parameter.typical > 0.0 {
            (value / parameter.typical).ln().abs()
        } else {
            (value - parameter.typical).abs()
        }
    });
    of.sum()
}

#[cfg(test)]
mod tests {
    use crate::bench::{Plan, practice_camera, taken};
    use crate::diagnose::Data;
    use crate::diagnose::fit::unfitted;
    use crate::diagnose::pass::Pass;
    use crate::diagnose::pieces::candidates;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;
    use crate::physics::{Active, FREQUENCY_HZ, effects};

    /// A rail and a motion, with an effect.
    fn campaign(effects: &[Active]) -> Data {
        let camera = practice_camera(Geometry { width: 12, height: 10 });
        let plan = Plan { frequency_hz: FREQUENCY_HZ, frame_period_s: 0.025, seed: 4 };
        Data::of(&taken(&camera, &plan, effects, &["four-rail", "wdft-motion"]).unwrap(), Vec::new()).unwrap()
    }

    /// What the recordings show of an effect is by how much more they differ from a fit without it.
    #[test]
    fn what_is_promised_is_seen() {
        let clean = campaign(&[]);
        let noise = stated_noise(&clean);
        let baseline = unfitted(&clean, noise);
        let candidates = candidates(&clean, &baseline.series);
        let rows = Pass::of(&clean, &baseline, &candidates, noise, 1.0).detectable;
        // Noise adds two standard deviations of the strength. A line of the encoder is taken for its noise in part, and beyond a corner more is seen than just there.
        let many = f64::INFINITY;
        for (name, times, is_seen) in [
            ("image_lag", 4.0, 0.7..1.4),
            ("lens_scatter", 4.0, 0.7..1.4),
            ("encoder_cyclic", 4.0, 0.4..1.4),
            ("saturation", 1.0, 1.0..many),
        ] {
            let row = rows.iter().find(|row| row.name == name).unwrap();
            let effect = effects::named(name).unwrap();
            let usual = |parameter: &crate::physics::Parameter| match parameter.is_shape() {
                true if !parameter.is_choice => parameter.typical,
                _ => parameter.off,
            };
            let mut values: Vec<f64> = effect.parameters.iter().map(usual).collect();
            values[row.parameter] = times * row.value;
            let with = unfitted(&campaign(&[Active { effect, values }]), noise);
            let (seen, promised) = (with.chi2 - baseline.chi2, (times * row.value / row.sigma).powi(2));
            assert!(is_seen.contains(&(seen / promised)), "{name} {row:?}: {seen} of {promised}");
        }
    }
}
