//! Light that the lens and the camera scatter over the image.

use crate::frames::Geometry;
use crate::physics::{Act, Chance, Effect, Exposure, Fidelity, Parameter, Place};

/// Share of every pixel's light that is spread: over all pixels alike (0), or around it, falling by a factor e every so much of the image's width along its columns and
/// as far along its rows. What falls beyond the image's border is lost then, and nothing comes from there.
pub static EFFECT: Effect = Effect {
    name: "lens_scatter",
    sentence: "The lens scatters part of the light over the image, so every pixel carries some of what others see.",
    reference: "Mure-Dubois 2007; Kavli 2008: z -> z + h * z",
    parameters: &[
        Parameter::strength("share", "1", 0.0, (0.0, 0.5), 0.02),
        Parameter::choice("decay_length_of_width", "1", &[0.0, 0.1, 0.2, 0.4]),
    ],
    place: Place::Correlation,
    chance: Chance::None,
    looks_back: false,
    fidelity: Fidelity::Loose,
    act: Act::Code(act),
};

fn act(values: &[f64], exposure: &mut Exposure) {
    let (share, decay) = (values[0], values[1]);
    if decay > 0.0 {
        let Geometry { width, height } = exposure.pixels.geometry;
        let spread_dn = spread(&exposure.signal_dn, width, height, (-1.0 / (decay * width as f64)).exp());
        let both = exposure.signal_dn.iter_mut().zip(spread_dn);
        both.for_each(|(signal, spread)| *signal += share * (spread - *signal));
    } else {
        let mean_dn = exposure.signal_dn.iter().sum::<f64>() / exposure.signal_dn.len().max(1) as f64;
        exposure.signal_dn.iter_mut().for_each(|signal| *signal += share * (mean_dn - *signal));
    }
}

/// `image`, each pixel of it spread over its row and its column, with `kept` times as much in the next pixel; what would go beyond the border is lost.
fn spread(image: &[f64], width: usize, height: usize, kept: f64) -> Vec<f64> {
    let mut image = image.to_vec();
    // The sum of all that falls on an endless line.
    let whole = (1.0 + kept) / (1.0 - kept);
    let mut along = |start: usize, step: usize, count: usize| {
        let mut before = 0.0;
        let forward: Vec<f64> = (0..count)
            .map(|n| {
                before = before * kept + image[start + n * step];
                before
            })
            .collect();
        let mut after = 0.0;
        for n in (0..count).rev() {
            let own = image[start + n * step];
            image[start + n * step] = (forward[n] + after) / whole;
            after = (after + own) * kept;
        }
    };
    (0..height).for_each(|row| along(row * width, 1, width));
    (0..width).for_each(|column| along(column, width, height));
    image
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One bright pixel among twelve by nine, by the sums written out.
    #[test]
    fn light_is_spread_by_the_sum_of_distances() {
        let (width, height, kept) = (12, 9, 0.7_f64);
        let mut image = vec![0.0; width * height];
        (image[4 * width + 3], image[7 * width + 10]) = (100.0, 30.0);
        let weight = |pixel: usize, row: usize, column: usize| {
            let steps = (pixel / width).abs_diff(row) + (pixel % width).abs_diff(column);
            kept.powi(steps as i32) * (0.3_f64 / 1.7).powi(2)
        };
        for (pixel, found) in spread(&image, width, height, kept).into_iter().enumerate() {
            let expected = 100.0 * weight(pixel, 4, 3) + 30.0 * weight(pixel, 7, 10);
            assert!((found - expected).abs() < 1e-12, "{pixel}: {found}, not {expected}");
        }
    }
}
