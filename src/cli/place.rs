//! Places that paths mean, and whether files may be written there.

use crate::problem::{Problem, Result};
use std::path::{Component, Path, PathBuf};

/// The place that `path` means: from the root on, links followed as far as there is something, without `.` and `..`.
pub(super) fn at(path: &Path) -> PathBuf {
    let mut place = PathBuf::new();
    for part in std::path::absolute(path).unwrap_or_else(|_| path.to_owned()).components() {
        match part {
            Component::ParentDir => _ = place.pop(),
            part => place.push(part),
        }
        place = place.canonicalize().unwrap_or(place);
    }
    place
}

/// Refuses `outputs` (option, path) that are one and the same file, a folder, in no folder, or one of the files that are `read`: before a long run, not after it.
pub(super) fn may_be_written(outputs: &[(&str, &Path)], read: &[PathBuf]) -> Result<()> {
    let read: Vec<PathBuf> = read.iter().map(|file| at(file)).collect();
    for (number, (option, path)) in outputs.iter().enumerate() {
        let refusal = |what: &str| Problem::in_file(path, format_args!("{option}: {what}"));
        if path == &Path::new("-") {
            return Err(refusal("is not a file's name")
                .expected("the path of a file")
                .remedy("only the verdict goes to standard output: --json -; a file of that name is ./-"));
        }
        if path.is_dir() {
            return Err(refusal("is a folder").expected("the path of a file").remedy("name a file in it"));
        }
        let place = at(path);
        if !place.parent().is_some_and(Path::is_dir) {
            return Err(refusal("its folder is not there")
                .expected("a file in a folder that there is")
                .remedy("make the folder, or name another"));
        }
        if read.contains(&place) {
            return Err(refusal("is a file that is read: it would be lost")
                .expected("another file")
                .remedy("choose another name"));
        }
        if let Some((other, _)) = outputs[..number].iter().find(|(_, other)| at(other) == place) {
            return Err(refusal(&format!("is the file of {other}, too"))
                .expected("a file for each")
                .remedy("choose another name for one of them"));
        }
    }
    Ok(())
}
