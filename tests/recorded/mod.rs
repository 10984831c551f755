//! Recordings that are not part of the package, for the tests that use them where they are at hand.

use std::io::Write;
use std::path::{Path, PathBuf};

/// The folder `part` of the one that `variable` names, or, without it, of `beside` among the recordings beside the repository; nothing, and a message, where it
/// is absent.
pub fn at_hand(variable: &str, beside: &str, part: &str) -> Option<PathBuf> {
    let recordings = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/recordings");
    let folder = std::env::var_os(variable).map_or_else(|| recordings.join(beside), PathBuf::from).join(part);
    if !folder.is_dir() {
        // Not by println!, which a test that passes does not show.
        let words = format!("SKIPPED: {} is absent; {variable} may name another folder\n", folder.display());
        std::io::stderr().write_all(words.as_bytes()).expect("standard error takes words");
        return None;
    }
    Some(folder)
}
