//! On which sides of off the search for an effect begins.

use crate::physics::Effect;

/// Effects that are no continuation of themselves beyond off: what moves to one side brings what lies on the other, and what it does must be looked at by itself.
const WITH_SIDES: [&str; 1] = ["lateral_motion"];
/// A strength on the far side of off begins at so much of its usual size.
const BARELY: f64 = -1e-9;

/// The `values` from which the search for an effect of these `strengths` starts: one of each combination of sides, where it has any.
pub fn sides(effect: &Effect, values: &[f64], strengths: &[usize]) -> Vec<Vec<f64>> {
    let mut sides = vec![values.to_vec()];
    let chosen = effect.parameters.iter().zip(values).find(|(parameter, _)| parameter.is_choice);
    if WITH_SIDES.contains(&effect.name) && chosen.is_none_or(|(_, &chosen)| chosen == 0.0) {
        for &number in strengths {
            let mut beyond = sides.clone();
            beyond.iter_mut().for_each(|values| values[number] += BARELY * effect.parameters[number].typical);
            sides.extend(beyond);
        }
    }
    sides
}
