//! What has been measured once, by the content of everything that it depends on.

use super::verilog::digest;
use crate::problem::{Problem, Result};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};

/// A folder of results, each in a file that is named after the digest of what it was computed from.
#[derive(Debug, Clone)]
pub struct Cache {
    folder: PathBuf,
}

impl Cache {
    /// The cache in `folder`, which need not be there yet.
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into() }
    }

    /// Where its files are.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    fn path(&self, inputs: &[&str]) -> PathBuf {
        self.folder.join(format!("{}.json", digest(inputs.iter().copied())))
    }

    /// The result that was computed from `inputs`, if it is there and can be read: a damaged file counts as none.
    pub fn recall<T: DeserializeOwned>(&self, inputs: &[&str]) -> Option<T> {
        serde_json::from_slice(&std::fs::read(self.path(inputs)).ok()?).ok()
    }

    /// Keeps `result`, computed from `inputs`: whole or not at all, so that two programs may share the folder.
    pub fn keep<T: Serialize>(&self, inputs: &[&str], result: &T) -> Result<()> {
        let path = self.path(inputs);
        let refused = |error: std::io::Error| {
            Problem::io(&path, "write", &error).remedy("make room, or make the folder writable")
        };
        std::fs::create_dir_all(&self.folder).map_err(refused)?;
        let beside = tempfile::NamedTempFile::new_in(&self.folder).map_err(refused)?;
        serde_json::to_writer(&beside, result).map_err(|error| refused(error.into()))?;
        beside.persist(&path).map_err(|error| refused(error.error))?;
        Ok(())
    }

    /// The result of `inputs`: recalled, or computed and kept.
    pub fn recall_or<T: Serialize + DeserializeOwned>(
        &self,
        inputs: &[&str],
        compute: impl FnOnce() -> Result<T>,
    ) -> Result<T> {
        if let Some(result) = self.recall(inputs) {
            return Ok(result);
        }
        let result = compute()?;
        self.keep(inputs, &result)?;
        Ok(result)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_is_computed_once_for_each_content() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::new(folder.path().join("new"));
        let mut computed = 0;
        let mut get = |inputs: &[&str]| {
            let compute = || {
                computed += 1;
                Ok(computed)
            };
            cache.recall_or(inputs, compute).unwrap()
        };
        assert_eq!([get(&["a", "b"]), get(&["ab", ""]), get(&["a", "b"]), get(&["a", "c"])], [1, 2, 1, 3]);
    }

    #[test]
    fn a_damaged_file_is_computed_again_and_a_failure_is_not_kept() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::new(folder.path());
        cache.keep(&["a"], &1_u64).unwrap();
        let path = std::fs::read_dir(folder.path()).unwrap().next().unwrap().unwrap().path();
        std::fs::write(&path, "{\"cut").unwrap();
        assert_eq!(cache.recall_or(&["a"], || Ok(2_u64)), Ok(2));
        assert_eq!(cache.recall::<u64>(&["a"]), Some(2));
        let failure = Problem::at("a tool", "failed");
        assert_eq!(cache.recall_or::<u64>(&["b"], || Err(failure.clone())), Err(failure));
        assert_eq!(cache.recall::<u64>(&["b"]), None);
    }
}
