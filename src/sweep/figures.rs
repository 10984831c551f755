//! What a person wants to know of a tally.

use super::exact_angle::UNIT_BITS;
use super::tally::{OctaveTally, SQUARE_UNIT_BITS, Tally, Worst};

/// Errors of one octave, or of all, in turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Figures {
    /// Vectors of which mean, RMS and shares are.
    pub vectors: u64,
    /// Corners beside them; the maximum counts them too.
    pub corners: u64,
    /// The largest error's size, turns.
    pub max_turns: f64,
    /// Root mean square, turns.
    pub rms_turns: f64,
    /// Mean: the bias, turns.
    pub mean_turns: f64,
    /// Mean with the octant's sign, turns: a bias towards (positive) the octants' diagonals, which a fold hides from the mean.
    pub octant_mean_turns: f64,
    /// The worst vector, if there is any.
    pub worst: Option<Worst>,
    /// Share of vectors less than one phase code off.
    pub faithful: f64,
    /// Share of vectors at most half a phase code off.
    pub correctly_rounded: f64,
    /// Whether every vector, corners included, is less than one phase code off.
    pub all_faithful: bool,
}

/// Figures of an octave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Vectors of length 2^octave up to (excluding) 2^(octave + 1); `None`: all octaves together.
    pub octave: Option<u32>,
    /// Their errors.
    pub figures: Figures,
}

fn turns(units: f64) -> f64 {
    units / f64::from(UNIT_BITS).exp2()
}

impl Figures {
    fn of(even: &OctaveTally, corners: &OctaveTally) -> Self {
        let mut both = *even;
        both.merge(corners);
        let share = |part: f64| if even.vectors == 0 { 0.0 } else { part / even.vectors as f64 };
        Self {
            vectors: even.vectors,
            corners: corners.vectors,
            max_turns: both.worst.map_or(0.0, |worst| turns(worst.error.unsigned_abs() as f64)),
            rms_turns: share(even.squares as f64).sqrt() / f64::from(SQUARE_UNIT_BITS).exp2(),
            mean_turns: turns(share(even.sum as f64)),
            octant_mean_turns: turns(share(even.octant_sum as f64)),
            worst: both.worst,
            faithful: share(even.faithful as f64),
            correctly_rounded: share(even.correctly_rounded as f64),
            all_faithful: both.faithful == both.vectors,
        }
    }

    /// All octaves together, then each that holds a vector.
    ///
    /// Where vectors were drawn, every drawn octave has the same weight in the first row; where all were visited, every vector.
    pub fn rows(tally: &Tally) -> Vec<Row> {
        let (even, corners) = tally.overall();
        let octaves = (0..).zip(tally.even.iter().zip(&tally.corners));
        let octaves = octaves
            .filter(|(_, (even, corners))| even.vectors + corners.vectors > 0)
            .map(|(octave, (even, corners))| Row { octave: Some(octave), figures: Self::of(even, corners) });
        std::iter::once(Row { octave: None, figures: Self::of(&even, &corners) }).chain(octaves).collect()
    }
}
