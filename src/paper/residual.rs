//! What the paper makes of errors: without their mean or a fitted line, root mean square, range.

/// Root mean square of `values`; NaN where there are none.
pub fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

/// The largest value less the least.
pub fn span(values: &[f64]) -> f64 {
    let (low, high) = values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)));
    high - low
}

/// The mean; NaN where there are no values.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// `values` less their mean.
pub fn without_mean(values: &[f64]) -> Vec<f64> {
    let mean = mean(values);
    values.iter().map(|value| value - mean).collect()
}

/// Ordinates of `points` less the line that fits them best by least squares. At least two different abscissas.
pub fn without_line(points: &[(f64, f64)]) -> Vec<f64> {
    let n = points.len() as f64;
    let centre = points.iter().fold((0.0, 0.0), |sum, point| (sum.0 + point.0 / n, sum.1 + point.1 / n));
    let (mut square, mut product) = (0.0, 0.0);
    for (x, y) in points {
        square += (x - centre.0) * (x - centre.0);
        product += (x - centre.0) * (y - centre.1);
    }
    let slope = product / square;
    points.iter().map(|(x, y)| y - centre.1 - slope * (x - centre.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_leaves_nothing_and_a_kink_does() {
        let line: Vec<(f64, f64)> = (0..9).map(|n| (f64::from(n), 3.0 - 0.5 * f64::from(n))).collect();
        assert!(without_line(&line).iter().all(|rest| rest.abs() < 1e-12));
        let kink = without_line(&[(-1.0, 1.0), (0.0, 0.0), (1.0, 1.0)]);
        assert!((kink[0] - 1.0 / 3.0).abs() < 1e-12 && (kink[1] + 2.0 / 3.0).abs() < 1e-12);
        assert_eq!((span(&[1.0, -2.0, 0.5]), rms(&[3.0, -3.0])), (3.0, 3.0));
        assert_eq!(without_mean(&[1.0, 3.0]), [-1.0, 1.0]);
    }
}
