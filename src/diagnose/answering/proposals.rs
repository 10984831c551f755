//! Recordings that could be taken: each is a recorded one that would be taken otherwise.

use crate::diagnose::reading::data::Take;
use crate::physics::Moment;
use std::f64::consts::TAU;

/// A recording that could be taken.
pub struct Proposal {
    /// How it would be taken, in words.
    pub what: &'static str,
    /// Whether it matters where the target is, which nobody knows of a still scene.
    pub is_of_places: bool,
    /// Whether sets have other frames then, of which an effect with a number for each frame says nothing.
    pub has_other_frames: bool,
    /// How a set's frames would be taken instead, and the set's number among those that are.
    pub plan: fn(&[Moment], usize) -> Vec<Moment>,
}

/// All of them.
pub const PROPOSALS: [Proposal; 9] = [
    Proposal {
        what: "the same with another modulation frequency (4/3 of it)",
        is_of_places: true,
        has_other_frames: false,
        plan: |set, _| each(set, |m| Moment { frequency_hz: m.frequency_hz * 4.0 / 3.0, ..m }),
    },
    Proposal {
        what: "the same with the phase steps in reversed order",
        is_of_places: false,
        has_other_frames: false,
        plan: |set, _| each(set, |m| Moment { step_rad: -m.step_rad, ..m }),
    },
    Proposal {
        what: "the same without the camera's light",
        is_of_places: false,
        has_other_frames: false,
        plan: |set, _| each(set, |m| Moment { lit: false, ..m }),
    },
    Proposal {
        what: "the same with the lens covered",
        is_of_places: false,
        has_other_frames: false,
        plan: |set, _| each(set, |m| Moment { transmission: 0.0, ..m }),
    },
    Proposal {
        what: "the same through a neutral filter (a quarter of the light)",
        is_of_places: false,
        has_other_frames: false,
        plan: |set, _| each(set, |m| Moment { transmission: 0.25, ..m }),
    },
    Proposal {
        what: "the same at twice the velocity, or moving where it stood (1 m/s)",
        is_of_places: true,
        has_other_frames: false,
        plan: |set, _| {
            let faster = |velocity_m_s| if velocity_m_s == 0.0 { 1.0 } else { 2.0 * velocity_m_s };
            each(set, |m| Moment { velocity_m_s: faster(m.velocity_m_s), ..m })
        },
    },
    Proposal {
        what: "the same at a third of the distance",
        is_of_places: true,
        has_other_frames: false,
        plan: |set, _| {
            each(set, |m| Moment { position_m: m.position_m / 3.0, place_m: m.place_m / 3.0, ..m })
        },
    },
    Proposal {
        what: "the same at other phase offsets, over the whole turn",
        is_of_places: false,
        has_other_frames: false,
        plan: |set, number| {
            each(set, |m| Moment { offset_rad: TAU * (GOLDEN * (number + 1) as f64).fract(), ..m })
        },
    },
    Proposal {
        what: "the same with twice as many phase steps a set",
        is_of_places: false,
        has_other_frames: true,
        plan: finer,
    },
];

/// The golden section: that of a turn, again and again, goes evenly over the turn, and a single one to its other side.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

fn each(set: &[Moment], change: impl Fn(Moment) -> Moment) -> Vec<Moment> {
    set.iter().map(|moment| change(*moment)).collect()
}

/// Twice as many steps, evenly over the turn, of sets that begin where they did and take twice the time.
fn finer(set: &[Moment], _: usize) -> Vec<Moment> {
    let Some(first) = set.first() else { return Vec::new() };
    let frames = 2 * set.len();
    let of = |frame: usize| {
        let in_set_s = frame as f64 * first.frame_period_s;
        Moment {
            frame,
            frames,
            in_set_s,
            time_s: 2.0 * first.time_s + in_set_s,
            step_rad: TAU * frame as f64 / frames as f64,
            ..*first
        }
    };
    (0..frames).map(of).collect()
}

impl Proposal {
    /// `recorded`, taken as it is proposed; its samples are still those of `recorded`.
    pub fn of(&self, recorded: &Take) -> Take {
        let sets = recorded.moments.chunks(recorded.frames).enumerate();
        let plan: Vec<Vec<Moment>> = sets.map(|(number, set)| (self.plan)(set, number)).collect();
        Take { frames: plan.first().map_or(0, Vec::len), moments: plan.concat(), ..recorded.clone() }
    }
}

/// Of longer recordings every so many sets are looked at: what all say together grows with their number.
const MOST_FRAMES: usize = 120;

/// Every so many sets of `take`, which has so many `pixels`.
pub fn thinned(take: &Take, pixels: usize) -> Take {
    let every = take.moments.len().div_ceil(MOST_FRAMES).max(1);
    let of = |(set, moments): (usize, &[Moment])| {
        let first = set * take.frames * pixels;
        (moments.to_vec(), take.signal_dn[first..first + moments.len() * pixels].to_vec())
    };
    let (moments, signal_dn): (Vec<_>, Vec<_>) =
        take.moments.chunks(take.frames).enumerate().step_by(every).map(of).unzip();
    Take { moments: moments.concat(), signal_dn: signal_dn.concat(), ..take.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::diagnose::Data;
    use crate::frames::Geometry;

    fn recorded() -> (Data, usize) {
        let size = Geometry { width: 8, height: 6 };
        let recordings = taken(size, 3, &[], &["four-motion"]).unwrap();
        (Data::of(&recordings, Vec::new()).unwrap(), size.pixels())
    }

    #[test]
    fn twice_as_many_steps_go_once_round() {
        let (data, pixels) = recorded();
        let take = thinned(&data.takes[0], pixels);
        let finer =
            PROPOSALS.iter().map(|proposal| proposal.of(&take)).find(|plan| plan.frames == 8).unwrap();
        assert_eq!(finer.moments.len(), 2 * take.moments.len());
        for (moments, recorded) in finer.moments.chunks(8).zip(take.moments.chunks(4)) {
            for (frame, moment) in moments.iter().enumerate() {
                assert_eq!(
                    (moment.frame, moment.frames, moment.position_m),
                    (frame, 8, recorded[0].position_m)
                );
                assert!((moment.step_rad - TAU * frame as f64 / 8.0).abs() < 1e-12);
            }
            assert!((moments[7].time_s - moments[0].time_s - 7.0 * recorded[0].frame_period_s).abs() < 1e-9);
        }
        // Its sets do not overlap.
        assert!(finer.moments.windows(2).all(|pair| pair[1].time_s > pair[0].time_s));
    }

    #[test]
    fn sets_of_a_long_recording_are_thinned_with_their_samples() {
        let (data, pixels) = recorded();
        let take = &data.takes[0];
        assert!(take.moments.len() > 3 * MOST_FRAMES);
        let few = thinned(take, pixels);
        assert!(few.moments.len() <= MOST_FRAMES && few.moments.len() > MOST_FRAMES / 2);
        assert_eq!(few.signal_dn.len(), few.moments.len() * pixels);
        for (set, frames) in few.moments.chunks(4).zip(few.signal_dn.chunks(4 * pixels)) {
            let first = take.moments.iter().position(|moment| moment == &set[0]).unwrap();
            assert_eq!(frames, &take.signal_dn[first * pixels..(first + 4) * pixels]);
        }
    }
}
