//! The chain: places one after the other, with the effects that act at each.

use super::correlation::Correlation;
use super::effect::{Active, Chance, Place};
use super::effects;
use super::exposure::{Exposure, Included, Moment};
use super::pixels::Pixels;
use std::sync::Arc;

/// A camera as its simulation has it: pixels, waveform, and what acts besides.
#[derive(Debug, Clone)]
pub struct Chain {
    /// The pixels.
    pub pixels: Arc<Pixels>,
    /// The correlation waveform.
    pub correlation: Correlation,
    /// What the baseline takes into account of a target that moves.
    pub included: Included,
    /// Effects, in any order: they act where they belong, and in the registry's order where they share a place.
    pub effects: Vec<Active>,
}

/// What a frame needs to know of others.
#[derive(Debug, Clone, Default)]
pub struct Memory {
    /// What light brought to the pixels in the frame before, DN.
    pub before_dn: Option<Arc<Vec<f64>>>,
    /// Draws from the standard normal distribution for this frame, one for each of [`Chain::effects`]; where there are none, 0.
    pub deviates: Vec<f64>,
    /// Draws for its pixels; empty where no effect needs any.
    pub pixel_deviates: Vec<f64>,
    /// Whether noise comes after the chain.
    pub noisy: bool,
}

impl Chain {
    /// The frame at `moment`, before noise and converter; [`Exposure::arrived_dn`] is what the next frame's memory is made of.
    pub fn expose(&self, moment: Moment, memory: Memory) -> Exposure {
        let mut exposure = self.begin(moment, memory);
        self.run(&mut exposure, Place::Encoder);
        exposure
    }

    /// The frame at `moment` as it is when each place has been passed, in the order of [`Place::ALL`].
    pub fn stations(&self, moment: Moment, memory: Memory) -> Vec<Exposure> {
        let mut exposure = self.begin(moment, memory);
        let station = |place: Place| {
            self.run_between(&mut exposure, place, place);
            exposure.clone()
        };
        Place::ALL.into_iter().map(station).collect()
    }

    /// Takes `exposure`, which has passed `last`, to the end of the chain.
    pub fn resume(&self, exposure: &mut Exposure, last: Place) {
        if let Some(next) = Place::ALL.into_iter().find(|place| *place > last) {
            self.run(exposure, next);
        }
    }

    fn begin(&self, moment: Moment, memory: Memory) -> Exposure {
        let Memory { before_dn, deviates, pixel_deviates, noisy } = memory;
        let exposure = Exposure::new(moment, &self.pixels, self.included, &self.correlation);
        Exposure { before_dn, deviates, pixel_deviates, noisy, ..exposure }
    }

    /// Cuts low bits off noisy codes, where the camera's arithmetic does.
    pub fn cut_codes(&self, codes: &mut [u32]) {
        for active in self.effects.iter().filter(|active| active.effect.name == effects::FIXED_POINT) {
            let bits = active.values[0].round() as u32;
            codes.iter_mut().for_each(|code| *code = *code >> bits << bits);
        }
    }

    /// Whether a frame needs the light of the one before.
    pub fn looks_back(&self) -> bool {
        self.effects.iter().any(|active| active.effect.looks_back)
    }

    /// Whether an effect draws for every pixel.
    pub fn draws_for_pixels(&self) -> bool {
        self.effects.iter().any(|active| active.effect.chance == Chance::Pixel)
    }

    /// What light brings to the pixels at `moment`, before charge goes anywhere, DN.
    pub fn arrive(&self, moment: Moment, memory: Memory) -> Arc<Vec<f64>> {
        let mut exposure = self.begin(moment, memory);
        self.run_between(&mut exposure, Place::Encoder, Place::Correlation);
        Arc::new(exposure.signal_dn)
    }

    /// Takes `exposure` from `first`, whose own step is done again, to the end of the chain.
    pub fn run(&self, exposure: &mut Exposure, first: Place) {
        self.run_between(exposure, first, Place::Readout);
    }

    /// The effects of `place` with their numbers, in the registry's order, whoever named them first; those that are in none, a user's
    /// formulas, come last.
    fn acting_at(&self, place: Place) -> Vec<(usize, &Active)> {
        let here = self.effects.iter().enumerate().filter(|(_, active)| active.effect.place == place);
        let mut here: Vec<(usize, &Active)> = here.collect();
        if here.len() > 1 {
            let known = |effect| effects::EFFECTS.iter().position(|known| std::ptr::eq(*known, effect));
            here.sort_by_key(|(_, active)| known(active.effect).unwrap_or(usize::MAX));
        }
        here
    }

    fn run_between(&self, exposure: &mut Exposure, first: Place, last: Place) {
        for place in Place::ALL.into_iter().filter(|place| (first..=last).contains(place)) {
            match place {
                Place::Encoder | Place::Clock | Place::Waveform | Place::Readout => {}
                Place::Path => exposure.look(),
                Place::Light => exposure.light(),
                Place::Correlation => exposure.correlate(),
                Place::Charge => exposure.arrived_dn = Arc::new(exposure.signal_dn.clone()),
            }
            for (number, Active { effect, values }) in self.acting_at(place) {
                exposure.deviate = exposure.deviates.get(number).copied().unwrap_or(0.0);
                effect.act_on(values, exposure);
            }
        }
    }
}
