//! `--library FILE.toml`: effects of a user's own.

use crate::bench::library;
use crate::physics::Effect;
use crate::problem::{Problem, Result};
use std::path::Path;

/// The effects in `file`; none where none is given.
pub(super) fn effects_in(file: Option<&Path>) -> Result<Vec<&'static Effect>> {
    let Some(file) = file else { return Ok(Vec::new()) };
    let text = std::fs::read_to_string(file).map_err(|error| Problem::io(file, "read", &error))?;
    library(&file.display().to_string(), &text)
}
