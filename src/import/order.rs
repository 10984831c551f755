//! The order of files: as people number them.

use crate::problem::{Problem, Result};
use alphanumeric_sort::compare_path;
use std::collections::BTreeSet;
use std::path::PathBuf;

/// `files` sorted by their paths, numbers in them by value: `f2` before `f10`.
pub fn natural_order(mut files: Vec<PathBuf>) -> Vec<PathBuf> {
    files.sort_by(|one, other| compare_path(one, other));
    files
}

/// Refuses a file that is named twice, by whatever path: its frames would be there twice.
///
/// # Errors
/// It.
pub fn each_file_once(files: &[PathBuf]) -> Result<()> {
    let mut known = BTreeSet::new();
    for file in files {
        // What is not there is said when it is read.
        if !known.insert(file.canonicalize().unwrap_or_else(|_| file.clone())) {
            return Err(Problem::in_file(file, "is named twice")
                .expected("each file once")
                .remedy("leave it out the second time; links to it, and other paths, are the same file"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_count_by_value_and_folders_first() {
        let paths = |names: &[&str]| -> Vec<PathBuf> { names.iter().map(PathBuf::from).collect() };
        let sorted = natural_order(paths(&["b/f1", "a/f10", "f100", "f10", "a/f9", "f09", "f2", "f002x"]));
        assert_eq!(sorted, paths(&["a/f9", "a/f10", "b/f1", "f2", "f002x", "f09", "f10", "f100"]));
        let refusal = each_file_once(&paths(&["f1", "f2", "f1"])).unwrap_err().to_string();
        assert!(refusal.contains("f1: is named twice"), "{refusal}");
    }

    #[test]
    fn a_file_is_the_same_by_another_path() {
        let folder = tempfile::tempdir().unwrap();
        let [file, link] = ["f1", "f2"].map(|name| folder.path().join(name));
        std::fs::write(&file, "").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        assert!(each_file_once(std::slice::from_ref(&file)).is_ok());
        for other in [folder.path().join("./f1"), link] {
            let refusal = each_file_once(&[file.clone(), other]).unwrap_err().to_string();
            assert!(refusal.contains("is named twice"), "{refusal}");
        }
    }
}
