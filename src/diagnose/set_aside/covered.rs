//! Dark recordings in which nothing comes in at all: no recording says whether the camera's light was off, or the room's too (or the lens was covered). What pixels show then is where each of
//! them begins, which the ambient light has in all other recordings.

use crate::diagnose::fitting::finished::unfitted;
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::reading::data::{Data, Take};
use std::f64::consts::TAU;

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
        let mut dark: Vec<&mut Take> =
            takes.iter_mut().filter(|take| is_dark(take) && is_covered(take)).collect();
        dark.iter_mut().flat_map(|take| &mut take.moments).for_each(|moment| moment.transmission = 0.0);
        begin_at_nothing(&mut dark, data.pixels());
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
    // One number a pixel says where it begins.
    let gained = CLEARLY + data.pixels() as f64;
    (fitted.left() + gained < baseline.left()).then_some((covered, fitted))
}

/// Takes from the pixels of `dark` recordings, in which nothing comes in, what each of them shows on average in frames that go round once: what follows the phase steps stays.
fn begin_at_nothing(dark: &mut [&mut Take], pixels: usize) {
    let mut sums = vec![(0.0, 0_usize); pixels];
    for take in dark.iter() {
        let turn = once_round(take);
        let frames = take.signal_dn.chunks(pixels).zip(&take.moments);
        for (frame, _) in frames.filter(|(_, moment)| moment.frame < turn) {
            for (sum, signal) in sums.iter_mut().zip(frame).filter(|(_, signal)| signal.is_finite()) {
                *sum = (sum.0 + f64::from(*signal), sum.1 + 1);
            }
        }
    }
    let means: Vec<f32> = sums.into_iter().map(|(sum, count)| (sum / count.max(1) as f64) as f32).collect();
    for frame in dark.iter_mut().flat_map(|take| take.signal_dn.chunks_mut(pixels)) {
        frame.iter_mut().zip(&means).for_each(|(signal, mean)| *signal -= mean);
    }
}

/// How many frames of a set go round once; all, where that is no whole number of them.
fn once_round(take: &Take) -> usize {
    let step_rad = match &take.moments[..] {
        [first, second, ..] if take.frames > 1 => second.step_rad - first.step_rad,
        _ => 0.0,
    };
    let turn = (TAU / step_rad.abs()).round();
    let is_whole = turn <= take.frames as f64 && (turn * step_rad.abs() - TAU).abs() < WHOLE_RAD;
    if is_whole { turn as usize } else { take.frames }
}

/// Steps that go round but for so much go round.
const WHOLE_RAD: f64 = 1e-3;

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

    /// Pixels that begin at levels of their own in covered recordings do not differ from the simulation there, and what couples into them from the phase steps stays.
    #[test]
    fn pixels_begin_where_they_do() {
        const COUPLED_DN: f64 = 2.0;
        let recordings =
            taken(Geometry { width: 8, height: 6 }, 3, &[], &["four-rail", "four-dark", "wdft-dark"]);
        let data = Data::of(&recordings.unwrap(), Vec::new()).unwrap();
        let pixels = data.pixels();
        let levels = |step_dn: f64| move |pixel: usize| step_dn * (pixel % 5) as f64;
        let with = |data: &mut Data, level: &dyn Fn(usize) -> f64, coupled_dn: f64| {
            for take in data.takes.iter_mut().filter(|take| !take.moments[0].lit) {
                let less_dn = mean_dn(take);
                for (frame, moment) in take.signal_dn.chunks_mut(pixels).zip(&take.moments) {
                    let more_dn = coupled_dn * moment.step_rad.cos() - less_dn;
                    frame
                        .iter_mut()
                        .enumerate()
                        .for_each(|(pixel, signal)| *signal += (more_dn + level(pixel)) as f32);
                }
            }
        };
        let noise = stated_noise(&data);
        let left = |step_dn: f64, coupled_dn: f64| {
            let mut data = data.clone();
            with(&mut data, &levels(step_dn), coupled_dn);
            let (data, fitted) = covered(&data, &unfitted(&data, noise), noise).unwrap();
            assert_eq!(without_light(&data).len(), 2);
            fitted.left()
        };
        let (even, uneven, coupled) = (left(0.0, 0.0), left(3.0, 0.0), left(3.0, COUPLED_DN));
        assert!((uneven - even).abs() < 1.0, "{even} {uneven}");
        // In each of the dark frames, of which cosines have these means of the square.
        let of_dark = |take: &Take| -> f64 {
            let squares = take.moments.iter().map(|moment| (COUPLED_DN * moment.step_rad.cos()).powi(2));
            pixels as f64 * squares.sum::<f64>() / noise.floor
        };
        let expected: f64 = data.takes.iter().filter(|take| !take.moments[0].lit).map(of_dark).sum();
        assert!((coupled - uneven - expected).abs() < 0.1 * expected, "{coupled} - {uneven}, not {expected}");
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
