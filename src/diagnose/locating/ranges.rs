//! What the coordinates range over in a campaign.

use super::line_ways::{Ways, ways};
use super::lines_at_signals::PARTS;
use crate::diagnose::reading::data::Data;
use crate::frames::Geometry;
use crate::physics::{Moment, Pixels};

/// What the coordinates range over in a campaign.
#[derive(Debug, Clone)]
pub struct Ranges {
    /// The sensor's pixels.
    pub geometry: Geometry,
    /// Whether nothing moves.
    pub is_still: bool,
    /// Of each pixel, whether it tells the constant part of the camera's light from ambient light.
    pub tells_constant: Vec<bool>,
    /// Position of the target plane, m.
    pub position_m: (f64, f64),
    /// Whether it is at several positions.
    pub has_places: bool,
    /// Whether a recording has several sets.
    pub has_sets: bool,
    /// Whether a recording has several phase offsets: else the commanded phase is the frame's number in another word.
    pub has_offsets: bool,
    /// Greatest speed, m/s.
    pub speed_m_s: f64,
    /// Least and greatest velocity, m/s.
    pub velocity_m_s: (f64, f64),
    /// How each pixel's row differs from others.
    pub rows: Vec<Ways>,
    /// The same of its column.
    pub columns: Vec<Ways>,
    /// Signals between some parts of equally many samples, ascending, DN.
    pub signals_dn: Vec<f64>,
    /// Duration of each recording, s.
    pub duration_s: Vec<f64>,
    /// Frames a set of each recording, and the first number of its frames among those of all schemes.
    pub frames: Vec<(usize, usize)>,
    /// Frames of all schemes together.
    pub frame_numbers: usize,
    /// Natural logarithm of the amplitude.
    pub ln_amplitude: (f64, f64),
    /// Signal at the converter's full scale, DN.
    pub full_scale_dn: f64,
}

impl Ranges {
    /// Of the frames of `data`, seen by `pixels`.
    pub fn of(data: &Data, pixels: &Pixels) -> Self {
        let moments = || data.takes.iter().flat_map(|take| &take.moments);
        let least_greatest = |values: &mut dyn Iterator<Item = f64>| {
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
        };
        let spread = |(low, high)| if low < high { (low, high) } else { (low - 0.5, low + 0.5) };
        let places_m = least_greatest(&mut moments().map(Moment::commanded_m));
        let position_m = spread(places_m);
        let light = |pixel: usize| {
            let range_m = pixels.obliquity[pixel];
            (pixels.amplitude_1m_dn[pixel].max(1e-3) / (range_m * range_m)).ln()
        };
        let is_still = data.assumed.still_scene;
        let targets = (0..pixels.count()).filter(|&pixel| is_still || pixels.target[pixel]);
        let at_1m = spread(least_greatest(&mut targets.map(light)));
        let schemes = data.schemes();
        let first = |frames: usize| schemes.iter().take_while(|&&other| other < frames).sum();
        // Whether every other line of those that are looked at is every other one of the sensor.
        let (geometry, alternates) = (data.geometry(), data.grid.every % 2 == 1);
        Self {
            geometry,
            is_still,
            tells_constant: (0..pixels.count()).map(|pixel| data.tells_constant(pixel)).collect(),
            position_m,
            has_places: places_m.0 < places_m.1,
            has_sets: moments().any(|moment| moment.set > 0),
            has_offsets: data.takes.iter().any(|take| {
                let mut offsets = take.moments.iter().map(|moment| moment.offset_rad);
                let first = offsets.next();
                offsets.any(|offset| Some(offset) != first)
            }),
            speed_m_s: moments().map(|moment| moment.velocity_m_s.abs()).fold(0.0, f64::max),
            velocity_m_s: least_greatest(&mut moments().map(|moment| moment.velocity_m_s)),
            rows: ways(&pixels.target, geometry.height, alternates, |pixel| geometry.row_column(pixel).0),
            columns: ways(&pixels.target, geometry.width, alternates, |pixel| geometry.row_column(pixel).1),
            signals_dn: data.quantiles_dn(PARTS),
            duration_s: data.takes.iter().map(|t| t.moments.last().map_or(0.0, |m| m.time_s)).collect(),
            frames: data.takes.iter().map(|take| (take.frames, first(take.frames))).collect(),
            frame_numbers: schemes.iter().sum(),
            ln_amplitude: (
                at_1m.0 - 2.0 * position_m.1.max(1e-3).ln(),
                at_1m.1 - 2.0 * position_m.0.max(1e-3).ln(),
            ),
            full_scale_dn: pixels.full_scale_dn,
        }
    }
}
