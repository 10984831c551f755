//! Draws from the standard normal distribution: a stream a frame, the same bits on every machine.

use super::trig::cos_sin;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::f64::consts::TAU;

/// The random numbers of one frame. They follow from seed and stream alone, so that frames can be made in any order.
#[derive(Debug, Clone)]
pub struct Draws(ChaCha8Rng);

/// The random stream of raw frame number `stream`.
pub(super) fn source(seed: u64, stream: u64) -> ChaCha8Rng {
    let mut source = ChaCha8Rng::seed_from_u64(seed);
    source.set_stream(stream);
    source
}

impl Draws {
    /// The draws of stream number `stream` of `seed`.
    pub fn of(seed: u64, stream: u64) -> Self {
        Self(source(seed, stream))
    }

    /// Evenly distributed in [0, 1), in steps of 2⁻⁵³.
    pub fn even(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (-53f64).exp2()
    }

    /// Two independent normal deviates (Box and Muller 1958). The usual faster methods need the platform's exponential function
    /// now and then, and then differ from one machine to the next.
    fn pair(&mut self) -> (f64, f64) {
        // In (0, 1], whose logarithm is finite.
        let above_zero = 1.0 - self.even();
        let length = (-2.0 * libm::log(above_zero)).sqrt();
        let (cosine, sine) = cos_sin(TAU * self.even());
        (length * cosine, length * sine)
    }

    /// `count` normal deviates.
    pub fn normal(&mut self, count: usize) -> Vec<f64> {
        let mut deviates = Vec::with_capacity(count + 1);
        while deviates.len() < count {
            let (one, other) = self.pair();
            deviates.extend([one, other]);
        }
        deviates.truncate(count);
        deviates
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moments and tails of the normal distribution, each within four of its own standard errors.
    #[test]
    fn they_are_normal() {
        let count = 400_000;
        let draws = Draws::of(7, 3).normal(count);
        let n = count as f64;
        let mean = |power: i32| draws.iter().map(|draw| draw.powi(power)).sum::<f64>() / n;
        let within = |found: f64, expected: f64, variance: f64| {
            assert!((found - expected).abs() < 4.0 * (variance / n).sqrt(), "{found}, not {expected}");
        };
        within(mean(1), 0.0, 1.0);
        within(mean(2), 1.0, 2.0);
        within(mean(3), 0.0, 15.0);
        within(mean(4), 3.0, 96.0);
        for (beyond, share) in [(1.0, 0.317_310_5), (2.0, 0.045_500_3), (3.0, 0.002_699_8)] {
            let found = draws.iter().filter(|draw| draw.abs() > beyond).count() as f64 / n;
            within(found, share, share * (1.0 - share));
        }
        let next = draws.windows(2).map(|two| two[0] * two[1]).sum::<f64>() / n;
        within(next, 0.0, 1.0);
    }

    #[test]
    fn streams_and_seeds_differ_and_repeat() {
        let draws = |seed, stream| Draws::of(seed, stream).normal(3);
        assert_eq!(draws(1, 2), draws(1, 2));
        assert_ne!(draws(1, 2), draws(1, 3));
        assert_ne!(draws(1, 2), draws(2, 2));
        assert_eq!(draws(1, 2), Draws::of(1, 2).normal(8)[..3]);
    }
}
