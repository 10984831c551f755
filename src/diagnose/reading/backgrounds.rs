//! What stands still at a distance that nobody knows.

use super::data::Take;
use super::frequencies::{Frequency, usual};

/// Has pixels that see the background, all but the `target`, count at one modulation frequency alone: that of most frames.
///
/// At one frequency a pixel's own phase says all that its distance could. At two frequencies the distance, which no recording states, says two things. Without the
/// camera's light there is no phase.
pub fn at_one_frequency(takes: &mut [Take], target: &[bool]) {
    let Some(usual) = usual(takes) else { return };
    let is_other = |take: &Take| Frequency::of(take).is_some_and(|frequency| frequency != usual);
    for take in takes.iter_mut().filter(|take| is_other(take)) {
        for frame in take.signal_dn.chunks_mut(target.len().max(1)) {
            let beyond = frame.iter_mut().zip(target).filter(|(_, is_target)| !**is_target);
            beyond.for_each(|(signal, _)| *signal = f32::NAN);
        }
    }
}

/// The modulation frequency at which the background counts, Hz; nothing where there is one frequency alone.
pub fn counts_at_hz(takes: &[Take]) -> Option<f64> {
    usual(takes).map(|frequency| frequency.hz)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::diagnose::Data;
    use crate::frames::Geometry;

    /// Of three recordings the one at a frequency of its own loses its background; where all are at one, none does.
    #[test]
    fn a_background_counts_at_one_frequency() {
        let size = Geometry { width: 8, height: 6 };
        let mut recordings = taken(size, 2, &[], &["four-rail", "wdft-rail", "four-sweep"]).unwrap();
        let counted = |recordings: &[crate::recording::Recording]| {
            let data = Data::of(recordings, Vec::new()).unwrap();
            let seen = |take: &Take, is_target: bool| {
                let signals =
                    take.signal_dn.chunks(data.target.len()).flat_map(|frame| frame.iter().zip(&data.target));
                signals.filter(|(signal, target)| **target == is_target && !signal.is_nan()).count()
            };
            data.takes.iter().map(|take| [seen(take, true), seen(take, false)]).collect::<Vec<_>>()
        };
        let all = counted(&recordings);
        assert!(all.iter().flatten().all(|count| *count > 0), "{all:?}");
        recordings[1].frequency_hz *= 4.0 / 3.0;
        let some = counted(&recordings);
        assert_eq!((some[0], some[1], some[2]), (all[0], [all[1][0], 0], all[2]));
        let at_hz = |recordings: &[crate::recording::Recording]| {
            counts_at_hz(&Data::of(recordings, Vec::new()).unwrap().takes)
        };
        assert_eq!(at_hz(&recordings), Some(recordings[0].frequency_hz));
        // Written with other digits, it is the same frequency.
        recordings[1].frequency_hz = recordings[0].frequency_hz + 0.1;
        assert_eq!((counted(&recordings), at_hz(&recordings)), (all, None));
    }
}
