//! Effects whose shape is the period of a line: it is looked for in what frames and sets say, and only then tried.

use crate::diagnose::forms::other_camera::{self, OTHER_CAMERA, is_same};
use crate::diagnose::periodic::lamps::{FLICKER, FLICKER_HZ, NEAR_MAINS, is_seen_as_lamps};
use crate::diagnose::periodic::lines::{Line, Series};

/// A line that was found: shapes that it may have, among how many they were looked for, and its shape in each recording where that may differ.
pub struct Found {
    /// At least one.
    pub shapes: Vec<f64>,
    /// Those of them that another form of the effect has.
    pub instead: Vec<f64>,
    /// Among so many.
    pub looked: f64,
    /// None, or one a recording.
    pub own: Vec<f64>,
}

/// Effects whose shape is the period of a line, by what frames and sets say, and their line of no lamp, for which all frequencies are looked at.
pub type LineShape = fn(&Series, Option<Line>) -> Option<Found>;
pub const LINES: [(&str, LineShape); 3] = [
    (FLICKER, |series, of_no_lamp| {
        // What is no lamp's is looked for as another light's.
        let is_far = |line: &Line| !is_seen_as_lamps(line.frequency, series.frame_period_s, NEAR_MAINS);
        let of_no_lamp = of_no_lamp.filter(is_far);
        let is_it = |line: &Line| {
            of_no_lamp.is_some_and(|other| is_same(line.frequency, other.frequency, series.frame_period_s))
        };
        let line = series.in_time(FLICKER_HZ).filter(|line| !is_it(line))?;
        Some(Found {
            shapes: vec![line.frequency],
            looked: line.looked,
            own: series.near(line.frequency),
            instead: Vec::new(),
        })
    }),
    (OTHER_CAMERA, other_camera::found),
    ("encoder_cyclic", |series, _| {
        let lines = series.in_position();
        let shapes = lines.iter().map(|line| line.frequency.recip()).collect();
        Some(Found { shapes, looked: lines.first()?.looked, own: Vec::new(), instead: Vec::new() })
    }),
];
