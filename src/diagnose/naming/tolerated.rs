//! What the forms of named effects may leave of what these explain.

use super::found::Named;
use super::pass::DISBELIEF;
use crate::physics::{EFFECTS, Fidelity};

/// Effects of one quantity, ambient light or the power of the source: what the form of one leaves, another may look like.
const OF_ONE_QUANTITY: [&[&str]; 2] =
    [&["ambient_drift", "ambient_flicker"], &["frame_gain", "illumination_drift", "illumination_droop"]];

/// Effects by which light seems to come further, or less far, by how much it comes: what the form of one leaves, the others say as a rule. (Of twelve second paths by a
/// wall, of rho 60 to 350, in frames of a generator in another language one in two left what one of these says.)
const OF_DISTANCE: [&str; 6] = [
    "encoder_offset",
    "encoder_scale",
    "illumination_baseline",
    "intensity_related_phase",
    "modulation_frequency_error",
    "multipath_interference",
];

/// Share of what the effect called `name` explains that its own form may leave; a user's formula is exact.
pub fn tolerance(name: &str) -> f64 {
    let known = EFFECTS.iter().find(|effect| effect.name == name);
    match known.map_or(Fidelity::Exact, |effect| effect.fidelity) {
        Fidelity::Law => 1e-4,
        Fidelity::Exact => 0.01,
        Fidelity::Approximate => 0.04,
        Fidelity::Loose => 0.08,
    }
}

/// Whether two effects both change how far light seems to come.
pub fn are_of_distance(one: &str, other: &str) -> bool {
    OF_DISTANCE.contains(&one) && OF_DISTANCE.contains(&other)
}

/// Whether two effects are of one quantity.
pub fn are_of_one_quantity(one: &str, other: &str) -> bool {
    OF_ONE_QUANTITY.iter().any(|names| names.contains(&one) && names.contains(&other))
}

/// What stands of the named effects' evidence may come from their own form: this much of what they explain is theirs.
pub fn tolerated(named: &[Named]) -> f64 {
    named.iter().map(|named| tolerance(named.name) * named.score.0).sum()
}

/// Effects that are not the same where the target is again, or near: of light, and others.
const CHANGING: [&[&str]; 2] = [
    &["ambient_drift", "ambient_flicker", "illumination_drift", "response_decay"],
    &["phase_drift", "encoder_cyclic"],
];
/// Of what the form of another effect leaves, what is not the same there.
const NOT_STRAIGHT: f64 = 0.02;

/// The same of what is new each time that the target is somewhere; of light only if what is left may be of that, and not of what is `steady` though it is among those.
pub fn tolerated_as_new(named: &[Named], may_be_of_light: bool, steady: &dyn Fn(&str) -> bool) -> f64 {
    let [of_light, others] = CHANGING;
    let share = |name: &str| match name {
        name if steady(name) => NOT_STRAIGHT,
        name if others.contains(&name) || may_be_of_light && of_light.contains(&name) => 1.0,
        _ => NOT_STRAIGHT,
    };
    named.iter().map(|named| share(named.name) * tolerance(named.name) * named.score.0).sum()
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

    /// An effect of one number that explains so much.
    fn named(name: &'static str, chi2: f64) -> Named {
        Named { name, ln_bayes: 0.0, score: (chi2, 1), rivals: Vec::new(), is_trusted: false }
    }

    #[test]
    fn a_weak_loose_form_excuses_little() {
        let both = [named("encoder_cyclic", 194.0), named("intensity_related_phase", 30.0)];
        let is = |share: f64, of: &[Named]| (form_share(of) - share).abs() < 1e-12;
        assert!(is(0.03, &both[..1]) && is(0.24, &both[1..]));
        assert!(is(3.0 * (1.94 + 2.4) / 224.0, &both));
        assert_eq!(form_share(&[]), 0.0);
    }

    #[test]
    fn where_the_target_is_again_little_is_left_but_of_what_goes_with_the_time() {
        let all = [named("lens_scatter", 1e6), named("ambient_flicker", 1e5), named("phase_drift", 1e4)];
        let of = |number: usize| tolerance(all[number].name) * all[number].score.0;
        let is_of = |of_light, steady: &str, expected: f64| {
            (tolerated_as_new(&all, of_light, &|name| name == steady) / expected - 1.0).abs() < 1e-12
        };
        let is = |of_light, expected: f64| is_of(of_light, "", expected);
        assert!(is(true, 0.02 * of(0) + of(1) + of(2)));
        assert!(is(false, 0.02 * (of(0) + of(1)) + of(2)));
        assert!(is_of(true, "phase_drift", 0.02 * (of(0) + of(2)) + of(1)));
    }
}
