//! Parts of a coordinate's columns: one way of being off alone may say it by fewer numbers than all.

use super::coordinates::{MODES, OF_OFFSET, OF_RANGE};
use super::line_ways::LINE_WAYS;
use super::ranges::Ranges;
use super::velocities::OF_RUN;

/// Parts of the columns of a coordinate, by their numbers.
type Parts = fn(&Ranges, usize) -> Vec<Vec<usize>>;

/// Parts of those coordinates that have any.
const PARTS: [(&str, Parts); 9] = [
    ("phase", |ranges, size| {
        // Errors of the phase, of the offset, of the waveform; and what goes with the phase offset that was set, or with the commanded phase.
        let way = |way: usize| (0..OF_RANGE).filter(|column| column % 6 / 2 == way).collect();
        let set = modes(ranges, size - OF_RANGE).into_iter().flat_map(|part| {
            let mut of_offset: Vec<usize> = part.into_iter().map(|n| OF_RANGE + n).collect();
            let of_frame = of_offset.split_off(OF_OFFSET);
            [of_offset, of_frame]
        });
        (0..3).map(way).chain(set).collect()
    }),
    ("position_m", modes),
    ("velocity_m_s", |ranges, size| {
        // A place that is not where it is said to be is one number.
        let of_place = (OF_RUN..size).map(|column| vec![column]);
        modes(ranges, OF_RUN).into_iter().chain(of_place).collect()
    }),
    ("frame", |ranges, size| {
        // Long sets have many frames, and few sets.
        let is_short = |column: &usize| {
            let number = column % ranges.frame_numbers;
            ranges
                .frames
                .iter()
                .any(|(frames, first)| (*first..first + frames).contains(&number) && *frames <= SHORT)
        };
        let mut parts = modes(ranges, size);
        let some = (0..size).filter(is_short).count();
        if some > 0 && some < size {
            let short = |part: &Vec<usize>| part.iter().copied().filter(is_short).collect();
            parts.extend(parts.iter().map(short).collect::<Vec<_>>());
        }
        // A pulse into the read-out is the offset of one frame, in sets of whatever length.
        let longest = ranges.frames.iter().map(|(frames, _)| *frames).max();
        parts.extend((0..longest.unwrap_or(0).min(SHORT)).map(|frame| {
            let of_it = ranges.frames.iter().filter(|(frames, _)| frame < *frames);
            let mut numbers: Vec<usize> = of_it.map(|(_, first)| first + frame).collect();
            // Recordings of as many frames share them.
            numbers.sort_unstable();
            numbers.dedup();
            numbers
        }));
        parts
    }),
    ("time_s", modes),
    ("row", of_lines),
    ("column", of_lines),
    ("amplitude", modes),
    ("set", modes),
];

/// Frames of a short set.
const SHORT: usize = 8;

/// Those of each of [`MODES`].
fn modes(_: &Ranges, size: usize) -> Vec<Vec<usize>> {
    let of = size / MODES.len();
    (0..MODES.len()).map(|mode| (mode * of..(mode + 1) * of).collect()).collect()
}

/// Those of each of [`MODES`], what is smooth and what alternates.
fn of_lines(ranges: &Ranges, size: usize) -> Vec<Vec<usize>> {
    let alternates = |column: &usize| column % LINE_WAYS.len() == LINE_WAYS.len() - 1;
    let of = |part: Vec<usize>| {
        let (odd, smooth): (Vec<usize>, Vec<usize>) = part.into_iter().partition(alternates);
        [smooth, odd]
    };
    modes(ranges, size).into_iter().flat_map(of).collect()
}

/// Parts of the columns of `coordinate`, which has so many.
pub fn parts(coordinate: &str, ranges: &Ranges, size: usize) -> Vec<Vec<usize>> {
    PARTS.iter().find(|(name, _)| *name == coordinate).map_or_else(Vec::new, |(_, of)| of(ranges, size))
}

#[cfg(test)]
mod tests {
    use super::super::coordinates::COORDINATES;
    use super::*;
    use crate::frames::Geometry;

    fn ranges(frames: Vec<(usize, usize)>) -> Ranges {
        Ranges {
            geometry: Geometry { width: 2, height: 2 },
            is_still: false,
            tells_constant: vec![true; 4],
            position_m: (0.0, 1.0),
            speed_m_s: 1.0,
            velocity_m_s: (-1.0, 1.0),
            rows: vec![[0.0; LINE_WAYS.len()]; 4],
            columns: vec![[0.0; LINE_WAYS.len()]; 4],
            signals_dn: vec![1.0],
            duration_s: vec![1.0; frames.len()],
            has_places: true,
            has_sets: true,
            has_offsets: true,
            frame_numbers: frames.iter().map(|(frames, first)| first + frames).max().unwrap_or(0),
            frames,
            ln_amplitude: (0.0, 1.0),
            full_scale_dn: 4096.0,
        }
    }

    #[test]
    fn parts_are_columns_of_one_way_each() {
        let ranges = ranges(vec![(4, 0), (64, 4)]);
        let phase = COORDINATES.iter().find(|coordinate| coordinate.name == "phase").unwrap();
        let of_phase = (phase.columns)(&ranges);
        for (name, size) in [("phase", of_phase), ("time_s", 64), ("set", 8)] {
            let mut all = parts(name, &ranges, size).concat();
            all.sort_unstable();
            assert_eq!(all, (0..size).collect::<Vec<_>>(), "{name}");
        }
        let phase = parts("phase", &ranges, of_phase);
        assert_eq!((&phase[1][..4], phase[3][0]), (&[2, 3, 8, 9][..], 36));
        // Offset, gain, phase and contrast have each a cosine and a sine of one to four cycles of the offset, and one or two of the commanded phase.
        assert_eq!(phase[3..].iter().map(Vec::len).collect::<Vec<_>>(), [8, 4].repeat(4));
        assert_eq!((phase[4][0], phase[5][0]), (44, 48));
        // A place that is off is a part by itself, in either way.
        let of_velocity = parts("velocity_m_s", &ranges, OF_RUN + 2);
        assert_eq!(of_velocity[3..], [(15..20).collect(), vec![20], vec![21]]);
        assert!(parts("neighbours", &ranges, 4).is_empty());
    }

    #[test]
    fn frames_of_short_sets_are_parts_besides() {
        let parts = parts("frame", &ranges(vec![(4, 0), (64, 4)]), 4 * 68);
        // All and the short ones in four ways, and eight frames alone.
        assert_eq!(parts.len(), 8 + 8);
        assert_eq!(parts[4], [0, 1, 2, 3]);
        assert_eq!(parts[6], [136, 137, 138, 139]);
        assert_eq!(parts[9], [1, 5]);
        let alike = super::parts("frame", &ranges(vec![(4, 0), (5, 4), (5, 4)]), 4 * 9);
        assert_eq!(alike.len(), 4 + 5);
        assert_eq!((&alike[4][..], &alike[8][..]), (&[0, 4][..], &[8][..]));
    }
}
