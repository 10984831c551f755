//! Calibration by a cubic B-spline.

use super::calibration::Calibration;

/// Intervals of a turn: two for each of the error's half cycles. Assumed.
const INTERVALS: i32 = 16;

/// A periodic cubic B-spline with even knots.
pub const B_SPLINE: Calibration = Calibration { name: "cubic B-spline, 16 intervals", basis };

fn basis(turns: f64) -> Vec<f64> {
    let period = f64::from(INTERVALS);
    let value = |knot: i32| {
        let away = turns * period - f64::from(knot);
        // To the nearest of its periods.
        let away = (away - period * (away / period).round()).abs();
        match away {
            a if a < 1.0 => (4.0 - 6.0 * a * a + 3.0 * a * a * a) / 6.0,
            a if a < 2.0 => (2.0 - a).powi(3) / 6.0,
            _ => 0.0,
        }
    };
    (0..INTERVALS).map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn its_parts_sum_to_one_everywhere() {
        for n in 0..100 {
            let sum: f64 = basis(f64::from(n) / 100.0).iter().sum();
            assert!((sum - 1.0).abs() < 1e-12, "{sum}");
        }
    }
}
