//! A share of the work.

use crate::problem::{Problem, Result};
use std::fmt;

/// Share `index` of `count`: the blocks whose number leaves that rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// From 1.
    pub index: u64,
    /// At least 1.
    pub count: u64,
}

impl Shard {
    /// All of it.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// Reads `i/n`.
    pub fn parse(text: &str) -> Result<Self> {
        let numbers = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((index, count)) if (1..=count).contains(&index) && count <= 10_000 => {
                Ok(Self { index, count })
            }
            _ => Err(Problem::at("--shard", format_args!("\"{text}\""))
                .expected("i/n with 1 <= i <= n <= 10000, such as 2/4")),
        }
    }

    /// Whether block number `block` belongs to it.
    pub fn has(self, block: u64) -> bool {
        block % self.count == self.index - 1
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_block_has_one_shard_and_nonsense_is_refused() {
        for count in 1..7 {
            for block in 0..40 {
                let owners = (1..=count).filter(|&index| Shard { index, count }.has(block)).count();
                assert_eq!(owners, 1);
            }
        }
        assert_eq!(Shard::parse("2/4").unwrap(), Shard { index: 2, count: 4 });
        for text in ["", "1", "0/3", "4/3", "1/0", "a/b", "1/2/3", "-1/2", "1/10001"] {
            assert!(Shard::parse(text).is_err(), "{text}");
        }
    }
}
