//! The noise that the recordings themselves show: what a pixel's residual has that its neighbour's has not.

use super::columns::Tangents;
use super::data::Data;
use super::fit::Fit;
use super::gram::Noise;

/// So many frames at most are looked at, evenly over all.
const FRAMES: usize = 64;
/// Groups of samples of like signal.
const GROUPS: usize = 24;
/// Median of the square of a standard normal deviate.
const MEDIAN_SQUARE: f64 = 0.454_936;
/// Variance of rounding to a code, DN².
pub const ROUNDING_DN2: f64 = 1.0 / 12.0;

/// Variance over signal from half the squared differences of neighbours' residuals in a row: what both share (an effect, as a rule)
/// drops out. Medians, so that dead pixels and edges say little.
pub fn measured(data: &Data, fit: &Fit) -> Noise {
    let (tangents, _) = Tangents::new(data, &fit.pixels, &fit.pieces, &[]);
    let (pixels, width) = (data.pixels(), data.geometry().width);
    let frames: Vec<(usize, usize)> = data
        .takes
        .iter()
        .enumerate()
        .flat_map(|(take, recording)| (0..recording.moments.len()).map(move |index| (take, index)))
        .collect();
    let mut samples: Vec<(f64, f64)> = Vec::new();
    for &(take, index) in frames.iter().step_by(frames.len().div_ceil(FRAMES).max(1)) {
        let base = tangents.base(take, index);
        let measured = &data.takes[take].signal_dn[index * pixels..(index + 1) * pixels];
        let residual = |pixel: usize| f64::from(measured[pixel]) - base[pixel];
        for pixel in (0..pixels.saturating_sub(1)).filter(|pixel| (pixel + 1) % width != 0) {
            let difference = residual(pixel) - residual(pixel + 1);
            if difference.is_finite() {
                samples.push((0.5 * (base[pixel] + base[pixel + 1]), 0.5 * difference * difference));
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
        return Noise { floor, slope, square: 0.0 };
    }
    // All of it by the signal.
    let slope = if xx > 0.0 { ((xy - ROUNDING_DN2 * x) / xx).max(0.0) } else { 0.0 };
    Noise { floor: ROUNDING_DN2, slope, square: 0.0 }
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
}
