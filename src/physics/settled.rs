//! How far a drift has come.

/// Of a drift that settles with a time constant of `tau_s`, as what warms up does, the share that is done after `time_s`: 1 in the end. Or, where it
/// `accelerates` (not 0), the beginning of its mirror image, exp(x) - 1 to the second order: twice as fast after `tau_s` as in the beginning, and never done.
pub fn settled(time_s: f64, tau_s: f64, accelerates: f64) -> f64 {
    let x = time_s / tau_s;
    match accelerates {
        0.0 => -libm::expm1(-x),
        _ => x * (1.0 + 0.5 * x),
    }
}

#[cfg(test)]
mod tests {
    use super::settled;

    /// By hand, at half and at three time constants.
    #[test]
    fn a_drift_settles_or_accelerates() {
        let is_near = |(x, accelerates, expected): (f64, f64, f64)| {
            (settled(7.0 * x, 7.0, accelerates) - expected).abs() < 1e-6
        };
        let expected = [(0.5, 0.0, 0.393_469_3), (3.0, 0.0, 0.950_212_9), (0.5, 1.0, 0.625), (3.0, 1.0, 7.5)];
        assert!(expected.into_iter().all(is_near));
        // Both begin alike.
        assert!((settled(1e-6, 1.0, 0.0) / settled(1e-6, 1.0, 1.0) - 1.0).abs() < 1e-5);
    }
}
