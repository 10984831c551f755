//! Samples that noise would have clipped at full scale. Those that it did clip do not count; those of the same light that it did not clip are the darker ones of them, and would say that bright light
//! is less than it is: as a full well says, or a response that bends.

use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::reading::data::{CLIPPED_DN, Data};
use crate::diagnose::tangents::columns::Tangents;

/// Within so many standard deviations of full scale noise clips.
const REACH: f64 = 4.0;
/// Where less than this share of the samples is clipped that noise would clip, something else keeps them below: a well that is full before the converter is.
const AS_EXPECTED: f64 = 0.5;

/// `data` without the samples whose signal, as `fit` has it, is so near full scale that noise may have clipped them; nothing where there are none, or where they are not clipped.
pub fn below_full(data: &Data, fit: &Fit, noise: Noise) -> Option<Data> {
    let top_dn = f64::from(data.camera.full_scale() - CLIPPED_DN) - data.camera.pedestal_dn;
    let sigma_dn = noise.weight(top_dn).recip().sqrt();
    let near_dn = top_dn - REACH * sigma_dn;
    let is_near = |&measured: &f32| f64::from(measured) > near_dn;
    if !data.takes.iter().any(|take| take.signal_dn.iter().any(is_near)) {
        return None;
    }
    let (tangents, _) = Tangents::new(data, &fit.pixels, &fit.pieces, &[]);
    let (pixels, told) = (data.pixels(), data.are_told());
    let (mut near, mut clipped, mut expected) = (Vec::new(), 0.0, 0.0);
    for (take, recorded) in data.takes.iter().enumerate() {
        for (index, measured) in recorded.signal_dn.chunks(pixels).enumerate() {
            let base = tangents.base(take, index);
            for ((base, measured), told) in base.iter().zip(measured).zip(&told) {
                near.push(*base > near_dn);
                if *told && *base > near_dn {
                    let beyond = (base - top_dn) / sigma_dn;
                    expected += 0.5 * libm::erfc(-beyond * std::f64::consts::FRAC_1_SQRT_2);
                    clipped += f64::from(u8::from(measured.is_nan()));
                }
            }
        }
    }
    let is_clipped = clipped > 0.0 && clipped > AS_EXPECTED * expected;
    is_clipped.then(|| data.only(|frame, pixel| !near[frame * pixels + pixel]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::stated_noise;
    use crate::frames::{Geometry, RawSets};

    /// How many samples count before and after, of a camera of 10 bits that sees what one of 12 bits did, with no code above `most`.
    fn samples(most: u32) -> (usize, Option<usize>) {
        let mut recordings = taken(Geometry { width: 12, height: 10 }, 3, &[], &["four-rail"]).unwrap();
        for recording in &mut recordings {
            let codes = recording.raw.codes().iter().map(|&code| code.min(most)).collect();
            let (geometry, frames) = (recording.geometry(), recording.raw.frames_per_set());
            recording.raw = RawSets::new(geometry, frames, codes).unwrap();
            recording.camera.as_mut().unwrap().adc_bits = 10;
        }
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let count = |data: &Data| {
            let signals = data.takes.iter().flat_map(|take| &take.signal_dn);
            signals.filter(|signal| !signal.is_nan()).count()
        };
        let noise = stated_noise(&data);
        let baseline = unfitted(&data, noise);
        (count(&data), below_full(&data, &baseline, noise).as_ref().map(count))
    }

    #[test]
    fn what_noise_may_have_clipped_does_not_count() {
        let (before, after) = samples(1023);
        assert!(after.is_some_and(|after| after < before && after > before / 2), "{before} {after:?}");
    }

    #[test]
    fn a_well_that_is_full_before_the_converter_is_still_counts() {
        assert_eq!(samples(1005).1, None);
        // Nothing comes near.
        assert_eq!(samples(500).1, None);
    }
}
