//! The smallest strengths of what is random that 95 of 100 campaigns like this one show.

use crate::diagnose::fitting::noise::{Noise, square_known_to};
use crate::diagnose::locating::location::Location;
use crate::diagnose::reading::data::Data;
use crate::diagnose::shared_errors::jitters::Frame;
use crate::diagnose::shared_errors::random::{self, CLUSTER_NATS, EXCESS_NOISE, JITTERS};
use crate::diagnose::statistics::evidence::POWER_SIGMAS;

/// Strengths are looked for in so many halvings, from one to a millionth of it.
const HALVINGS: usize = 40;
const ENDS: (f64, f64) = (1e-6, 1.0);

/// What is random, each with its smallest strength: the standard deviation of a frame's phase (rad) and of its time (s), and that of noise over the signal. Nothing
/// where no strength shows it. Of what the camera includes, so much more must be there.
pub fn detectable_at_random(
    data: &Data,
    location: &Location,
    noise: Noise,
) -> Vec<(&'static str, Option<f64>)> {
    let frames = location.jitters.frames();
    let sets = frames.iter().map(|frame| frame.set).max().map_or(1, |last| last + 1) as f64;
    // Of a frame's information the pixels' own numbers take a part of one over the number of sets.
    let share = 1.0 - sets.recip();
    let least = random::least_of_effects(data, location);
    let kinds: [fn(&Frame) -> f64; 2] = [|frame| frame.phase.1, |frame| frame.time.1];
    let jitters = [0, 1].map(|kind| {
        let information: Vec<f64> = frames.iter().map(|frame| share * kinds[kind](frame)).collect();
        let beside = |sigma: f64| sigma.hypot(data.unpredicted.jitter[kind]);
        (JITTERS[kind], smallest(&information, least).map(beside))
    });
    // Chi squared of one number, from which on its evidence is enough.
    let excess_sigmas = (2.0 * CLUSTER_NATS).sqrt() + POWER_SIGMAS;
    let square = excess_sigmas * square_known_to(data, noise);
    let excess = (square > 0.0).then(|| (square + data.unpredicted.square).sqrt());
    jitters.into_iter().chain([(EXCESS_NOISE, excess)]).collect()
}

/// The standard deviation at which errors of clusters of this `information` have more evidence than `least` (nats) in 95 of 100 campaigns.
fn smallest(information: &[f64], least: f64) -> Option<f64> {
    let is_enough = |sigma: f64| {
        // The score's square has the variance 1 + sigma² k in units of k: its mean, and how it scatters.
        let (mut mean, mut variance) = (0.0, 0.0);
        for share in information.iter().map(|k| sigma * sigma * k) {
            mean += 0.5 * (share - share.ln_1p());
            variance += 0.5 * share * share;
        }
        mean - POWER_SIGMAS * variance.sqrt() > least
    };
    let (mut low, mut high) = ENDS;
    if !is_enough(high) {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if is_enough(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::statistics::evidence::of_variance;
    use crate::physics::Draws;

    /// By drawing scores: at the strength that is stated the evidence is beyond the threshold in 95 of 100.
    #[test]
    fn ninety_five_of_a_hundred_are_seen() {
        const DRAWS: u64 = 400;
        const LEAST: f64 = 7.0;
        let information: Vec<f64> = (0..300).map(|n| 1e4 * (1.0 + f64::from(n % 3))).collect();
        let sigma = smallest(&information, LEAST).unwrap();
        let is_seen = |draw: &u64| {
            let scores = Draws::of(9, *draw).normal(information.len());
            let evidence = information.iter().zip(&scores).map(|(k, deviate)| {
                let score = deviate * (k * (1.0 + sigma * sigma * k)).sqrt();
                of_variance(sigma * sigma, score, *k)
            });
            evidence.sum::<f64>() > LEAST
        };
        let seen = (0..DRAWS).filter(is_seen).count();
        // 380, and three standard deviations of a binomial number; sums of squares are not quite normal.
        assert!((362..=396).contains(&seen), "{seen} of {DRAWS} at {sigma}");
        assert_eq!(smallest(&[], LEAST), None);
    }
}
