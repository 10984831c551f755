//! Two random errors of frames at once: of the phase (a clock's), and of when they are taken (of a target that moves). Where nothing moves only the first
//! one shows, and with the velocity the second one grows: so both can be told although in a moving frame they are nearly the same.

/// What a frame says of both errors: scores and information of phase and time, and what they share.
#[derive(Debug, Clone, Copy)]
pub struct Seen {
    /// By the phase, rad.
    pub phase: (f64, f64),
    /// By the time, s; nothing where the target stands still.
    pub time: (f64, f64),
    /// Information that both share.
    pub shared: f64,
}

/// What all frames say.
#[derive(Debug, Clone, Default)]
pub struct Jitters {
    frames: Vec<Seen>,
}

/// Both errors' standard deviations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Both {
    /// Of the phase, rad.
    pub phase_rad: f64,
    /// Of the time, s.
    pub time_s: f64,
    /// Evidence for either beside the other one, nats: of the phase, and of the time.
    pub beside: [f64; 2],
}

/// Standard deviations that are looked at, and how many between the ends.
const PHASES_RAD: (f64, f64) = (3e-5, 0.1);
const TIMES_S: (f64, f64) = (1e-5, 0.03);
const STEPS: usize = 33;
/// A frame says at most so much (nats) of a second error: a few outliers are none.
const MOST_NATS: f64 = 4.0;

fn steps((low, high): (f64, f64)) -> impl Iterator<Item = f64> + Clone {
    let of = move |step: usize| low * (high / low).powf(step as f64 / (STEPS - 1) as f64);
    std::iter::once(0.0).chain((0..STEPS).map(of))
}

impl Seen {
    /// Evidence for errors of these standard deviations, nats.
    fn ln_bayes(&self, phase_rad: f64, time_s: f64) -> f64 {
        let (a, b) = (phase_rad * phase_rad, time_s * time_s);
        let ((s, k), (t, l), m) = (self.phase, self.time, self.shared);
        // Sylvester: det(1 + V K), and the scores by the inverse of K + 1 / V, without dividing by a variance of 0.
        let determinant = (1.0 + a * k) * (1.0 + b * l) - a * b * m * m;
        let square = a * s * s * (1.0 + b * l) + b * t * t * (1.0 + a * k) - 2.0 * a * b * m * s * t;
        0.5 * (square / determinant - determinant.ln())
    }
}

impl Jitters {
    /// With one more frame.
    pub fn add(&mut self, seen: Seen) {
        self.frames.push(seen);
    }

    /// Those of both.
    pub fn and(mut self, other: Self) -> Self {
        self.frames.extend(other.frames);
        self
    }

    /// Both errors as the frames show them best together, and what each of them says beside the best of the other one alone; nothing where no frame
    /// shows a time.
    pub fn both(&self) -> Option<Both> {
        if self.frames.iter().all(|frame| frame.time.1 <= 0.0) {
            return None;
        }
        let sum = |at: (f64, f64)| self.frames.iter().map(|frame| frame.ln_bayes(at.0, at.1)).sum::<f64>();
        let greatest = |all: &mut dyn Iterator<Item = (f64, f64)>| {
            let of = all.map(|at| (at, sum(at)));
            of.max_by(|a, b| a.1.total_cmp(&b.1)).map_or((0.0, 0.0), |best| best.0)
        };
        let (mut phases, mut times) = (steps(PHASES_RAD), steps(TIMES_S));
        let phase_alone = greatest(&mut phases.by_ref().map(|phase_rad| (phase_rad, 0.0)));
        let time_alone = greatest(&mut times.by_ref().map(|time_s| (0.0, time_s)));
        let mut all = steps(PHASES_RAD).flat_map(|phase| steps(TIMES_S).map(move |time| (phase, time)));
        let together = greatest(&mut all);
        let beyond = |alone: (f64, f64)| {
            let more = |frame: &Seen| {
                let more = frame.ln_bayes(together.0, together.1) - frame.ln_bayes(alone.0, alone.1);
                more.min(MOST_NATS)
            };
            self.frames.iter().map(more).sum::<f64>()
        };
        let beside = [beyond(time_alone), beyond(phase_alone)];
        Some(Both { phase_rad: together.0, time_s: together.1, beside })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    /// Frames of which half move, with errors of these standard deviations and unit noise.
    fn frames(phase_rad: f64, time_s: f64) -> Jitters {
        const PHASE: f64 = 3000.0;
        const TIME: f64 = 9000.0;
        let mut jitters = Jitters::default();
        for (number, draws) in (0..600).map(|number| (number, Draws::of(11, number).normal(3))) {
            let by_time = if number % 2 == 0 { TIME } else { 0.0 };
            let off = PHASE * phase_rad * draws[0] + by_time * time_s * draws[1] + draws[2];
            jitters.add(Seen {
                phase: (PHASE * off, PHASE * PHASE),
                time: (by_time * off, by_time * by_time),
                shared: PHASE * by_time,
            });
        }
        jitters
    }

    #[test]
    fn two_errors_are_two_and_one_is_one() {
        let both = frames(1e-3, 1e-3).both().unwrap();
        assert!(both.beside.iter().all(|nats| *nats > 20.0), "{both:?}");
        assert!(
            (both.phase_rad / 1e-3).ln().abs() < 0.3 && (both.time_s / 1e-3).ln().abs() < 0.3,
            "{both:?}"
        );
        let [phase, time] = frames(1e-3, 0.0).both().unwrap().beside;
        assert!(phase > 20.0 && time < 4.0, "{phase} {time}");
        let [phase, time] = frames(0.0, 1e-3).both().unwrap().beside;
        assert!(phase < 4.0 && time > 20.0, "{phase} {time}");
    }

    /// Against the definition, by integrals over both errors.
    #[test]
    fn evidence_is_the_integral_over_both_errors() {
        let seen = Seen { phase: (1.3, 2.0), time: (-0.4, 1.5), shared: 0.7 };
        let (a, b) = (0.8, 0.6);
        let (mut sum, step) = (0.0, 0.02);
        for (x, y) in (-400..=400).flat_map(|x| (-400..=400).map(move |y| (x, y))) {
            let (x, y) = (f64::from(x) * step, f64::from(y) * step);
            let prior = (-0.5 * (x * x / (a * a) + y * y / (b * b))).exp() / (std::f64::consts::TAU * a * b);
            let square = x * x * seen.phase.1 + 2.0 * x * y * seen.shared + y * y * seen.time.1;
            sum += prior * (x * seen.phase.0 + y * seen.time.0 - 0.5 * square).exp() * step * step;
        }
        assert!((sum.ln() - seen.ln_bayes(a, b)).abs() < 1e-6, "{} {}", sum.ln(), seen.ln_bayes(a, b));
    }
}
