//! What may be wrong with a camera: one entry each, with its own mechanics in time.

mod charge;
mod clock;
mod light;
mod outside;

pub use charge::{cubic_part, is_emptied};
pub use clock::{ambient_drift_s, begins_anew, flicker, light_warm_up_s, phase_warm_up_s};
pub use light::{coupled_e, coupled_rad, ringing};

use super::plan::Take;
use super::scene::Scene;
use super::waveform::Waveform;
use super::world::{Moment, Ray, World};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Where a flaw acts.
#[derive(Debug, Clone, Copy)]
pub enum Hook {
    /// On the light's and the gate's correlation.
    Waveform(fn(&Flaw, &Waveform) -> Waveform),
    /// On when and how a frame is taken.
    Clock(fn(&Flaw, &Take, &mut Moment)),
    /// On the light of one pixel.
    Ray(fn(&Flaw, &Moment, &Scene, &mut Ray)),
    /// On the charge of all pixels.
    Image(fn(&Flaw, &Moment, &Scene, &mut [f64])),
    /// On the charge of all pixels, from that of the frame before.
    Lag(fn(&Flaw, &[f64], &mut [f64])),
    /// On the charge of a pixel, when it is read.
    Response(fn(&Flaw, &World, usize, f64) -> f64),
    /// On the voltage before the converter, in DN.
    Code(fn(&Flaw, &Moment, &World, usize, f64) -> f64),
    /// It is the world's own, and the camera's simulation does not know it: nothing has to be done.
    Unknown,
}

/// A kind of flaw.
#[derive(Debug)]
pub struct Mechanism {
    /// The effect's name; of one that is in no library, a name of its own.
    pub name: &'static str,
    /// Unit of its size.
    pub unit: &'static str,
    /// A size to begin with.
    pub usual: f64,
    /// The largest size that is still this flaw.
    pub most: f64,
    /// Where it acts.
    pub hook: Hook,
    /// Of one that is in no library, the coordinates where it lives; any of them is right.
    pub lives: &'static [&'static str],
    /// Look-alikes have the same letter.
    pub group: char,
}

impl Mechanism {
    /// One that the registry has by this name.
    const fn known(
        name: &'static str,
        unit: &'static str,
        usual: f64,
        most: f64,
        hook: Hook,
        group: char,
    ) -> Self {
        Self { name, unit, usual, most, hook, lives: &[], group }
    }

    /// One that no library has, and the coordinates where it lives.
    const fn outside(
        name: &'static str,
        unit: &'static str,
        usual: f64,
        most: f64,
        hook: Hook,
        lives: &'static [&'static str],
    ) -> Self {
        Self { lives, ..Self::known(name, unit, usual, most, hook, 'x') }
    }

    /// Whether no library has it.
    pub fn is_outside(&self) -> bool {
        !self.lives.is_empty()
    }
}

/// Every mechanism.
pub const MECHANISMS: &[&[Mechanism]] =
    &[clock::MECHANISMS, light::MECHANISMS, charge::MECHANISMS, outside::MECHANISMS];

/// A mechanism with its size and whatever else about it is random.
#[derive(Debug, Clone)]
pub struct Flaw {
    /// Which.
    pub mechanism: &'static Mechanism,
    /// How large, in the mechanism's unit.
    pub size: f64,
    /// Shape numbers, each in [0, 1).
    pub draws: [f64; 8],
    /// For what is random from frame to frame.
    pub seed: u64,
}

impl Flaw {
    /// A flaw of the mechanism's usual size, its shape drawn.
    pub fn drawn(mechanism: &'static Mechanism, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let draws = std::array::from_fn(|_| random.random());
        Self { mechanism, size: mechanism.usual, draws, seed: random.random() }
    }

    /// The same with another size.
    pub fn sized(&self, size: f64) -> Self {
        Self { size, ..self.clone() }
    }

    /// Shape number `number` as a value from `low` to `high`.
    fn draw(&self, number: usize, low: f64, high: f64) -> f64 {
        low + (high - low) * self.draws[number % 8]
    }

    /// Either sign.
    pub fn sign(&self, number: usize) -> f64 {
        if self.draws[number % 8] < 0.5 { -1.0 } else { 1.0 }
    }

    /// A standard normal number that belongs to these whole numbers.
    fn normal(&self, one: usize, two: usize, three: usize) -> f64 {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(((one as u64) << 40) | ((two as u64) << 12) | three as u64);
        StandardNormal.sample(&mut random)
    }
}

/// All mechanisms, one after the other.
pub fn all() -> impl Iterator<Item = &'static Mechanism> {
    MECHANISMS.iter().copied().flatten()
}

/// The mechanism called `name`.
pub fn named(name: &str) -> Option<&'static Mechanism> {
    all().find(|mechanism| mechanism.name == name)
}
