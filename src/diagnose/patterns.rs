//! What many effects do to a frame is the same but for a factor: they change a number of the exposure (an angle, a time, a place), or all light alike.
//! Such a change is made once, and each effect has its share of it.

use super::acting::Acting;
use crate::physics::{Active, Chain, Exposure, Place};

/// A change of a frame that several effects may make.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Change {
    /// Of one of [`Exposure::scalars_mut`].
    Scalar(usize),
    /// Of all of the camera's own light.
    Light,
    /// Of all ambient light.
    Ambient,
}

/// Steps of the scalars, in their units: none is more than a thousandth of what matters.
const SCALAR_STEPS: [f64; Exposure::SCALARS] = [1e-6, 1e-6, 1e-6, 1e-3, 1e-3, 1.0, 1e-5];
/// Relative step of the light.
const LIGHT_STEP: f64 = 1e-3;
/// Two factors are the same where they differ by no more than rounding.
const ROUNDING: f64 = 1e-12;

/// The columns of a frame, as they are found.
pub struct Patterns<'a> {
    chain: &'a Chain,
    base: &'a [f64],
    /// The frame as it is before any place, and when each has been passed.
    start: Exposure,
    stations: Vec<Exposure>,
    known: Vec<((Place, Change), usize)>,
    /// The columns.
    pub acting: Acting,
}

impl<'a> Patterns<'a> {
    /// None yet, of a frame that is `base`, and which from its `start` has passed these `stations` of the `chain`.
    pub fn new(chain: &'a Chain, base: &'a [f64], start: Exposure, stations: Vec<Exposure>) -> Self {
        Self { chain, base, start, stations, known: Vec::new(), acting: Acting::default() }
    }

    /// Column `number`: what one more effect does by a `step` of one of its numbers, over that step.
    pub fn more(&mut self, number: usize, more: &Active, step: f64, is_finite: bool) {
        let place = more.effect.place;
        let station = &self.stations[place as usize];
        let mut exposure = station.clone();
        more.effect.act_on(&more.values, &mut exposure);
        let changes = if is_finite { None } else { changes(&exposure, station) };
        if !exposure.stands_as(station) {
            self.add(number, self.chain, exposure, place, step, changes);
        }
    }

    /// Column `number`: what another chain does, which differs from this one from `place` on by a `step` of one of its numbers, over that step.
    pub fn other(&mut self, number: usize, other: &Chain, step: f64, place: Place) {
        let mut exposure = match (place as usize).checked_sub(1) {
            Some(before) => self.stations[before].clone(),
            None => self.start.clone(),
        };
        other.pass(&mut exposure, place);
        let station = &self.stations[place as usize];
        let changes = changes(&exposure, station);
        if !exposure.stands_as(station) {
            self.add(number, other, exposure, place, step, changes);
        }
    }

    /// Column `number`: what becomes in `chain` of a frame that was changed at `place`, by these `changes` if it is they, over the `step` that made it.
    fn add(
        &mut self,
        number: usize,
        chain: &Chain,
        exposure: Exposure,
        place: Place,
        step: f64,
        changes: Option<Vec<(Change, f64)>>,
    ) {
        let Some(changes) = changes else {
            self.acting.column(number, end(chain, exposure, place, self.base, step));
            return;
        };
        for (change, by) in changes {
            let pattern = self.pattern(place, change);
            self.acting.share(number, pattern, by / step);
        }
    }

    fn pattern(&mut self, place: Place, change: Change) -> usize {
        if let Some((_, known)) = self.known.iter().find(|(known, _)| *known == (place, change)) {
            return *known;
        }
        let mut exposure = self.stations[place as usize].clone();
        let step = match change {
            Change::Scalar(number) => {
                let step = SCALAR_STEPS[number];
                *exposure.scalars_mut()[number] += step;
                step
            }
            Change::Light => {
                exposure.scale_light(1.0 + LIGHT_STEP);
                LIGHT_STEP
            }
            Change::Ambient => {
                exposure.ambient_dn.iter_mut().for_each(|ambient| *ambient *= 1.0 + LIGHT_STEP);
                LIGHT_STEP
            }
        };
        let values = end(self.chain, exposure, place, self.base, step);
        let number = self.acting.pattern(values);
        self.known.push(((place, change), number));
        number
    }
}

/// What becomes in `chain` of a frame that was changed at `place`, less the `base`, over the `step` by which it was.
fn end(chain: &Chain, mut exposure: Exposure, place: Place, base: &[f64], step: f64) -> Vec<f64> {
    chain.resume(&mut exposure, place);
    difference(&exposure.signal_dn, base, step)
}

/// By what `exposure` differs from `station`, if that is scalars, or a factor of all light.
fn changes(exposure: &Exposure, station: &Exposure) -> Option<Vec<(Change, f64)>> {
    let scalars = exposure.scalars().into_iter().zip(station.scalars()).enumerate();
    let changed = scalars.filter(|(_, (a, b))| a != b);
    let mut changes: Vec<_> = changed.map(|(number, (a, b))| (Change::Scalar(number), a - b)).collect();
    if exposure.arrays_stand_as(station) {
        return Some(changes);
    }
    let same = Exposure {
        amplitude_dn: station.amplitude_dn.clone(),
        constant_dn: station.constant_dn.clone(),
        ambient_dn: station.ambient_dn.clone(),
        ..exposure.clone()
    };
    if !same.arrays_stand_as(station) {
        return None;
    }
    let ambient = factor(&[(&exposure.ambient_dn, &station.ambient_dn)])?;
    let own = [
        (&exposure.amplitude_dn[..], &station.amplitude_dn[..]),
        (&exposure.constant_dn[..], &station.constant_dn[..]),
    ];
    changes.push((Change::Light, factor(&own)? - 1.0));
    changes.push((Change::Ambient, ambient - 1.0));
    changes.retain(|(_, by)| *by != 0.0);
    Some(changes)
}

/// The factor by which all values are others, if it is one.
fn factor(pairs: &[(&[f64], &[f64])]) -> Option<f64> {
    let all = || pairs.iter().flat_map(|(changed, own)| changed.iter().zip(*own));
    let factor = all().find(|(_, own)| **own != 0.0).map_or(1.0, |(changed, own)| changed / own);
    let is_same = |(changed, own): (&f64, &f64)| (changed - factor * own).abs() <= ROUNDING * own.abs();
    all().all(is_same).then_some(factor)
}

/// The difference of a `changed` frame from `base`, over the `step` that made it.
pub fn difference(changed: &[f64], base: &[f64], step: f64) -> Vec<f64> {
    let per = step.recip();
    pulp::Arch::new()
        .dispatch(|| changed.iter().zip(base).map(|(changed, base)| (changed - base) * per).collect())
}
