//! The options that both kinds of import have: files, steps, times, and what else pictures do not tell.

use super::super::option::{each_once, in_range};
use super::camera::{CameraArguments, Known};
use crate::import::{Levels, Taking};
use crate::problem::{Problem, Result};
use crate::recording::Kind;
use clap::Args;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

/// Files and how their frames were taken.
#[derive(Debug, Args)]
pub(super) struct Frames {
    /// Files of frames
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Folder of the new recording, or of the campaign of them
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Frames a set: the phase steps of one measurement
    #[arg(long, value_name = "N")]
    steps: usize,
    /// Phase step from a frame to the next, degrees (30, -90, 360/7); or the step of each of the N frames, with commas
    #[arg(long, value_name = "DEG", value_delimiter = ',', required = true, allow_hyphen_values = true, value_parser = degrees)]
    step_deg: Vec<f64>,
    /// How many recordings of equally many sets, or their names, with commas [default: one, of all sets]
    #[arg(long, value_name = "K|NAME,…", value_delimiter = ',')]
    recordings: Vec<String>,
    /// Modulation frequency, Hz, which a recording needs; one, or one for each recording, with commas
    #[arg(long, value_name = "HZ", value_delimiter = ',')]
    frequency_hz: Vec<f64>,
    /// From the start of a frame to the start of the next, s, which a recording needs [default: the mean of --frame-times]
    #[arg(long, value_name = "S")]
    frame_period_s: Option<f64>,
    /// From the start of a set to the start of the next, s [default: N frame periods]
    #[arg(long, value_name = "S", conflicts_with = "frame_times")]
    set_period_s: Option<f64>,
    /// A text with the start of every frame, s, one a line
    #[arg(long, value_name = "FILE")]
    frame_times: Option<PathBuf>,
    /// What was recorded: phase_sweep, rail, motion, dark, harmonics, other
    #[arg(long, value_name = "KIND", default_value = "other")]
    kind: String,
    /// Distance of the target along the axis, m; one, or one for each set, with commas
    #[arg(long, value_name = "M", value_delimiter = ',', allow_hyphen_values = true)]
    position_m: Vec<f64>,
    /// Velocity of the target, m/s, positive away from the camera; one, or one for each set, with commas
    #[arg(long, value_name = "M/S", value_delimiter = ',', default_value = "0", allow_hyphen_values = true)]
    velocity_m_s: Vec<f64>,
    /// What is added to a set's phase steps, degrees; one, or one for each set, with commas
    #[arg(long, value_name = "DEG", value_delimiter = ',', default_value = "0", allow_hyphen_values = true, value_parser = degrees)]
    offset_deg: Vec<f64>,
    /// Take the files in the order in which they are named, instead of the natural order of their names
    #[arg(long)]
    pub as_given: bool,
    /// Factor on the numbers of the files, which are then rounded to the nearest code
    #[arg(long, value_name = "FACTOR")]
    scale: Option<f64>,
    /// Whole code that is added to all numbers (after --scale)
    #[arg(long, value_name = "CODE", default_value_t = 0, allow_hyphen_values = true)]
    add: i32,
    /// Code from which on the camera saturates, where that is below the ADC's greatest code, which such codes become
    #[arg(long, value_name = "CODE")]
    saturation_code: Option<u32>,
    #[command(flatten)]
    pub camera: CameraArguments,
}

/// `30`, `-90`, `360/7`.
fn degrees(text: &str) -> std::result::Result<f64, String> {
    let (over, under) = text.split_once('/').unwrap_or((text, "1"));
    match (over.trim().parse::<f64>(), under.trim().parse::<f64>()) {
        (Ok(over), Ok(under)) if (over / under).is_finite() => Ok(over / under),
        _ => Err("expected degrees, such as 30, -90 or 360/7".to_owned()),
    }
}

impl Frames {
    /// How numbers become codes.
    pub fn levels(&self, known: &Known) -> Result<Levels> {
        let levels = Levels {
            scale: self.scale,
            add: f64::from(self.add),
            adc_bits: known.adc_bits(),
            saturation_code: self.saturation_code,
        };
        if let Some(scale) = self.scale {
            in_range("--scale", scale, &(1e-9..=1e9))?;
        }
        let greatest = levels.greatest();
        match self.saturation_code {
            Some(_) if levels.adc_bits.is_none() => {
                Err(Problem::at("--saturation-code", "given without --adc-bits")
                    .expected("--adc-bits, too: clipped codes become the ADC's greatest"))
            }
            Some(code) if !(1..=greatest).contains(&code) => Err(Problem::at("--saturation-code", code)
                .expected(format_args!("a code from 1 to {greatest}, the ADC's greatest"))),
            _ => Ok(levels),
        }
    }

    /// How the frames were taken. Ranges are those of the format.
    pub fn taking(&self) -> Result<Taking> {
        let kind = Kind::named(&self.kind).ok_or_else(|| {
            Problem::at("--kind", &self.kind).expected(format_args!("one of {}", Kind::names()))
        })?;
        if self.frequency_hz.is_empty() {
            return Err(Problem::at("--frequency-hz", "is missing")
                .expected("the modulation frequency, 1e4 to 1e10 Hz: a recording needs it, and frames do not tell it")
                .remedy(
                    "where nothing is modulated (projected fringes), any will do: phases are the same, but distances \
                     mean nothing",
                ));
        }
        let frame_times_s = self.frame_times.as_deref().map(times_s).transpose()?;
        let frame_period_s = match (self.frame_period_s, &self.frame_times, &frame_times_s) {
            (Some(period_s), ..) => period_s,
            (None, Some(file), Some(times_s)) => mean_period_s(times_s, self.steps).ok_or_else(|| {
                Problem::in_file(file, "tells no time from a frame of a set to the next")
                    .expected("times that grow from frame to frame, of sets of two frames or more")
                    .remedy("correct them, or give --frame-period-s, too")
            })?,
            _ => {
                return Err(Problem::at("--frame-period-s", "is missing")
                    .expected("s from the start of a frame to the start of the next: a recording needs it, and frames do not tell it")
                    .remedy("--frame-times FILE says it, too, where the start of every frame was recorded"));
            }
        };
        let all = |option: &str, values: &[f64], allowed: RangeInclusive<f64>| {
            values.iter().try_for_each(|&value| in_range(option, value, &allowed))
        };
        let set_period_s = self.set_period_s.unwrap_or(self.steps as f64 * frame_period_s);
        all("--frequency-hz", &self.frequency_hz, 1e4..=1e10)?;
        all("--frame-period-s", &[frame_period_s], 1e-9..=1e6)?;
        all("--set-period-s", &[set_period_s], 0.0..=1e9)?;
        all("--position-m", &self.position_m, 0.0..=1e6)?;
        all("--velocity-m-s", &self.velocity_m_s, -1e4..=1e4)?;
        all("--offset-deg", &self.offset_deg, -1e6..=1e6)?;
        Ok(Taking {
            kind,
            steps_rad: self.steps_rad()?,
            frequencies_hz: self.frequency_hz.clone(),
            frame_period_s,
            set_period_s,
            frame_times_s,
            positions_m: self.position_m.clone(),
            velocities_m_s: self.velocity_m_s.clone(),
            phase_offsets_rad: self.offset_deg.iter().map(|degrees| degrees.to_radians()).collect(),
            names: self.names()?,
        })
    }

    fn steps_rad(&self) -> Result<Vec<f64>> {
        if !(1..=65_536).contains(&self.steps) {
            return Err(Problem::at("--steps", self.steps).expected("a whole number from 1 to 65536"));
        }
        const MOST_DEG: RangeInclusive<f64> = -360.0 * 65_536.0..=360.0 * 65_536.0;
        match &self.step_deg[..] {
            &[step_deg] => {
                in_range("--step-deg", step_deg, &(-360.0..=360.0))?;
                let step_rad = step_deg.to_radians();
                Ok((0..self.steps).map(|n| n as f64 * step_rad).collect())
            }
            of_each if of_each.len() == self.steps => of_each
                .iter()
                .map(|&deg| in_range("--step-deg", deg, &MOST_DEG).map(|()| deg.to_radians()))
                .collect(),
            of_each => Err(Problem::at("--step-deg", format_args!("{} values", of_each.len())).expected(
                format_args!(
                    "one, the step from a frame to the next, or {}: one for each of --steps",
                    self.steps
                ),
            )),
        }
    }

    /// Names of the recordings; none for the one that holds all sets.
    fn names(&self) -> Result<Vec<String>> {
        let refuse = |found: &str, expected: &str| Err(Problem::at("--recordings", found).expected(expected));
        if let [count] = &self.recordings[..]
            && count.bytes().all(|byte| byte.is_ascii_digit())
        {
            return match count.parse::<usize>() {
                Ok(1) => Ok(Vec::new()),
                Ok(count @ 2..=65_536) => {
                    let digits = count.to_string().len();
                    Ok((1..=count).map(|number| format!("recording-{number:0digits$}")).collect())
                }
                _ => refuse(count, "from 1 to 65536 recordings, or their names"),
            };
        }
        let is_plain = |c: char| c.is_alphanumeric() || "-_.".contains(c);
        for name in &self.recordings {
            if name.is_empty()
                || name.starts_with('.')
                || !name.chars().all(is_plain)
                || name == "camera.toml"
            {
                return refuse(name, "names of letters, digits, -, _ and ., for folders");
            }
        }
        each_once("--recordings", "name", self.recordings.iter().map(String::as_str))?;
        Ok(self.recordings.clone())
    }
}

/// Mean time from one frame of a set of `frames` to the next; `None` where that is nothing.
fn mean_period_s(times_s: &[f64], frames: usize) -> Option<f64> {
    let within: Vec<f64> =
        times_s.chunks(frames.max(1)).flat_map(|set| set.windows(2).map(|pair| pair[1] - pair[0])).collect();
    let mean_s = within.iter().sum::<f64>() / within.len() as f64;
    (mean_s > 0.0).then_some(mean_s)
}

/// The numbers in the text `file`, one a line.
fn times_s(file: &Path) -> Result<Vec<f64>> {
    let text = std::fs::read_to_string(file).map_err(|error| Problem::io(file, "read", &error))?;
    let lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty());
    let time_s = |(number, line): (usize, &str)| {
        let time_s = line.trim().parse().ok().filter(|time_s| (-1e9..=1e9).contains(time_s));
        time_s.ok_or_else(|| {
            Problem::at(format_args!("{}, line {number}", file.display()), format_args!("\"{line}\""))
                .expected("the start of a frame: a number from -1e9 to 1e9 s")
        })
    };
    lines.map(time_s).collect()
}
