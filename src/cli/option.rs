//! What is asked of the values of options, whichever command has them.

use crate::problem::{Problem, Result};
use std::collections::BTreeSet;
use std::ops::RangeInclusive;

/// Refuses the value of `option` outside its range.
pub(super) fn in_range(option: &str, value: f64, allowed: &RangeInclusive<f64>) -> Result<()> {
    let (low, high) = (allowed.start(), allowed.end());
    match allowed.contains(&value) {
        true => Ok(()),
        false => Err(Problem::at(option, format_args!("{value:?}"))
            .expected(format_args!("a number from {low:e} to {high:e}"))),
    }
}

/// Refuses a name that `option` has a second time; `each` is what names stand for.
pub(super) fn each_once<'a>(
    option: &str,
    each: &str,
    names: impl IntoIterator<Item = &'a str>,
) -> Result<()> {
    let mut seen = BTreeSet::new();
    match names.into_iter().find(|name| !seen.insert(*name)) {
        None => Ok(()),
        Some(twice) => Err(Problem::at(option, format_args!("{twice} is there twice"))
            .expected(format_args!("each {each} once"))),
    }
}
