//! What is kept of a pixel while a set's frames arrive: its three sums, or fewer bits from which they follow.
//!
//! Frames whose weights are multiples of one another, in all three sums, need only be told apart as a group: of the WDFT's five frames
//! the first and the fourth have (2, 0, 1) and (4, 0, 2), the second and the fifth (-2, 2, 2) and (-1, 1, 1), the third
//! (-3, -3, 3). So I1 + 2 I4, 2 I2 + I5 and I3 hold all that the three sums hold.

use super::{Scheme, Word};

/// A sum that is kept.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StoredSum {
    /// Its noun.
    pub name: &'static str,
    /// The weight of every phase step.
    pub weights: Vec<i64>,
    /// Its word, by the bound of [`super::Derived::in_phase`].
    pub word: Word,
}

/// The sums that are kept, and what the others are of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Storage {
    /// What is kept.
    pub sums: [StoredSum; 3],
    /// In-phase, quadrature and offset sum, each as a combination of what is kept.
    pub combination: [[i64; 3]; 3],
}

impl Storage {
    /// What to keep of `scheme`; `largest` is frames a step × full scale.
    pub(super) fn new(scheme: &Scheme, largest: i64) -> Self {
        let stored = |name, weights: Vec<i64>| {
            let total = |sign: i64| weights.iter().filter(|&&w| w * sign > 0).sum::<i64>() * largest;
            StoredSum { name, word: Word::holding(total(-1), total(1)), weights }
        };
        let plain = Self {
            sums: [
                stored("in_phase", scheme.in_phase.to_vec()),
                stored("quadrature", scheme.quadrature.to_vec()),
                stored("offset", scheme.offset.to_vec()),
            ],
            combination: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        };
        let Some(groups) = groups(scheme) else { return plain };
        let [a, b, c] = groups.map(|group| (group.direction, group.weights));
        let combination = [0, 1, 2].map(|sum| [a.0[sum], b.0[sum], c.0[sum]]);
        let grouped = Self {
            sums: [stored("group_a", a.1), stored("group_b", b.1), stored("group_c", c.1)],
            combination,
        };
        if grouped.bits() < plain.bits() { grouped } else { plain }
    }

    /// Bits of all three sums.
    pub fn bits(&self) -> u32 {
        self.sums.iter().map(|sum| sum.word.bits).sum()
    }

    /// Whether the sums are kept as they are.
    pub fn is_plain(&self) -> bool {
        self.combination == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    }
}

/// Frames of one direction of the weights.
struct Group {
    /// What a unit of the group's sum adds to the in-phase, quadrature and offset sum.
    direction: [i64; 3],
    /// The multiple of it that every phase step has; 0 for steps of other groups.
    weights: Vec<i64>,
}

/// The three groups of the scheme's frames, where they are three.
fn groups(scheme: &Scheme) -> Option<[Group; 3]> {
    let mut groups: Vec<Group> = Vec::new();
    for step in 0..scheme.steps() {
        let weights = [scheme.in_phase[step], scheme.quadrature[step], scheme.offset[step]];
        let times = weights.into_iter().fold(0, greatest_common_divisor);
        if times == 0 {
            continue;
        }
        let direction = weights.map(|weight| weight / times);
        let place = groups.iter().position(|group| group.direction == direction).unwrap_or_else(|| {
            groups.push(Group { direction, weights: vec![0; scheme.steps()] });
            groups.len() - 1
        });
        groups[place].weights[step] = times;
    }
    for group in &mut groups {
        let common = group.weights.iter().copied().fold(0, greatest_common_divisor);
        group.weights.iter_mut().for_each(|weight| *weight /= common);
        group.direction = group.direction.map(|weight| weight * common);
    }
    groups.try_into().ok()
}

fn greatest_common_divisor(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { greatest_common_divisor(b, a % b) }
}

/// Bits of a block RAM with its most usual size, in the words that it can have.
const BLOCK_BITS: u32 = 16_384;

/// Widths of the columns into which a memory of `words` words of `bits` bits is cut so that it takes the fewest block RAMs of
/// 16 kbit (18 kbit where words of 9 and 18 bits are taken), widest first.
pub(super) fn columns(bits: u32, words: usize) -> Vec<u32> {
    // A block holds 1024 words of 18 bits, 2048 of 9, and so on: the parity bits serve only whole bytes.
    let blocks = |width: u32| {
        let data = match width {
            18 => 16,
            9 => 8,
            other => other,
        };
        words.div_ceil((BLOCK_BITS / data) as usize)
    };
    const WIDTHS: [u32; 5] = [18, 9, 4, 2, 1];
    // The fewest blocks for so many bits, and the column to begin with.
    let mut best: Vec<(usize, u32)> = vec![(0, 0)];
    for wanted in 1..=bits as usize {
        let choices = WIDTHS
            .iter()
            .map(|&width| (blocks(width) + best[wanted.saturating_sub(width as usize)].0, width));
        best.extend(choices.min_by_key(|&(blocks, width)| (blocks, u32::MAX - width)));
    }
    let mut columns = Vec::new();
    let mut left = bits;
    while left > 0 {
        let width = best[left as usize].1.min(left);
        columns.push(width);
        left -= width;
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::scheme;

    /// By hand, from the table of weights.
    #[test]
    fn the_wdft_needs_three_short_sums() {
        let storage = Storage::new(scheme("wdft").unwrap(), 4095);
        let weights: Vec<&[i64]> = storage.sums.iter().map(|sum| sum.weights.as_slice()).collect();
        assert_eq!(weights, [&[1, 0, 0, 2, 0][..], &[0, 2, 0, 0, 1], &[0, 0, 1, 0, 0]]);
        assert_eq!(storage.combination, [[2, -1, -3], [0, 1, -3], [1, 1, 3]]);
        assert_eq!(storage.bits(), 14 + 14 + 12);
        let four = Storage::new(scheme("four_frame").unwrap(), 4095);
        assert!(four.is_plain());
    }

    /// 19200 words: 18 bits take 19 blocks, 9 take 10, 4 take 5, 2 take 3, 1 takes 2.
    #[test]
    fn columns_take_the_fewest_blocks() {
        assert_eq!(columns(41, 19_200), [18, 18, 4, 1]);
        // 19 + 19 + 10 + 5; three bits as two columns would take 3 + 2 as well.
        assert_eq!(columns(48, 19_200), [18, 18, 9, 3]);
        assert_eq!(columns(18, 19_200), [18]);
        assert_eq!(columns(1, 8), [1]);
        for bits in 1..80 {
            assert_eq!(columns(bits, 19_200).iter().sum::<u32>(), bits);
        }
    }
}
