//! The noise that the recordings themselves show: what a pixel's residual has that its neighbour's has not, and what residuals of a fit
//! have beyond the noise that was stated.

use super::fit::Fit;
use super::in_order::joined;
use super::set_errors::Jitter;
use super::whiten::{WINSOR, whiten};
use crate::diagnose::reading::data::{Data, Take};
use crate::diagnose::shared_errors::random::CLUSTER_NATS;
use crate::diagnose::tangents::columns::Tangents;
use nalgebra::{Matrix3, Vector3};

/// Variance of the noise at a signal, DN², and what frames are off by at random.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Read noise and quantisation, DN².
    pub floor: f64,
    /// Shot noise, DN² a DN.
    pub slope: f64,
    /// Noise in proportion to the signal, relative, squared.
    pub square: f64,
    /// What a frame's samples are off by together.
    pub jitter: Jitter,
}

impl Noise {
    /// So many times the variance.
    pub fn times(self, many: f64) -> Self {
        let [floor, slope, square] = [self.floor, self.slope, self.square].map(|part| many * part);
        Self { floor, slope, square, ..self }
    }

    /// Whether its variance is that of `other` but for a thousandth, in the dark and in the light.
    pub fn is_near(self, other: Self) -> bool {
        let ratio = |signal_dn: f64| self.variance(signal_dn) / other.variance(signal_dn);
        [0.0, 1e3].into_iter().all(|signal_dn| (ratio(signal_dn) - 1.0).abs() < 1e-3)
    }

    /// One over the variance.
    #[inline(always)]
    pub fn weight(&self, signal_dn: f64) -> f64 {
        1.0 / self.variance(signal_dn)
    }

    /// The variance of a sample at a signal, DN².
    #[inline(always)]
    pub fn variance(&self, signal_dn: f64) -> f64 {
        let signal_dn = signal_dn.max(0.0);
        self.floor + signal_dn * (self.slope + signal_dn * self.square)
    }

    /// Sum of the logarithms of the variance at a model's signals, whose weights have these `roots`, over this one's at the measured `signals`. A model whose
    /// signals are too great has too great a variance, and chi squared alone would prefer it.
    pub fn ln_variance(&self, signals: &[f32], roots: &[f64]) -> f64 {
        let ratio = |(&measured, &root): (&f32, &f64)| match root > 0.0 {
            true => root * root * self.variance(f64::from(measured)),
            false => 1.0,
        };
        let of_some =
            |(signals, roots): (&[f32], &[f64])| signals.iter().zip(roots).map(ratio).product::<f64>().ln();
        -signals.chunks(LOGARITHM).zip(roots.chunks(LOGARITHM)).map(of_some).sum::<f64>()
    }
}

/// So many ratios are multiplied before the logarithm is taken.
const LOGARITHM: usize = 8;

/// So many frames at most are looked at, evenly over all.
const FRAMES: usize = 64;
/// Groups of samples of like signal.
const GROUPS: usize = 24;
/// Median of the square of a standard normal deviate.
const MEDIAN_SQUARE: f64 = 0.454_936;
/// Variance of rounding to a code, DN².
pub const ROUNDING_DN2: f64 = 1.0 / 12.0;

/// Every frame: its recording, and its number there.
fn frames(data: &Data) -> Vec<(usize, usize)> {
    let of = |(take, recording): (usize, &Take)| (0..recording.moments.len()).map(move |index| (take, index));
    data.takes.iter().enumerate().flat_map(of).collect()
}

/// Variance over signal from half the squared differences of neighbours' residuals in a row, of which the pixels' own numbers took their part: what both
/// share (an effect, as a rule) drops out. Medians, so that dead pixels and edges say little.
pub fn measured(data: &Data, fit: &Fit) -> Noise {
    let (tangents, _) = Tangents::new(data, &fit.pixels, &fit.pieces, &[]);
    let (pixels, width) = (data.pixels(), data.geometry().width);
    let (frames, free) = (frames(data), data.free_shares());
    let mut samples: Vec<(f64, f64)> = Vec::new();
    for &(take, index) in frames.iter().step_by(frames.len().div_ceil(FRAMES).max(1)) {
        let base = tangents.base(take, index);
        let measured = &data.takes[take].signal_dn[index * pixels..(index + 1) * pixels];
        let residual = |pixel: usize| f64::from(measured[pixel]) - base[pixel];
        for pixel in (0..pixels.saturating_sub(1)).filter(|pixel| (pixel + 1) % width != 0) {
            let difference = residual(pixel) - residual(pixel + 1);
            let free = free[pixel] + free[pixel + 1];
            if difference.is_finite() && free > 0.0 {
                samples.push((0.5 * (base[pixel] + base[pixel + 1]), difference * difference / free));
            }
        }
    }
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    let groups = samples.chunks(samples.len().div_ceil(GROUPS).max(1)).map(|group| {
        let mut squares: Vec<f64> = group.iter().map(|sample| sample.1).collect();
        squares.sort_by(f64::total_cmp);
        let variance = squares[squares.len() / 2] / MEDIAN_SQUARE;
        (group[group.len() / 2].0, variance.max(ROUNDING_DN2))
    });
    line(&groups.collect::<Vec<_>>())
}

/// Floor and slope through `(signal, variance)`, each point weighted by its variance; neither below what is possible.
fn line(points: &[(f64, f64)]) -> Noise {
    let [mut n, mut x, mut y, mut xx, mut xy] = [0.0; 5];
    for &(signal, variance) in points {
        let weight = (variance * variance).recip();
        n += weight;
        x += weight * signal;
        y += weight * variance;
        xx += weight * signal * signal;
        xy += weight * signal * variance;
    }
    let determinant = n * xx - x * x;
    let slope = if determinant > 1e-9 * n * xx { ((n * xy - x * y) / determinant).max(0.0) } else { 0.0 };
    let floor = if n > 0.0 { (y - slope * x) / n } else { ROUNDING_DN2 };
    if floor >= ROUNDING_DN2 {
        return Noise { floor, slope, square: 0.0, jitter: [0.0; 2] };
    }
    // All of it by the signal.
    let slope = if xx > 0.0 { ((xy - ROUNDING_DN2 * x) / xx).max(0.0) } else { 0.0 };
    Noise { floor: ROUNDING_DN2, slope, square: 0.0, jitter: [0.0; 2] }
}

/// The noise that residuals show.
#[derive(Debug, Clone, Copy)]
pub struct Beyond {
    /// It, with what was stated.
    pub noise: Noise,
    /// Evidence (nats) that some of it is in proportion to the signal, rather than all of it like read and shot noise, or what the response makes of that; 0 where
    /// that is not clear.
    pub in_proportion: f64,
    /// Standard deviation of the part in proportion to the signal, relative, squared.
    pub square_sigma: f64,
}

/// Frames are summed in so many chunks.
const CHUNKS: usize = 64;
/// Bins of the signal, evenly over its root.
const BINS: usize = 48;

/// What the residuals of `fit` show beyond the noise that was `stated`: their squares over the signal, by least squares, no part less than
/// was stated. Beside the noise `known` so far they are looked at first, and then beside what they showed: what is far beyond the noise does not count.
pub fn beyond(data: &Data, fit: &Fit, known: Noise, stated: Noise) -> Beyond {
    let mut found = seen_beside(data, fit, known, stated);
    for _ in 1..LOOKS {
        found = seen_beside(data, fit, found.noise, stated);
    }
    found
}

/// Mean square of normal deviates that are less than [`WINSOR`]: 1 - 2 k p(k) / (2 P(k) - 1).
const NEAR: f64 = 0.998_929;

/// How often residuals are looked at, each time beside the noise that they showed the time before.
const LOOKS: usize = 8;

/// The same, beside the noise `known`.
fn seen_beside(data: &Data, fit: &Fit, known: Noise, stated: Noise) -> Beyond {
    let (tangents, _) = Tangents::new(data, &fit.pixels, &fit.pieces, &[]);
    let full_scale_dn = fit.pixels.full_scale_dn;
    // Samples, and sums of their signal, of their residual's square over the variance, and of what shot noise of the charge has beyond that of the signal, if it is there before
    // the read-out makes more of it.
    let add = |mut bins: Vec<[f64; 4]>, &(take, index): &(usize, usize)| {
        let base = tangents.base(take, index);
        let read_out = tangents.read_out(take, index);
        let shots = |pixel: usize| {
            read_out.as_ref().map_or(0.0, |(charge, response)| {
                stated.slope * (charge[pixel].max(0.0) * response[pixel].powi(2) - base[pixel].max(0.0))
            })
        };
        let (roots, residuals) = whiten(data, take, index, &base, known);
        // A few samples that are far off (pixels that were hit) are no noise of all.
        let is_near = |(_, residual): &(&f64, f64)| residual.abs() < WINSOR;
        let seen = base.iter().zip(residuals).zip(&roots).enumerate().filter(|(_, (_, root))| **root > 0.0);
        let seen = seen.map(|(pixel, (of, _))| (pixel, of)).filter(|(_, of)| is_near(of));
        for (pixel, (&signal, residual)) in seen {
            let place = (signal.max(0.0) / full_scale_dn).sqrt() * BINS as f64;
            let [count, signals, squares, more] = &mut bins[(place as usize).min(BINS - 1)];
            *count += 1.0;
            *signals += signal.max(0.0);
            *squares += residual * residual;
            *more += shots(pixel);
        }
        bins
    };
    let none = || vec![[0.0; 4]; BINS];
    let frames = frames(data);
    let chunk = frames.len().div_ceil(CHUNKS).max(1);
    let of_chunk = |frames: &[(usize, usize)]| frames.iter().fold(none(), add);
    let join = |mut bins: Vec<[f64; 4]>, others: Vec<[f64; 4]>| {
        bins.iter_mut().flatten().zip(others.into_iter().flatten()).for_each(|(sum, other)| *sum += other);
        bins
    };
    let bins = joined(&frames, chunk, of_chunk, join).unwrap_or_else(none);
    let points = bins.into_iter().filter(|bin| bin[0] > 0.0).map(|[count, signals, squares, shots]| {
        let signal = signals / count;
        let (variance, ratio) = (known.weight(signal).recip(), squares / (count * NEAR));
        // The squares scatter by the variance that there is.
        let scatter = variance * ratio.max(1.0);
        let more = ratio * variance - stated.weight(signal).recip();
        let point = Point { signal, more, weight: count / (2.0 * scatter * scatter) };
        (Point { more: more - shots / count, ..point }, point)
    });
    let (without_shots, points): (Vec<Point>, Vec<Point>) = points.unzip();
    let gain = |points: &[Point]| 0.5 * (least(points, 2).1 - least(points, 3).1);
    let is_clear = |nats: &f64| *nats > CLUSTER_NATS;
    let nats = gain(&points);
    let parts = least(&points, if is_clear(&nats) { 3 } else { 2 }).0;
    // A response that is steeper where there is more light makes more of the shot noise there, if that is of the charge, and not of what is read out: what either says
    // is no noise of its own.
    let in_proportion = Some(nats.min(gain(&without_shots))).filter(is_clear).unwrap_or(0.0);
    let noise = Noise {
        floor: stated.floor + parts[0],
        slope: stated.slope + parts[1],
        square: stated.square + parts[2],
        ..known
    };
    Beyond { noise, in_proportion, square_sigma: sigma_of_square(&points, &parts) }
}

/// Variance beyond what was stated, DN², at a signal, and the inverse square of what it is known to.
#[derive(Clone, Copy)]
struct Point {
    signal: f64,
    more: f64,
    weight: f64,
}

/// Powers of a signal, whose parts noise has.
fn powers(signal: f64) -> [f64; 3] {
    [1.0, signal, signal * signal]
}

/// The normal equations of the parts that `are_there`: matrix and right side, over the roots of the diagonal, and the inverses of these.
fn normal(points: &[Point], are_there: [bool; 3]) -> (Matrix3<f64>, Vector3<f64>, Vector3<f64>) {
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for point in points {
        let powers = powers(point.signal);
        let there = Vector3::from_fn(|n, _| if are_there[n] { powers[n] } else { 0.0 });
        normal += point.weight * there * there.transpose();
        right += point.weight * point.more * there;
    }
    let scale = normal.diagonal().map(|d| if d > 0.0 { d.sqrt().recip() } else { 0.0 });
    let scaled = Matrix3::from_fn(|r, c| normal[(r, c)] * scale[r] * scale[c]);
    (scaled, right.component_mul(&scale), scale)
}

/// Standard deviation of noise in proportion to the signal, relative, squared, as the signals of `data` tell it where the `noise` is as stated: beside more shot
/// noise, which is nearest to it. (Read noise would have to be less than was stated.)
pub fn square_known_to(data: &Data, noise: Noise) -> f64 {
    let signals = || data.takes.iter().flat_map(|take| &take.signal_dn).filter(|signal| signal.is_finite());
    let every = (signals().count() / SIGNALS).max(1);
    let point = |&signal: &f32| {
        let signal = f64::from(signal).max(0.0);
        Point { signal, more: 0.0, weight: every as f64 * 0.5 * noise.weight(signal).powi(2) }
    };
    sigma_of_square(&signals().step_by(every).map(point).collect::<Vec<_>>(), &[0.0, 1.0, 1.0])
}

/// So many signals say how exactly noise is told by them.
const SIGNALS: usize = 20_000;

/// Standard deviation of the part of the square, beside those of the `parts` that are there; 0 where it is not.
fn sigma_of_square(points: &[Point], parts: &[f64; 3]) -> f64 {
    let (scaled, _, scale) = normal(points, parts.map(|part| part > 0.0));
    let inverse = scaled.pseudo_inverse(1e-9).unwrap_or_default();
    inverse[(2, 2)].max(0.0).sqrt() * scale[2]
}

/// The parts of 1, signal and its square that explain the `points` best, of which the first so `many` may be there, and none is negative;
/// and the weighted squares that they leave.
fn least(points: &[Point], many: usize) -> ([f64; 3], f64) {
    let left = |parts: &[f64; 3]| -> f64 {
        let of = |point: &Point| {
            let said: f64 = parts.iter().zip(powers(point.signal)).map(|(part, power)| part * power).sum();
            point.weight * (point.more - said).powi(2)
        };
        points.iter().map(of).sum()
    };
    let solved = |which: usize| -> Option<[f64; 3]> {
        let (scaled, right, scale) = normal(points, [0, 1, 2].map(|n| which >> n & 1 == 1));
        let solution = scaled.svd(true, true).solve(&right, 1e-9).ok()?;
        let parts: [f64; 3] = solution.component_mul(&scale).into();
        parts.iter().all(|part| *part >= 0.0).then_some(parts)
    };
    let ways = (0..1 << many).filter_map(solved).map(|parts| (parts, left(&parts)));
    ways.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or(([0.0; 3], f64::INFINITY))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_through_variances_is_found_and_stays_possible() {
        let points = |floor: f64, slope: f64| -> Vec<(f64, f64)> {
            (1..20).map(|n| (50.0 * f64::from(n), floor + slope * 50.0 * f64::from(n))).collect()
        };
        let noise = line(&points(9.0, 0.35));
        assert!((noise.floor - 9.0).abs() < 1e-6 && (noise.slope - 0.35).abs() < 1e-9, "{noise:?}");
        let noise = line(&points(900.0, -0.4));
        assert!(noise.slope == 0.0 && noise.floor > 100.0, "{noise:?}");
        let noise = line(&points(-3.0, 0.35));
        assert!(noise.floor == ROUNDING_DN2 && (0.3..0.35).contains(&noise.slope), "{noise:?}");
    }

    /// Of a noise that is the stated one times 1.3 nothing is in proportion to the signal; where it is, it is found.
    #[test]
    fn noise_is_more_of_the_same_or_in_proportion() {
        let points = |floor: f64, slope: f64, square: f64| -> Vec<Point> {
            let signals = (1..20).map(|n| 50.0 * f64::from(n));
            let more = |signal: f64| floor + signal * (slope + signal * square);
            signals.map(|signal| Point { signal, more: more(signal), weight: 1e4 }).collect()
        };
        let (parts, left) = least(&points(9.0, 0.05, 0.0), 2);
        assert!((parts[0] - 9.0).abs() < 1e-6 && (parts[1] - 0.05).abs() < 1e-9 && left < 1e-6, "{parts:?}");
        let (parts, left) = least(&points(0.0, 0.0, 1e-4), 3);
        assert!(parts[..2] == [0.0; 2] && (parts[2] - 1e-4).abs() < 1e-12 && left < 1e-6, "{parts:?} {left}");
        // One number of nineteen points.
        let normal: f64 = (1..20).map(|n| 1e4 * (50.0 * f64::from(n)).powi(4)).sum();
        assert!((sigma_of_square(&points(0.0, 0.0, 1e-4), &parts) * normal.sqrt() - 1.0).abs() < 1e-9);
        assert_eq!(sigma_of_square(&points(9.0, 0.05, 0.0), &[9.0, 0.05, 0.0]), 0.0);
        // Shot noise is the nearest to it that may be without it, and less than nothing is no noise.
        assert!(least(&points(0.0, 0.0, 1e-4), 2).1 > 1e3);
        assert_eq!(least(&points(-2.0, 0.0, 0.0), 3).0, [0.0; 3]);
    }

    /// Clean recordings, and their noise.
    fn clean() -> (Data, Noise) {
        let size = crate::frames::Geometry { width: 16, height: 12 };
        let recordings = crate::bench::taken(size, 7, &[], &["four-rail"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let stated = crate::diagnose::stated_noise(&data);
        (data, stated)
    }

    /// One sample in 200 is 80 DN off: counted as 4 standard deviations these would be 8 per cent of the variance.
    #[test]
    fn samples_that_are_hit_are_no_noise_of_all() {
        let (mut data, stated) = clean();
        let fitted = crate::diagnose::fitting::fit::fit(&data, None, Vec::new(), stated, &|_| true);
        data.takes[0].signal_dn.iter_mut().step_by(199).for_each(|signal| *signal += 80.0);
        let found = beyond(&data, &fitted, stated, stated).noise;
        for signal_dn in [300.0, 600.0] {
            let ratio = found.variance(signal_dn) / stated.variance(signal_dn);
            assert!((ratio - 1.0).abs() < 0.04, "{signal_dn}: {ratio}");
        }
    }

    /// A response that doubles the slope at full scale makes four times the shot noise there: that is no noise of its own, but noise none the less.
    #[test]
    fn shot_noise_of_a_steep_response_is_no_noise_of_its_own() {
        let (mut data, stated) = clean();
        let fitted =
            |data: &Data, pieces| crate::diagnose::fitting::fit::fit(data, None, pieces, stated, &|_| true);
        let full_scale_dn = fitted(&data, Vec::new()).pixels.full_scale_dn as f32;
        for signal in &mut data.takes[0].signal_dn {
            *signal += 0.5 * *signal * *signal / full_scale_dn;
        }
        let response = crate::diagnose::tangents::pieces::Piece::off("intensity_nonlinearity", &[0], &[0]);
        let fitted = fitted(&data, vec![response]);
        let found = beyond(&data, &fitted, stated, stated);
        assert!(found.in_proportion == 0.0 && found.noise.square > 0.0, "{found:?}");
        // What is much more than that is noise of its own.
        let signals = data.takes[0].signal_dn.iter_mut();
        for (signal, draw) in signals.zip(crate::physics::Draws::of(3, 1).normal(fitted.samples)) {
            *signal *= 1.0 + 0.02 * draw as f32;
        }
        assert!(beyond(&data, &fitted, stated, stated).in_proportion > CLUSTER_NATS);
    }
}
