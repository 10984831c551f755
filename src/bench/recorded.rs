//! A simulated recording, as it would be read.

use super::camera::{chain, practice_camera, sensor};
use super::course::Course;
use super::plan::Plan;
use super::simulation::{Simulation, simulate};
use crate::frames::Geometry;
use crate::physics::{Active, Stage};
use crate::problem::Result;
use crate::recording::{Camera, Recording};
use std::path::Path;
use std::sync::Arc;

/// The recording called `name` (of [`Plan::names`]) in the folder of a `campaign`, with the frames of `simulation`, whose recording number is
/// that of the name. `tell` hears of every set that is done.
///
/// # Errors
/// As [`simulate`].
pub fn recorded(
    campaign: &Path,
    name: &str,
    plan: &Plan,
    course: &Course,
    camera: &Camera,
    simulation: &Simulation,
    tell: &(dyn Fn() + Sync),
) -> Result<Recording> {
    Ok(Recording {
        folder: campaign.join(name),
        name: name.to_owned(),
        kind: course.kind,
        frequency_hz: course.frequency_hz,
        steps_rad: course.steps_rad.clone(),
        frame_period_s: course.frame_period_s,
        raw: simulate(simulation, course, tell)?,
        sets: plan.as_read(course, simulation.recording),
        extra_columns: Vec::new(),
        mask: Some(simulation.chain.pixels.target.clone()),
        frame_times_s: course.frame_times_s.clone(),
        camera: Some(camera.clone()),
    })
}

/// The recordings called `names` (of [`Plan::names`]) that the usual camera, of this `size`, takes of the usual bench as is [usual](Plan::usual), with noise and
/// with `effects` that it does not tell, everything drawn by `seed`.
///
/// # Errors
/// As [`Plan::course`] and [`simulate`].
pub fn taken(size: Geometry, seed: u64, effects: &[Active], names: &[&str]) -> Result<Vec<Recording>> {
    let (camera, plan) = (practice_camera(size), Plan::usual(seed));
    let sensor = sensor(&camera);
    let pixels = Arc::new(Stage::bench().pixels(&sensor, seed));
    let chain = chain(&camera, pixels, effects.to_vec());
    let take = |name: &&str| {
        let recording = number_of(name);
        let simulation = Simulation { chain: &chain, sensor: &sensor, noise: true, seed, recording };
        recorded(Path::new("simulated"), name, &plan, &plan.course(name)?, &camera, &simulation, &|| ())
    };
    names.iter().map(take).collect()
}

/// The number of the recording called `name`: the same recording has the same noise, whichever others are taken.
pub fn number_of(name: &str) -> u32 {
    Plan::names().iter().position(|known| known == name).unwrap_or(0) as u32
}
