//! What many effects do to a frame is the same but for a factor: they change a number of the exposure (an angle, a time, a place), or all light alike.
//! Such a change is made once, and each effect has its share of it.

use super::acting::Acting;
use super::charges::Charges;
use crate::physics::{Active, Chain, Exposure, Place};
use crate::widest::widest;

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

/// Steps of the scalars, in their units. What comes after need not be smooth: a converter's error may have a period of some DN.
const SCALAR_STEPS: [f64; Exposure::SCALARS] = [1e-6, 1e-6, 1e-6, 1e-5, 1e-5, 1.0, 1e-5, 1e-6];
/// Relative step of the light.
const LIGHT_STEP: f64 = 1e-5;
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
    /// What effects did to the charge, by the small step that made the pattern.
    charges: Charges,
    /// The columns.
    pub acting: Acting,
}

impl<'a> Patterns<'a> {
    /// None yet, of a frame that is `base`, and which from its `start` has passed these `stations` of the `chain`.
    pub fn new(chain: &'a Chain, base: &'a [f64], start: Exposure, stations: Vec<Exposure>) -> Self {
        Self {
            chain,
            base,
            start,
            stations,
            known: Vec::new(),
            charges: Charges::default(),
            acting: Acting::default(),
        }
    }

    /// Column `number`: what one more effect does by a `step` of one of its numbers, over that step.
    pub fn more(&mut self, number: usize, more: &Active, step: f64, is_finite: bool) {
        let place = more.effect.place;
        let station = &self.stations[place as usize];
        let mut exposure = station.clone();
        more.effect.act_on(&more.values, &mut exposure);
        let changes = if is_finite { None } else { changes(&exposure, station) };
        if exposure.stands_as(station) {
            return;
        }
        if is_finite || changes.is_some() || !exposure.stands_as_but_for_charge(station) {
            self.add(number, self.chain, exposure, place, step, changes);
            return;
        }
        match self.charges.share(more.effect.name, &exposure, station, step) {
            Ok((pattern, factor)) => self.acting.share(number, pattern, factor),
            Err(new) => {
                self.add(number, self.chain, exposure, place, step, None);
                self.charges.knows(new, more.effect.name, step, self.acting.patterns.len() - 1);
            }
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
    if !exposure.stands_as_but_for_light(station) {
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
    let mut all = pairs.iter().flat_map(|(changed, own)| changed.iter().zip(*own));
    let factor = all.find(|(_, own)| **own != 0.0).map_or(1.0, |(changed, own)| changed / own);
    pairs.iter().all(|(changed, own)| is_multiple(changed, own, factor)).then_some(factor)
}

/// Whether all values are `factor` times others.
fn is_multiple(changed: &[f64], own: &[f64], factor: f64) -> bool {
    let mut same = [1_u64; LANES];
    let all = &mut same;
    widest!((all: &'a mut [u64; LANES], changed: &'a [f64], own: &'a [f64], factor: f64) {
        for (changed, own) in changed.chunks(LANES).zip(own.chunks(LANES)) {
            for ((same, changed), own) in all.iter_mut().zip(changed).zip(own) {
                *same &= u64::from((changed - factor * own).abs() <= ROUNDING * own.abs());
            }
        }
    });
    same == [1; LANES]
}

/// Values that are compared side by side.
const LANES: usize = 16;

/// The difference of a `changed` frame from `base`, over the `step` that made it.
pub fn difference(changed: &[f64], base: &[f64], step: f64) -> Vec<f64> {
    debug_assert_eq!(changed.len(), base.len());
    let (per, mut differences) = (step.recip(), vec![0.0; base.len()]);
    let all = &mut differences[..];
    widest!((all: &'a mut [f64], changed: &'a [f64], base: &'a [f64], per: f64) {
        for ((difference, changed), base) in all.iter_mut().zip(changed).zip(base) {
            *difference = (changed - base) * per;
        }
    });
    differences
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{practice_camera, sensor};
    use crate::frames::Geometry;
    use crate::physics::{Correlation, EFFECTS, Effect, Included, Memory, Moment, Stage};
    use std::sync::Arc;

    fn chain_of(effects: &[Active]) -> Chain {
        let sensor = sensor(&practice_camera(Geometry { width: 8, height: 6 }));
        let pixels = Arc::new(Stage::bench().pixels(&sensor, 5));
        let included = Included { axial_motion: true, inverse_square_falloff: true };
        Chain::new(pixels, Correlation::measured(), included, effects.to_vec())
    }

    fn moments() -> Vec<Moment> {
        let of = |(frame, velocity_m_s, offset_rad, lit): (usize, f64, f64, bool)| Moment {
            set: 2,
            frame,
            frames: 4,
            time_s: 3.1 + frame as f64 * 0.025,
            in_set_s: frame as f64 * 0.025,
            frame_period_s: 0.025,
            step_rad: frame as f64 * std::f64::consts::FRAC_PI_2,
            offset_rad,
            position_m: 2.1,
            place_m: 2.1,
            velocity_m_s,
            frequency_hz: 30e6,
            lit,
            transmission: 1.0,
        };
        [(0, 0.0, 0.0, true), (1, 2.0, 1.0, true), (3, -1.0, 4.4, true), (2, 0.0, 0.3, false)]
            .map(of)
            .to_vec()
    }

    fn effect(name: &str) -> &'static Effect {
        EFFECTS.iter().find(|effect| effect.name == name).unwrap()
    }

    /// What is fitted already: something at each place that makes a difference to what comes after.
    fn fitted() -> Vec<Active> {
        let of = |(name, values): (&str, &[f64])| {
            let effect = effect(name);
            let mut all = effect.off();
            all[..values.len()].copy_from_slice(values);
            Active { effect, values: all }
        };
        let all: [(&str, &[f64]); 5] = [
            ("encoder_scale", &[0.01]),
            ("phase_drift", &[0.05]),
            ("illumination_drift", &[0.1]),
            ("multipath_interference", &[0.1]),
            ("intensity_nonlinearity", &[0.05]),
        ];
        all.map(of).to_vec()
    }

    /// What stands in `acting` of column 0, written out.
    fn written_out(acting: &Acting, pixels: usize) -> Vec<f64> {
        let mut values = vec![0.0; pixels];
        for share in &acting.shares {
            assert_eq!(share.column, 0);
            let pattern = &acting.patterns[share.pattern];
            values.iter_mut().zip(pattern).for_each(|(value, pattern)| *value += share.factor * pattern);
        }
        values
    }

    /// How many numbers `of` changes, each by `(effects with the change, column)`: the column is the change of the frame that `direct` chains show.
    fn agrees(
        name: &str,
        moment: Moment,
        chain: &Chain,
        changed: &Chain,
        step: f64,
        acting: &Acting,
    ) -> bool {
        let memory = |chain: &Chain| Memory {
            before: chain.looks_back().then(|| chain.remember([moment; 3], &[])),
            ..Memory::default()
        };
        let [base, other] = [chain, changed].map(|chain| chain.expose(moment, memory(chain)).signal_dn);
        let direct = difference(&other, &base, step);
        let column = written_out(acting, base.len());
        let greatest = direct.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        for (direct, column) in direct.iter().zip(&column) {
            assert!((direct - column).abs() <= 2e-3 * greatest, "{name}: {direct} {column} of {greatest}");
        }
        greatest > 0.0
    }

    /// Numbers of an effect, strengths first, with the step that is small for each.
    fn steps(effect: &Effect) -> Vec<(usize, f64)> {
        let strengths = effect.parameters.iter().enumerate().filter(|(_, parameter)| !parameter.is_shape());
        strengths.map(|(number, parameter)| (number, 1e-4 * parameter.typical)).collect()
    }

    #[test]
    fn an_effects_column_is_what_it_does_to_the_frame() {
        let chain = chain_of(&fitted());
        let mut seen = std::collections::BTreeSet::new();
        for effect in
            EFFECTS.iter().filter(|effect| fitted().iter().all(|known| known.effect.name != effect.name))
        {
            for (moment, (number, step)) in moments()
                .into_iter()
                .flat_map(|moment| steps(effect).into_iter().map(move |step| (moment, step)))
            {
                let mut values = effect.off();
                values[number] += step;
                let more = Active { effect, values };
                let changed = chain_of(&[fitted(), vec![more.clone()]].concat());
                let before = changed.looks_back().then(|| chain.remember([moment; 3], &[]));
                let start = chain.begin(moment, Memory { before, ..Memory::default() });
                let base = chain.expose(moment, Memory::default()).signal_dn;
                let mut patterns = Patterns::new(&chain, &base, start.clone(), chain.stations(&start));
                patterns.more(0, &more, step, false);
                if agrees(effect.name, moment, &chain, &changed, step, &patterns.acting) {
                    seen.insert(effect.name);
                }
            }
        }
        // But for random effects, and those that begin at a size, all of them do something.
        assert!(seen.len() + 8 >= EFFECTS.len() - fitted().len(), "{seen:?}");
    }

    #[test]
    fn a_fitted_numbers_column_is_what_it_does_to_the_frame() {
        let chain = chain_of(&fitted());
        for (place, active) in fitted().iter().enumerate() {
            for (moment, (number, step)) in moments()
                .into_iter()
                .flat_map(|moment| steps(active.effect).into_iter().map(move |step| (moment, step)))
            {
                let mut effects = fitted();
                effects[place].values[number] += step;
                let changed = chain_of(&effects);
                let start = chain.begin(moment, Memory::default());
                let base = chain.expose(moment, Memory::default()).signal_dn;
                let mut patterns = Patterns::new(&chain, &base, start.clone(), chain.stations(&start));
                patterns.other(0, &changed, step, active.effect.place);
                agrees(active.effect.name, moment, &chain, &changed, step, &patterns.acting);
            }
        }
    }

    /// One value that is another, wherever it stands, is enough; so is one that is no number.
    #[test]
    fn a_factor_is_that_of_all_values() {
        let own: Vec<f64> = (0..37).map(f64::from).collect();
        let changed: Vec<f64> = own.iter().map(|own| 1.5 * own).collect();
        assert_eq!(factor(&[(&changed, &own), (&own[..0], &own[..0])]), Some(1.5));
        for place in [2, 17, 36] {
            for other in [1.5 * own[place] + 1e-9, f64::NAN] {
                let mut changed = changed.clone();
                changed[place] = other;
                assert_eq!(factor(&[(&changed, &own)]), None, "{place} {other}");
            }
        }
    }

    #[test]
    fn what_scales_light_or_a_scalar_alone_shares_a_pattern() {
        let chain = chain_of(&[]);
        let moment = moments()[1];
        let start = chain.begin(moment, Memory::default());
        let base = chain.expose(moment, Memory::default()).signal_dn;
        let mut patterns = Patterns::new(&chain, &base, start.clone(), chain.stations(&start));
        for (column, name) in
            ["phase_drift", "phase_step_scale", "illumination_drift", "lens_scatter"].iter().enumerate()
        {
            let effect = effect(name);
            let mut values = effect.off();
            values[0] += 1e-3;
            patterns.more(column, &Active { effect, values }, 1e-3, false);
        }
        let shares: Vec<usize> = patterns.acting.shares.iter().map(|share| share.pattern).collect();
        assert_eq!(shares, [0, 0, 1, 2]);
    }

    #[test]
    fn what_moves_charge_alike_shares_a_pattern() {
        let (chain, moment, effect) = (chain_of(&[]), moments()[1], effect("lateral_motion"));
        let start = chain.begin(moment, Memory::default());
        let base = chain.expose(moment, Memory::default()).signal_dn;
        let mut patterns = Patterns::new(&chain, &base, start.clone(), chain.stations(&start));
        for number in 0..4 {
            let mut values = effect.off();
            values[number] += 1e-3;
            patterns.more(number, &Active { effect, values }, 1e-3, false);
        }
        let shares = patterns.acting.shares.iter().map(|share| (share.pattern, share.factor.round()));
        assert_eq!(shares.collect::<Vec<_>>(), [(0, 1.0), (1, 1.0), (0, 2.0), (1, 2.0)]);
    }
}
