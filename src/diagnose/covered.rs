//! Dark recordings in which nothing comes in at all: no recording says whether the camera's light was off, or the room's too (or the lens was covered).

use super::data::{Data, Take};
use super::finished::unfitted;
use super::fit::Fit;
use super::noise::Noise;

/// No light at all explains such recordings better than ambient light alone by this chi squared, at least: ten nats.
const CLEARLY: f64 = 20.0;
/// Of the ambient light that others see, what is less than this share in a recording is none.
const NONE: f64 = 0.1;

/// `data` with no ambient light in those of its dark recordings that see none, and the fit to that, where this says clearly more than the `baseline`, which has it there.
pub fn covered(data: &Data, baseline: &Fit, noise: Noise) -> Option<(Data, Fit)> {
    let is_dark = |take: &Take| take.moments.iter().all(|moment| !moment.lit);
    if !data.takes.iter().any(is_dark) || data.takes.iter().all(is_dark) {
        return None;
    }
    let without = |is_covered: &dyn Fn(&Take) -> bool| {
        let mut takes = data.takes.clone();
        for take in takes.iter_mut().filter(|take| is_dark(take) && is_covered(take)) {
            take.moments.iter_mut().for_each(|moment| moment.transmission = 0.0);
        }
        let covered = data.with_takes(takes);
        let fitted = unfitted(&covered, noise);
        (covered, fitted)
    };
    // What ambient light there is the others say.
    let all = without(&|_| true);
    let ambient = &all.1.pixels.ambient_dn;
    let ambient_dn = ambient.iter().sum::<f64>() / ambient.len() as f64;
    let sees_none = |take: &Take| mean_dn(take) < NONE * ambient_dn;
    let mut dark = data.takes.iter().filter(|take| is_dark(take)).map(sees_none);
    if !dark.clone().any(|none| none) {
        return None;
    }
    let (covered, fitted) = if dark.all(|none| none) { all } else { without(&sees_none) };
    (fitted.left() + CLEARLY < baseline.left()).then_some((covered, fitted))
}

/// What a recording sees on average, DN.
fn mean_dn(take: &Take) -> f64 {
    let seen = || take.signal_dn.iter().filter(|signal| signal.is_finite());
    seen().map(|&signal| f64::from(signal)).sum::<f64>() / seen().count().max(1) as f64
}

/// The names of recordings in which nothing comes in.
pub fn without_light(data: &Data) -> Vec<String> {
    let is_covered =
        data.takes.iter().filter(|take| take.moments.iter().all(|moment| moment.transmission == 0.0));
    is_covered.map(|take| take.name.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;

    /// The recordings in which no light is found, of a rail or a sweep and two dark ones, of which the ambient light has these shares; and whether a pixel's
    /// constant light is told from ambient light then.
    fn covered_of(bright: &str, shares: [f32; 2]) -> (Vec<String>, bool) {
        let names = [bright, "four-dark", "wdft-dark"];
        let recordings = taken(Geometry { width: 8, height: 6 }, 3, &[], &names).unwrap();
        let mut data = Data::of(&recordings, Vec::new()).unwrap();
        for (name, share) in names[1..].iter().zip(shares) {
            let take = data.takes.iter_mut().find(|take| take.name == *name).unwrap();
            let less_dn = (1.0 - share) * mean_dn(take) as f32;
            take.signal_dn.iter_mut().for_each(|signal| *signal -= less_dn);
        }
        let noise = stated_noise(&data);
        let found = covered(&data, &unfitted(&data, noise), noise).map(|(data, _)| data);
        let found = found.as_ref().unwrap_or(&data);
        (without_light(found), found.tells_constant(0))
    }

    #[test]
    fn what_sees_nothing_is_covered() {
        let names = |of: &[&str]| of.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
        let both = names(&["four-dark", "wdft-dark"]);
        assert_eq!(covered_of("four-rail", [1.0, 1.0]), (Vec::new(), true));
        assert_eq!(covered_of("four-rail", [0.0, 0.0]).0, both);
        // Of two one may be.
        assert_eq!(covered_of("four-rail", [0.0, 1.0]), (names(&["four-dark"]), true));
        // A room that is dimmer than before is not without light.
        assert_eq!(covered_of("four-rail", [0.15, 0.15]), (Vec::new(), true));
    }

    /// Where nothing moves, frames without any light do not tell ambient light from the constant part of the camera's own.
    #[test]
    fn frames_without_light_say_nothing_of_ambient_light() {
        let data = |transmission: f64| {
            let recordings =
                taken(Geometry { width: 8, height: 6 }, 3, &[], &["four-sweep", "four-dark"]).unwrap();
            let data = Data::of(&recordings, Vec::new()).unwrap();
            let mut takes = data.takes.clone();
            let dark = takes.iter_mut().flat_map(|take| &mut take.moments).filter(|moment| !moment.lit);
            dark.for_each(|moment| moment.transmission = transmission);
            data.with_takes(takes)
        };
        assert!(data(1.0).tells_constant(0) && !data(0.0).tells_constant(0));
    }

    /// A dark recording alone says nothing of what others would see.
    #[test]
    fn a_dark_recording_alone_is_not_covered() {
        let recordings = taken(Geometry { width: 8, height: 6 }, 3, &[], &["four-dark"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        assert!(covered(&data, &unfitted(&data, noise), noise).is_none());
    }
}
