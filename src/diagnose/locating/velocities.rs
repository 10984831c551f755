//! The target's velocity as a coordinate: in which way frames are off while it moves, and whether it is where it is said to be.

use super::coordinates::{MODES, View, by_frame, centred, mode_shape};
use crate::diagnose::tangents::acting::Acting;

/// Functions of the velocity, for each way in which a frame may be off.
const RUN_WAYS: [&str; 5] = [
    "linear in velocity",
    "with speed",
    "with its square",
    "linear in velocity and frame",
    "with speed and frame",
];
/// Columns by which frames are off as in [`MODES`]; those after them are a target that is not where it is said to be.
pub const OF_RUN: usize = MODES.len() * RUN_WAYS.len();
/// Of a reading that comes late, and of play.
const PLACE_WAYS: [&str; 2] = ["linear in velocity", "with the direction"];
/// Columns of the coordinate.
pub const COLUMNS: usize = OF_RUN + PLACE_WAYS.len();

/// Whether a column of the coordinate called `name` is a target that is not where it is said to be.
pub fn is_of_place(name: &str, column: usize) -> bool {
    name == "velocity_m_s" && column >= OF_RUN
}

/// The columns that act in a frame.
pub fn fill(view: &View) -> Acting {
    let velocity = view.moment.velocity_m_s / view.ranges.speed_m_s.max(1e-9);
    let speed = velocity.abs();
    let frame = centred(view.moment);
    let functions = [velocity, speed, speed * speed, velocity * frame, speed * frame];
    let functions: Vec<_> = functions.into_iter().enumerate().collect();
    let mut columns = by_frame(view, RUN_WAYS.len(), &functions);
    // Where all move alike that is an encoder's zero that is off.
    let (low, high) = view.ranges.velocity_m_s;
    let direction = if speed > 0.0 { velocity.signum() } else { 0.0 };
    let ways = [(low < high, velocity), (low < 0.0 && high > 0.0, direction)];
    let there = ways.into_iter().enumerate().filter(|(_, (tells, value))| *tells && *value != 0.0);
    let there: Vec<(usize, f64)> = there.map(|(way, (_, value))| (way, value)).collect();
    if !there.is_empty() {
        let place = columns.pattern(view.frame.position.clone());
        there.into_iter().for_each(|(way, value)| columns.share(OF_RUN + way, place, value));
    }
    columns
}

/// What a column looks like, in words.
pub fn shape(column: usize) -> String {
    match column.checked_sub(OF_RUN) {
        Some(way) => format!("place, {}", PLACE_WAYS[way]),
        None => mode_shape(RUN_WAYS.len(), column, |n| RUN_WAYS[n].to_owned()),
    }
}
