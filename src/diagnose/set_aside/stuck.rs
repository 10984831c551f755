//! Pixels that say nothing of light: the same code in every frame (dead ones), or none that counts (stuck at full scale).

use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::reading::data::Data;

/// So many samples at least, whose noise is at least so many DN² each, are hardly the same by chance: a code has 0.56 of them at most (of the variance a twelfth is rounding), and 0.56 to the twentieth is 1e-5.
const LEAST: usize = 20;
const LEAST_DN2: f64 = 0.5;

/// The pixels of `data`, which has this `noise`, that are stuck, in order.
pub fn stuck_pixels(data: &Data, noise: Noise) -> Vec<usize> {
    (0..data.pixels()).filter(|&pixel| is_stuck(data, noise, pixel)).collect()
}

/// Whether all samples of a pixel that count are the same, though its `noise` should move them, or none counts.
fn is_stuck(data: &Data, noise: Noise, pixel: usize) -> bool {
    let pixels = data.pixels();
    let all = data.takes.iter().flat_map(|take| take.signal_dn.iter().skip(pixel).step_by(pixels));
    let mut signals = all.copied().filter(|signal| !signal.is_nan());
    let Some(first) = signals.next() else { return true };
    let mut count = 1;
    let are_same = signals.all(|signal| {
        count += 1;
        signal == first
    });
    are_same && count >= LEAST && noise.variance(f64::from(first)) > LEAST_DN2
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::judging::conclusion::Verdict;
    use crate::diagnose::{diagnose, stated_noise};
    use crate::frames::Geometry;

    const SIZE: Geometry = Geometry { width: 16, height: 12 };
    /// In the image's corner and in its middle.
    const STUCK: [usize; 2] = [0, 5 * 16 + 8];

    /// Recordings with an `effect`, in which some pixels show the code of no light and others none that counts.
    fn recorded(effect: &str, recordings: &[&str]) -> Data {
        let effects = [injection(effect).unwrap()];
        let mut data = Data::of(&taken(SIZE, 2, &effects, recordings).unwrap(), Vec::new()).unwrap();
        for take in &mut data.takes {
            for frame in take.signal_dn.chunks_exact_mut(SIZE.pixels()) {
                (frame[STUCK[0]], frame[STUCK[1]]) = (0.0, f32::NAN);
            }
        }
        data
    }

    #[test]
    fn pixels_that_never_change_are_stuck_and_others_are_not() {
        let mut data = recorded("lens_scatter:share=0", &["four-rail"]);
        let noise = stated_noise(&data);
        assert_eq!(stuck_pixels(&data, noise), STUCK);
        // One other code, or noise that no code shows, and it may be the scene.
        assert_eq!(stuck_pixels(&data, noise.times(0.01)), STUCK[1..]);
        data.takes[0].signal_dn[20 * SIZE.pixels()] = 1.0;
        assert_eq!(stuck_pixels(&data, noise), STUCK[1..]);
    }

    /// What falls there is what falls beside it, or an image that moves brings darkness from there.
    #[test]
    fn an_image_that_moves_over_stuck_pixels_is_explained() {
        let diagnosis = diagnose(&recorded("lateral_motion:columns_a_metre=0.6", &["four-motion"]));
        let named: Vec<&str> = diagnosis.judgement.named.iter().map(|named| named.name).collect();
        assert_eq!((diagnosis.judgement.verdict, &named[..]), (Verdict::Explained, &["lateral_motion"][..]));
        let moved = diagnosis.judgement.fit.pieces[0].values[2];
        assert!((moved - 0.6).abs() < 0.03, "{moved}");
        assert_eq!(diagnosis.left_out.stuck, [(0, 0), (5, 8)]);
    }
}
