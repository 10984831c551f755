//! Which vectors are evaluated: all of a small word, or weak ones all, others drawn evenly in each octave, and corners.
//!
//! The work is cut into blocks whose contents depend on the words alone, so that any distribution of blocks gives the same sums.

use super::configuration::Configuration;
use super::shard::Shard;
use std::collections::BTreeSet;

/// How the vectors are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coverage {
    /// All vectors of the words but (0, 0).
    Exhaustive,
    /// All vectors shorter than 2^6, this many drawn in each octave above, and corners.
    Stratified {
        /// Vectors an octave.
        samples: u64,
    },
}

/// Exhaustive up to so many bits of both words together.
const EXHAUSTIVE_BITS: u32 = 24;
/// Octaves below this one are visited whole.
const WEAK_OCTAVE: u32 = 6;
/// Vectors a block of drawn ones.
const BLOCK_SAMPLES: u64 = 4096;
/// Vectors a block of visited ones, about.
const BLOCK_VECTORS: u64 = 1 << 15;

/// The vectors of two words: configurations with the same words and metric share one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Plan {
    coverage: Coverage,
    metric: i64,
    x_bits: u32,
    y_bits: u32,
    blocks: Vec<Block>,
}

/// A part of a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Block {
    /// Quadrant rows |x| from `first` up to (excluding) `end`, |y| up to `largest_y`, of length squared below `below`.
    Rows { first: i64, end: i64, largest_y: i64, below: i64 },
    /// Draws number `first` up to (excluding) `end` in an octave.
    Drawn { octave: u32, first: u64, end: u64 },
    /// Corners.
    Corners(Vec<(i64, i64)>),
}

/// A well mixed 64-bit number (SplitMix64: Steele, Lea, Flood 2014).
fn mixed(number: u64) -> u64 {
    let z = number.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(0x9E37_79B9_7F4A_7C15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// The octave of a vector of this length squared (> 0): floor(log2 length).
#[inline]
pub(super) const fn octave_of(length_squared: i64) -> usize {
    ((63 - length_squared.leading_zeros()) / 2) as usize
}

impl Coverage {
    /// As a journal writes it.
    pub fn text(self) -> String {
        match self {
            Self::Exhaustive => "exhaustive".to_owned(),
            Self::Stratified { samples } => format!("samples={samples}"),
        }
    }

    /// Reads that.
    pub fn parse(text: &str) -> Option<Self> {
        match text.strip_prefix("samples=") {
            Some(samples) => samples.parse().ok().map(|samples| Self::Stratified { samples }),
            None => (text == "exhaustive").then_some(Self::Exhaustive),
        }
    }
}

impl Plan {
    /// The vectors of `configuration`'s words: all where both words together have at most 24 bits or `exhaustive` says so,
    /// otherwise `samples` an octave.
    pub fn new(configuration: &Configuration, samples: u64, exhaustive: bool) -> Self {
        let &Configuration { metric, x_bits, y_bits, .. } = configuration;
        let coverage = if exhaustive || x_bits + y_bits <= EXHAUSTIVE_BITS {
            Coverage::Exhaustive
        } else {
            Coverage::Stratified { samples }
        };
        let plan = Self { coverage, metric, x_bits, y_bits, blocks: Vec::new() };
        Self { blocks: plan.cut(), ..plan }
    }

    /// Whether it is that of `configuration` too.
    pub fn serves(&self, configuration: &Configuration) -> bool {
        (self.metric, self.x_bits, self.y_bits)
            == (configuration.metric, configuration.x_bits, configuration.y_bits)
    }

    /// Vectors of all blocks of `shard`, about: what a progress bar needs.
    pub fn size(&self, shard: Shard) -> u64 {
        let size = |block: &Block| match block {
            Block::Rows { first, end, largest_y, .. } => (4 * (end - first) * (largest_y + 1)) as u64,
            Block::Drawn { first, end, .. } => end - first,
            Block::Corners(corners) => corners.len() as u64,
        };
        self.blocks_of(shard).map(size).sum()
    }

    /// The blocks of `shard`.
    pub(super) fn blocks_of(&self, shard: Shard) -> impl Iterator<Item = &Block> {
        (0..).zip(&self.blocks).filter(move |(number, _)| shard.has(*number)).map(|(_, block)| block)
    }

    /// How its vectors are chosen.
    pub fn coverage(&self) -> Coverage {
        self.coverage
    }

    /// Octaves that its vectors can have.
    pub fn octaves(&self) -> usize {
        let (x, y) = self.largest();
        octave_of(x * x + self.metric * (y * y)) + 1
    }

    /// The largest magnitudes: those of the words' least values.
    fn largest(&self) -> (i64, i64) {
        (1 << (self.x_bits - 1), 1 << (self.y_bits - 1))
    }

    /// Whether the words hold the vector, and it is one.
    #[inline]
    pub(super) fn holds(&self, x: i64, y: i64) -> bool {
        let (x_end, y_end) = self.largest();
        (-x_end..x_end).contains(&x) && (-y_end..y_end).contains(&y) && (x, y) != (0, 0)
    }

    /// All blocks, in a fixed order.
    fn cut(&self) -> Vec<Block> {
        let (x_end, y_end) = self.largest();
        match self.coverage {
            Coverage::Exhaustive => rows(x_end, y_end, i64::MAX),
            Coverage::Stratified { samples } => {
                let weak = 1 << WEAK_OCTAVE;
                let mut blocks = rows(x_end.min(weak), y_end.min(weak), weak * weak);
                for octave in WEAK_OCTAVE..self.octaves() as u32 {
                    blocks.extend((0..samples).step_by(BLOCK_SAMPLES as usize).map(|first| Block::Drawn {
                        octave,
                        first,
                        end: (first + BLOCK_SAMPLES).min(samples),
                    }));
                }
                let corners: Vec<_> = self.corners().into_iter().collect();
                blocks
                    .extend(corners.chunks(BLOCK_SAMPLES as usize).map(|part| Block::Corners(part.to_vec())));
                blocks
            }
        }
    }

    /// Draw number `number` of `octave`: even over the octave's vectors; `None` where the words hold hardly any of them.
    pub(super) fn draw(&self, octave: u32, number: u64) -> Option<(i64, i64)> {
        let (x_end, y_end) = self.largest();
        // The smallest box around the octave within the words.
        let side = 1i64 << (octave + 1);
        let (x_end, y_end) = (x_end.min(side), y_end.min(side));
        let seed = mixed(mixed(number).wrapping_add(u64::from(octave)));
        (0..64).map(|attempt| mixed(seed.wrapping_add(attempt))).find_map(|random| {
            let (x, y) = (
                (random >> 32) as i64 % (2 * x_end) - x_end,
                (random & 0xFFFF_FFFF) as i64 % (2 * y_end) - y_end,
            );
            let squared = x * x + self.metric * (y * y);
            (squared > 0 && octave_of(squared) == octave as usize).then_some((x, y))
        })
    }

    /// Powers of two and their neighbours against one another, the words' ends, axes, and diagonals with their neighbours.
    fn corners(&self) -> BTreeSet<(i64, i64)> {
        let values = |bits: u32| {
            let end = 1i64 << (bits - 1);
            let powers = (0..bits).flat_map(|bit| [(1i64 << bit) - 1, 1 << bit, (1 << bit) + 1]);
            powers.chain([end]).flat_map(|value| [value, -value]).collect::<BTreeSet<i64>>()
        };
        let (xs, ys) = (values(self.x_bits), values(self.y_bits));
        let mut corners: BTreeSet<(i64, i64)> =
            xs.iter().flat_map(|&x| ys.iter().map(move |&y| (x, y))).collect();
        let longest = self.x_bits.max(self.y_bits) - 1;
        for octave in 0..longest {
            for number in 0..64 {
                let a = (1i64 << octave) + (mixed(number) >> (64 - octave).min(63)) as i64;
                for (x, y) in [(a, 0), (0, a), (a, a), (a, a - 1), (a - 1, a), (a, 1), (1, a)] {
                    corners.extend([(x, y), (-x, y), (x, -y), (-x, -y)]);
                }
            }
        }
        corners.retain(|&(x, y)| self.holds(x, y));
        corners
    }
}

/// Blocks of whole rows of the quadrant |x| ≤ `x_end`, |y| ≤ `largest_y`.
fn rows(x_end: i64, largest_y: i64, below: i64) -> Vec<Block> {
    let rows = (BLOCK_VECTORS as i64 / (4 * (largest_y + 1))).max(1);
    (0..=x_end)
        .step_by(rows as usize)
        .map(|first| Block::Rows { first, end: (first + rows).min(x_end + 1), largest_y, below })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::configuration::tests::word;
    use super::*;

    #[test]
    fn octaves_are_those_of_the_length() {
        for (squared, octave) in [(1, 0), (3, 0), (4, 1), (15, 1), (16, 2), (1 << 60, 30)] {
            assert_eq!(octave_of(squared), octave);
        }
        let octaves =
            |bits, metric| Plan::new(&Configuration { metric, ..word(bits, 8) }, 1, false).octaves();
        // |(-8, -8)| = 11.3; with sqrt(3): 16.
        assert_eq!((octaves(4, 1), octaves(4, 3)), (4, 5));
    }

    #[test]
    fn draws_lie_in_their_octave_and_in_the_words_and_cover_them_evenly() {
        let plan = Plan::new(&word(16, 16), 1000, false);
        for octave in WEAK_OCTAVE..plan.octaves() as u32 {
            let draws: Vec<_> = (0..4000).filter_map(|number| plan.draw(octave, number)).collect();
            assert!(draws.len() > 3990, "octave {octave}: {}", draws.len());
            assert!(draws.iter().all(|&(x, y)| plan.holds(x, y)));
            for signs in [(true, true), (true, false), (false, true), (false, false)] {
                let share = draws.iter().filter(|&&(x, y)| (x < 0, y < 0) == signs).count();
                assert!((850..1150).contains(&share), "octave {octave} {signs:?}: {share}");
            }
        }
    }

    #[test]
    fn corners_hold_axes_diagonals_and_the_words_ends() {
        let corners = Plan::new(&word(16, 16), 1, false).corners();
        for vector in [(-32768, -32768), (-32768, 32767), (32767, 0), (0, -32768), (-5, 0), (16383, -16385)] {
            assert!(corners.contains(&vector), "{vector:?}");
        }
        assert!(corners.iter().filter(|(x, y)| x == y).count() > 1000, "{}", corners.len());
        assert!(!corners.contains(&(0, 0)) && corners.iter().all(|&(x, y)| x < 32768 && y < 32768));
    }
}
