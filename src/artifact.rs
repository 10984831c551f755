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
    /// The file is there, and should not be.
    Surplus(String),
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing(path) => write!(f, "missing {path}"),
            Self::Stale(path, line) => write!(f, "stale   {path}, from line {line}"),
            Self::Surplus(path) => write!(f, "surplus {path}"),
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

/// Every file below `folder`/`part`, as `part/…`.
fn files_below(folder: &Path, part: &str) -> Result<Vec<String>> {
    let path = folder.join(part);
    if !path.is_dir() {
        return Ok(if path.exists() { vec![part.to_owned()] } else { Vec::new() });
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
                found.push((path.clone(), Difference::Surplus(path)));
            }
        }
    }
    found.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(found.into_iter().map(|(_, difference)| difference).collect())
}

/// Writes `artifacts` below `folder`: each beside its place first, then renamed, so that no file is ever half there.
///
/// A surplus file of an earlier run is removed only where it says that it was generated here.
pub fn write(folder: &Path, artifacts: &[Artifact]) -> Result<()> {
    let obstacle = |path: &Path, error: &std::io::Error| {
        Problem::io(path, "write", error).remedy("choose a folder that is writable")
    };
    for artifact in artifacts {
        let path = folder.join(&artifact.path);
        let parent = path.parent().unwrap_or(folder);
        std::fs::create_dir_all(parent).map_err(|error| obstacle(parent, &error))?;
        if std::fs::read(&path).is_ok_and(|bytes| bytes == artifact.text.as_bytes()) {
            continue;
        }
        let beside = tempfile::NamedTempFile::new_in(parent).map_err(|error| obstacle(parent, &error))?;
        std::fs::write(beside.path(), &artifact.text).map_err(|error| obstacle(beside.path(), &error))?;
        let readable = std::os::unix::fs::PermissionsExt::from_mode(0o644);
        beside.as_file().set_permissions(readable).map_err(|error| obstacle(&path, &error))?;
        beside.persist(&path).map_err(|error| obstacle(&path, &error.error))?;
    }
    for difference in differences(folder, artifacts)? {
        if let Difference::Surplus(path) = difference {
            let path = folder.join(path);
            if was_generated(&path) {
                std::fs::remove_file(&path).map_err(|error| Problem::io(&path, "remove", &error))?;
            }
        }
    }
    Ok(())
}

/// Whether the file at `path` says in its first lines that it was generated here.
fn was_generated(path: &Path) -> bool {
    let text = std::fs::read(path).unwrap_or_default();
    let head = String::from_utf8_lossy(&text[..text.len().min(400)]).into_owned();
    head.lines().take(4).any(|line| line.contains("Generated by `vuris "))
}
