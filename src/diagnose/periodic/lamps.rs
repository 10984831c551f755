//! Whether a line of the ambient light is a lamp's: lamps flicker with twice the mains' frequency.

use super::lines::{CLEARLY_MORE, DRIFT_CYCLES, MAINS_DRIFT_CYCLES, Series, most_between};
use crate::diagnose::statistics::gaps::{Gap, forward, gaps, seen_cycles};

/// The effect that is a line in time.
pub const FLICKER: &str = "ambient_flicker";
/// Lamps flicker with twice the mains' frequency, and not with all others: Hz.
pub const FLICKER_HZ: (f64, f64) = (80.0, 130.0);
const TWICE_MAINS_HZ: [f64; 2] = [100.0, 120.0];
/// By what share the mains' frequency is off at most.
pub const MAINS_OFF: f64 = 2e-3;
/// Of a cycle, what is no more within a set is none.
const LEAST_FORWARD: f64 = 1e-3;
/// A generator that is not on the grid is off by more, but hardly by this share.
pub const NEAR_MAINS: f64 = 0.05;

/// Whether a frequency, Hz, may be twice the mains'.
pub fn is_mains(frequency_hz: f64) -> bool {
    TWICE_MAINS_HZ.iter().any(|mains| (frequency_hz / mains - 1.0).abs() < MAINS_OFF)
}

/// Whether frames that are a period (s) apart see a line of so many hertz as one within a `share` of twice the mains' frequency.
pub fn is_seen_as_lamps(hz: f64, period_s: f64, share: f64) -> bool {
    // Images are whole turns from frame to frame apart; of those on either side of twice the mains' frequency the nearest one counts.
    let nearest = |mains: f64, hz: f64| hz + ((mains - hz) * period_s).round() / period_s;
    let is_near = |mains: f64| [hz, -hz].iter().any(|&hz| (nearest(mains, hz) / mains - 1.0).abs() < share);
    TWICE_MAINS_HZ.into_iter().any(is_near)
}

impl Series {
    /// Whether a line of the ambient light that is near `frequency_hz` may be a lamp's, where the series has nothing else: it is near twice the mains' frequency,
    /// or as strong a line is there; noise has `inflation` times the variance that was stated.
    pub fn may_be_lamps(&self, frequency_hz: f64, inflation: f64) -> bool {
        let takes = self.by_take();
        let near = |hz: f64, share: f64| {
            most_between(&takes, (hz * (1.0 - share), hz * (1.0 + share)), self.frame_period_s)
        };
        let is_near = |hz: &f64| (frequency_hz / hz - 1.0).abs() < NEAR_MAINS;
        let of_mains = || TWICE_MAINS_HZ.map(|hz| near(hz, NEAR_MAINS)).into_iter().fold(0.0, f64::max);
        let clearly = CLEARLY_MORE * inflation.max(1.0);
        TWICE_MAINS_HZ.iter().any(is_near) || near(frequency_hz, MAINS_OFF) < of_mains() + clearly
    }

    /// Whether no recording sees more of a line of this frequency, Hz, than a drift has that goes up and down.
    pub fn sees_at_rest(&self, frequency_hz: f64) -> bool {
        self.by_take().iter().all(|take| seen_cycles(&gaps(take), frequency_hz) < DRIFT_CYCLES)
    }

    /// Whether all recordings see a lamp's flicker at rest: it is a drift to them, and a drift may be a flicker.
    pub fn flicker_rests(&self) -> bool {
        self.has_resting(&|_, _| true)
    }

    /// The same of one that goes forward in each set, and back again to the next: what drifts anew within every set may be that.
    pub fn flicker_comes_back(&self) -> bool {
        self.has_resting(&|gaps, mains| forward(gaps, mains).abs() > LEAST_FORWARD)
    }

    /// Whether all recordings see a lamp's flicker at rest of which, with their gaps, this is true in one.
    fn has_resting(&self, is_so: &dyn Fn(&[Gap], f64) -> bool) -> bool {
        let gaps: Vec<_> = self.by_take().iter().map(|take| gaps(take)).collect();
        let rests = |mains: f64| gaps.iter().all(|gaps| seen_cycles(gaps, mains) < MAINS_DRIFT_CYCLES);
        let is_it = |&mains: &f64| rests(mains) && gaps.iter().any(|gaps| is_so(gaps, mains));
        TWICE_MAINS_HZ.iter().any(is_it)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::periodic::lines::FrameSeen;
    use crate::physics::Draws;
    use std::f64::consts::TAU;

    /// Frames 25 ms apart see 16.9 Hz as 103.1 Hz; frames a millisecond apart see it as it is.
    #[test]
    fn a_lamps_line_may_be_seen_elsewhere() {
        for (hz, period_s, is_lamps) in [
            (16.9, 0.025, true),
            (-23.1, 0.025, true),
            (103.1, 0.025, true),
            (7.31, 0.025, false),
            (16.9, 0.001, false),
            (99.9, 0.001, true),
            (88.3, 0.025, false),
            (7.31, 0.0, false),
        ] {
            assert_eq!(is_seen_as_lamps(hz, period_s, NEAR_MAINS), is_lamps, "{hz} Hz, every {period_s} s");
        }
    }

    /// Frames 25 ms apart see 100 and 120 Hz stand, and frames 20.2 ms apart, in sets that begin 200 ms apart, see 100 Hz go forward and come back.
    #[test]
    fn a_lamp_may_go_forward_in_every_set_and_come_back() {
        let of = |frame_s: f64, set_s: f64| {
            let frame = |n: usize| FrameSeen {
                time_s: set_s * (n / 4) as f64 + frame_s * (n % 4) as f64,
                ambient: (0.0, 1.0),
                ..FrameSeen::default()
            };
            let series =
                Series { frame_period_s: frame_s, frames: (0..80).map(frame).collect(), ..Series::default() };
            (series.flicker_rests(), series.flicker_comes_back())
        };
        assert_eq!(of(0.025, 0.275), (true, false));
        assert_eq!(of(0.0202, 0.2), (true, true));
        assert_eq!(of(0.0237, 0.2), (false, false));
    }

    /// Frames 25 ms apart, in sets of four that begin eleven of them apart, see a line of 117.6 Hz and one of 82.4 Hz alike, and scans do not, whose steps
    /// are at other places between them.
    #[test]
    fn what_frames_see_alike_is_equally_strong() {
        for (draw, offset_hz) in (0..12).map(|n| (n, 0.013 * n as f64)) {
            let hz = 117.6 + offset_hz;
            let of_take = |(take, sets): (u64, usize)| {
                let noise = Draws::of(draw, take).normal(4 * sets);
                let at = |n: usize| 0.025 * (11 * (n / 4) + n % 4) as f64;
                // As strong as 1340 to 1440 in the noise of one.
                let line = |n: usize| 2.05 * (TAU * hz * at(n) + 1.0).sin() + noise[n];
                (0..4 * sets).map(|n| (at(n), (line(n), 1.0))).collect::<Vec<_>>()
            };
            let takes = [(0, 68), (1, 102)].map(of_take);
            let near =
                |hz: f64, share: f64| most_between(&takes, (hz * (1.0 - share), hz * (1.0 + share)), 0.025);
            let (image, of_mains) = (near(200.0 - hz, MAINS_OFF), near(120.0, NEAR_MAINS));
            assert!(image > 1000.0, "{image}");
            assert!((image - of_mains).abs() < 0.5 * CLEARLY_MORE, "{hz}: {image} {of_mains}");
        }
    }
}
