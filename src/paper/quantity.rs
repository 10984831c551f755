//! A number of the paper, beside what is predicted here.

/// A measured value with its error, in the unit of its quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// The error that the paper gives with it, > 0.
    pub error: f64,
}

impl Measured {
    /// `value` ± `error`.
    pub const fn new(value: f64, error: f64) -> Self {
        Self { value, error }
    }
}

/// A quantity in metres, predicted and, where the paper measured it, measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// What it is, such as "four frames, linearity, RMS".
    pub what: String,
    /// The prediction, m.
    pub predicted_m: f64,
    /// The paper's measurement, m, where it has one.
    pub measured: Option<Measured>,
    /// What was assumed beyond the paper's own numbers.
    pub assumed: &'static str,
    /// Where the two differ by more than the error: why, as far as is known.
    pub why: String,
}

impl Quantity {
    /// Whether the prediction lies within the measurement's error; `None` where nothing was measured.
    pub fn is_within(&self) -> Option<bool> {
        self.measured.map(|measured| (self.predicted_m - measured.value).abs() <= measured.error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_errors_ends_are_within_it() {
        let quantity = |predicted_m| Quantity {
            what: String::new(),
            predicted_m,
            measured: Some(Measured::new(0.25, 0.125)),
            assumed: "",
            why: String::new(),
        };
        let within = [0.125, 0.375, 0.12, 0.38].map(|predicted_m| quantity(predicted_m).is_within());
        assert_eq!(within, [Some(true), Some(true), Some(false), Some(false)]);
        assert_eq!(Quantity { measured: None, ..quantity(0.25) }.is_within(), None);
    }
}
