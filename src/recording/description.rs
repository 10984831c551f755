//! `recording.toml`: how a recording was taken.

use super::{Kind, Recording};
use crate::fields::{self, Fields};
use crate::problem::{Problem, Result};
use std::f64::consts::TAU;
use std::path::Path;

pub(super) const FORMAT: &str = "vuris-recording/1";

/// What `recording.toml` says; the fields are those of [`Recording`].
pub(super) struct Description {
    pub kind: Kind,
    pub frequency_hz: f64,
    pub steps_rad: Vec<f64>,
    pub frame_period_s: f64,
}

/// Reads the file at `path`.
pub(super) fn read(path: &Path) -> Result<Description> {
    let text = std::fs::read_to_string(path).map_err(|error| Problem::io(path, "read", &error))?;
    let file = path.display().to_string();
    let table = fields::parse(&file, &text)?;
    let top = Fields::top(&file, &table);
    let format = format!("\"{FORMAT}\"");
    if top.text("format", &format)? != FORMAT {
        return Err(top.refuse("format", &format));
    }
    let one_of = format!("one of {}", Kind::names());
    let kind = Kind::named(top.text("kind", &one_of)?).ok_or_else(|| top.refuse("kind", &one_of))?;
    let modulation = top.section("modulation")?;
    Ok(Description {
        kind,
        frequency_hz: modulation.number("frequency_hz", 1e4..=1e10, "Hz")?,
        steps_rad: steps_rad(&file, &modulation)?,
        frame_period_s: top.section("timing")?.number("frame_period_s", 1e-9..=1e6, "s")?,
    })
}

/// The N phase steps, from their constant difference or from the list of them.
fn steps_rad(file: &str, modulation: &Fields) -> Result<Vec<f64>> {
    let frames = modulation.integer("frames", 1..=65_536)? as usize;
    match (modulation.has("phase_step_rad"), modulation.has("phase_steps_rad")) {
        (true, false) => {
            let step_rad = modulation.number("phase_step_rad", -TAU..=TAU, "rad")?;
            Ok((0..frames).map(|n| n as f64 * step_rad).collect())
        }
        (false, true) => {
            let expected = format!("{frames} finite numbers in rad, the step of each of modulation.frames");
            let steps_rad = modulation.numbers("phase_steps_rad", &expected)?;
            if steps_rad.len() != frames {
                let found = format_args!("modulation.phase_steps_rad has {} numbers", steps_rad.len());
                return Err(Problem::at(file, found).expected(expected));
            }
            Ok(steps_rad)
        }
        (both, _) => {
            let found = if both { "are both given" } else { "are both missing" };
            Err(Problem::at(
                file,
                format_args!("modulation.phase_step_rad and modulation.phase_steps_rad {found}"),
            )
            .expected("one of them: the constant difference between frames, or the step of each frame"))
        }
    }
}

/// The text of a file that reads as `recording`'s description.
pub(super) fn write(recording: &Recording) -> String {
    let steps_rad = &recording.steps_rad;
    let step_rad = steps_rad.get(1).copied().unwrap_or(0.0);
    let uniform =
        step_rad.abs() <= TAU && steps_rad.iter().enumerate().all(|(n, &step)| step == n as f64 * step_rad);
    let steps = if uniform {
        format!("phase_step_rad = {step_rad:?}")
    } else {
        format!("phase_steps_rad = {steps_rad:?}")
    };
    format!(
        "format = \"{FORMAT}\"\nkind = \"{}\"\n\n[modulation]\nfrequency_hz = {:?}\nframes = {}\n{steps}\n\
         \n[timing]\nframe_period_s = {:?}\n",
        recording.kind,
        recording.frequency_hz,
        steps_rad.len(),
        recording.frame_period_s,
    )
}
