//! A course's frames, as many at a time as there are threads.

use super::course::Course;
use crate::frames::RawSets;
use crate::physics::{Chain, Draws, EFFECTS, Exposure, Memory, Moment, Sensor};
use crate::problem::{Problem, Result};
use rayon::prelude::*;

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

/// What is drawn for a frame, always in this order, so that an effect more or less changes no other's draws.
struct FrameDraws {
    registry: Vec<f64>,
    rest: Draws,
}

impl Simulation<'_> {
    fn draws(&self, index: usize) -> FrameDraws {
        let stream = (u64::from(self.recording) << 32) | (index as u64 & 0xffff_ffff);
        let mut rest = Draws::of(self.seed, stream);
        FrameDraws { registry: rest.normal(EFFECTS.len()), rest }
    }

    /// The deviates of the chain's effects, by their places in the registry.
    fn deviates(&self, draws: &FrameDraws) -> Vec<f64> {
        let place = |name: &str| EFFECTS.iter().position(|effect| effect.name == name);
        let deviate = |name: &str| place(name).map_or(0.0, |place| draws.registry[place]);
        self.chain.effects.iter().map(|active| deviate(active.effect.name)).collect()
    }

    /// The signal of frame number `index`, with the draws for its pixels, of which none is left out.
    fn expose(&self, moment: Moment, before: Option<Moment>, index: usize) -> (Exposure, Vec<f64>) {
        let pixels = self.chain.pixels.count();
        let mut draws = self.draws(index);
        let deviates = self.deviates(&draws);
        let noise =
            if self.noise || self.chain.draws_for_pixels() { draws.rest.normal(pixels) } else { Vec::new() };
        let pixel_deviates =
            if self.chain.draws_for_pixels() { draws.rest.normal(pixels) } else { Vec::new() };
        // What the frame before left behind: it is simulated again, so that frames can be made in any order.
        let before_dn = before.filter(|_| moment.follows && self.chain.looks_back()).map(|before| {
            let deviates = self.deviates(&self.draws(index - 1));
            // Draws for pixels act at the read-out only, behind what is asked for here.
            let memory =
                Memory { deviates, pixel_deviates: vec![0.0; pixel_deviates.len()], ..Memory::default() };
            self.chain.expose(before, memory).arrived_dn
        });
        (self.chain.expose(moment, Memory { before_dn, deviates, pixel_deviates }), noise)
    }

    /// The signal of frame number `index` of `course`, DN above the pedestal, before noise and converter.
    pub fn signal(&self, course: &Course, index: usize) -> Vec<f64> {
        let before = index.checked_sub(1).map(|before| course.moment(before));
        self.expose(course.moment(index), before, index).0.signal_dn
    }

    fn codes(&self, course: &Course, index: usize, codes: &mut [u32]) {
        let before = index.checked_sub(1).map(|before| course.moment(before));
        let (exposure, noise) = self.expose(course.moment(index), before, index);
        self.sensor.read_out(&exposure.signal_dn, self.noise.then_some(&*noise), codes);
    }
}

/// The raw frames of `course`. `tell` hears of every frame that is done.
///
/// The codes depend on the simulation alone, not on machine or number of threads.
///
/// # Errors
/// No pixels or no frames.
pub fn simulate(simulation: &Simulation, course: &Course, tell: &(dyn Fn() + Sync)) -> Result<RawSets> {
    let pixels = simulation.chain.pixels.count();
    let mut codes = vec![0; pixels * course.count()];
    codes.par_chunks_mut(pixels.max(1)).enumerate().for_each(|(index, frame)| {
        simulation.codes(course, index, frame);
        tell();
    });
    RawSets::new(simulation.chain.pixels.geometry, course.frames(), codes).ok_or_else(|| {
        let found = format!("{pixels} pixels, {} frames", course.count());
        Problem::at("simulation", found).expected("at least one of each")
    })
}
