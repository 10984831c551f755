//! `vuris diagnose`

use super::campaign::{recordings_in, remark_on_physics, unfinished_in};
use super::library::effects_in;
use super::place::{at, may_be_written};
use super::print::{counted, remark, say};
use super::progress;
use crate::artifact::write_file;
use crate::diagnose::{Data, Diagnosis, camera_with, diagnose};
use crate::physics::Effect;
use crate::problem::{Problem, Result};
use crate::recording::{FILES, Recording};
use crate::report::{diagnosis_page, diagnosis_text};
use clap::Args;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Find where recordings and simulation disagree, and name the physics that the simulation leaves out
#[derive(Debug, Args)]
pub(super) struct Diagnose {
    /// Campaigns, or single recordings
    #[arg(required = true, value_name = "CAMPAIGN")]
    campaigns: Vec<PathBuf>,
    /// Effects of your own, as formulas
    #[arg(long, value_name = "FILE.toml")]
    library: Option<PathBuf>,
    /// Write the verdict as JSON; `-` for standard output
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write a page with maps, curves and the evidence
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    /// Write the camera's description with the effects that were found
    #[arg(long, value_name = "camera.toml")]
    write_camera: Option<PathBuf>,
    /// Write what two simpler methods name, best single effect by BIC and sparse regression, as JSON
    #[arg(long, value_name = "FILE")]
    simpler: Option<PathBuf>,
}

impl Diagnose {
    pub(super) fn run(self) -> Result<ExitCode> {
        if self.campaigns.len() > 1
            && [&self.json, &self.report, &self.write_camera, &self.simpler].iter().any(|file| file.is_some())
        {
            return Err(Problem::at(
                "--json, --report, --write-camera, --simpler",
                counted(self.campaigns.len(), "campaign"),
            )
            .expected("one campaign for one file")
            .remedy("diagnose them one by one"));
        }
        self.check_files()?;
        let library = effects_in(self.library.as_deref())?;
        for campaign in &self.campaigns {
            let data = read(campaign, &library)?;
            remark_on_physics(&data.described);
            let what = format!("diagnosing {}", campaign.display());
            let diagnosis: Diagnosis = progress::during(what, || diagnose(&data));
            let text = serde_json::to_string_pretty(&diagnosis.answer)
                .map_err(|error| Problem::at("the verdict", error))?;
            if let Some(file) = &self.write_camera {
                let camera = camera_with(&data, &diagnosis.judgement);
                write_file(file, &camera.to_toml())?;
                if data.assumed.camera {
                    remark(format_args!(
                        "{}: no camera.toml describes the camera: {} bits, a pedestal of {} DN, a sinusoidal correlation and parallel rays \
                         (a focal length of {:e} pixels) are assumed; gain and read noise are those that were measured, where noise tells them",
                        file.display(),
                        camera.adc_bits,
                        camera.pedestal_dn,
                        camera.focal_length_px
                    ));
                }
            }
            if let Some(file) = &self.simpler {
                let simpler = &diagnosis.judgement.found.simpler;
                let text = serde_json::to_string_pretty(&json!({
                    "format": "vuris-simpler/1",
                    "best_single": simpler.best_single,
                    "sparse_regression": simpler.sparse_regression,
                }));
                let text = text.map_err(|error| Problem::at("the simpler methods' names", error))?;
                write_file(file, &format!("{text}\n"))?;
            }
            if let Some(file) = &self.report {
                write_file(file, &diagnosis_page(campaign, &diagnosis)?)?;
            }
            if self.json.as_deref() == Some(Path::new("-")) {
                say!("{text}");
                continue;
            }
            if let Some(file) = &self.json {
                write_file(file, &format!("{text}\n"))?;
            }
            say!("{}", diagnosis_text(campaign, &diagnosis));
            for file in [&self.json, &self.report, &self.write_camera, &self.simpler].into_iter().flatten() {
                say!("written: {}", file.display());
            }
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Refuses campaigns that are given twice, and files that cannot be written or would be lost.
    fn check_files(&self) -> Result<()> {
        for (number, campaign) in self.campaigns.iter().enumerate() {
            if self.campaigns[..number].iter().any(|other| at(other) == at(campaign)) {
                return Err(Problem::in_file(campaign, "is given twice")
                    .expected("each campaign once")
                    .remedy("leave one of them out"));
            }
        }
        let json = self.json.as_deref().filter(|file| *file != Path::new("-"));
        let [report, simpler, camera] =
            [&self.report, &self.simpler, &self.write_camera].map(Option::as_deref);
        let others = [("--json", json), ("--report", report), ("--simpler", simpler)];
        let given = |(option, file)| Option::map(file, |file: &Path| (option, file));
        let others: Vec<(&str, &Path)> = others.into_iter().filter_map(given).collect();
        let all: Vec<(&str, &Path)> =
            others.iter().copied().chain(given(("--write-camera", camera))).collect();
        let mut read: Vec<PathBuf> = self.library.iter().cloned().collect();
        let mut cameras = Vec::new();
        for campaign in &self.campaigns {
            cameras.push(campaign.join("camera.toml"));
            for recording in recordings_in(campaign)? {
                cameras.push(recording.join("camera.toml"));
                read.extend(FILES.map(|name| recording.join(name)));
            }
        }
        may_be_written(&all, &read)?;
        // The campaign's own camera may be written anew, by what writes cameras.
        may_be_written(&others, &cameras)
    }
}

/// The recordings in `campaign`, with a remark on those that say nothing, and on masks that are not one.
fn read(campaign: &Path, library: &[&'static Effect]) -> Result<Data> {
    for folder in unfinished_in(campaign)? {
        remark(format_args!("{}: left out: it has frames.npy, and no recording.toml", folder.display()));
    }
    let recordings: Vec<Recording> =
        recordings_in(campaign)?.iter().map(|folder| Recording::open(folder)).collect::<Result<_>>()?;
    let data = Data::of(&recordings, library.to_vec())?;
    for take in data.takes.iter().filter(|take| take.signal_dn.iter().all(|signal| signal.is_nan())) {
        remark(format_args!(
            "{}: says nothing: all its codes are 0, or at full scale, or of a background at another modulation frequency",
            take.name
        ));
    }
    if let Some((first, others)) = recordings.split_first() {
        if !data.assumed.still_scene && !data.target.contains(&true) {
            remark(format_args!(
                "{}: mask.npy marks no pixel: nothing is known to see the target",
                first.name
            ));
        }
        for other in others.iter().filter(|other| other.mask != first.mask) {
            remark(format_args!(
                "{}: has another mask.npy than {}, whose mask counts for all (and where pixels clearly show something else, that)",
                other.name, first.name
            ));
        }
    }
    Ok(data)
}
