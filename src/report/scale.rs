//! Round numbers for the ends and the ticks of a colour bar.

/// The values that are numbers.
pub fn finite(values: &[f64]) -> impl Iterator<Item = f64> + '_ {
    values.iter().copied().filter(|value| value.is_finite())
}

/// The range's scale: whole steps of 1, 2 or 5 times a power of ten around all finite values.
pub struct RangeScale {
    /// Lower end, m.
    pub low_m: f64,
    /// Upper end, m.
    pub high_m: f64,
    step_m: f64,
}

impl RangeScale {
    /// The scale of `range_m`; 0 to 1 m where it holds no number.
    pub fn of(range_m: &[f64]) -> Self {
        let (low_m, high_m) = finite(range_m)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        if low_m > high_m {
            return Self { low_m: 0.0, high_m: 1.0, step_m: 1.0 };
        }
        let step_m = round_up((high_m - low_m).max(1e-3) / 6.0, &[1.0, 2.0, 5.0]);
        let low_m = (low_m / step_m).floor() * step_m;
        Self { low_m, high_m: ((high_m / step_m).ceil() * step_m).max(low_m + step_m), step_m }
    }

    /// Place, 0 to 1, and label.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        let steps = ((self.high_m - self.low_m) / self.step_m).round();
        (0..=steps as usize)
            .map(|tick| (tick as f64 / steps, plain(self.low_m + tick as f64 * self.step_m)))
            .collect()
    }
}

/// A round error that 99 % of the values do not exceed: a few outliers must not bleach the rest.
pub fn error_limit<'a>(errors_m: impl Iterator<Item = &'a f64>) -> f64 {
    let mut sizes: Vec<f64> = errors_m.map(|error| error.abs()).filter(|size| size.is_finite()).collect();
    sizes.sort_by(f64::total_cmp);
    let most = sizes.get(sizes.len() * 99 / 100).copied().unwrap_or(0.0);
    round_up(most.max(1e-6), &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0])
}

/// The least of `mantissas` times a power of ten that is not below `value` (> 0).
pub fn round_up(value: f64, mantissas: &[f64]) -> f64 {
    let decade = 10f64.powi(value.log10().floor() as i32);
    let enough = |mantissa: &&f64| **mantissa * decade >= value * (1.0 - 1e-9);
    mantissas.iter().find(enough).map_or(10.0 * decade, |mantissa| mantissa * decade)
}

fn plain(value: f64) -> String {
    format!("{}", (value * 1e6).round() / 1e6)
}

/// With a sign, and a real minus.
pub fn signed(value: f64) -> String {
    let sign = if value > 0.0 {
        "+"
    } else if value < 0.0 {
        "\u{2212}"
    } else {
        ""
    };
    format!("{sign}{}", plain(value.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_end_at_round_numbers_around_the_values() {
        let scale = RangeScale::of(&[1.66, f64::NAN, 4.41]);
        assert_eq!((scale.low_m, scale.high_m), (1.5, 4.5));
        let labels: Vec<String> = scale.ticks().into_iter().map(|(_, label)| label).collect();
        assert_eq!(labels, ["1.5", "2", "2.5", "3", "3.5", "4", "4.5"]);
        assert_eq!(RangeScale::of(&[f64::NAN]).high_m, 1.0);
    }

    #[test]
    fn one_outlier_in_a_thousand_does_not_set_the_scale() {
        let mut errors_m = vec![0.033; 999];
        errors_m.push(5.0);
        assert!((error_limit(errors_m.iter()) - 0.04).abs() < 1e-12);
    }

    #[test]
    fn signs_are_written() {
        assert_eq!([-7.5, 0.0, 60.0].map(signed), ["\u{2212}7.5", "0", "+60"]);
    }
}
