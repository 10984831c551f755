//! The worst-case error of an angle unit, derived, for every vector that is not zero.

use super::{AngleUnit, Rounding};
use crate::spec::Contribution;
use std::f64::consts::TAU;

/// Where the phase's error can come from, and how large it can be.
#[derive(Debug, Clone, PartialEq)]
pub struct AngleBudget {
    /// Sources of phase error, in the order in which the data meets them.
    pub phase: Vec<Contribution>,
    /// Relative error of the length.
    pub length_relative: f64,
    phase_bits: u32,
}

impl AngleBudget {
    /// Derives the bounds of `unit`.
    pub(super) fn new(unit: &AngleUnit) -> Self {
        if let Some(poly) = &unit.poly {
            return Self { phase: poly.budget(), length_relative: 0.0, phase_bits: unit.phase_bits };
        }
        let codes_a_rad = f64::from(unit.phase_bits).exp2() / TAU;
        let walk = Walk::new(unit);
        let guard = f64::from(unit.cordic.angle_guard_bits).exp2();
        let table =
            |bound: fn(&(f64, f64)) -> f64| unit.groups.iter().map(|group| bound(&group.errors)).sum::<f64>();
        let table_codes = table(|errors| errors.0).abs().max(table(|errors| errors.1).abs()) / guard;
        let contribution =
            |name, rad: f64, why: String| Contribution { name, phase_codes: rad * codes_a_rad, why };
        let phase = vec![
            contribution(
                "fold and width of the input",
                walk.input_rad,
                match unit.drop_bits() {
                    _ if walk.lost => {
                        "not normalised: the weakest vectors are lost among the roundings, and may point anywhere"
                            .to_owned()
                    }
                    0 => "the one that a complement lacks".to_owned(),
                    bits => format!("{bits} bits cut off, and the one that a complement lacks"),
                },
            ),
            contribution(
                "rounding of x and y",
                walk.turned_rad,
                "one rounding each coordinate and iteration, over a vector not shorter than 1.0 times the gain so far; an \
                 error of x turns it by the sine of the remaining angle"
                    .to_owned(),
            ),
            contribution(
                "straight line",
                walk.line_rad,
                format!("x stays after iteration {}: the last angles are a line's", unit.stages.x_iterations),
            ),
            contribution(
                "remaining angle",
                walk.remaining_rad,
                format!(
                    "at most sqrt({}) x 2^-{}, the last iteration's own",
                    unit.metric, unit.iterations
                ),
            ),
            Contribution {
                name: "rounding of the angle table",
                phase_codes: table_codes,
                why: format!("{} tables, every row's rounding error known", unit.groups.len()),
            },
            Contribution {
                name: "rounding to the phase word",
                phase_codes: 0.5 - 0.5 / guard,
                why: "half a code, less half a unit of the angle".to_owned(),
            },
        ];
        Self { phase, length_relative: walk.length_relative, phase_bits: unit.phase_bits }
    }

    /// Worst case of the phase in phase codes.
    pub fn phase_codes(&self) -> f64 {
        self.phase.iter().map(|contribution| contribution.phase_codes).sum()
    }

    /// The same in radians.
    pub fn phase_rad(&self) -> f64 {
        self.phase_codes() * TAU / f64::from(self.phase_bits).exp2()
    }
}

/// How far rounding can lead the iterations astray. Coordinates are x and √metric · y, so that iterations turn.
struct Walk {
    input_rad: f64,
    turned_rad: f64,
    line_rad: f64,
    remaining_rad: f64,
    length_relative: f64,
    /// Roundings can outweigh the weakest vector: nothing is known of its direction.
    lost: bool,
}

impl Walk {
    /// Every rounding counts once. Let d_k be the last change of direction: there the vector's angle, as it stands, is at most
    /// a_k, and what it differs from the exact one is the roundings up to k. After it no direction changes, so the exact
    /// angle that is left is that sum and at most a_k - a_(k+1) - ... - a_N, which is no more than a_N because every angle
    /// is at most twice the next one. With no change at all the same holds from the fold on.
    fn new(unit: &AngleUnit) -> Self {
        let (root, unit_x) = ((unit.metric as f64).sqrt(), f64::from(unit.fraction_bits).exp2().recip());
        let metric = unit.metric as f64;
        let least =
            if unit.cordic.normalise { 1.0 } else { f64::from(unit.magnitude_bits - 1).exp2().recip() };
        let (x_input, y_input) = input_units(unit);
        let mut norm = least * (1.0 + metric).sqrt();
        let input = (x_input * unit_x).hypot(root * y_input * unit_x) / norm;
        let mut lost = input >= 1.0;
        let input_rad = input.min(1.0).asin();
        norm -= input * norm;
        // The fold leaves the angle between the axes' and iteration 0's.
        let first = root.atan();
        let mut remaining = first.max(TAU / 4.0 - first) + input_rad;
        let (mut turned_rad, mut stretched) = (0.0, input);
        // The same without any assumption: the vector as long as it is without roundings, and every one of them along it.
        let (mut longest_norm, mut longest) = (least * (1.0 + metric).sqrt(), input);
        let part = if unit.cordic.rounding == Rounding::Nearest { 0.5 } else { 1.0 };
        let y_unit = |i: u32| f64::from(unit.stages.y[i as usize].fraction_bits).exp2().recip();
        let y_part = if unit.stages.scaled { 0.5 } else { part };
        let u = unit.stages.x_iterations;
        for i in 1..=u {
            let tangent = root * f64::from(i).exp2().recip();
            norm *= (1.0 + tangent * tangent).sqrt();
            longest_norm *= (1.0 + tangent * tangent).sqrt();
            remaining = tangent.atan().max(remaining - tangent.atan());
            let x_error = x_units(unit, i, part);
            let y_error = root * y_part * y_unit(i);
            norm -= x_error + y_error;
            longest += (x_error + y_error) / longest_norm;
            let across = x_error * remaining.min(TAU / 4.0).sin() + y_error;
            lost |= across >= norm;
            let delta = (across / norm).clamp(0.0, 1.0).asin();
            turned_rad += delta;
            remaining += delta;
            stretched += (x_error + y_error * remaining.sin()) / norm;
        }
        lost |= remaining >= TAU / 4.0;
        if lost {
            let length_relative = 1.0 + longest;
            let input_rad = TAU / 2.0;
            return Self {
                input_rad,
                turned_rad: 0.0,
                line_rad: 0.0,
                remaining_rad: 0.0,
                length_relative,
                lost,
            };
        }
        let x = norm * remaining.cos();
        let largest = remaining.tan();
        // The slope of the line, as the angle table has it.
        let slope = 1.0 - metric * f64::from(2 * u).exp2().recip() / 4.0;
        let off = |t: f64| (t.atan() - slope * t).abs();
        let turning_point = (1.0 / slope - 1.0).sqrt();
        let line_rad =
            if u >= unit.iterations { 0.0 } else { off(largest).max(off(turning_point.min(largest))) };
        for i in u + 1..unit.iterations {
            turned_rad += root * y_part * y_unit(i) / x;
        }
        let remaining_rad = root * f64::from(unit.iterations).exp2().recip();
        // The length's factor stands for the middle between both ends of the last angles.
        let length_relative = stretched + largest * largest / 4.0;
        Self { input_rad, turned_rad, line_rad, remaining_rad, length_relative, lost }
    }
}

/// Errors of x and y after iteration 0, in units of 2^−`fraction_bits`.
///
/// A coordinate c is held as its complement followed by ones that end somewhere: it is short by at most one unit, or, where
/// bits are cut off, by less than one. See [`crate::model::turn`] for the carries.
fn input_units(unit: &AngleUnit) -> (f64, f64) {
    let metric = unit.metric as f64;
    // y is loaded with a bit less where it is to be doubled.
    let padded = unit.pad_bits() > u32::from(unit.stages.scaled);
    let dropped = unit.drop_bits() > 0;
    match (unit.stages.scaled, padded, dropped) {
        (true, true, _) => (3.0, 2.5),
        (true, false, _) => (1.0 + 2.0 * metric, 2.5),
        (false, _, false) => (1.0, 0.5),
        (false, _, true) => (1.0 + metric, 1.5),
    }
}

/// Error of x by iteration `i`, absolute.
fn x_units(unit: &AngleUnit, i: u32, part: f64) -> f64 {
    let word = unit.stages.x[(i as usize).min(unit.stages.x.len() - 1)];
    let before = unit.stages.x[i as usize - 1];
    // The bit that the narrower word has no place for, the rounding of the shifted y, and y's own half unit.
    let narrowed = if word.fraction_bits < before.fraction_bits { 0.5 } else { 0.0 };
    let half = 1.5 * f64::from(i).exp2().recip() * f64::from(unit.fraction_bits).exp2().recip();
    (narrowed + part) * f64::from(word.fraction_bits).exp2().recip() + half
}
