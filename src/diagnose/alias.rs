//! How likely something that nobody has written down looks like a known effect.

/// Chi squared that noise hides: a residual of less is not seen beside what a name explains.
const HIDDEN: f64 = 10.0;

/// Odds, against a name that is asserted, of an effect outside the library whose residual is the named one's but for what noise hides: it hides
/// the share 10 / rho² of the residual. That one in so many unknown effects falls within it, and that unknown effects are as frequent as
/// known ones, is an assumption, which the calibration of blind campaigns tests (`vuris challenge score`).
pub fn alias_odds(rho: f64) -> f64 {
    HIDDEN / rho.powi(2).max(HIDDEN)
}

#[cfg(test)]
mod tests {
    use super::alias_odds;

    #[test]
    fn a_strong_effect_has_no_alias() {
        assert_eq!(alias_odds(0.0), 1.0);
        assert!((alias_odds(10.0) - 0.1).abs() < 1e-12 && (alias_odds(100.0) - 1e-3).abs() < 1e-12);
    }
}
