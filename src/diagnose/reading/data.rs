//! A campaign as the fit sees it: frames above the pedestal, which samples count, and what the encoder said of each.

use super::backgrounds::at_one_frequency;
use super::grid::Grid;
use super::included::Unpredicted;
use super::places::with_places;
use super::together::check_together;
use crate::bench::{Course, camera_effects};
use crate::frames::Geometry;
use crate::physics::{Active, Effect, Moment, effects};
use crate::problem::{Problem, Result};
use crate::recording::{Camera, Recording};
use serde::Serialize;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A recording's frames.
#[derive(Debug, Clone)]
pub struct Take {
    /// The recording's name.
    pub name: String,
    /// Every frame, in the order `[set, frame]`.
    pub moments: Vec<Moment>,
    /// Frames a set.
    pub frames: usize,
    /// Effects that the camera's simulation includes, with values, but for those of `unpredicted`.
    pub included: Vec<Active>,
    /// Signals above the pedestal, DN, `[frame, pixel]`; NaN where a sample does not count.
    pub signal_dn: Vec<f32>,
}

/// Recordings of one camera.
#[derive(Debug, Clone)]
pub struct Data {
    /// What the simulation of the camera includes, as if it had no pixels but those that are looked at.
    pub camera: Camera,
    /// The same, as it was described.
    pub described: Camera,
    /// The pixels that are looked at.
    pub grid: Grid,
    /// The recordings, by name.
    pub takes: Vec<Take>,
    /// Which pixels see the target.
    pub target: Vec<bool>,
    /// Low bits that no code of any recording has set.
    pub cut_bits: u32,
    /// What the camera's simulation includes that no prediction shows.
    pub unpredicted: Unpredicted,
    /// Effects that may be found beside those of the registry.
    pub library: Vec<&'static Effect>,
    /// What was taken for granted, as no file says it.
    pub assumed: Assumed,
    /// Of a grid with gaps, pixels without gaps: what neighbours make is seen there alone.
    pub close: Option<Arc<Self>>,
    /// What they show of the camera's light.
    light: SeenLight,
}

/// What recordings may leave out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Assumed {
    /// There is no camera.toml: no pedestal, a sinusoidal correlation, and noise as the recordings show it.
    pub camera: bool,
    /// No set has a position: the scene stands still, and each pixel sees its own part of it.
    pub still_scene: bool,
}

/// Above so many codes below full scale a sample is clipped, or about to be.
pub const CLIPPED_DN: u32 = 2;

/// Numbers that each pixel has at least: amplitude, phase, and light that does not follow the modulation.
const LEAST_OWN: usize = 3;
/// Places that differ by less of themselves are one: light goes with the square of the distance.
const ONE_PLACE: f64 = 0.01;

/// Phases that are as near are one.
pub const SAME_PHASE_RAD: f64 = 1e-6;

/// What recordings show of the camera's light.
#[derive(Debug, Clone, Copy)]
struct SeenLight {
    /// In some frames there is ambient light alone.
    is_once_off: bool,
    /// It comes from different distances, beyond what readings of one scatter by.
    moves: bool,
}

impl SeenLight {
    fn of(takes: &[Take]) -> Self {
        let moments = || takes.iter().flat_map(|take| &take.moments);
        let places_m = || moments().filter(|moment| moment.lit).map(Moment::commanded_m);
        let [least_m, most_m] = [places_m().fold(f64::INFINITY, f64::min), places_m().fold(0.0, f64::max)];
        let is_once_off = moments().any(|moment| !moment.lit && moment.transmission > 0.0);
        Self { is_once_off, moves: most_m > (1.0 + ONE_PLACE) * least_m }
    }
}

impl Data {
    /// The recordings of one campaign, in which effects of `library` may be found besides.
    ///
    /// # Errors
    /// No recording, no camera, recordings that do not belong together, and a set of which nothing can be simulated.
    pub fn of(recordings: &[Recording], library: Vec<&'static Effect>) -> Result<Self> {
        let Some(first) = recordings.first() else {
            return Err(Problem::at("diagnosis", "no recording")
                .expected("a recording, or a campaign of recordings")
                .remedy("give a folder with recording.toml, or one that has such folders"));
        };
        let camera = first.camera.clone().unwrap_or_else(|| {
            let adc_bits = recordings.iter().map(Recording::adc_bits).max().unwrap_or(16);
            Camera::assumed(first.geometry(), adc_bits)
        });
        let has_position = |recording: &Recording| recording.sets.iter().any(|row| row.position_m.is_some());
        let assumed =
            Assumed { camera: first.camera.is_none(), still_scene: !recordings.iter().any(has_position) };
        let geometry = first.geometry();
        check_together(recordings, &camera)?;
        let sees_target = |pixel: usize| !assumed.still_scene && first.sees_target(pixel);
        let target: Vec<bool> = (0..geometry.pixels()).map(sees_target).collect();
        let frames = recordings.iter().map(|recording| recording.raw.codes().len() / geometry.pixels()).sum();
        let grid = Grid::of(geometry, frames);
        let seen = |grid| Self::seen(recordings, &camera, &library, assumed, &target, grid);
        let close = grid.close(&target).map(seen).transpose()?;
        let data = Self { close: close.map(Arc::new), ..seen(grid)? };
        if data.unpredicted.bits_cut > data.cut_bits {
            let found = format!(
                "codes have bits below the {} that camera.toml says are cut off (fixed_point)",
                data.unpredicted.bits_cut
            );
            return Err(Problem::in_file(&first.folder, found)
                .expected(format_args!("{} bits cut at most", data.cut_bits))
                .remedy("correct physics.effects of camera.toml"));
        }
        if data.free_shares().into_iter().all(|share| share <= 0.0) {
            let samples = data.samples_of_pixels().into_iter().max().unwrap_or(0);
            if samples == 0 {
                return Err(Problem::in_file(
                    &first.folder,
                    "no sample counts: all codes are 0, or at full scale",
                )
                .expected("pixels that see light and are not clipped")
                .remedy("record with another exposure, or see that adc_bits is that of the converter"));
            }
            return Err(Problem::in_file(
                &first.folder,
                format_args!("no pixel has more than {samples} samples, and each has {LEAST_OWN} numbers of its own (amplitude, phase, offset) or more"),
            )
            .expected("more samples than numbers: whatever was recorded agrees with the simulation, and nothing can be tested")
            .remedy("record at least four steps a set, or sets at several distances"));
        }
        match data.phases()[..] {
            [] => Ok(data),
            ref phases if phases.len() >= LEAST_OWN || data.light.moves => Ok(data),
            ref phases => {
                let degrees: Vec<String> =
                    phases.iter().map(|phase| format!("{:.3}\u{b0}", phase.to_degrees())).collect();
                Err(Problem::in_file(&first.folder, format_args!("all phase steps are at {}", degrees.join(" and ")))
                    .expected("steps and offsets at three phases of the turn or more: fewer do not tell amplitude, phase and offset")
                    .remedy("correct phase_step_rad, or phase_steps_rad, of recording.toml (radians)"))
            }
        }
    }

    /// The phases (steps and offsets, rad, from 0 to a turn) at which the scene is seen in the camera's light.
    fn phases(&self) -> Vec<f64> {
        let mut phases: Vec<f64> =
            self.lit().map(|moment| (moment.step_rad + moment.offset_rad).rem_euclid(TAU)).collect();
        phases.sort_by(f64::total_cmp);
        phases.dedup_by(|later, earlier| *later - *earlier < SAME_PHASE_RAD);
        // The last one may be the first, a turn later.
        if phases.len() > 1 && phases[0] + TAU - phases[phases.len() - 1] < SAME_PHASE_RAD {
            phases.pop();
        }
        phases
    }

    /// The frames in the camera's light.
    pub fn lit(&self) -> impl Iterator<Item = &Moment> {
        self.takes.iter().flat_map(|take| &take.moments).filter(|moment| moment.lit)
    }

    /// How many samples of each pixel count.
    pub fn samples_of_pixels(&self) -> Vec<usize> {
        let pixels = self.pixels();
        let mut samples = vec![0; pixels];
        for frame in self.takes.iter().flat_map(|take| take.signal_dn.chunks(pixels)) {
            samples
                .iter_mut()
                .zip(frame)
                .for_each(|(samples, signal)| *samples += usize::from(!signal.is_nan()));
        }
        samples
    }

    /// Of each pixel, what share of its samples' noise is left beside its own numbers, which are fitted to them.
    pub fn free_shares(&self) -> Vec<f64> {
        let samples = self.samples_of_pixels().into_iter();
        let share =
            |(samples, own): (usize, usize)| samples.saturating_sub(own) as f64 / samples.max(1) as f64;
        samples.zip(self.own_numbers()).map(share).collect()
    }

    /// Which pixels have samples enough for their own numbers.
    pub fn are_told(&self) -> Vec<bool> {
        let samples = self.samples_of_pixels().into_iter();
        samples.zip(self.own_numbers()).map(|(samples, own)| samples >= own).collect()
    }

    /// How many numbers of its own the frames could tell of each pixel.
    fn own_numbers(&self) -> Vec<usize> {
        let is_lit = self.lit().next().is_some();
        let own = |pixel| if is_lit { LEAST_OWN + usize::from(self.tells_constant(pixel)) } else { 1 };
        (0..self.pixels()).map(own).collect()
    }

    /// The pixels of `grid`.
    fn seen(
        recordings: &[Recording],
        camera: &Camera,
        library: &[&'static Effect],
        assumed: Assumed,
        target: &[bool],
        grid: Grid,
    ) -> Result<Self> {
        let geometry = camera.geometry;
        let pixels = grid.pixels();
        let included: Vec<Vec<Active>> = recordings
            .iter()
            .map(|recording| camera_effects(camera, &recording.name, library))
            .collect::<Result<_>>()?;
        let unpredicted = Unpredicted::of(included.iter().map(Vec::as_slice));
        let mut takes = Vec::new();
        for (recording, included) in recordings.iter().zip(included) {
            let course = if assumed.still_scene { Course::still(recording) } else { Course::of(recording)? };
            let full_scale = camera.full_scale();
            let signal = |code: u32| match code {
                0 => f32::NAN,
                code if code + CLIPPED_DN > full_scale => f32::NAN,
                code => (f64::from(code) - camera.pedestal_dn) as f32,
            };
            takes.push(Take {
                name: recording.name.clone(),
                moments: with_places(course.moments()),
                frames: course.frames(),
                included: included.into_iter().filter(|active| active.effect.is_predicted()).collect(),
                signal_dn: recording
                    .raw
                    .codes()
                    .chunks_exact(geometry.pixels())
                    .flat_map(|frame| pixels.iter().map(|&pixel| signal(frame[pixel])))
                    .collect(),
            });
        }
        let target: Vec<bool> = pixels.iter().map(|&pixel| target[pixel]).collect();
        if !assumed.still_scene {
            at_one_frequency(&mut takes, &target);
        }
        let light = SeenLight::of(&takes);
        let union = recordings.iter().flat_map(|r| r.raw.codes()).fold(0, |union, code| union | code);
        let cut_bits = if union == 0 { 0 } else { union.trailing_zeros() };
        Ok(Self {
            camera: Camera { geometry: grid.geometry(), ..camera.clone() },
            described: camera.clone(),
            grid,
            takes,
            target,
            cut_bits,
            unpredicted,
            library: library.to_vec(),
            assumed,
            close: None,
            light,
        })
    }

    /// The same with only those samples of which `counts` (number of the frame over all recordings, pixel) is true.
    pub fn only(&self, counts: impl Fn(usize, usize) -> bool) -> Self {
        let mut data = self.clone();
        let pixels = self.pixels();
        let frames = data.takes.iter_mut().flat_map(|take| take.signal_dn.chunks_mut(pixels));
        for (frame, signals) in frames.enumerate() {
            for (pixel, signal) in signals.iter_mut().enumerate() {
                if !counts(frame, pixel) {
                    *signal = f32::NAN;
                }
            }
        }
        data
    }

    /// All sets: recording, and number of the set within it.
    pub fn sets(&self) -> Vec<(usize, usize)> {
        let of = |(take, recording): (usize, &Take)| {
            (0..recording.moments.len() / recording.frames).map(move |set| (take, set))
        };
        self.takes.iter().enumerate().flat_map(of).collect()
    }

    /// How many frames a set may have, ascending: each number once.
    pub fn schemes(&self) -> Vec<usize> {
        let mut frames: Vec<usize> = self.takes.iter().map(|take| take.frames).collect();
        frames.sort_unstable();
        frames.dedup();
        frames
    }

    /// Radial distance over axial distance of every pixel that is looked at: where it is on the whole sensor counts.
    pub fn obliquities(&self) -> Vec<f64> {
        let all = self.described.obliquities();
        self.grid.pixels().into_iter().map(|pixel| all[pixel]).collect()
    }

    /// The pixels that are looked at.
    pub fn geometry(&self) -> Geometry {
        self.camera.geometry
    }

    /// Mean signal of the samples that count, DN.
    pub fn typical_signal_dn(&self) -> f64 {
        let signals =
            || self.takes.iter().flat_map(|take| &take.signal_dn).filter(|signal| signal.is_finite());
        signals().map(|&signal| f64::from(signal)).sum::<f64>() / signals().count().max(1) as f64
    }

    /// Whether all of the scene is in the same place in all recordings, as far as positions tell.
    pub fn stands_still(&self) -> bool {
        self.assumed.still_scene || !self.light.moves
    }

    /// Whether `pixel` tells its constant light from the ambient light: where the target moves, or the camera's light is once off.
    pub fn tells_constant(&self, pixel: usize) -> bool {
        self.light.is_once_off || self.target[pixel] && self.light.moves
    }

    /// The same camera with other recordings.
    #[must_use]
    pub fn with_takes(&self, takes: Vec<Take>) -> Self {
        Self { light: SeenLight::of(&takes), takes, ..self.clone() }
    }

    /// The same with this share of the strength of every effect that the camera's simulation includes.
    #[must_use]
    pub fn with_share_of_included(&self, share: f64) -> Self {
        let mut data = self.clone();
        for active in data.takes.iter_mut().flat_map(|take| &mut take.included) {
            active.values = active.effect.with_share(&active.values, share);
        }
        data
    }

    /// The same without the effect called `name` in the camera's simulation.
    #[must_use]
    pub fn without_included(&self, name: &str) -> Self {
        let mut data = self.clone();
        data.takes.iter_mut().for_each(|take| take.included.retain(|active| active.effect.name != name));
        data
    }

    /// The same with another mask, a pixel each.
    #[must_use]
    pub fn with_target(&self, target: Vec<bool>) -> Self {
        let mut data = Self { target, ..self.clone() };
        at_one_frequency(&mut data.takes, &data.target);
        data
    }

    /// The same with these sets (numbers over all recordings) left out; nothing where there are none.
    pub fn without(&self, sets: &[usize]) -> Option<Self> {
        if sets.is_empty() {
            return None;
        }
        let mut data = self.clone();
        let places = self.sets();
        for &(take, set) in sets.iter().filter_map(|&number| places.get(number)) {
            let take = &mut data.takes[take];
            let samples = take.frames * self.target.len();
            take.signal_dn[set * samples..(set + 1) * samples].fill(f32::NAN);
        }
        Some(data)
    }

    /// The effect called `name`, of the registry or the library.
    pub fn effect(&self, name: &str) -> Option<&'static Effect> {
        effects::named_among(name, &self.library)
    }

    /// What codes are rounded to, DN, without the low bits that are never set.
    pub fn unit_dn(&self) -> f64 {
        f64::from(1_u32 << self.cut_bits.min(16))
    }

    /// Number of pixels.
    pub fn pixels(&self) -> usize {
        self.geometry().pixels()
    }
}
