//! The fingerprint of a campaign: what its seal binds to its label.

use crate::artifact::files_below;
use crate::challenge::hexadecimal;
use crate::problem::{Problem, Result};
use sha2::{Digest, Sha256};
use std::path::Path;

/// SHA-256 of all files of the campaign in the subfolder `name` of `folder`, in the order of their paths: of each the path within the campaign, a line feed, the number of bytes
/// (8, the least significant one first), and the bytes. 64 hexadecimal digits.
///
/// # Errors
/// A file that cannot be read.
pub(super) fn fingerprint(folder: &Path, name: &str) -> Result<String> {
    let mut files = files_below(folder, name)?;
    files.sort_unstable();
    let mut hash = Sha256::new();
    for file in files {
        let path = folder.join(&file);
        let bytes = std::fs::read(&path).map_err(|error| Problem::io(&path, "read", &error))?;
        hash.update(file.strip_prefix(name).unwrap_or(&file).trim_start_matches('/'));
        hash.update(b"\n");
        hash.update((bytes.len() as u64).to_le_bytes());
        hash.update(&bytes);
    }
    Ok(hexadecimal(&hash.finalize()))
}
