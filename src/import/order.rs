//! The order of files: as people number them.

use crate::problem::{Problem, Result};
use alphanumeric_sort::compare_path;
use std::path::PathBuf;

/// `files` sorted by their paths, numbers in them by value: `f2` before `f10`.
///
/// # Errors
/// A file that is named twice, whose frames would be there twice.
pub fn natural_order(mut files: Vec<PathBuf>) -> Result<Vec<PathBuf>> {
    files.sort_by(|one, other| compare_path(one, other));
    match files.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(Problem::in_file(&pair[0], "is named twice").expected("each file once")),
        None => Ok(files),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_count_by_value_and_folders_first() {
        let paths = |names: &[&str]| -> Vec<PathBuf> { names.iter().map(PathBuf::from).collect() };
        let sorted =
            natural_order(paths(&["b/f1", "a/f10", "f100", "f10", "a/f9", "f09", "f2", "f002x"])).unwrap();
        assert_eq!(sorted, paths(&["a/f9", "a/f10", "b/f1", "f2", "f002x", "f09", "f10", "f100"]));
        let refusal = natural_order(paths(&["f1", "f2", "f1"])).unwrap_err().to_string();
        assert!(refusal.contains("f1: is named twice"), "{refusal}");
    }
}
