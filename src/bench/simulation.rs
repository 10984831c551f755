//! A course's frames, as many sets at a time as there are threads.

use super::course::Course;
use crate::frames::RawSets;
use crate::physics::{Before, Chain, Draws, EFFECTS, Exposure, Memory, Moment, PerPixel, Sensor};
use crate::problem::{Problem, Result};
use rayon::prelude::*;
use std::sync::Arc;

/// A camera that takes frames.
#[derive(Debug, Clone, Copy)]
pub struct Simulation<'a> {
    /// From the encoder to the charge.
    pub chain: &'a Chain,
    /// Converter and noise.
    pub sensor: &'a Sensor,
    /// Whether there are shot and read noise.
    pub noise: bool,
    /// From it and the frame's number follows all that is drawn.
    pub seed: u64,
    /// Number of the recording, so that two of one seed have different noise.
    pub recording: u32,
}

/// So many effects of the registry, its first ones, have a draw of each frame: the others draw nothing, so that a longer registry leaves all noise as it was.
const DRAWING: usize = 34;

/// What is drawn for a frame, always in this order, so that an effect more or less changes no other's draws.
struct FrameDraws {
    registry: Vec<f64>,
    rest: Draws,
}

impl Simulation<'_> {
    fn draws(&self, index: usize) -> FrameDraws {
        let stream = (u64::from(self.recording) << 32) | (index as u64 & 0xffff_ffff);
        let mut rest = Draws::of(self.seed, stream);
        FrameDraws { registry: rest.normal(DRAWING), rest }
    }

    /// The deviates of the chain's effects, by their places in the registry.
    fn deviates(&self, draws: &FrameDraws) -> Vec<f64> {
        let place = |name: &str| EFFECTS.iter().position(|effect| effect.name == name);
        let deviate =
            |name: &str| place(name).and_then(|place| draws.registry.get(place).copied()).unwrap_or(0.0);
        self.chain.effects().iter().map(|active| deviate(active.effect.name)).collect()
    }

    /// Frame number `index` of `course`, and the noise of its pixels; `before` is what light brought to the frame before, where that
    /// is known: it is simulated again where not, so that frames can be made in any order.
    fn expose(&self, course: &Course, index: usize, before: Option<PerPixel>) -> (Exposure, Vec<f64>) {
        let pixels = self.chain.pixels.count();
        let moment = course.moment(index);
        let mut draws = self.draws(index);
        let deviates = self.deviates(&draws);
        let for_pixels = self.chain.draws_for_pixels();
        let noise = if self.noise || for_pixels { draws.rest.normal(pixels) } else { Vec::new() };
        let pixel_deviates = if for_pixels { draws.rest.normal(pixels) } else { Vec::new() };
        let before = self.chain.looks_back().then(|| match before {
            Some(before_dn) => {
                let [evenly_dn, again_dn] = [before_dn.clone(), before_dn.clone()];
                Arc::new(Before { evenly_dn, again_dn, kept_dn: before_dn, rested_s: 0.0 })
            }
            None => {
                let deviates =
                    if moment.frame > 0 { self.deviates(&self.draws(index - 1)) } else { Vec::new() };
                self.chain.remember(Moment::before(index, |index| course.moment(index)), &deviates)
            }
        });
        let memory = Memory { before, deviates, pixel_deviates, noisy: self.noise, ..Memory::default() };
        (self.chain.expose(moment, memory), noise)
    }

    /// The signal of frame number `index` of `course`, DN above the pedestal, before noise and converter.
    pub fn signal(&self, course: &Course, index: usize) -> PerPixel {
        self.expose(course, index, None).0.signal_dn
    }

    /// The codes of set number `set`, `[frame, pixel]`.
    fn set(&self, course: &Course, set: usize, codes: &mut [u32]) {
        let mut before = None;
        for (frame, codes) in codes.chunks_mut(self.chain.pixels.count()).enumerate() {
            let (exposure, noise) = self.expose(course, set * course.frames() + frame, before);
            self.sensor.read_out(&exposure.signal_dn, self.noise.then_some(&*noise), codes);
            if self.noise {
                self.chain.cut_codes(codes);
            }
            before = Some(exposure.arrived_dn);
        }
    }
}

/// The raw frames of `course`. `tell` hears of every set that is done.
///
/// The codes depend on the simulation alone, not on machine or number of threads.
///
/// # Errors
/// No pixels or no frames.
pub fn simulate(simulation: &Simulation, course: &Course, tell: &(dyn Fn() + Sync)) -> Result<RawSets> {
    let pixels = simulation.chain.pixels.count();
    let mut codes = vec![0; pixels * course.count()];
    codes.par_chunks_mut((pixels * course.frames()).max(1)).enumerate().for_each(|(set, codes)| {
        simulation.set(course, set, codes);
        tell();
    });
    RawSets::new(simulation.chain.pixels.geometry, course.frames(), codes).ok_or_else(|| {
        let found = format!("{pixels} pixels, {} frames", course.count());
        Problem::at("simulation", found).expected("at least one of each")
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Chance;

    #[test]
    fn whatever_draws_for_a_frame_is_among_the_first() {
        assert!(EFFECTS.iter().skip(DRAWING).all(|effect| effect.chance == Chance::None));
        assert!(EFFECTS.iter().take(DRAWING).any(|effect| effect.chance == Chance::Frame));
    }
}
