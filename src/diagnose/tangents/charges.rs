//! Small steps of several numbers of one effect may change the same charge, each by so much: motion to the side by the second and by the metre, what stays
//! of either frame before.

use super::patterns::difference;
use crate::physics::Exposure;

/// What steps of an effect's number changed of the charge at its place, DN, and what that became at the chain's end: the number of the
/// pattern that it is, over the step.
struct Charge {
    name: &'static str,
    change_dn: Vec<f64>,
    /// Where the change is the greatest.
    place: usize,
    step: f64,
    pattern: usize,
}

/// What was changed so far in a frame.
#[derive(Default)]
pub struct Charges(Vec<Charge>);

/// A change of the charge that is not known yet, and the rounding of either of its ends, DN.
pub struct NewCharge(Vec<f64>, f64);

/// Changes of the charge are the same where they differ by no more than rounding of the charge of full scale.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// What others are compared with is so many times more than that: of what is rounding itself anything is a multiple.
const CLEAR: f64 = 1e6;

impl Charges {
    /// The pattern, and how much of it, that a `step` of a number of the effect `name` makes of `station`, where it changed the charge alone, and one before it did the same;
    /// else the change, to be [known](Self::knows).
    pub fn share(
        &self,
        name: &str,
        exposure: &Exposure,
        station: &Exposure,
        step: f64,
    ) -> Result<(usize, f64), NewCharge> {
        let change_dn = difference(&exposure.signal_dn, &station.signal_dn, 1.0);
        let rounding = ROUNDING * exposure.pixels.full_scale_dn;
        for known in self.0.iter().filter(|known| known.name == name) {
            if let Some(factor) = multiple(&change_dn, &known.change_dn, known.place, rounding) {
                return Ok((known.pattern, factor * known.step / step));
            }
        }
        Err(NewCharge(change_dn, rounding))
    }

    /// From now on a change by a `step` of a number of the effect `name` is known, of which `pattern` is what it became.
    pub fn knows(
        &mut self,
        NewCharge(change_dn, rounding): NewCharge,
        name: &'static str,
        step: f64,
        pattern: usize,
    ) {
        let mut place = 0;
        for (other, change) in change_dn.iter().enumerate() {
            if change.abs() > change_dn[place].abs() {
                place = other;
            }
        }
        if change_dn.get(place).is_some_and(|change| change.abs() > CLEAR * rounding) {
            self.0.push(Charge { name, change_dn, place, step, pattern });
        }
    }
}

/// The factor by which all of `changed` is that of `own`, to within `rounding` of either, as it is at this `place`, if there is one.
fn multiple(changed: &[f64], own: &[f64], place: usize, rounding: f64) -> Option<f64> {
    let factor = changed[place] / own[place];
    let most = rounding * (1.0 + factor.abs());
    let is_near = |(changed, own): (&f64, &f64)| (changed - factor * own).abs() <= most;
    (factor != 0.0 && changed.iter().zip(own).all(is_near)).then_some(factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_multiple_is_one_of_all_values_but_for_rounding() {
        let own = [0.0, 1.0, -3.0, 2.0];
        let changed = own.map(|own| -0.7 * own);
        assert!((multiple(&changed, &own, 2, 1e-15).unwrap() + 0.7).abs() < 1e-15);
        for place in 0..4 {
            let mut other = changed;
            other[place] += 1e-9;
            assert_eq!(multiple(&other, &own, 2, 1e-15), None, "{place}");
            other[place] = f64::NAN;
            assert_eq!(multiple(&other, &own, 2, 1e-15), None, "{place}");
        }
        // What changes nothing is no multiple.
        assert_eq!(multiple(&[0.0; 4], &own, 2, 1e-15), None);
    }
}
