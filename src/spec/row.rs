//! Rows of integer weights that a specification gives itself.

use super::response::{Response, is_blind};
use super::scheme::{Irrational, SCHEMES, Scheme, SchemeOrigin, equal_step};
use super::step_angle::{StepAngle, greatest_common_divisor};
use super::{DFT_FRAMES, refused};
use crate::problem::Result;
use std::collections::BTreeMap;

/// A row as a specification gives it, with I_n = A cos(angle_n − φ) + B.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Its name; not that of a named scheme.
    pub name: String,
    /// The phase steps' angles.
    pub angles: Vec<StepAngle>,
    /// Weights of the in-phase sum: gain · A cos φ.
    pub in_phase: Vec<i64>,
    /// Weights of the quadrature sum: gain · A sin φ / factor.
    pub quadrature: Vec<i64>,
    /// Weights of the offset sum; `None` for those that [`offset_weights`] finds.
    pub offset: Option<Vec<i64>>,
    /// What the quadrature sum is still to be multiplied by.
    pub irrational: Irrational,
    /// Where it comes from.
    pub reference: String,
}

/// Largest weight, either sign: what a signed word of 18 bits holds.
const MOST_WEIGHT: i64 = (1 << 17) - 1;

/// Largest error of a sinusoid's phase, rad, and of its amplitude, that weights may have: more is a slip of the pen.
const MOST_ERROR: f64 = 0.01;

impl Scheme {
    /// The scheme of `row`; `source` is the name that a refusal gives.
    ///
    /// # Errors
    /// Lists of different lengths; weights too large, or that do not add up to 0 (constant light would have a phase); sums
    /// that are not gain · A cos φ and gain · A sin φ / factor to 1 %; an offset that sees the fundamental.
    pub fn of_row(source: &str, row: Row) -> Result<Self> {
        let field = |field: &str| format!("modulation.scheme.{field}");
        let name_is_taken = SCHEMES.iter().any(|scheme| scheme.name == row.name) || row.name == "dft";
        let letter = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
        if name_is_taken || row.name.is_empty() || row.name.len() > 32 || !row.name.chars().all(letter) {
            return Err(refused(source, &field("name"), format_args!("\"{}\"", row.name)).expected(
                "1 to 32 lower case letters, digits, `-` and `_`, and not the name of a scheme that is built in",
            ));
        }
        if row.reference.chars().any(|c| c.is_control() || c == '"' || c == '\\') {
            return Err(refused(source, &field("reference"), format_args!("{:?}", row.reference))
                .expected("one line without quotation marks and backslashes"));
        }
        let steps = row.in_phase.len();
        if !DFT_FRAMES.contains(&steps) {
            return Err(refused(source, &field("in_phase"), format_args!("{:?}", row.in_phase)).expected(
                format_args!("{} to {} weights, one a phase step", DFT_FRAMES.start(), DFT_FRAMES.end()),
            ));
        }
        let same = |what: &str, length: usize, shown: String| {
            if length == steps {
                return Ok(());
            }
            Err(refused(source, &field(what), shown)
                .expected(format_args!("{steps} of them, one a phase step, as in_phase has")))
        };
        same("quadrature", row.quadrature.len(), format!("{:?}", row.quadrature))?;
        same("step_turns", row.angles.len(), format!("{} angles", row.angles.len()))?;
        for (what, weights) in [("in_phase", &row.in_phase), ("quadrature", &row.quadrature)] {
            let sum: i64 = weights.iter().sum();
            let shown = || format!("{weights:?}");
            if weights.iter().any(|weight| weight.abs() > MOST_WEIGHT) {
                return Err(refused(source, &field(what), shown())
                    .expected(format_args!("weights from -{MOST_WEIGHT} to {MOST_WEIGHT}")));
            }
            if sum != 0 {
                return Err(refused(source, &field(what), shown()).expected(format_args!(
                    "weights that add up to 0 (these make {sum}): constant light has no phase"
                )));
            }
        }
        let response = checked_response(source, &row)?;
        let offset = offset_of(source, &row)?;
        Ok(Self {
            name: row.name.into(),
            angles: row.angles.into(),
            in_phase: row.in_phase.into(),
            quadrature: row.quadrature.into(),
            offset: offset.into(),
            irrational: row.irrational,
            gain: response.gain,
            weight_error_rad: response.phase_rad(),
            weight_error_amplitude: response.image,
            origin: SchemeOrigin::Row,
            reference: row.reference.into(),
        })
    }
}

fn checked_response(source: &str, row: &Row) -> Result<Response> {
    let refuse = |found: String| {
        refused(source, "modulation.scheme.quadrature", format_args!("{:?}: {found}", row.quadrature)).expected(
            "weights with which the sums of I_n = A cos(angle_n - phi) + B are gain A cos phi, and gain A sin phi over \
             the irrational",
        )
    };
    let response = Response::new(&row.angles, &row.in_phase, &row.quadrature, row.irrational);
    let Some(response) = response.filter(|response| response.image < 1.0) else {
        return Err(refuse("the sums turn backwards, by -phi, or not at all".to_owned()).remedy(
            "negate the quadrature weights: their published form may be for I_n = A cos(phi + angle_n) + B",
        ));
    };
    if response.turn_rad.abs() > MOST_ERROR {
        let turns = response.turn_rad / std::f64::consts::TAU;
        return Err(refuse(format!("the phase is turned by {turns:.4} turn")).remedy(
            "give step_turns as a list that is 0 at the frame that the weights refer to, or turn the weights",
        ));
    }
    if response.image > MOST_ERROR {
        return Err(refuse(format!("the two sums differ in gain, by {:.1} %", 200.0 * response.image)).remedy(
            "correct the weights, the steps, or the irrational (\"1\" or \"sqrt(3)\") that the quadrature sum is still to \
             be multiplied by",
        ));
    }
    Ok(response)
}

fn offset_of(source: &str, row: &Row) -> Result<Vec<i64>> {
    let field = "modulation.scheme.offset";
    let Some(offset) = &row.offset else {
        return offset_weights(&row.angles).ok_or_else(|| {
            refused(source, field, "none")
                .expected("phase steps among which there is a regular polygon, whose frames' mean is blind to the fundamental")
                .remedy("give offset: weights, none negative, with which the fundamental does not leak into the offset")
        });
    };
    let shown = format!("{offset:?}");
    if offset.len() != row.in_phase.len() || offset.iter().any(|weight| !(0..=MOST_WEIGHT).contains(weight)) {
        return Err(refused(source, field, shown).expected(format_args!(
            "{} weights from 0 to {MOST_WEIGHT}, one a phase step",
            row.in_phase.len()
        )));
    }
    if offset.iter().all(|&weight| weight == 0) || !is_blind(&row.angles, offset) {
        return Err(refused(source, field, shown)
            .expected("weights, not all 0, with which the fundamental does not leak into the offset: the sum of weight x exp(i angle) is 0")
            .remedy("leave them out, for those that follow from the phase steps"));
    }
    Ok(offset.clone())
}

/// Offset weights that are blind to the fundamental, none negative, without a common divisor; `None` where the steps have
/// no regular polygon among them.
///
/// With equal steps of p/q turn, q successive frames are a polygon; all of them together (1 2 3 2 1 for five frames of a
/// third) are blind to a linear step error too as soon as there are 2q − 1 frames. Without such, all regular polygons of a
/// prime number of corners, each corner the mean of the frames that share its angle.
pub fn offset_weights(angles: &[StepAngle]) -> Option<Vec<i64>> {
    let steps = angles.len();
    if let Some(step) = equal_step(angles) {
        let corners =
            usize::try_from(step.denominator()).ok().filter(|corners| (2..=steps).contains(corners));
        if let Some(corners) = corners {
            let windows = steps - corners + 1;
            return Some(
                (0..steps).map(|n| (n + 1).min(corners).min(windows).min(steps - n) as i64).collect(),
            );
        }
    }
    // Angles as whole parts of a turn.
    let parts = angles.iter().try_fold(1_i64, |parts, angle| {
        let denominator = angle.denominator();
        Some(parts / greatest_common_divisor(parts, denominator) * denominator)
            .filter(|&parts| parts <= 1 << 20)
    })?;
    let place = |angle: &StepAngle| (angle.numerator() * (parts / angle.denominator())).rem_euclid(parts);
    let mut frames_at: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
    for (frame, angle) in angles.iter().enumerate() {
        frames_at.entry(place(angle)).or_default().push(frame);
    }
    // Every corner counts as much, however many frames share it.
    let share = frames_at
        .values()
        .map(|frames| frames.len() as i64)
        .fold(1, |multiple, count| multiple / greatest_common_divisor(multiple, count) * count);
    let mut weights = vec![0; steps];
    for prime in (2..=steps as i64).filter(|&p| parts % p == 0 && (2..p).all(|divisor| p % divisor != 0)) {
        let side = parts / prime;
        for &first in frames_at.keys().filter(|&&place| place < side) {
            let corners: Option<Vec<&Vec<usize>>> =
                (0..prime).map(|corner| frames_at.get(&(first + corner * side))).collect();
            for frames in corners.into_iter().flatten() {
                for &frame in frames {
                    weights[frame] += share / frames.len() as i64;
                }
            }
        }
    }
    let divisor = weights.iter().fold(0, |divisor, &weight| greatest_common_divisor(divisor, weight));
    (divisor > 0).then(|| weights.iter().map(|weight| weight / divisor).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn angles(text: &str) -> Vec<StepAngle> {
        text.split(' ').map(|angle| StepAngle::parse(angle).unwrap()).collect()
    }

    #[test]
    fn offset_weights_of_the_named_rows_are_theirs() {
        for scheme in SCHEMES {
            assert_eq!(offset_weights(&scheme.angles).unwrap(), *scheme.offset, "{}", scheme.name);
        }
    }

    #[test]
    fn offset_weights_by_hand() {
        for (text, weights) in [
            ("0 1/4 1/2 3/4 1", &[1, 2, 2, 2, 1][..]),
            ("0 1/4 1/2 3/4 1 5/4 3/2", &[1, 2, 3, 4, 3, 2, 1]),
            ("-1/2 -1/4 0 1/4 1/2", &[1, 2, 2, 2, 1]), // opposite pairs, the half turns sharing theirs
            ("0 1/2 1/7", &[1, 1, 0]),
            ("0 1/3 2/3 1/2", &[2, 1, 1, 1]), // a triangle and a pair
            ("0 2/5 4/5 6/5 8/5", &[1, 1, 1, 1, 1]),
        ] {
            assert_eq!(offset_weights(&angles(text)).unwrap(), weights, "{text}");
            assert!(is_blind(&angles(text), weights));
        }
        assert_eq!(offset_weights(&angles("0 1/7 3/7")), None);
        assert_eq!(offset_weights(&angles("0 1/8 2/8 3/8")), None);
    }
}
