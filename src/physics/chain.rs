//! The chain: places one after the other, with the effects that act at each.

use super::correlation::{Correlation, Waveform};
use super::effect::{Active, Chance, Place};
use super::effects;
use super::exposure::{Before, Exposure, Included, Moment};
use super::per_pixel::PerPixel;
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
    /// What acts, in the order in which it does.
    effects: Vec<Active>,
}

/// What a frame needs to know of others.
#[derive(Debug, Clone, Default)]
pub struct Memory {
    /// What light brought to the pixels in the frame before, DN.
    pub before: Option<Arc<Before>>,
    /// The waveform at phases that the frame's may be, where it is at hand.
    pub waveform: Option<Arc<Waveform>>,
    /// The same of light that comes by other ways.
    pub paths: Arc<Vec<Arc<Waveform>>>,
    /// Draws from the standard normal distribution for this frame, one for each of [`Chain::effects`], in its order; where there are none, 0.
    pub deviates: Vec<f64>,
    /// Draws for its pixels; empty where no effect needs any.
    pub pixel_deviates: Vec<f64>,
    /// Whether noise comes after the chain.
    pub noisy: bool,
}

impl Chain {
    /// With `effects` in any order: they act where they belong, in the registry's order where they share a place, whoever named them
    /// first; those that are in none, a user's formulas, come last there.
    pub fn new(
        pixels: Arc<Pixels>,
        correlation: Correlation,
        included: Included,
        mut effects: Vec<Active>,
    ) -> Self {
        let number = |effect| effects::EFFECTS.iter().position(|known| std::ptr::eq(*known, effect));
        effects
            .sort_by_cached_key(|active| (active.effect.place, number(active.effect).unwrap_or(usize::MAX)));
        Self { pixels, correlation, included, effects }
    }

    /// What acts, in the order in which it does, which is that of [`Memory::deviates`].
    pub fn effects(&self) -> &[Active] {
        &self.effects
    }

    /// The frame at `moment`, before noise and converter; [`Exposure::arrived_dn`] is what the next frame's memory is made of.
    pub fn expose(&self, moment: Moment, memory: Memory) -> Exposure {
        let mut exposure = self.begin(moment, memory);
        self.run(&mut exposure, Place::Encoder);
        exposure
    }

    /// A frame from its `start` as it is when each place has been passed, in the order of [`Place::ALL`].
    pub fn stations(&self, start: &Exposure) -> Vec<Exposure> {
        let mut exposure = start.clone();
        let station = |place: Place| {
            self.pass(&mut exposure, place);
            exposure.clone()
        };
        Place::ALL.into_iter().map(station).collect()
    }

    /// Takes `exposure`, which has come to `place`, past it.
    pub fn pass(&self, exposure: &mut Exposure, place: Place) {
        self.run_between(exposure, place, place);
    }

    /// Takes `exposure`, which has passed `last`, to the end of the chain.
    pub fn resume(&self, exposure: &mut Exposure, last: Place) {
        if let Some(next) = Place::ALL.into_iter().find(|place| *place > last) {
            self.run(exposure, next);
        }
    }

    /// The frame at `moment` before it has come to any place.
    pub fn begin(&self, moment: Moment, memory: Memory) -> Exposure {
        let Memory { before, waveform, paths, deviates, pixel_deviates, noisy } = memory;
        let exposure = Exposure::new(moment, &self.pixels, self.included, &self.correlation);
        Exposure { before, waveform, paths, deviates, pixel_deviates, noisy, ..exposure }
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

    /// What light brought in the frame before, which is one of [`Moment::before`], with its `deviates`.
    pub fn remember(&self, [evenly, again, kept]: [Moment; 3], deviates: &[f64]) -> Arc<Before> {
        let arrive =
            |moment| self.arrive(moment, Memory { deviates: deviates.to_vec(), ..Memory::default() });
        let evenly_dn = arrive(evenly);
        let again_dn = if again == evenly { evenly_dn.clone() } else { arrive(again) };
        let kept_dn = if kept == again { again_dn.clone() } else { arrive(kept) };
        // The even camera's frame is the one that begins a frame period before.
        Arc::new(Before { evenly_dn, again_dn, kept_dn, rested_s: evenly.time_s - kept.time_s })
    }

    /// What light brings to the pixels at `moment`, before charge goes anywhere, DN.
    pub fn arrive(&self, moment: Moment, memory: Memory) -> PerPixel {
        let mut exposure = self.begin(moment, memory);
        self.run_between(&mut exposure, Place::Encoder, Place::Correlation);
        exposure.signal_dn
    }

    /// Takes `exposure` from `first`, whose own step is done again, to the end of the chain.
    pub fn run(&self, exposure: &mut Exposure, first: Place) {
        self.run_between(exposure, first, Place::Readout);
    }

    fn run_between(&self, exposure: &mut Exposure, first: Place, last: Place) {
        for place in Place::ALL.into_iter().filter(|place| (first..=last).contains(place)) {
            match place {
                Place::Encoder | Place::Clock | Place::Waveform | Place::Readout => {}
                Place::Path => exposure.look(),
                Place::Light => exposure.light(),
                Place::Correlation => exposure.correlate(),
                Place::Charge => exposure.arrived_dn = exposure.signal_dn.clone(),
            }
            let acting = self.effects.iter().enumerate().filter(|(_, active)| active.effect.place == place);
            for (number, Active { effect, values }) in acting {
                exposure.deviate = exposure.deviates.get(number).copied().unwrap_or(0.0);
                effect.act_on(values, exposure);
            }
        }
    }
}
