//! Dark recordings in which nothing comes in at all: no recording says whether the camera's light was off, or the room's too (or the lens was covered).

use super::data::Data;
use super::finished::unfitted;
use super::fit::Fit;
use super::noise::Noise;

/// No light at all explains such recordings better than ambient light alone by this chi squared, at least: ten nats.
const CLEARLY: f64 = 20.0;

/// `data` with no ambient light in its dark recordings, and the fit to that, where this says clearly more than the `baseline`, which has it there.
pub fn covered(data: &Data, baseline: &Fit, noise: Noise) -> Option<(Data, Fit)> {
    let mut covered = data.clone();
    let dark = covered.takes.iter_mut().filter(|take| take.moments.iter().all(|moment| !moment.lit));
    let dark = dark.map(|take| take.moments.iter_mut().for_each(|moment| moment.transmission = 0.0)).count();
    if dark == 0 || dark == data.takes.len() {
        return None;
    }
    let fitted = unfitted(&covered, noise);
    (fitted.left() + CLEARLY < baseline.left()).then_some((covered, fitted))
}

/// The names of recordings in which nothing comes in.
pub fn without_light(data: &Data) -> Vec<&str> {
    let is_covered =
        data.takes.iter().filter(|take| take.moments.iter().all(|moment| moment.transmission == 0.0));
    is_covered.map(|take| &take.name[..]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// A dark recording of a camera that sees ambient light, or, with the lens covered, its read noise alone.
    #[test]
    fn what_sees_nothing_is_covered() {
        let names = ["four-rail", "four-dark"];
        let recordings = taken(Geometry { width: 8, height: 6 }, 3, &[], &names).unwrap();
        let mut data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let is_covered = |data: &Data| covered(data, &unfitted(data, noise), noise).map(|(data, _)| data);
        assert!(is_covered(&data).is_none() && without_light(&data).is_empty());
        let dark = data.takes.iter().position(|take| take.name == names[1]).unwrap();
        // Its noise is that of the light that it saw.
        let signals = &mut data.takes[dark].signal_dn;
        let mean = signals.iter().sum::<f32>() / signals.len() as f32;
        signals.iter_mut().for_each(|signal| *signal = 0.2 * (*signal - mean));
        let found = is_covered(&data).unwrap();
        assert_eq!(without_light(&found), [names[1]]);
        // Alone it says nothing of that.
        data.takes.retain(|take| take.name == names[1]);
        assert!(is_covered(&data).is_none());
    }
}
