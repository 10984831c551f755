//! `vuris scene`

use super::stimulus::FRAME_PERIOD_S;
use super::{progress, scene_sets};
use crate::artifact::{Artifact, write};
use crate::model::{PipelineModel, StreamEvent, beats_of_set};
use crate::problem::Result;
use crate::report::{ErrorMap, ErrorMaps, rms};
use crate::spec::Pipeline;
use crate::units::{unambiguous_range_m, wrap_rad};
use clap::Args;
use std::f64::consts::TAU;
use std::path::PathBuf;
use std::process::ExitCode;

/// Draw the errors of four frames and of the WDFT on the same simulated scene, by the integer model
#[derive(Debug, Args)]
pub(super) struct Scene {
    /// Folder for error-maps.svg
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Seed of the noise
    #[arg(long, default_value_t = 2012)]
    seed: u64,
}

/// A scheme's errors on the scene.
struct Measured {
    true_range_m: Vec<f64>,
    error_m: Vec<f64>,
}

/// Runs the integer model of the preset over one set of the scene.
fn measure(preset: &str, seed: u64) -> Result<Measured> {
    let pipeline = Pipeline::named(preset)?;
    let (raw, true_range_m) = scene_sets(&pipeline, 1, Some(seed))?;
    let mut model = PipelineModel::new(&pipeline);
    for beat in beats_of_set(&raw, 0) {
        model.advance(StreamEvent::Beat(beat));
    }
    let records = model.advance(StreamEvent::Silence).unwrap_or_default();
    let metres_a_rad = unambiguous_range_m(pipeline.modulation.frequency_hz) / TAU;
    let error_m = records
        .iter()
        .zip(&true_range_m)
        .map(|(record, true_m)| {
            let range_m = record.distance as f64 * pipeline.output.distance_unit_m;
            if record.valid { wrap_rad((range_m - true_m) / metres_a_rad) * metres_a_rad } else { f64::NAN }
        })
        .collect();
    Ok(Measured { true_range_m, error_m })
}

impl Scene {
    pub(super) fn run(self) -> Result<ExitCode> {
        let [four, wdft] = progress::during("simulating", || {
            ["vuris-four-frame", "vuris"].map(|preset| measure(preset, self.seed))
        });
        let (four, wdft) = (four?, wdft?);
        let pipeline = Pipeline::named("vuris")?;
        let subtitle = format!(
            "Simulated at {} MHz and {} ms a frame with the waveform of the paper's Table I, shot and read noise; phase by the integer model",
            pipeline.modulation.frequency_hz / 1e6,
            1e3 * FRAME_PERIOD_S
        );
        let picture = ErrorMaps {
            title: "Range error of two phase schemes on the same scene",
            subtitle: &subtitle,
            geometry: pipeline.geometry(),
            range_m: &wdft.true_range_m,
            range_note: "the box in front approaches at 1 m/s",
            errors: [
                ErrorMap {
                    label: "Error, four frames",
                    note: "preset vuris-four-frame",
                    error_m: &four.error_m,
                },
                ErrorMap { label: "Error, WDFT (five frames)", note: "preset vuris", error_m: &wdft.error_m },
            ],
            grey: "an edge crosses the pixel during the measurement: left out of the RMS",
        };
        write(&self.out, &[Artifact::new("error-maps.svg", picture.to_svg()?)])?;
        for (name, measured) in [("four frames", &four), ("WDFT", &wdft)] {
            println!("{name}: range error {:.1} mm RMS", 1e3 * rms(measured.error_m.iter().copied()));
        }
        println!("written: {}", self.out.join("error-maps.svg").display());
        Ok(ExitCode::SUCCESS)
    }
}
