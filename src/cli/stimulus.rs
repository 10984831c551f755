//! Raw frames to drive a core with: a simulated scene.

use crate::cosim::aborted_then_good;
use crate::frames::RawSets;
use crate::hdl::{Golden, Scenario, Segment};
use crate::physics::{Acquisition, Correlation, Scene, Sensor, simulate};
use crate::problem::Result;
use crate::spec::Pipeline;

/// Seconds from one raw frame to the next in simulated scenes.
pub(super) const FRAME_PERIOD_S: f64 = 0.025;

/// The paper's camera behind `pipeline`'s sensor: same lens, same light, codes scaled to the ADC's bits.
pub(super) fn sensor(pipeline: &Pipeline) -> Sensor {
    let sensor = Sensor::vuris().with_geometry(pipeline.geometry());
    let adc_bits = pipeline.sensor.adc_bits;
    let scale = f64::from(adc_bits as i32 - sensor.adc_bits as i32).exp2();
    Sensor {
        adc_bits,
        gain_e_per_dn: sensor.gain_e_per_dn / scale,
        pedestal_dn: sensor.pedestal_dn * scale,
        ..sensor
    }
}

/// Raw frames of the simulated room, seen by `pipeline`'s camera, and the true radial ranges in m, both
/// `[set, …, row, column]`.
pub fn scene_sets(pipeline: &Pipeline, sets: usize, noise_seed: Option<u64>) -> Result<(RawSets, Vec<f64>)> {
    let acquisition = Acquisition {
        scheme: pipeline.modulation.scheme.clone(),
        frames_per_step: pipeline.modulation.frames_per_step,
        order: pipeline.modulation.steps_in_order(),
        frequency_hz: pipeline.modulation.frequency_hz,
        frame_period_s: FRAME_PERIOD_S,
        sets,
    };
    simulate(&Scene::room(), &Correlation::measured(), &sensor(pipeline), &acquisition, noise_seed)
}

/// The golden vectors that `vuris generate` writes: a set that breaks off, and the noise-free scene. Small enough to be
/// kept in a repository, and without noise, whose generator could round differently on another machine.
pub fn golden_of_preset(pipeline: &Pipeline) -> Result<Golden> {
    let (raw, _) = scene_sets(pipeline, 1, None)?;
    let scenario: Scenario = aborted_then_good(pipeline, Segment::of_sets("scene", &raw));
    Ok(Golden::new(pipeline, &scenario))
}
