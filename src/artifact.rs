//! Text files to be written or checked: missing, stale (with the first line that differs), surplus.

use crate::problem::{Problem, Result};
use std::fmt;
use std::path::Path;

/// A file with its contents, its path relative to the folder of the whole.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Artifact {
    /// Path within the folder, with `/`.
    pub path: String,
    /// The file's text.
    pub text: String,
}

impl Artifact {
    /// The file `path` with `text`.
    pub fn new(path: impl Into<String>, text: impl Into<String>) -> Self {
        Self { path: path.into(), text: text.into() }
    }
}

/// How a folder differs from what it should hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Difference {
    /// The file is not there.
    Missing(String),
    /// The file is there, and from this line (1-based) on it is another.
    Stale(String, usize),
    /// The file is there, and should not be. Writing removes it where it was generated here.
    Surplus {
        /// The file.
        path: String,
        /// Whether it says that it was generated here.
        generated: bool,
    },
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing(path) => write!(f, "missing {path}"),
            Self::Stale(path, line) => write!(f, "stale   {path}, from line {line}"),
            Self::Surplus { path, generated: true } => write!(f, "surplus {path}"),
            Self::Surplus { path, generated: false } => {
                write!(f, "surplus {path}, which vuris did not write: remove it, or move it away")
            }
        }
    }
}

/// The folders below which every file is one of the artifacts: only there a file can be surplus.
fn owned_folders(artifacts: &[Artifact]) -> Vec<&str> {
    let mut folders: Vec<&str> =
        artifacts.iter().filter_map(|artifact| artifact.path.split_once('/')).map(|(top, _)| top).collect();
    folders.sort_unstable();
    folders.dedup();
    folders
}

/// Every file below `folder`/`part`, as `part/…`. A link is a file of its own: what it points to is not ours.
///
/// # Errors
/// A folder that cannot be listed.
pub fn files_below(folder: &Path, part: &str) -> Result<Vec<String>> {
    let path = folder.join(part);
    match path.symlink_metadata() {
        Err(_) => return Ok(Vec::new()),
        Ok(metadata) if !metadata.is_dir() => return Ok(vec![part.to_owned()]),
        Ok(_) => {}
    }
    let entries = std::fs::read_dir(&path).map_err(|error| Problem::io(&path, "list", &error))?;
    let mut files = Vec::new();
    for entry in entries {
        let entry = entry.map_err(|error| Problem::io(&path, "list", &error))?;
        files.extend(files_below(folder, &format!("{part}/{}", entry.file_name().to_string_lossy()))?);
    }
    Ok(files)
}

/// Compares `folder` with `artifacts` both ways, in the order of paths.
pub fn differences(folder: &Path, artifacts: &[Artifact]) -> Result<Vec<Difference>> {
    let mut found = Vec::new();
    for artifact in artifacts {
        let path = folder.join(&artifact.path);
        match std::fs::read(&path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                found.push((artifact.path.clone(), Difference::Missing(artifact.path.clone())));
            }
            Err(error) => return Err(Problem::io(&path, "read", &error)),
            Ok(bytes) if bytes == artifact.text.as_bytes() => {}
            Ok(bytes) => {
                let same = bytes.iter().zip(artifact.text.as_bytes()).take_while(|(a, b)| a == b).count();
                let line = bytes[..same].iter().filter(|&&byte| byte == b'\n').count() + 1;
                found.push((artifact.path.clone(), Difference::Stale(artifact.path.clone(), line)));
            }
        }
    }
    for part in owned_folders(artifacts) {
        for path in files_below(folder, part)? {
            if !artifacts.iter().any(|artifact| artifact.path == path) {
                let generated = was_generated(&folder.join(&path));
                found.push((path.clone(), Difference::Surplus { path, generated }));
            }
        }
    }
    found.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(found.into_iter().map(|(_, difference)| difference).collect())
}

/// Writes `artifacts` below `folder`: every file beside its place first, then all renamed, so that a failure leaves what
/// stood there. Surplus files of an earlier run are removed; a file that was not generated here is never replaced or removed.
pub fn write(folder: &Path, artifacts: &[Artifact]) -> Result<()> {
    let mut staged = Vec::new();
    for artifact in artifacts {
        let path = folder.join(&artifact.path);
        if !std::fs::read(&path).is_ok_and(|bytes| bytes == artifact.text.as_bytes()) {
            may_be_replaced(&path)?;
            staged.push((stage(&path, &artifact.text)?, path));
        }
    }
    for (beside, path) in staged {
        beside.persist(&path).map_err(|error| obstacle(&path, &error.error))?;
    }
    for difference in differences(folder, artifacts)? {
        if let Difference::Surplus { path, generated: true } = difference {
            let path = folder.join(path);
            std::fs::remove_file(&path).map_err(|error| Problem::io(&path, "remove", &error))?;
        }
    }
    Ok(())
}

/// Writes `text` as the one file `path`, whatever stood there: beside its place first, then renamed. A link goes on to point to the file; a
/// device or a pipe stays what it is, and takes the text.
///
/// # Errors
/// A place that cannot be written.
pub fn write_file(path: &Path, text: &str) -> Result<()> {
    if path.metadata().is_ok_and(|there| !there.is_file() && !there.is_dir()) {
        return std::fs::write(path, text).map_err(|error| obstacle(path, &error));
    }
    let place = path.canonicalize().unwrap_or_else(|_| Path::new(".").join(path));
    stage(&place, text)?.persist(&place).map_err(|error| obstacle(path, &error.error))?;
    Ok(())
}

fn obstacle(path: &Path, error: &std::io::Error) -> Problem {
    Problem::io(path, "write", error).remedy("choose a folder that is writable")
}

/// A new file with `text` beside `path`, that vanishes unless it is put there.
fn stage(path: &Path, text: &str) -> Result<tempfile::NamedTempFile> {
    let parent = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(parent).map_err(|error| obstacle(parent, &error))?;
    let beside = tempfile::NamedTempFile::new_in(parent).map_err(|error| obstacle(parent, &error))?;
    std::fs::write(beside.path(), text).map_err(|error| obstacle(path, &error))?;
    let readable = std::os::unix::fs::PermissionsExt::from_mode(0o644);
    beside.as_file().set_permissions(readable).map_err(|error| obstacle(path, &error))?;
    Ok(beside)
}

/// Refuses a path at which something stands that was not generated here.
fn may_be_replaced(path: &Path) -> Result<()> {
    match path.symlink_metadata() {
        // Nothing is lost with an empty file.
        Ok(metadata) if metadata.is_file() && metadata.len() == 0 => Ok(()),
        Ok(_) if !was_generated(path) => {
            Err(Problem::in_file(path, "is there and was not generated by vuris")
                .expected("nothing there, or a file of an earlier run")
                .remedy("choose another folder, or move this file away"))
        }
        _ => Ok(()),
    }
}

/// Whether the regular file at `path` says in its first lines that it was generated here.
fn was_generated(path: &Path) -> bool {
    if !path.symlink_metadata().is_ok_and(|metadata| metadata.is_file()) {
        return false;
    }
    let text = std::fs::read(path).unwrap_or_default();
    let head = String::from_utf8_lossy(&text[..text.len().min(400)]).into_owned();
    head.lines().take(4).any(|line| line.contains("Generated by `vuris "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::{FileTypeExt, symlink};

    #[test]
    fn a_pipe_stays_a_pipe_and_takes_the_text() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || std::fs::read_to_string(pipe).unwrap()
        });
        write_file(&pipe, "text\n").unwrap();
        assert!(pipe.symlink_metadata().unwrap().file_type().is_fifo(), "it was replaced by a file");
        assert_eq!(reader.join().unwrap(), "text\n");
    }

    #[test]
    fn a_link_goes_on_to_point_to_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let [file, link] = ["file", "link"].map(|name| folder.path().join(name));
        std::fs::write(&file, "old").unwrap();
        symlink(&file, &link).unwrap();
        write_file(&link, "new").unwrap();
        assert!(link.symlink_metadata().unwrap().is_symlink());
        assert_eq!(std::fs::read_to_string(&file).unwrap(), "new");
    }
}
