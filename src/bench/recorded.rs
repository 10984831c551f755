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
    taken_by(&practice_camera(size), &[Plan::usual(seed)], effects, names)
}

/// The same by `camera`, once by each of the `plans`: of the second one and those after it, recordings are called by their number, too. The scene is
/// drawn by the first one's seed.
///
/// # Errors
/// As [`Plan::course`] and [`simulate`].
pub fn taken_by(
    camera: &Camera,
    plans: &[Plan],
    effects: &[Active],
    names: &[&str],
) -> Result<Vec<Recording>> {
    let sensor = sensor(camera);
    let scene = plans.first().map_or(0, |plan| plan.seed);
    let pixels = Arc::new(Stage::bench().pixels(&sensor, scene));
    let chain = chain(camera, pixels, effects.to_vec());
    let take = |(number, plan, name): (usize, &Plan, &str)| {
        let recording = number_of(name) + (number * Plan::names().len()) as u32;
        let simulation =
            Simulation { chain: &chain, sensor: &sensor, noise: true, seed: plan.seed, recording };
        let called = if number == 0 { name.to_owned() } else { format!("{name}-{}", number + 1) };
        let course = plan.course(name)?;
        recorded(Path::new("simulated"), &called, plan, &course, camera, &simulation, &|| ())
    };
    let all = plans.iter().enumerate();
    all.flat_map(|(number, plan)| names.iter().map(move |&name| (number, plan, name))).map(take).collect()
}

/// The number of the recording called `name`: the same recording has the same noise, whichever others are taken.
pub fn number_of(name: &str) -> u32 {
    Plan::names().iter().position(|known| known == name).unwrap_or(0) as u32
}
