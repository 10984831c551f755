//! The loop: every vector of a plan through the unit and through exact arithmetic.

use super::exact_angle::{ExactAngle, UNIT_BITS};
use super::phase_of::PhaseOf;
use super::plan::{Block, Plan, octave_of};
use super::shard::Shard;
use super::tally::{OctaveTally, Tally};
use rayon::prelude::*;

/// The errors of `unit` over the blocks of `plan` that belong to `shard`, on all cores; `advance` hears of vectors that are done.
pub fn evaluate<U: PhaseOf>(
    unit: &U,
    exact: &ExactAngle,
    plan: &Plan,
    shard: Shard,
    advance: &(dyn Fn(u64) + Sync),
) -> Tally {
    let blocks: Vec<&Block> = plan.blocks_of(shard).collect();
    let loop_over = Loop { unit, exact, plan, phase_bits: unit.phase_bits() };
    blocks
        .par_iter()
        .map(|block| {
            let tally = loop_over.block(block);
            let (even, corners) = tally.overall();
            advance(even.vectors + corners.vectors);
            tally
        })
        .reduce(|| Tally::new(plan.octaves()), |one, other| one.merged(&other))
}

struct Loop<'a, U> {
    unit: &'a U,
    exact: &'a ExactAngle,
    plan: &'a Plan,
    phase_bits: u32,
}

impl<U: PhaseOf> Loop<'_, U> {
    fn block(&self, block: &Block) -> Tally {
        let mut tally = Tally::new(self.plan.octaves());
        match *block {
            Block::Rows { first, end, largest_y, below } => {
                for x in first..end {
                    self.row(x, largest_y, below, &mut tally.even);
                }
            }
            Block::Drawn { octave, first, end } => {
                for (x, y) in (first..end).filter_map(|number| self.plan.draw(octave, number)) {
                    let (quadrant, upper) = self.exact.quadrant(x, y);
                    self.vector((x, y), quadrant, upper, &mut tally.even[octave as usize]);
                }
            }
            Block::Corners(ref corners) => {
                for &(x, y) in corners {
                    let octave = octave_of(self.exact.length_squared(x, y));
                    let (quadrant, upper) = self.exact.quadrant(x, y);
                    self.vector((x, y), quadrant, upper, &mut tally.corners[octave]);
                }
            }
        }
        tally
    }

    /// All vectors (±x, ±y) of the words with y from 0 to `largest_y`: one exact angle serves the four.
    fn row(&self, x: i64, largest_y: i64, below: i64, octaves: &mut [OctaveTally]) {
        for y in i64::from(x == 0)..=largest_y {
            let squared = self.exact.length_squared(x, y);
            if squared >= below {
                break;
            }
            let octave = &mut octaves[octave_of(squared)];
            let (quadrant, upper) = self.exact.quadrant(x, y);
            for (x, y, double) in
                [(x, y, false), (-x, y, x == 0), (x, -y, y == 0), (-x, -y, x == 0 || y == 0)]
            {
                if !double && self.plan.holds(x, y) {
                    self.vector((x, y), quadrant, upper, octave);
                }
            }
        }
    }

    #[inline]
    fn vector(&self, (x, y): (i64, i64), quadrant: i64, upper: bool, octave: &mut OctaveTally) {
        let code = self.unit.phase(x, y);
        let error = ExactAngle::error(code, self.phase_bits, ExactAngle::unfold(x, y, quadrant));
        let lsb = 1i64 << (UNIT_BITS - self.phase_bits);
        let below =
            [lsb, lsb / 2].map(|limit| self.exact.is_below(limit, error, code, self.phase_bits, (x, y)));
        octave.add((x, y), error, upper ^ (x < 0) ^ (y < 0), below);
    }
}
