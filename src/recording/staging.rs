//! Folders that appear whole or not at all: filled under another name beside the target, then renamed.

use crate::problem::{Problem, Result};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A folder in the making.
pub struct Staging {
    temporary: TempDir,
    new: PathBuf,
    target: PathBuf,
}

impl Staging {
    /// Begins a folder that is to stand at `target`, whose parent is made where it is not there.
    pub fn beside(target: &Path) -> Result<Self> {
        if target.file_name().is_none() {
            return Err(
                Problem::in_file(target, "is not a name for a new folder").remedy("give the folder a name")
            );
        }
        let parent = match target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let cannot = |error: std::io::Error| {
            Problem::io(target, "write", &error)
                .expected(format_args!("a writable folder {}", parent.display()))
                .remedy("choose another place for the output")
        };
        fs::create_dir_all(parent).map_err(cannot)?;
        // Beside the target, since a folder cannot be renamed into another file system.
        let temporary = tempfile::Builder::new().prefix(".vuris-").tempdir_in(parent).map_err(cannot)?;
        let new = temporary.path().join("new");
        fs::create_dir(&new).map_err(cannot)?;
        Ok(Self { temporary, new, target: target.to_owned() })
    }

    /// The folder to fill.
    pub fn path(&self) -> &Path {
        &self.new
    }

    /// Writes one text file.
    pub fn write_text(&self, name: &str, text: &str) -> Result<()> {
        fs::write(self.new.join(name), text)
            .map_err(|error| Problem::io(&self.target.join(name), "write", &error))
    }

    /// Puts the folder in its place, where nothing must have come to stand meanwhile.
    pub fn publish_new(self) -> Result<()> {
        if self.target.symlink_metadata().is_ok() {
            return Err(Problem::in_file(&self.target, "has come to be there meanwhile")
                .expected("nothing at the place of a new folder")
                .remedy("choose another place for the output"));
        }
        self.publish()
    }

    /// Puts the folder in its place; one that stands there is replaced, and restored should that fail.
    pub fn publish(self) -> Result<()> {
        let cannot = |error: &std::io::Error| Problem::io(&self.target, "write", error);
        let old = self.temporary.path().join("old");
        let replaces = self.target.symlink_metadata().is_ok();
        if replaces {
            fs::rename(&self.target, &old).map_err(|error| cannot(&error))?;
        }
        let Err(error) = fs::rename(&self.new, &self.target) else { return Ok(()) };
        if replaces && fs::rename(&old, &self.target).is_err() {
            let kept = self.temporary.keep();
            return Err(Problem::io(&self.target, "write", &error)
                .remedy(format_args!("the previous output is in {}", kept.join("old").display())));
        }
        Err(cannot(&error))
    }
}
