//! Mean residuals over coordinates and pixels, with the noise of each mean: what a report draws.

use super::data::Data;
use super::fit::Fit;
use super::gram::Whitened;
use super::ranges::Ranges;
use crate::physics::Moment;
use crate::units::phase_rad;
use std::f64::consts::TAU;

/// A mean residual and its standard deviation by the noise alone, DN, at a place of the coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// The coordinate.
    pub at: f64,
    /// Mean residual, DN.
    pub residual_dn: f64,
    /// Its standard deviation, DN.
    pub sigma_dn: f64,
}

/// A coordinate over which residuals are averaged.
struct Axis {
    name: &'static str,
    bins: usize,
    /// The place of a sample, 0 … 1.
    place: Place,
    /// The coordinate at a place.
    at: fn(&Ranges, f64) -> f64,
}

/// What a place hangs on.
enum Place {
    /// The frame alone.
    Frame(fn(&Moment, &Ranges) -> f64),
    /// The pixel alone.
    Pixel(fn(usize, &Ranges) -> f64),
    /// Both.
    Sample(fn(&Sample) -> f64),
}

struct Sample<'a> {
    moment: &'a Moment,
    ranges: &'a Ranges,
    fit: &'a Fit,
    base_dn: f64,
    pixel: usize,
}

const BINS: usize = 36;

const AXES: [Axis; 8] = [
    Axis {
        name: "phase, turns",
        bins: BINS,
        place: Place::Sample(|s| {
            let range_m = s.moment.commanded_m() * s.fit.pixels.obliquity[s.pixel];
            let phase = phase_rad(range_m, s.moment.frequency_hz) + s.fit.pixels.phase_rad[s.pixel];
            ((s.moment.step_rad + s.moment.offset_rad - phase) / TAU).rem_euclid(1.0)
        }),
        at: |_, place| place,
    },
    Axis {
        name: "position, m",
        bins: BINS,
        place: Place::Frame(|moment, ranges| {
            let (low, high) = ranges.position_m;
            (moment.commanded_m() - low) / (high - low)
        }),
        at: |r, place| r.position_m.0 + place * (r.position_m.1 - r.position_m.0),
    },
    Axis {
        name: "velocity, m/s",
        bins: 17,
        place: Place::Frame(|moment, ranges| 0.5 + 0.5 * moment.velocity_m_s / ranges.speed_m_s.max(1e-9)),
        at: |r, place| (2.0 * place - 1.0) * r.speed_m_s,
    },
    Axis {
        name: "frame of a set",
        bins: 64,
        place: Place::Frame(|moment, _| (moment.frame as f64 + 0.5) / 64.0),
        at: |_, place| (place * 64.0).floor(),
    },
    Axis {
        name: "time, s",
        bins: BINS,
        place: Place::Frame(|moment, ranges| moment.time_s / longest_s(ranges)),
        at: |r, place| place * longest_s(r),
    },
    Axis {
        name: "row",
        bins: 64,
        place: Place::Pixel(|pixel, ranges| {
            ((pixel / ranges.geometry.width) as f64 + 0.5) / ranges.geometry.height as f64
        }),
        at: |r, place| place * r.geometry.height as f64,
    },
    Axis {
        name: "column",
        bins: 64,
        place: Place::Pixel(|pixel, ranges| {
            ((pixel % ranges.geometry.width) as f64 + 0.5) / ranges.geometry.width as f64
        }),
        at: |r, place| place * r.geometry.width as f64,
    },
    Axis {
        name: "signal, DN",
        bins: BINS,
        place: Place::Sample(|s| s.base_dn / s.ranges.full_scale_dn),
        at: |r, place| place * r.full_scale_dn,
    },
];

impl Axis {
    /// The bin of a place.
    fn bin(&self, place: f64) -> usize {
        ((place * self.bins as f64) as usize).min(self.bins - 1)
    }
}

/// Duration of the longest recording, s.
fn longest_s(ranges: &Ranges) -> f64 {
    ranges.duration_s.iter().copied().fold(1e-9, f64::max)
}

/// Sum of w r, and sum of w.
type Sum = (f64, f64);

fn add(sum: &mut Sum, (score, weight): Sum) {
    *sum = (sum.0 + score, sum.1 + weight);
}

/// Weighted sums of residuals.
#[derive(Debug, Clone, Default)]
pub struct Profiles {
    /// `[axis][bin]`, of axes whose places do not hang on the pixel alone.
    sums: Vec<Vec<Sum>>,
    /// `[pixel]`, of those that are looked at.
    of_pixels: Vec<Sum>,
    /// `[pixel]`: sum of squares of the whitened residual, and samples.
    pixels: Vec<(f64, usize)>,
}

/// A coordinate's points.
#[derive(Debug, Clone)]
pub struct Profile {
    /// The coordinate and its unit.
    pub name: &'static str,
    /// Where there are samples.
    pub points: Vec<Point>,
}

impl Profiles {
    /// With one more frame.
    pub fn with(mut self, data: &Data, ranges: &Ranges, fit: &Fit, whitened: &Whitened) -> Self {
        self.sums.resize_with(AXES.len(), Vec::new);
        for (sums, axis) in self.sums.iter_mut().zip(&AXES) {
            sums.resize(axis.bins, (0.0, 0.0));
        }
        self.pixels.resize(data.pixels(), (0.0, 0));
        self.of_pixels.resize(data.pixels(), (0.0, 0.0));
        let moment = &data.takes[whitened.take].moments[whitened.index];
        let mut all = (0.0, 0.0);
        for (pixel, (&root, &residual)) in whitened.roots.iter().zip(whitened.residual).enumerate() {
            if root == 0.0 {
                continue;
            }
            self.pixels[pixel].0 += residual * residual;
            self.pixels[pixel].1 += 1;
            if !(ranges.is_still || data.target[pixel]) {
                continue;
            }
            let sum = (root * residual, root * root);
            add(&mut all, sum);
            add(&mut self.of_pixels[pixel], sum);
            let sample = Sample { moment, ranges, fit, base_dn: whitened.frame.base[pixel], pixel };
            for (sums, axis) in self.sums.iter_mut().zip(&AXES) {
                if let Place::Sample(place) = axis.place {
                    add(&mut sums[axis.bin(place(&sample))], sum);
                }
            }
        }
        for (sums, axis) in self.sums.iter_mut().zip(&AXES) {
            if let Place::Frame(place) = axis.place {
                add(&mut sums[axis.bin(place(moment, ranges))], all);
            }
        }
        self
    }

    /// Those of both.
    pub fn and(mut self, other: Self) -> Self {
        if self.sums.is_empty() {
            return other;
        }
        let sums = self.sums.iter_mut().flatten().zip(other.sums.into_iter().flatten());
        sums.chain(self.of_pixels.iter_mut().zip(other.of_pixels)).for_each(|(sum, other)| add(sum, other));
        for (sum, other) in self.pixels.iter_mut().zip(other.pixels) {
            sum.0 += other.0;
            sum.1 += other.1;
        }
        self
    }

    /// The curves.
    pub fn curves(&self, ranges: &Ranges) -> Vec<Profile> {
        let curve = |(axis, sums): (&Axis, &Vec<Sum>)| {
            let mut sums = sums.clone();
            if let Place::Pixel(place) = axis.place {
                for (pixel, &sum) in self.of_pixels.iter().enumerate() {
                    add(&mut sums[axis.bin(place(pixel, ranges))], sum);
                }
            }
            let point = |(bin, &(score, weight)): (usize, &Sum)| Point {
                at: (axis.at)(ranges, (bin as f64 + 0.5) / axis.bins as f64),
                residual_dn: score / weight,
                sigma_dn: weight.sqrt().recip(),
            };
            let points = sums.iter().enumerate().filter(|(_, sum)| sum.1 > 0.0).map(point).collect();
            Profile { name: axis.name, points }
        };
        AXES.iter().zip(&self.sums).map(curve).collect()
    }

    /// Root of each pixel's chi squared a sample; NaN where a pixel has none.
    pub fn map(&self) -> Vec<f64> {
        self.pixels.iter().map(|&(square, samples)| (square / samples as f64).sqrt()).collect()
    }
}
