//! What is trusted to be an effect of its own beside others whose forms may leave more than it explains.

use super::found::Named;
use super::tolerated::{are_of_distance, are_of_one_quantity};

/// Such an effect is trusted if it explains at least this share of what the forms may leave.
const SHARE: f64 = 0.03;
/// Or so much of chi squared: what is left then would stand out, unless another effect says as much as four fifths of what a form leaves.
const CHI2: f64 = 200.0;
/// Not one that alone, at the baseline, would have explained this share of what the first one did.
const ALIKE_SHARE: f64 = 0.5;

/// Beside what it is asked.
pub struct Trust<'a> {
    /// What is named.
    pub named: &'a [Named],
    /// What the forms of that may leave, chi squared.
    pub tolerated: f64,
    /// What an effect would have explained alone, at the baseline, chi squared.
    pub alone: &'a dyn Fn(&str) -> f64,
    /// Whether the camera is described, with no effect whose form may leave something.
    pub is_described: bool,
}

impl Trust<'_> {
    /// So much of chi squared, and more, the effect `name` must explain to be trusted.
    pub fn least_chi2(&self, name: &str) -> f64 {
        // What would have explained most of the first one is what the form of that leaves.
        let is_alike = |first: &Named| (self.alone)(name) > ALIKE_SHARE * (self.alone)(first.name);
        let is_of_distance = |named: &Named| are_of_distance(named.name, name);
        if self.named.first().is_some_and(is_alike) || self.named.iter().any(is_of_distance) {
            return f64::INFINITY;
        }
        // What is of the quantity of a named effect may be what its form leaves, and what a form leaves that is included was not seen.
        let is_of_a_named = self.named.iter().any(|named| are_of_one_quantity(named.name, name));
        let of_share = SHARE * self.tolerated;
        if self.is_described && !is_of_a_named { of_share.min(CHI2) } else { of_share }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_of_what_forms_may_leave_is_needed_or_a_chi_squared() {
        let flicker = Named {
            name: "ambient_flicker",
            ln_bayes: 0.0,
            score: (1e6, 3),
            rivals: Vec::new(),
            is_trusted: false,
        };
        let alone = |name: &str| match name {
            "ambient_flicker" => 1e6,
            "charge_crosstalk" => 501e3,
            "multipath_interference" => 1.2e6,
            _ => 499e3,
        };
        let trust = |tolerated: f64, is_described: bool| Trust {
            named: std::slice::from_ref(&flicker),
            tolerated,
            alone: &alone,
            is_described,
        };
        let least = |tolerated: f64, name: &str| trust(tolerated, true).least_chi2(name);
        // Near the noise the share is less, far from it the chi squared.
        assert_eq!(least(1e3, "phase_step_scale"), 30.0);
        assert_eq!(least(1e5, "phase_step_scale"), 200.0);
        // What is of the flicker's quantity, what a camera includes, and what is not described need the share.
        assert_eq!(least(1e5, "ambient_drift"), 3000.0);
        assert_eq!(trust(1e5, false).least_chi2("phase_step_scale"), 3000.0);
        // Half of what the flicker did, alone.
        assert_eq!(least(1e5, "charge_crosstalk"), f64::INFINITY);
        // What seems to be further is not trusted beside what seems to be.
        let path = [Named { name: "multipath_interference", ..flicker.clone() }];
        let beside_path = |name: &str| Trust { named: &path, ..trust(1e5, true) }.least_chi2(name);
        assert_eq!(beside_path("encoder_scale"), f64::INFINITY);
        assert_eq!(beside_path("image_lag"), 200.0);
        // The first one is beside none.
        assert_eq!(Trust { named: &[], ..trust(0.0, true) }.least_chi2("charge_crosstalk"), 0.0);
    }
}
