//! How exact an angle core's phase is, by the integer model: the figures beside its area.

use crate::problem::Result;
use crate::spec::{AngleCore, AngleUnit};
use crate::sweep::{Configuration, ExactAngle, Figures, Plan, Row, Shard, evaluate};
use crate::synthesis::{Accuracy, AccuracyMethod, OctaveMean};

/// Vectors drawn in each octave from 64 codes up; weaker ones are visited all, and so are corners.
const SAMPLES: u64 = 1 << 17;

/// Octaves that count as strong: the highest ones of the words.
const STRONG_OCTAVES: u32 = 4;

/// The octave of 16 codes; vectors below are weak.
const WEAK_OCTAVE: u32 = 4;

/// The errors of `core`.
pub(super) fn accuracy(core: &AngleCore) -> Result<Accuracy> {
    let unit: &AngleUnit = &core.unit;
    let configuration = Configuration::of(unit);
    let plan = Plan::new(&configuration, SAMPLES, false);
    let tally = evaluate(unit, &ExactAngle::new(unit.metric), &plan, Shard::WHOLE, &|_| ());
    Ok(from_rows(&Figures::rows(&tally), unit.x_bits.max(unit.y_bits)))
}

/// The figures of `rows`, of a core with words of `bits`.
fn from_rows(rows: &[Row], bits: u32) -> Accuracy {
    let lsb = |turns: f64| 16_f64.exp2() * turns;
    let largest = |of: &dyn Fn(Option<u32>) -> bool| {
        let turns = rows.iter().filter(|row| of(row.octave)).map(|row| row.figures.max_turns);
        lsb(turns.fold(0.0, f64::max))
    };
    let whole = rows.iter().find(|row| row.octave.is_none()).map(|row| row.figures);
    let strong = bits - STRONG_OCTAVES.min(bits)..bits;
    Accuracy {
        method: AccuracyMethod::Model,
        vectors: whole.map_or(0, |figures| figures.vectors + figures.corners),
        largest: rounded(largest(&|_| true)),
        rms: rounded(whole.map_or(0.0, |figures| lsb(figures.rms_turns))),
        largest_strong: rounded(largest(&|octave| octave.is_some_and(|octave| strong.contains(&octave)))),
        largest_weak: rounded(largest(&|octave| octave.is_some_and(|octave| octave < WEAK_OCTAVE))),
        means: rows
            .iter()
            .filter_map(|row| {
                // Of corners alone there is no mean.
                let octave = row.octave.filter(|_| row.figures.vectors > 0)?;
                Some(OctaveMean { octave, mean: rounded(lsb(row.figures.mean_turns)) })
            })
            .collect(),
    }
}

/// As many digits as the file needs.
fn rounded(lsb: f64) -> f64 {
    (1e5 * lsb).round() / 1e5
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(octave: Option<u32>, max_lsb: f64, mean_lsb: f64, vectors: u64) -> Row {
        let lsb = (-16_f64).exp2();
        let figures = Figures {
            vectors,
            corners: 1,
            max_turns: max_lsb * lsb,
            rms_turns: 0.5 * lsb,
            mean_turns: mean_lsb * lsb,
            octant_mean_turns: 0.0,
            worst: None,
            faithful: 1.0,
            correctly_rounded: 1.0,
            all_faithful: true,
        };
        Row { octave, figures }
    }

    #[test]
    fn octaves_are_strong_weak_or_between() {
        let rows = [
            row(None, 9.0, 0.0, 40),
            row(Some(3), 4.0, 0.25, 10),
            row(Some(4), 9.0, -0.5, 10),
            row(Some(11), 8.0, 0.0, 10),
            row(Some(12), 2.0, 0.0, 10),
            row(Some(15), 3.0, 0.0, 0),
        ];
        let accuracy = from_rows(&rows, 16);
        assert_eq!((accuracy.largest, accuracy.rms, accuracy.vectors), (9.0, 0.5, 41));
        assert_eq!((accuracy.largest_strong, accuracy.largest_weak), (3.0, 4.0));
        assert_eq!(accuracy.means.len(), 4);
        assert_eq!(accuracy.largest_mean_from(16), Some(0.5));
    }
}
