//! What the forms of named effects may leave of what these explain.

use super::pass::DISBELIEF;
use super::pieces::tolerance;
use super::search::Named;

/// Effects of one quantity, ambient light or the power of the source: what the form of one leaves, another may look like.
const OF_ONE_QUANTITY: [&[&str]; 2] =
    [&["ambient_drift", "ambient_flicker"], &["frame_gain", "illumination_drift", "illumination_droop"]];

/// Whether two effects are of one quantity.
pub fn are_of_one_quantity(one: &str, other: &str) -> bool {
    OF_ONE_QUANTITY.iter().any(|names| names.contains(&one) && names.contains(&other))
}

/// What stands of the named effects' evidence may come from their own form: this much of what they explain is theirs.
pub fn tolerated(named: &[Named]) -> f64 {
    named.iter().map(|named| tolerance(named.name) * named.score.0).sum()
}

/// Of what effects explain together, the share that may be left of it before they are not believed: each one's form may leave a part of what that effect
/// explains, and no loose form excuses what is left of another's.
pub fn form_share(named: &[Named]) -> f64 {
    let all: f64 = named.iter().map(|named| named.score.0).sum();
    if all > 0.0 { DISBELIEF * tolerated(named) / all } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_weak_loose_form_excuses_little() {
        let named = |name, chi2| Named {
            name,
            ln_bayes: 0.0,
            score: (chi2, 1),
            rivals: Vec::new(),
            is_trusted: false,
        };
        let both = [named("encoder_cyclic", 194.0), named("intensity_related_phase", 30.0)];
        let is = |share: f64, of: &[Named]| (form_share(of) - share).abs() < 1e-12;
        assert!(is(0.03, &both[..1]) && is(0.24, &both[1..]));
        assert!(is(3.0 * (1.94 + 2.4) / 224.0, &both));
        assert_eq!(form_share(&[]), 0.0);
    }
}
