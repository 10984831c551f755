//! A world's campaign as recordings.

use super::exposure::movie;
use super::flaws::Flaw;
use super::world::{Known, World};
use crate::frames::RawSets;
use crate::recording::{AXIAL_MOTION, Camera, INVERSE_SQUARE_FALLOFF, Recording, SetRow};
use std::path::PathBuf;

/// Decimals with which a waveform is told.
const TOLD: f64 = 1e7;

/// What the camera's simulation knows.
pub fn camera(world: &World, known: Known) -> Camera {
    let (amplitude, phase_rad) = world.waveform.harmonics();
    let told = |numbers: Vec<f64>| numbers.into_iter().map(|value| (value * TOLD).round() / TOLD).collect();
    let included = [(known.motion, AXIAL_MOTION), (known.falloff, INVERSE_SQUARE_FALLOFF)];
    Camera {
        geometry: world.scene.geometry,
        adc_bits: world.sensor.adc_bits,
        pedestal_dn: world.sensor.pedestal_dn,
        gain_e_per_dn: world.sensor.gain_e_per_dn,
        read_noise_e: world.sensor.read_noise_e,
        focal_length_px: world.sensor.focal_length_px,
        correlation_amplitude: told(amplitude),
        correlation_phase_rad: told(phase_rad),
        included_physics: included
            .into_iter()
            .filter(|(known, _)| *known)
            .map(|(_, name)| name.to_owned())
            .collect(),
        effects: Vec::new(),
    }
}

/// The recordings of `world` with `flaws`, by a camera whose simulation knows `known`; noise follows from `seed`.
pub fn recordings(world: &World, known: Known, flaws: &[&Flaw], seed: u64) -> Vec<Recording> {
    let frames = movie(world, Known::BOTH, flaws, Some(seed));
    let mut codes = frames.into_iter().map(|frame| frame.into_iter().map(|code| code as u32));
    let camera = camera(world, known);
    let mut recordings = Vec::new();
    for take in &world.takes {
        let count = take.rows.len() * take.steps_rad.len();
        let codes: Vec<u32> = codes.by_ref().take(count).flatten().collect();
        let Some(raw) = RawSets::new(world.scene.geometry, take.steps_rad.len(), codes) else { continue };
        let row = |row: &super::plan::Row| SetRow {
            time_s: row.time_s,
            position_m: Some(row.reading_m),
            velocity_m_s: row.velocity_m_s,
            phase_offset_rad: row.offset_rad,
            extra: Vec::new(),
        };
        recordings.push(Recording {
            folder: PathBuf::new(),
            name: take.name.clone(),
            kind: take.kind,
            frequency_hz: world.frequency_hz,
            steps_rad: take.steps_rad.clone(),
            frame_period_s: take.period_s,
            raw,
            sets: take.rows.iter().map(row).collect(),
            extra_columns: Vec::new(),
            mask: Some(world.scene.mask()),
            frame_times_s: None,
            camera: Some(camera.clone()),
        });
    }
    recordings
}
