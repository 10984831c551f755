//! How dark and how bright the samples are.

use super::data::Data;

/// So many samples are looked at, and not many more.
const LOOKED_AT: usize = 100_000;
/// But for this share at either end.
const EXTREME: f64 = 1e-3;
/// A full well would clip these shares of the samples, the brightest ones: it begins between what is seen of few and what darkens most.
const CLIPPED: [f64; 7] = [3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3];

impl Data {
    /// Some of the samples that count, of all pixels alike, from the darkest to the brightest, DN.
    fn ascending(&self) -> Vec<f32> {
        let all = || self.takes.iter().flat_map(|take| &take.signal_dn);
        // Not the same pixels in every frame.
        let fits = |every: &usize| gcd(*every, self.pixels()) == 1;
        let every = (all().count() / LOOKED_AT).max(1);
        let every = (every..).find(fits).unwrap_or(every);
        let mut some: Vec<f32> = all().step_by(every).copied().filter(|signal| signal.is_finite()).collect();
        some.sort_unstable_by(f32::total_cmp);
        some
    }

    /// From the darkest signal to the brightest one, but for one in a thousand each, DN.
    pub fn span_dn(&self) -> f64 {
        let some = self.ascending();
        let brightest = brightest(&some, EXTREME);
        let darkest = some.get((EXTREME * some.len() as f64) as usize);
        darkest.zip(brightest).map_or(0.0, |(&darkest, brightest)| brightest - f64::from(darkest))
    }

    /// Signals between so many parts of equally many samples, ascending, DN.
    pub fn quantiles_dn(&self, parts: usize) -> Vec<f64> {
        let some = self.ascending();
        let edge = |part: usize| some.get(part * some.len() / parts).map_or(0.0, |&signal| f64::from(signal));
        (1..parts).map(edge).collect()
    }

    /// Signals at which a full well would show in some samples, descending, DN.
    pub fn full_wells_dn(&self) -> Vec<f64> {
        let some = self.ascending();
        CLIPPED.iter().filter_map(|&share| brightest(&some, share)).collect()
    }
}

/// The signal, of all these in ascending order, of which this share is beyond.
fn brightest(ascending: &[f32], share: f64) -> Option<f64> {
    let beyond = (share * ascending.len() as f64) as usize;
    ascending.get(ascending.len().checked_sub(beyond + 1)?).map(|&signal| f64::from(signal))
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::frames::Geometry;

    /// Pixels whose number is their brightness, in many frames, a share of them none that counts.
    #[test]
    fn a_share_of_the_samples_is_brighter() {
        let recordings = taken(Geometry { width: 20, height: 15 }, 2, &[], &["four-rail"]).unwrap();
        let mut data = Data::of(&recordings, Vec::new()).unwrap();
        let pixels = data.pixels();
        for (number, signal) in data.takes[0].signal_dn.iter_mut().enumerate() {
            *signal = if number % pixels == 0 { f32::NAN } else { (number % pixels) as f32 };
        }
        let frames = data.takes[0].moments.len();
        data.takes[0].signal_dn.extend_from_within(..);
        data.takes[0].moments.extend_from_within(..);
        assert!(2 * frames * pixels > 2 * LOOKED_AT, "{frames}");
        let levels = data.full_wells_dn();
        assert_eq!(levels.len(), CLIPPED.len());
        assert!(levels.is_sorted_by(|brighter, darker| brighter >= darker));
        for (share, level) in CLIPPED.iter().zip(levels) {
            let expected = pixels as f64 * (1.0 - share);
            assert!((level - expected).abs() < 2.5, "{share}: {level}, not {expected}");
        }
        assert!((data.span_dn() - (pixels - 2) as f64).abs() < 2.5);
        assert_eq!((brightest(&[], 0.1), brightest(&[3.0], 0.1)), (None, Some(3.0)));
    }
}
