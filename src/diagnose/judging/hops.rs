//! A step in time that was taken for a drift: light, or a phase, that changes at once and stays so.

use super::steps::{OfNamed, alone};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::naming::found::Found;
use crate::diagnose::reading::data::Data;
use crate::diagnose::statistics::evidence::VISIBLE;
use crate::diagnose::tangents::acting::Acting;
use crate::diagnose::tangents::columns::{Frame, own_values};
use nalgebra::DMatrix;

/// A recording's sets are taken together in so many parts at most, between which a step may be.
const PARTS: usize = 64;
/// A step explains more than the drift by so much of chi squared: it is the best one of many.
const MORE: f64 = 20.0;

/// What drifts, of which effect: by which of the pixels' own numbers, and whether in proportion to them; in words.
type Drift = (&'static str, &'static [usize], bool, &'static str);

const DRIFTS: [Drift; 3] = [
    ("illumination_drift", &[0, 2], true, "the camera's own light"),
    ("ambient_drift", &[3], true, "the ambient light"),
    ("phase_drift", &[1], false, "the phase"),
];

/// A step in time.
pub struct Hop {
    /// The drift that was named.
    pub name: &'static str,
    /// What changes, in words.
    pub what: &'static str,
    /// The recording.
    pub take: usize,
    /// When, s.
    pub time_s: f64,
}

/// The step that explains more than a drift which was `found`, and most of what that does, beside all else that was.
pub fn hop(data: &Data, found: &Found, noise: Noise) -> Option<Hop> {
    let is_found = |drift: &&Drift| found.named.iter().any(|named| named.name == drift.0);
    DRIFTS.iter().filter(is_found).find_map(|drift| in_place_of(data, found, noise, drift))
}

fn in_place_of(
    data: &Data,
    found: &Found,
    noise: Noise,
    &(name, numbers, is_relative, what): &Drift,
) -> Option<Hop> {
    let fit = &found.fit;
    let times: Vec<Vec<f64>> = (0..data.takes.len()).map(|take| begins_s(data, take)).collect();
    let first = |take: usize| times[..take].iter().map(Vec::len).sum::<usize>();
    let own = own_values(&fit.pixels);
    let fill = |take: usize, index: usize, frame: &Frame| {
        let time_s = data.takes[take].moments[index].time_s;
        let part = times[take].partition_point(|&begins_s| begins_s <= time_s).saturating_sub(1);
        let mut shape = vec![0.0; data.pixels()];
        for &number in numbers {
            for ((shape, tangent), value) in shape.iter_mut().zip(&frame.own[number]).zip(own[number]) {
                *shape += tangent * if is_relative { *value } else { 1.0 };
            }
        }
        let mut acting = Acting::default();
        acting.column(first(take) + part, shape);
        vec![acting]
    };
    let parts = first(times.len());
    let OfNamed { projected, parts: strengths, sizes } =
        OfNamed::at(data, found, noise, &[name], parts, &fill);
    // A step is in all parts from one on, of a recording.
    let ends = |take: usize| first(take)..first(take) + times[take].len();
    let steps: Vec<(usize, usize)> =
        (0..times.len()).flat_map(|take| ends(take).skip(1).map(move |part| (take, part))).collect();
    let mut sums = DMatrix::zeros(projected.vector.len(), strengths.len() + steps.len());
    for (number, &column) in strengths.iter().enumerate() {
        sums[(column, number)] = 1.0;
    }
    for (number, &(take, part)) in steps.iter().enumerate() {
        for later in part..ends(take).end {
            sums[(fit.columns.len() + later, strengths.len() + number)] = 1.0;
        }
    }
    let (information, score) = (sums.tr_mul(&(&projected.matrix * &sums)), sums.tr_mul(&projected.vector));
    let raw = |number: usize| sums.column(number).dot(&projected.raw);
    let of_drift: Vec<usize> = (0..strengths.len()).collect();
    let of_steps: Vec<usize> = (0..steps.len()).map(|step| strengths.len() + step).collect();
    let explained = alone(&information, &score, (&of_drift, &sizes), &of_steps);
    let seen = |&step: &usize| {
        let column = of_steps[step];
        information[(column, column)] > VISIBLE * raw(column)
    };
    let best = explained.stands_for(seen, MORE)?;
    let (take, part) = steps[best];
    Some(Hop { name, what, take, time_s: times[take][part - first(take)] })
}

/// When the parts of a recording begin, s: as many sets each.
fn begins_s(data: &Data, take: usize) -> Vec<f64> {
    let moments = &data.takes[take].moments;
    let mut begins: Vec<f64> =
        moments.iter().filter(|moment| moment.frame == 0).map(|moment| moment.time_s).collect();
    // Sets of which the first frame was lost, all of them, are one part.
    if begins.is_empty() {
        begins.push(f64::NEG_INFINITY);
    }
    let sets = begins.len().div_ceil(PARTS).max(1);
    begins.into_iter().step_by(sets).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::judging::searched::searched;
    use crate::diagnose::stated_noise;
    use crate::frames::{Geometry, RawSets};

    /// The set from which on a rail has the `changed` effect, if that is all that differs.
    const AT: usize = 30;

    /// What is found where all of a sweep and a rail has the first effect, and the rail from a set on the second one; and what of that is a step.
    fn found(all: &[&str], changed: &[&str]) -> (Vec<&'static str>, Option<(String, f64)>) {
        let size = Geometry { width: 10, height: 8 };
        let of = |effects: &[&str]| {
            let effects: Vec<_> = effects.iter().map(|effect| injection(effect).unwrap()).collect();
            taken(size, 4, &effects, &["four-rail", "four-sweep"]).unwrap()
        };
        let (mut recordings, later) = (of(all), of(changed));
        let (rail, frames) = (recordings[0].raw.codes().to_vec(), recordings[0].raw.frames_per_set());
        let from = AT * frames * size.pixels();
        let codes = [&rail[..from], &later[0].raw.codes()[from..]].concat();
        recordings[0].raw = RawSets::new(size, frames, codes).unwrap();
        let at_s = recordings[0].sets[AT].time_s;
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let noise = stated_noise(&data);
        let found = searched(&data, unfitted(&data, noise), noise, 0.0).0.found;
        let names = found.named.iter().map(|named| named.name).collect();
        let hop = hop(&data, &found, noise);
        (names, hop.map(|hop| (data.takes[hop.take].name.clone(), hop.time_s - at_s)))
    }

    #[test]
    fn what_changes_at_once_is_no_drift() {
        let drift = "illumination_drift:relative=0.03,time_constant_s=10";
        assert_eq!(found(&[drift], &[drift]), (vec!["illumination_drift"], None));
        let (names, hop) = found(&[], &["illumination_drift:relative_before=0.01"]);
        assert!(names.contains(&"illumination_drift"), "{names:?}");
        let (name, late_s) = hop.unwrap();
        assert!(name == "four-rail" && late_s.abs() < 1.0, "{name}, {late_s}");
    }
}
