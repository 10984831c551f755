//! The files of a sweep: written beside, then renamed; files of others are never replaced.

use super::journal;
use crate::problem::{Problem, Result};
use crate::spec::AngleUnit;
use crate::sweep::{AreaSource, Configuration, rounding_named, throughput_named};
use std::io::Write;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use tempfile::NamedTempFile;

/// Names of the files that a whole sweep writes.
pub(super) const NAMES: [&str; 3] = ["sweep.csv", "sweep.parquet", "sweep.svg"];

/// Refuses a folder in which one of these files stands without a journal of a sweep: somebody else's.
pub(super) fn check(folder: &Path) -> Result<()> {
    if !journal::paths_in(folder)?.is_empty() {
        return Ok(());
    }
    for name in NAMES {
        let path = folder.join(name);
        if path.symlink_metadata().is_ok() {
            return Err(Problem::in_file(&path, "is there, and no journal of a sweep beside it")
                .expected("a new or empty folder, or that of an earlier sweep")
                .remedy("choose another folder, or move this file away"));
        }
    }
    Ok(())
}

/// A new file with `bytes` beside `path`, that vanishes unless it is put there.
pub(super) fn stage(path: &Path, bytes: &[u8]) -> Result<NamedTempFile> {
    let cannot = |error: std::io::Error| Problem::io(path, "write", &error);
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut beside = NamedTempFile::new_in(folder).map_err(cannot)?;
    beside.write_all(bytes).map_err(cannot)?;
    beside.as_file().set_permissions(PermissionsExt::from_mode(0o644)).map_err(cannot)?;
    Ok(beside)
}

/// Writes `files` (name and contents) into `folder`: all beside their places first, then all renamed.
pub(super) fn write(folder: &Path, files: [(&str, Vec<u8>); 3]) -> Result<()> {
    let mut staged = Vec::new();
    for (name, bytes) in files {
        let path = folder.join(name);
        staged.push((stage(&path, &bytes)?, path));
    }
    for (beside, path) in staged {
        beside.persist(&path).map_err(|error| Problem::io(&path, "write", &error.error))?;
    }
    Ok(())
}

/// The synthesised configurations and areas of the sweep.csv at `path`.
pub(super) fn synthesised_points(path: &Path) -> Result<Vec<(AngleUnit, f64)>> {
    let refuse =
        |found: String| Problem::in_file(path, found).expected("a sweep.csv of `vuris sweep --out DIR`");
    let text = std::fs::read_to_string(path).map_err(|error| Problem::io(path, "read", &error))?;
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().map_err(|error| refuse(error.to_string()))?.clone();
    let mut points = Vec::new();
    for (line, record) in (2..).zip(reader.records()) {
        let record = record.map_err(|error| refuse(error.to_string()))?;
        let field = |name: &str| {
            let place = header.iter().position(|column| column == name);
            place.and_then(|place| record.get(place)).ok_or_else(|| refuse(format!("no column {name}")))
        };
        if field("octave")? != "all" || field("area_source")? != AreaSource::Synthesised.name() {
            continue;
        }
        let number = |name: &str| {
            let text = field(name)?;
            text.parse::<u32>().map_err(|_| refuse(format!("line {line}: {name} = {text}")))
        };
        let configuration = Configuration {
            metric: number("metric")?.into(),
            x_bits: number("x_bits")?,
            y_bits: number("y_bits")?,
            phase_bits: number("phase_bits")?,
            length_bits: number("length_bits")?,
            iterations: number("iterations")?,
            vector_guard_bits: number("vector_guard_bits")?,
            angle_guard_bits: number("angle_guard_bits")?,
            throughput: throughput_named(field("cycles_per_pixel")?)
                .ok_or_else(|| refuse(format!("line {line}: cycles_per_pixel")))?,
            pipeline_every: number("pipeline_every")?,
            normaliser: field("normaliser")? == "yes",
            rounding: rounding_named(field("rounding")?)
                .ok_or_else(|| refuse(format!("line {line}: rounding")))?,
        };
        let luts = field("area_luts")?;
        let luts: f64 = luts.parse().map_err(|_| refuse(format!("line {line}: area_luts = {luts}")))?;
        if !(luts > 0.0 && luts.is_finite()) {
            return Err(refuse(format!("line {line}: area_luts = {luts}")));
        }
        points.push((configuration.unit()?, luts));
    }
    Ok(points)
}
