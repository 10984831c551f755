//! A register's word: how many bits, signed or not, and what it can hold.

use std::fmt;

/// A two's-complement (signed) or unsigned register of 1 to 63 bits, held in an `i64`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Word {
    /// Width in bits, 1 to 63.
    pub bits: u32,
    /// Two's complement where true.
    pub signed: bool,
}

impl Word {
    /// An unsigned register of `bits` bits.
    pub const fn unsigned(bits: u32) -> Self {
        Self { bits, signed: false }
    }

    /// A two's-complement register of `bits` bits, sign included.
    pub const fn signed(bits: u32) -> Self {
        Self { bits, signed: true }
    }

    /// The narrowest register that holds every value from `low` to `high`; signed only where `low` < 0.
    ///
    /// ```
    /// use vuris::spec::Word;
    /// assert_eq!(Word::holding(0, 255), Word::unsigned(8));
    /// assert_eq!(Word::holding(-24570, 24570), Word::signed(16));
    /// assert_eq!(Word::holding(-128, 128), Word::signed(9));
    /// ```
    pub fn holding(low: i64, high: i64) -> Self {
        // −v − 1 has in two's complement the same magnitude bits as v.
        let magnitude = |value: i64| 64 - (value ^ (value >> 63)).leading_zeros();
        let bits = magnitude(low).max(magnitude(high));
        if low < 0 { Self::signed(bits + 1) } else { Self::unsigned(bits.max(1)) }
    }

    /// The least value.
    pub const fn min(self) -> i64 {
        if self.signed { -(1 << (self.bits - 1)) } else { 0 }
    }

    /// The greatest value.
    pub const fn max(self) -> i64 {
        i64::MAX >> (63 - self.bits + self.signed as u32)
    }

    /// Whether the register holds `value` unchanged.
    pub const fn contains(self, value: i64) -> bool {
        self.min() <= value && value <= self.max()
    }

    /// What the register keeps of `value`: its low bits, read with the register's sign.
    pub const fn wrap(self, value: i64) -> i64 {
        let unused = 64 - self.bits;
        if self.signed { (value << unused) >> unused } else { (((value as u64) << unused) >> unused) as i64 }
    }

    /// The register's bits of `value`, as an unsigned pattern (what a simulator prints).
    pub const fn pattern(self, value: i64) -> u64 {
        (value as u64) & (u64::MAX >> (64 - self.bits))
    }

    /// The value of a bit pattern, the inverse of [`Word::pattern`].
    pub const fn value(self, pattern: u64) -> i64 {
        self.wrap(pattern as i64)
    }
}

impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", if self.signed { "s" } else { "u" }, self.bits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_narrowest_word_holds_the_range_and_one_bit_less_does_not(a in -(1i64 << 40)..1 << 40, b in -(1i64 << 40)..1 << 40) {
            let (low, high) = (a.min(b), a.max(b));
            let word = Word::holding(low, high);
            prop_assert!(word.contains(low) && word.contains(high));
            if word.bits > 1 {
                let narrower = Word { bits: word.bits - 1, ..word };
                prop_assert!(!(narrower.contains(low) && narrower.contains(high)));
            }
        }

        #[test]
        fn wrapping_keeps_what_fits_and_is_modular(bits in 1u32..=63, signed: bool, value: i64) {
            let word = Word { bits, signed };
            let wrapped = word.wrap(value);
            prop_assert!(word.contains(wrapped));
            prop_assert_eq!(wrapped.wrapping_sub(value) & ((1i64 << bits).wrapping_sub(1)), 0);
            prop_assert_eq!(word.value(word.pattern(value)), wrapped);
        }
    }
}
