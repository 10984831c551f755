//! A stack of frames, cut into sets and recordings.

use super::stack::Stack;
use crate::frames::RawSets;
use crate::problem::{Problem, Result};
use crate::recording::{Camera, Kind, Recording, SetRow};
use std::path::Path;

/// How the frames were taken. Lists have one value for all, or one for each recording or set, in the order of the frames;
/// the ranges are those of the format.
#[derive(Debug, Clone, PartialEq)]
pub struct Taking {
    /// What the recordings are for.
    pub kind: Kind,
    /// The phase step of each of a set's N frames, rad, 1 to 65536 of them.
    pub steps_rad: Vec<f64>,
    /// Modulation frequency of each recording, Hz.
    pub frequencies_hz: Vec<f64>,
    /// From the start of a frame to the start of the next, s.
    pub frame_period_s: f64,
    /// From the start of a set to the start of the next, s.
    pub set_period_s: f64,
    /// Start of each frame, s, where it was recorded; instead of both periods.
    pub frame_times_s: Option<Vec<f64>>,
    /// Axial distance of the target in each set, m; empty where it is not known.
    pub positions_m: Vec<f64>,
    /// Velocity of the target in each set, m/s, positive away from the camera.
    pub velocities_m_s: Vec<f64>,
    /// What is added to the phase steps in each set, rad.
    pub phase_offsets_rad: Vec<f64>,
    /// Names of the recordings, of equally many sets each; empty for the one that holds all.
    pub names: Vec<String>,
}

/// The recordings in `stack`: one, which is to be the folder `out`, or those of the campaign `out`, with `camera` where it is known.
///
/// # Errors
/// Frames that are no whole sets, sets that are not as many in each recording, lists that are neither one value nor one for
/// each, times that go back, a camera of another size.
pub fn recordings(
    stack: &Stack,
    taking: &Taking,
    camera: Option<&Camera>,
    out: &Path,
) -> Result<Vec<Recording>> {
    let nothing = || Problem::at("the files", "no frames").expected("at least one set");
    let geometry = stack.geometry().ok_or_else(nothing)?;
    let frames = taking.steps_rad.len();
    let sets = whole_sets(stack, frames)?;
    let count = taking.names.len().max(1);
    if !sets.is_multiple_of(count) {
        return Err(Problem::at("--recordings", format_args!("{count} of {sets} sets"))
            .expected(format_args!("a number of recordings that divides {sets}")));
    }
    if let Some(camera) = camera
        && camera.geometry != geometry
    {
        let found =
            format_args!("{} x {} pixels in camera.toml", camera.geometry.width, camera.geometry.height);
        return Err(Problem::at("--camera", found)
            .expected(format_args!("{} x {}, as the frames have", geometry.width, geometry.height)));
    }
    let each = |option: &str, values: &[f64], count: usize, of: &str| match values.len() {
        1 => Ok(vec![values[0]; count]),
        given if given == count => Ok(values.to_vec()),
        given => Err(Problem::at(option, format_args!("{given} values"))
            .expected(format_args!("one for all, or {count}: one for each {of}"))),
    };
    let frequencies_hz = each("--frequency-hz", &taking.frequencies_hz, count, "recording")?;
    let positions_m = match taking.positions_m.is_empty() {
        true => vec![None; sets],
        false => each("--position-m", &taking.positions_m, sets, "set")?.into_iter().map(Some).collect(),
    };
    let velocities_m_s = each("--velocity-m-s", &taking.velocities_m_s, sets, "set")?;
    let offsets_rad = each("--offset-deg", &taking.phase_offsets_rad, sets, "set")?;
    let sets_each = sets / count;
    let times_s = taking.frame_times_s.as_ref().map(|times_s| relative(times_s, stack, count)).transpose()?;
    let of_recording = |number: usize, frequency_hz: f64| {
        let codes = stack.codes()[number * sets_each * frames * geometry.pixels()..]
            [..sets_each * frames * geometry.pixels()]
            .to_vec();
        let raw = RawSets::new(geometry, frames, codes).ok_or_else(nothing)?;
        let times_s = times_s
            .as_ref()
            .map(|times_s| times_s[number * sets_each * frames..][..sets_each * frames].to_vec());
        let row = |set: usize| {
            let of_all = number * sets_each + set;
            SetRow {
                time_s: match &times_s {
                    Some(times_s) => times_s[set * frames],
                    None => set as f64 * taking.set_period_s,
                },
                position_m: positions_m[of_all],
                velocity_m_s: velocities_m_s[of_all],
                phase_offset_rad: offsets_rad[of_all],
                extra: Vec::new(),
            }
        };
        let folder = taking.names.get(number).map_or_else(|| out.to_owned(), |name| out.join(name));
        let name = folder.file_name().map(|name| name.to_string_lossy().into_owned());
        Ok(Recording {
            name: name.unwrap_or_default(),
            folder,
            kind: taking.kind,
            frequency_hz,
            steps_rad: taking.steps_rad.clone(),
            frame_period_s: taking.frame_period_s,
            raw,
            sets: (0..sets_each).map(row).collect(),
            extra_columns: Vec::new(),
            mask: None,
            frame_times_s: times_s.clone(),
            camera: camera.cloned(),
        })
    };
    (0..).zip(frequencies_hz).map(|(number, frequency_hz)| of_recording(number, frequency_hz)).collect()
}

/// How many sets of `frames` frames there are; the frames must be whole sets.
fn whole_sets(stack: &Stack, frames: usize) -> Result<usize> {
    let (held, files) = (stack.frames(), stack.sources());
    let left = held % frames.max(1);
    if left == 0 && held >= frames && frames > 0 {
        return Ok(held / frames);
    }
    let (Some(first), Some(last)) = (files.first(), files.last()) else {
        return Err(Problem::at("the files", "no frames"));
    };
    let counted = format!("{held} frame{}", if held == 1 { "" } else { "s" });
    let (first, last) = (first.file.display(), last.file.display());
    let found = match files.len() {
        1 => format!("{counted} in {first}"),
        count => format!("{counted} in {count} files, from {first} to {last}"),
    };
    let problem = Problem::at("the files", found).expected(format_args!("a multiple of --steps {frames}"));
    let missing = frames - left;
    Err(match held / frames.max(1) {
        0 => problem.remedy(format_args!("name all files of a set ({missing} missing), or correct --steps")),
        _ => problem.remedy(format_args!(
            "leave out {left} (a white picture at the end?), add {missing}, or correct --steps"
        )),
    })
}

/// Times from the start of each of `count` recordings on.
fn relative(times_s: &[f64], stack: &Stack, count: usize) -> Result<Vec<f64>> {
    let frames = stack.frames();
    if times_s.len() != frames {
        return Err(Problem::at("--frame-times", format_args!("{} times", times_s.len()))
            .expected(format_args!("{frames}, one for each frame")));
    }
    let mut all = Vec::with_capacity(frames);
    for (number, of_recording) in (0..).zip(times_s.chunks(frames / count)) {
        if let Some(at) = of_recording.windows(2).position(|pair| pair[1] < pair[0]) {
            let frame = number * (frames / count) + at + 1;
            return Err(Problem::at("--frame-times", format_args!("{} s at frame {frame}", times_s[frame]))
                .expected(format_args!("not before the frame before it, at {} s", times_s[frame - 1])));
        }
        all.extend(of_recording.iter().map(|time_s| time_s - of_recording[0]));
    }
    Ok(all)
}
