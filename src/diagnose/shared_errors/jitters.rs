//! Two random errors of frames at once: of the phase (a clock's), and of when they are taken (of a target that moves). Where nothing moves only the first
//! one shows, and with the velocity the second one grows: so both can be told although in a moving frame they are nearly the same.

use super::clusters::ENDS;
use super::levels::{PHASE, POSITION};
use super::random::Strength;
use crate::diagnose::tangents::columns;
use crate::physics::Moment;
use nalgebra::{Matrix2, Vector2};

/// What a frame says of both errors: scores and information of phase and time, and what they share.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    /// By the phase, rad.
    pub phase: (f64, f64),
    /// By the time, s; nothing where the target stands still.
    pub time: (f64, f64),
    /// Information that both share.
    pub shared: f64,
    /// Its recording.
    pub take: usize,
    /// When it was taken, s.
    pub time_s: f64,
    /// Number of its set, among all that are looked at together.
    pub set: usize,
    /// Its own number within the set, and how many frames that has.
    pub number: (usize, usize),
    /// The target's velocity, m/s.
    pub velocity_m_s: f64,
    /// Where it was when the set began, m.
    pub position_m: f64,
    /// The set's phase offset, rad.
    pub offset_rad: f64,
}

/// What all frames say.
#[derive(Debug, Clone, Default)]
pub struct Jitters {
    frames: Vec<Frame>,
}

/// Both errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Both {
    /// Standard deviations of the phase, rad, and of the time, s.
    pub strengths: [Strength; 2],
    /// Evidence for either beside the other one, nats: of the phase, and of the time.
    pub beside: [f64; 2],
}

/// Of the clusters' modes, the phase and the time of a frame.
const KINDS: [usize; 2] = [PHASE, POSITION];
/// Standard deviations that are looked at, beside none.
const STEPS: usize = 33;
/// Parts of a step that are looked at beside the best one.
const PARTS: i32 = 6;
/// A frame counts at most so much (nats) for a second error.
const MOST_NATS: f64 = 4.0;

fn steps((low, high): (f64, f64)) -> impl Iterator<Item = f64> {
    let of = move |step: usize| low * (high / low).powf(step as f64 / (STEPS - 1) as f64);
    std::iter::once(0.0).chain((0..STEPS).map(of))
}

/// From one of the steps of a kind to the next, in logarithms.
fn ln_step(kind: usize) -> f64 {
    let (low, high) = ENDS[KINDS[kind]];
    (high / low).ln() / (STEPS - 1) as f64
}

impl Frame {
    /// What the residuals of the frame of a recording and set (`take`, `set`) that was taken at a `moment`, whitened with the `roots` of their weights, say of both.
    pub fn seen(
        frame: &columns::Frame,
        roots: &[f64],
        residuals: &[f64],
        (take, set): (usize, usize),
        moment: &Moment,
    ) -> Self {
        let &Moment { velocity_m_s, position_m, offset_rad, frame: number, frames, time_s, .. } = moment;
        let mut seen = Self {
            phase: (0.0, 0.0),
            time: (0.0, 0.0),
            shared: 0.0,
            take,
            time_s,
            set,
            number: (number, frames),
            velocity_m_s,
            position_m,
            offset_rad,
        };
        let tangents = frame.phase().zip(&frame.position);
        for ((root, residual), (phase, position)) in roots.iter().zip(residuals).zip(tangents) {
            let (phase, time) = (root * phase, root * velocity_m_s * position);
            seen.phase.0 += phase * residual;
            seen.phase.1 += phase * phase;
            seen.time.0 += time * residual;
            seen.time.1 += time * time;
            seen.shared += phase * time;
        }
        seen
    }

    /// Of chi squared what errors of these standard deviations take, and by what factor they raise the noise's determinant, its logarithm.
    pub fn explained(&self, phase_rad: f64, time_s: f64) -> (f64, f64) {
        let (a, b) = (phase_rad * phase_rad, time_s * time_s);
        let ((s, k), (t, l), m) = (self.phase, self.time, self.shared);
        // Sylvester: det(1 + V K), and the scores by the inverse of K + 1 / V, without dividing by a variance of 0.
        let determinant = (1.0 + a * k) * (1.0 + b * l) - a * b * m * m;
        let square = a * s * s * (1.0 + b * l) + b * t * t * (1.0 + a * k) - 2.0 * a * b * m * s * t;
        (square / determinant, determinant.ln())
    }

    /// Evidence for errors of these standard deviations, nats.
    fn ln_bayes(&self, phase_rad: f64, time_s: f64) -> f64 {
        let (square, determinant) = self.explained(phase_rad, time_s);
        0.5 * (square - determinant)
    }
}

impl Jitters {
    /// With one more frame.
    pub fn add(&mut self, frame: Frame) {
        self.frames.push(frame);
    }

    /// Those of both.
    pub fn and(mut self, other: Self) -> Self {
        self.frames.extend(other.frames);
        self
    }

    /// The frames.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// Evidence of all frames for errors of these standard deviations, nats.
    fn sum(&self, (phase_rad, time_s): (f64, f64)) -> f64 {
        self.frames.iter().map(|frame| frame.ln_bayes(phase_rad, time_s)).sum()
    }

    /// Of these standard deviations of the phase, and of the time, those with the greatest evidence.
    fn greatest(&self, phases: &[f64], times: &[f64]) -> (f64, f64) {
        let all = phases.iter().flat_map(|&phase_rad| times.iter().map(move |&time_s| (phase_rad, time_s)));
        let of = all.map(|at| (at, self.sum(at)));
        of.max_by(|a, b| a.1.total_cmp(&b.1)).map_or((0.0, 0.0), |best| best.0)
    }

    /// The same of all steps; 0 for what does not `exist`.
    fn greatest_step(&self, exist: [bool; 2]) -> (f64, f64) {
        let [phases, times] =
            [0, 1].map(|kind| if exist[kind] { steps(ENDS[KINDS[kind]]).collect() } else { vec![0.0] });
        self.greatest(&phases, &times)
    }

    /// Standard deviations of the phase, rad, and of the time, s, at which the frames are likeliest; 0 for what does not `exist`.
    pub fn likeliest(&self, exist: [bool; 2]) -> (f64, f64) {
        let near = self.greatest_step(exist);
        // Between the steps beside it, in as many parts.
        let fine = |kind: usize, at: f64| -> Vec<f64> {
            let part = |part: i32| at * (ln_step(kind) * f64::from(part) / f64::from(PARTS)).exp();
            if at > 0.0 { (-PARTS..=PARTS).map(part).collect() } else { vec![0.0] }
        };
        self.greatest(&fine(0, near.0), &fine(1, near.1))
    }

    /// Both errors as the frames show them best together, and what each of them says beside the best of the other one alone; nothing where no frame
    /// shows a time.
    pub fn both(&self) -> Option<Both> {
        if self.frames.iter().all(|frame| frame.time.1 <= 0.0) {
            return None;
        }
        let [phase_alone, time_alone, together] =
            [[true, false], [false, true], [true, true]].map(|exist| self.greatest_step(exist));
        let beyond = |alone: (f64, f64)| {
            let more = |frame: &Frame| {
                let more = frame.ln_bayes(together.0, together.1) - frame.ln_bayes(alone.0, alone.1);
                more.min(MOST_NATS)
            };
            self.frames.iter().map(more).sum::<f64>()
        };
        let beside = [beyond(time_alone), beyond(phase_alone)];
        Some(Both { strengths: self.strengths(together), beside })
    }

    /// Where the evidence is greatest near the step `at`, and how exactly: by the parabola through its neighbours, over the logarithms.
    fn strengths(&self, at: (f64, f64)) -> [Strength; 2] {
        let h = [0, 1].map(ln_step);
        let beside =
            |phase: f64, time: f64| self.sum((at.0 * (h[0] * phase).exp(), at.1 * (h[1] * time).exp()));
        let middle = beside(0.0, 0.0);
        let [right, left, up, down] =
            [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)].map(|(phase, time)| beside(phase, time));
        let bend = 0.25 * (beside(1.0, 1.0) - beside(1.0, -1.0) - beside(-1.0, 1.0) + beside(-1.0, -1.0));
        let curvature = -Matrix2::new(right + left - 2.0 * middle, bend, bend, up + down - 2.0 * middle);
        let slope = 0.5 * Vector2::new(right - left, up - down);
        // Where it is no hill, nothing is known but the step.
        let inverse = curvature.cholesky().map(|root| root.inverse());
        let known = inverse.map(|inverse| (inverse * slope, inverse.diagonal()));
        let (move_by, variance) = known.unwrap_or((Vector2::zeros(), Vector2::new(1.0, 1.0)));
        std::array::from_fn(|number| {
            let value = [at.0, at.1][number] * (h[number] * move_by[number].clamp(-1.0, 1.0)).exp();
            Strength { value, sigma: value * h[number] * variance[number].sqrt() }
        })
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
            jitters.add(Frame {
                phase: (PHASE * off, PHASE * PHASE),
                time: (by_time * off, by_time * by_time),
                shared: PHASE * by_time,
                take: 0,
                time_s: number as f64,
                set: 0,
                number: (0, 1),
                velocity_m_s: 1.0,
                position_m: 1.0,
                offset_rad: 0.0,
            });
        }
        jitters
    }

    #[test]
    fn two_errors_are_two_and_one_is_one() {
        let both = frames(1e-3, 1e-3).both().unwrap();
        assert!(both.beside.iter().all(|nats| *nats > 20.0), "{both:?}");
        // Six hundred frames, half of which move, tell a standard deviation to some 3 and 5 per cent.
        for (strength, known_to) in both.strengths.iter().zip([0.03, 0.05]) {
            assert!((strength.value - 1e-3).abs() < 3.0 * strength.sigma, "{both:?}");
            assert!((strength.sigma / 1e-3 / known_to).ln().abs() < 0.5, "{both:?}");
        }
        let [phase, time] = frames(1e-3, 0.0).both().unwrap().beside;
        assert!(phase > 20.0 && time < 4.0, "{phase} {time}");
        let [phase, time] = frames(0.0, 1e-3).both().unwrap().beside;
        assert!(phase < 4.0 && time > 20.0, "{phase} {time}");
    }

    #[test]
    fn the_likeliest_strengths_are_those_of_the_errors() {
        let jitters = frames(1e-3, 2e-3);
        let (phase_rad, time_s) = jitters.likeliest([true, true]);
        // Known to some 3 and 5 per cent, and looked at in steps of 4.
        assert!((phase_rad / 1e-3 - 1.0).abs() < 0.12, "{phase_rad}");
        assert!((time_s / 2e-3 - 1.0).abs() < 0.15, "{time_s}");
        assert_eq!(jitters.likeliest([true, false]).1, 0.0);
        assert_eq!(jitters.likeliest([false, false]), (0.0, 0.0));
        assert_eq!(frames(0.0, 0.0).likeliest([false, true]).0, 0.0);
    }

    /// Against the definition, by integrals over both errors.
    #[test]
    fn evidence_is_the_integral_over_both_errors() {
        let (phase, time, shared) = ((1.3, 2.0), (-0.4, 1.5), 0.7);
        let frame = Frame {
            take: 0,
            time_s: 0.0,
            set: 0,
            number: (0, 1),
            velocity_m_s: 1.0,
            position_m: 1.0,
            offset_rad: 0.0,
            phase,
            time,
            shared,
        };
        let (a, b) = (0.8, 0.6);
        let (mut sum, step) = (0.0, 0.02);
        for (x, y) in (-400..=400).flat_map(|x| (-400..=400).map(move |y| (x, y))) {
            let (x, y) = (f64::from(x) * step, f64::from(y) * step);
            let prior = (-0.5 * (x * x / (a * a) + y * y / (b * b))).exp() / (std::f64::consts::TAU * a * b);
            let square = x * x * frame.phase.1 + 2.0 * x * y * frame.shared + y * y * frame.time.1;
            sum += prior * (x * frame.phase.0 + y * frame.time.0 - 0.5 * square).exp() * step * step;
        }
        assert!((sum.ln() - frame.ln_bayes(a, b)).abs() < 1e-6, "{} {}", sum.ln(), frame.ln_bayes(a, b));
    }
}
