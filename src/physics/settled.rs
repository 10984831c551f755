//! How far a drift has come.

/// In this time a drift that accelerates comes as far as its strength says, s.
const MINUTE_S: f64 = 60.0;

/// Of a drift that settles with a time constant of `tau_s`, as what warms up does, the share that is done after `time_s`: 1 in the end. Or, where it
/// `accelerates` (not 0), how far it has come, in units of the first minute.
pub fn settled(time_s: f64, tau_s: f64, accelerates: f64) -> f64 {
    match accelerates {
        0.0 => -libm::expm1(-time_s / tau_s),
        _ => accelerated_s(time_s, tau_s) / accelerated_s(MINUTE_S, tau_s),
    }
}

/// After `time_s`, the time in which a drift that is twice as fast after `tau_s`, and goes on like that, would have come as far at its first speed, s.
pub fn accelerated_s(time_s: f64, tau_s: f64) -> f64 {
    time_s * (1.0 + 0.5 * time_s / tau_s)
}

#[cfg(test)]
mod tests {
    use super::{accelerated_s, settled};

    /// By hand, at half and at three time constants.
    #[test]
    fn a_drift_settles_or_accelerates() {
        let is_near = |(x, expected): (f64, f64)| (settled(7.0 * x, 7.0, 0.0) - expected).abs() < 1e-6;
        assert!([(0.5, 0.393_469_3), (3.0, 0.950_212_9)].into_iter().all(is_near));
        assert!(
            [(0.5, 0.625), (3.0, 7.5)]
                .iter()
                .all(|(x, s)| (accelerated_s(7.0 * x, 7.0) - 7.0 * s).abs() < 1e-9)
        );
        // Even, as the square of the time, and always 1 after a minute.
        let ratio = |tau_s: f64| settled(600.0, tau_s, 1.0) / settled(60.0, tau_s, 1.0);
        assert!((ratio(1e9) - 10.0).abs() < 1e-3 && (ratio(1e-9) - 100.0).abs() < 1e-3);
        assert!([2.0, 60.0, 2000.0].iter().all(|&tau_s| (settled(60.0, tau_s, 1.0) - 1.0).abs() < 1e-12));
    }
}
