//! How likely something that nobody has written down looks like a known effect.

/// Chi squared that noise hides: a residual of less is not seen beside what a name explains.
const HIDDEN: f64 = 10.0;
/// The same beside an effect whose form may leave more than what is named: so much stands out nowhere.
const HIDDEN_BY_FORMS: f64 = 40.0;
/// However strong a name is, it is something else so often: of 85 names that were stated with more than 0.95 in a blind set (`docs/challenge.md`) two were.
const NEVER_SURE: f64 = 0.02;

/// Odds, against a name that is asserted, of an effect outside the library whose residual is the named one's but for what noise hides: it hides
/// the share 10 / rho² of the residual. That one in so many unknown effects falls within it, and that unknown effects are as frequent as
/// known ones, is an assumption, which the calibration of blind campaigns tests (`vuris challenge score`). Of a name that is trusted though the forms of others may leave more
/// than it explains, 40 is hidden. No name is sure.
pub fn alias_odds(rho: f64, is_trusted: bool) -> f64 {
    let hidden = if is_trusted { HIDDEN_BY_FORMS } else { HIDDEN };
    (hidden / rho.powi(2).max(hidden)).max(NEVER_SURE)
}

/// Odds against a name beside so many rivals within a few nats, which have as much of it each as one that is a nat and a half less likely, and beside what
/// nobody has written down.
pub fn odds_against(rho: f64, is_trusted: bool, rivals: usize) -> f64 {
    rivals as f64 * (-1.5_f64).exp() + alias_odds(rho, is_trusted)
}

#[cfg(test)]
mod tests {
    use super::{NEVER_SURE, alias_odds, odds_against};

    #[test]
    fn a_strong_effect_has_few_aliases() {
        assert_eq!(alias_odds(0.0, false), 1.0);
        let is = |rho: f64, is_trusted: bool, odds: f64| (alias_odds(rho, is_trusted) - odds).abs() < 1e-12;
        // A trusted name of rho 8 is as likely as not without a rival, and less so beside two.
        assert!(odds_against(8.0, true, 0) < 1.0 && odds_against(8.0, true, 2) > 1.0);
        assert!(odds_against(9.0, true, 2) < 1.0 && odds_against(6.0, true, 0) == 1.0);
        assert!(
            is(10.0, false, 0.1)
                && is(20.0, false, 0.025)
                && is(100.0, false, NEVER_SURE)
                && is(20.0, true, 0.1)
        );
    }
}
