//! `vuris simulate`

use super::campaign::remark_on_physics;
use super::library::effects_in;
use super::option::{each_once, in_range};
use super::print::{counted, remark, say};
use super::progress;
use crate::bench::{
    Course, Plan, Simulation, camera_effects, chain, included_without, injection_for, number_of,
    practice_camera, recorded, sensor, simulate, specification_of,
};
use crate::frames::Geometry;
use crate::physics::{Active, Chain, Correlation, EFFECTS, FREQUENCY_HZ, Pulse, Sensor, Stage};
use crate::problem::{Problem, Result};
use crate::recording::{Camera, Kind, write_camera, write_recording};
use clap::Args;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Simulate a campaign of recordings: a target on a rail before a camera, with any physical effects that its camera.toml does not tell
#[derive(Debug, Args)]
pub(super) struct Simulate {
    /// Folder of the new campaign
    #[arg(long, value_name = "DIR", required_unless_present = "frames_per_second")]
    out: Option<PathBuf>,
    /// An effect that the camera's simulation lacks, at its typical size or with values; may be repeated. fixed_point:pipeline=SPEC
    /// cuts the bits for which the specification SPEC (a preset or a TOML file) has no place
    #[arg(long, value_name = "NAME[:PARAMETER=VALUE,…]")]
    effect: Vec<String>,
    /// Effects of your own, as formulas, for --effect and for what the camera includes
    #[arg(long, value_name = "FILE.toml")]
    library: Option<PathBuf>,
    /// The camera; without it, a small one of 12 bits
    #[arg(long, value_name = "camera.toml")]
    camera: Option<PathBuf>,
    /// Light in time, instead of the camera's table of harmonics: duty, edge in s, bandwidth in Hz
    #[arg(long, value_name = "DUTY,EDGE_S,BANDWIDTH_HZ", requires = "demodulation", value_parser = pulse)]
    light: Option<Pulse>,
    /// Demodulation in time
    #[arg(long, value_name = "DUTY,EDGE_S,BANDWIDTH_HZ", requires = "light", value_parser = pulse)]
    demodulation: Option<Pulse>,
    /// The constant part of the camera's own light over its modulated part; without it, 2.2, or what the pulses give
    #[arg(long, value_name = "RATIO")]
    constant_ratio: Option<f64>,
    /// Columns and rows, behind the same lens; without it, the camera's
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<Geometry>,
    /// Seed of everything that is drawn
    #[arg(long, default_value_t = 2012)]
    seed: u64,
    /// Which recordings, with commas; without it, all
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    recordings: Vec<String>,
    /// Of the motion recordings only the runs at these velocities, with commas; without it, all: ±0.5, ±1 and ±2 m/s
    #[arg(long, value_name = "M/S", value_delimiter = ',', allow_negative_numbers = true)]
    velocities_m_s: Vec<f64>,
    /// Modulation frequency, Hz
    #[arg(long, value_name = "HZ", default_value_t = FREQUENCY_HZ)]
    frequency_hz: f64,
    /// From the start of a frame to the start of the next, s
    #[arg(long, value_name = "S", default_value_t = 0.025)]
    frame_period_s: f64,
    /// Print how fast this machine simulates sets of 160 x 120 x 5, and nothing else
    #[arg(long, conflicts_with = "out")]
    frames_per_second: bool,
}

/// Reads `0.45,2e-9,60e6`; edge and bandwidth may be left out.
fn pulse(text: &str) -> std::result::Result<Pulse, String> {
    let numbers: Vec<f64> = text
        .split(',')
        .map(|part| part.trim().parse().map_err(|_| format!("{part} is no number")))
        .collect::<std::result::Result<_, _>>()?;
    match numbers[..] {
        [duty] => Ok(Pulse { duty, ..Pulse::SQUARE }),
        [duty, edge_s] => Ok(Pulse { duty, edge_s, ..Pulse::SQUARE }),
        [duty, edge_s, bandwidth_hz] => Ok(Pulse { duty, edge_s, bandwidth_hz }),
        _ => Err("expected one to three numbers: duty, edge in s, bandwidth in Hz".to_owned()),
    }
}

fn size(text: &str) -> std::result::Result<Geometry, String> {
    let sides =
        text.split_once('x').and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    match sides {
        Some((width @ 1..=4096, height @ 1..=4096)) => Ok(Geometry { width, height }),
        _ => Err("expected columns x rows, each from 1 to 4096, such as 160x120".to_owned()),
    }
}

/// A recording's codes in memory, bytes at most: all of it is made before it is written.
const MOST_BYTES: u64 = 2_000_000_000;

/// Refuses a recording that is too large for memory.
fn bounded(name: &str, course: &Course, geometry: Geometry) -> Result<()> {
    let Geometry { width, height } = geometry;
    let samples = (width as u64 * height as u64).saturating_mul(course.count() as u64);
    let bytes = samples.saturating_mul(size_of::<u32>() as u64);
    if bytes <= MOST_BYTES {
        return Ok(());
    }
    let gigabytes = bytes as f64 / 1e9;
    let found =
        format!("{name}: {} frames of {width} x {height} are {gigabytes:.1} GB of codes", course.count());
    Err(Problem::at("--size, --recordings", found)
        .expected(format_args!("at most {} GB a recording", MOST_BYTES / 1_000_000_000))
        .remedy("a smaller sensor (--size), or recordings of fewer frames (--recordings)"))
}

/// Harmonics of a waveform that is given in time.
const HARMONICS: u32 = 15;

impl Simulate {
    pub(super) fn run(self) -> Result<ExitCode> {
        if self.frames_per_second {
            return frames_per_second();
        }
        let out = self.out.as_deref().unwrap_or(Path::new("."));
        let camera = self.described_camera()?;
        remark_on_physics(&camera);
        let library = effects_in(self.library.as_deref())?;
        let effects: Vec<Active> = self
            .effect
            .iter()
            .map(|text| injection_for(text, camera.adc_bits, &library))
            .collect::<Result<_>>()?;
        each_once("--effect", "effect", effects.iter().map(|active| active.effect.name))?;
        if let Some(ratio) = self.constant_ratio {
            in_range("--constant-ratio", ratio, &(0.0..=100.0))?;
        }
        in_range("--frequency-hz", self.frequency_hz, &(1e4..=1e10))?;
        in_range("--frame-period-s", self.frame_period_s, &(1e-6..=100.0))?;
        let (camera, sensor) = self.camera(camera, &effects)?;
        let plan =
            Plan { frequency_hz: self.frequency_hz, frame_period_s: self.frame_period_s, seed: self.seed };
        let names = if self.recordings.is_empty() { Plan::names() } else { self.recordings.clone() };
        each_once("--recordings", "recording", names.iter().map(String::as_str))?;
        let courses: Vec<Course> =
            names.iter().map(|name| self.at_velocities(name, plan.course(name)?)).collect::<Result<_>>()?;
        if let Some(present) = names.iter().map(|name| out.join(name)).find(|folder| folder.exists()) {
            return Err(Problem::in_file(&present, "is there already").expected("a new campaign"));
        }
        for (name, course) in names.iter().zip(&courses) {
            bounded(name, course, camera.geometry)?;
        }
        let pixels = Arc::new(Stage::bench().pixels(&sensor, self.seed));
        let chains: Vec<Chain> = names
            .iter()
            .map(|name| {
                let mut all = camera_effects(&camera, name, &library)?;
                all.extend(effects.iter().cloned());
                Ok(chain(&camera, Arc::clone(&pixels), all))
            })
            .collect::<Result<_>>()?;
        for (text, active) in
            self.effect.iter().zip(&effects).filter(|(text, _)| specification_of(text).is_some())
        {
            let cut = active.values[0];
            say!("{text}: cuts {cut} of the camera's {} bits", camera.adc_bits);
        }
        for (text, _) in self.effect.iter().zip(&effects).filter(|(_, active)| active.is_off()) {
            remark(format_args!("{text}: every strength is off, so that this effect is absent"));
        }
        write_camera(&camera, out)?;
        for ((name, course), chain) in names.iter().zip(&courses).zip(&chains) {
            let recording = number_of(name);
            let simulation = Simulation { chain, sensor: &sensor, noise: true, seed: self.seed, recording };
            let recording = progress::counted("sets", |tell| {
                let done = AtomicUsize::new(0);
                recorded(out, name, &plan, course, &camera, &simulation, &|| {
                    tell(done.fetch_add(1, Ordering::Relaxed) + 1, course.sets.len())
                })
            })?;
            write_recording(&recording, &out.join(name))?;
            say!("{name}: {} of {} frames", counted(course.sets.len(), "set"), course.frames());
        }
        say!("written: {}", out.display());
        Ok(ExitCode::SUCCESS)
    }

    /// The camera that the command line names.
    fn described_camera(&self) -> Result<Camera> {
        match &self.camera {
            Some(path) => Camera::read(path),
            None => Ok(practice_camera(Geometry { width: 24, height: 18 })),
        }
    }

    /// `course`, of a motion recording only the sets at the velocities that were asked for.
    fn at_velocities(&self, name: &str, mut course: Course) -> Result<Course> {
        if course.kind == Kind::Motion && !self.velocities_m_s.is_empty() {
            course.sets.retain(|row| self.velocities_m_s.contains(&row.velocity_m_s));
        }
        if course.sets.is_empty() {
            let found = format!("{name} has no run at {:?} m/s", self.velocities_m_s);
            return Err(Problem::at("--velocities-m-s", found).expected("some of ±0.5, ±1 and ±2 m/s"));
        }
        Ok(course)
    }

    /// What the campaign's camera.toml says, and the sensor with its assumed light.
    fn camera(&self, mut camera: Camera, effects: &[Active]) -> Result<(Camera, Sensor)> {
        if let Some(geometry) = self.size {
            camera = camera.resized(geometry);
        }
        let mut constant_ratio = None;
        if let (Some(light), Some(demodulation)) = (&self.light, &self.demodulation) {
            let (correlation, ratio) =
                Correlation::of_pulses(light, demodulation, self.frequency_hz, HARMONICS)?;
            camera.correlation_amplitude = correlation.harmonics().iter().map(|h| h.amplitude).collect();
            camera.correlation_phase_rad = correlation.harmonics().iter().map(|h| h.phase_rad).collect();
            constant_ratio = Some(ratio);
        }
        let sensor = sensor(&camera);
        let constant_ratio = self.constant_ratio.or(constant_ratio).unwrap_or(sensor.constant_ratio);
        let sensor = Sensor { constant_ratio, ..sensor };
        Ok((included_without(camera, effects), sensor))
    }
}

/// Sets of 160 x 120 x 5 a second with noise: without effects, and with all of them at once.
fn frames_per_second() -> Result<ExitCode> {
    const SETS: usize = 40;
    let camera = practice_camera(Geometry { width: 160, height: 120 });
    let sensor = sensor(&camera);
    let plan = Plan::usual(1);
    let mut course = plan.course("wdft-motion")?;
    course.sets.truncate(SETS);
    let pixels = Arc::new(Stage::bench().pixels(&sensor, 1));
    let every = EFFECTS.iter().map(|effect| Active { effect, values: effect.example() }).collect();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    for (what, effects) in [("no effect", Vec::new()), ("all effects at once", every)] {
        let chain: Chain = chain(&camera, Arc::clone(&pixels), effects);
        let simulation = Simulation { chain: &chain, sensor: &sensor, noise: true, seed: 1, recording: 0 };
        let began = Instant::now();
        progress::during("simulating", || simulate(&simulation, &course, &|| ()))?;
        let seconds = began.elapsed().as_secs_f64();
        let sets = course.sets.len() as f64;
        say!(
            "{what}: {:.0} frames of 160 x 120 x 5 a second, {:.0} raw frames ({threads} threads)",
            sets / seconds,
            sets * course.frames() as f64 / seconds
        );
    }
    Ok(ExitCode::SUCCESS)
}
