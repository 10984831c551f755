//! Mean residuals over coordinates and pixels, with the noise of each mean: what a report draws.

use super::ranges::Ranges;
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::gram::Whitened;
use crate::diagnose::reading::data::Data;
use crate::diagnose::statistics::periodogram::Sum;
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
    place: Over,
    /// The coordinate at a place.
    at: fn(&Ranges, f64) -> f64,
}

/// What a place hangs on.
enum Over {
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
        place: Over::Sample(|s| {
            let range_m = s.moment.commanded_m() * s.fit.pixels.obliquity[s.pixel];
            let frequency_hz = s.moment.frequency_hz;
            let phase = phase_rad(range_m, frequency_hz) + s.fit.pixels.own_phase_rad(s.pixel, frequency_hz);
            ((s.moment.step_rad + s.moment.offset_rad - phase) / TAU).rem_euclid(1.0)
        }),
        at: |_, place| place,
    },
    Axis {
        name: "position, m",
        bins: BINS,
        place: Over::Frame(|moment, ranges| {
            let (low, high) = ranges.position_m;
            (moment.commanded_m() - low) / (high - low)
        }),
        at: |r, place| r.position_m.0 + place * (r.position_m.1 - r.position_m.0),
    },
    Axis {
        name: "velocity, m/s",
        bins: 17,
        place: Over::Frame(|moment, ranges| 0.5 + 0.5 * moment.velocity_m_s / ranges.speed_m_s.max(1e-9)),
        at: |r, place| (2.0 * place - 1.0) * r.speed_m_s,
    },
    Axis {
        name: "frame of a set",
        bins: 64,
        place: Over::Frame(|moment, _| (moment.frame as f64 + 0.5) / 64.0),
        at: |_, place| (place * 64.0).floor(),
    },
    Axis {
        name: "time, s",
        bins: BINS,
        place: Over::Frame(|moment, ranges| moment.time_s / longest_s(ranges)),
        at: |r, place| place * longest_s(r),
    },
    Axis {
        name: "row",
        bins: 64,
        place: Over::Pixel(|pixel, ranges| {
            ((pixel / ranges.geometry.width) as f64 + 0.5) / ranges.geometry.height as f64
        }),
        at: |r, place| place * r.geometry.height as f64,
    },
    Axis {
        name: "column",
        bins: 64,
        place: Over::Pixel(|pixel, ranges| {
            ((pixel % ranges.geometry.width) as f64 + 0.5) / ranges.geometry.width as f64
        }),
        at: |r, place| place * r.geometry.width as f64,
    },
    Axis {
        name: "signal, DN",
        bins: BINS,
        place: Over::Sample(|s| s.base_dn / s.ranges.full_scale_dn),
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

fn add(sum: &mut Sum, (score, weight): Sum) {
    *sum = (sum.0 + score, sum.1 + weight);
}

/// Weighted sums of residuals.
#[derive(Debug, Clone, Default)]
pub struct Profiles {
    /// `[axis][bin]`: sum of w r, sum of w; zeros of axes whose places hang on the pixel alone.
    sums: Vec<Vec<Sum>>,
    /// `[pixel]`: the same, of those that are looked at.
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
                if let Over::Sample(place) = axis.place {
                    add(&mut sums[axis.bin(place(&sample))], sum);
                }
            }
        }
        for (sums, axis) in self.sums.iter_mut().zip(&AXES) {
            if let Over::Frame(place) = axis.place {
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
            if let Over::Pixel(place) = axis.place {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::locating::location::locate;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// Every sample has its place on each axis, whatever its place hangs on: the sums over the places are the same. And the places are those of the recordings.
    #[test]
    fn each_axis_has_all_samples() {
        let size = Geometry { width: 7, height: 5 };
        let data =
            Data::of(&taken(size, 3, &[], &["four-rail", "wdft-motion"]).unwrap(), Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let curves = locate(&data, &unfitted(&data, noise), noise).curves;
        let sums = |profile: &Profile| {
            let weights = profile.points.iter().map(|point| (point.sigma_dn.powi(-2), point.residual_dn));
            weights.fold((0.0, 0.0), |sums: Sum, (weight, residual)| {
                (sums.0 + weight, sums.1 + weight * residual)
            })
        };
        let (weight, score) = sums(&curves[0]);
        assert!(weight > 0.0);
        for curve in &curves {
            let (of_weight, of_score) = sums(curve);
            assert!((of_weight / weight - 1.0).abs() < 1e-9, "{}: {of_weight}, not {weight}", curve.name);
            assert!((of_score - score).abs() < 1e-9 * weight, "{}: {of_score}, not {score}", curve.name);
        }
        let curve = |name: &str| curves.iter().find(|curve| curve.name == name).unwrap();
        // The target's pixels do not reach the sensor's border.
        let rows =
            (0..size.height).filter(|row| data.target[row * size.width..][..size.width].contains(&true));
        assert_eq!(curve("row").points.len(), rows.count());
        assert_eq!(
            curve("frame of a set").points.iter().map(|point| point.at).collect::<Vec<_>>(),
            [0.0, 1.0, 2.0, 3.0, 4.0]
        );
        assert!(curve("position, m").points.len() > BINS / 2);
        // Times from the first to the last of the longest recording, and velocities of both signs and none.
        let ends = |name: &str| {
            let at = curve(name).points.iter().map(|point| point.at);
            at.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)))
        };
        let moments = || data.takes.iter().flat_map(|take| &take.moments);
        let longest_s = moments().map(|moment| moment.time_s).fold(0.0, f64::max);
        let ((first_s, last_s), bin_s) = (ends("time, s"), longest_s / BINS as f64);
        assert!(first_s < bin_s && (longest_s - bin_s..longest_s).contains(&last_s), "{first_s}, {last_s}");
        let speed_m_s = moments().map(|moment| moment.velocity_m_s.abs()).fold(0.0, f64::max);
        let (backwards, forwards) = ends("velocity, m/s");
        assert!(
            (backwards + forwards).abs() < 1e-9 && (0.9..1.0).contains(&(forwards / speed_m_s)),
            "{forwards}"
        );
        assert!(curve("velocity, m/s").points.iter().any(|point| point.at.abs() < 1e-9));
    }
}
