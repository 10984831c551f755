//! `vuris demo`

use super::print::say;
use super::process::Processed;
use super::verify::Subject;
use super::{SchemeArgument, agreement, campaign, golden_of_preset, progress};
use crate::artifact;
use crate::cosim::{Simulator, Traffic};
use crate::hdl::{Source, all_artifacts};
use crate::problem::Result;
use crate::ranging::RangeErrors;
use crate::spec::Pipeline;
use clap::Args;
use std::path::PathBuf;
use std::process::ExitCode;

/// Generate the preset, verify it in Verilator on a scene and on a recording, process the recording, and sum up
#[derive(Debug, Args)]
pub(super) struct Demo {
    /// Folder for the generated Verilog
    #[arg(long, value_name = "DIR", default_value = "target/demo")]
    out: PathBuf,
    /// Campaign with the recordings four-rail and wdft-rail
    #[arg(long, value_name = "DIR", default_value = "tests/data/practice-01")]
    campaign: PathBuf,
}

/// The presets and the recordings that have their phase steps.
const PAIRS: [(&str, &str, &str); 2] =
    [("four frames", "vuris-four-frame", "four-rail"), ("WDFT", "vuris", "wdft-rail")];

impl Demo {
    pub(super) fn run(self) -> Result<ExitCode> {
        let vuris = Pipeline::named("vuris")?;
        let golden = progress::during("running the model", || golden_of_preset(&vuris))?;
        let artifacts = all_artifacts(&Source { pipeline: &vuris, spec: "vuris" }, &golden);
        let mut subjects = vec![("vuris", Subject::scene(vuris, 1)?)];
        for (_, preset, recording) in PAIRS {
            let base = Pipeline::named(preset)?;
            let folder = self.campaign.join(recording);
            let fitted = Subject::of_recordings(&base, &folder, SchemeArgument::Specified, None)?;
            subjects.extend(fitted.into_iter().map(|subject| (preset, subject)));
        }
        let folder = self.out.join("vuris");
        artifact::write(&folder, &artifacts)?;
        say!("generated {}: {} files of specification vuris", folder.display(), artifacts.len());
        let (mut values, mut mismatches) = (0, 0);
        for (spec, subject) in &subjects {
            for outcome in subject.verify(spec, Simulator::Verilator, &[Traffic::default()], None)? {
                values += outcome.values;
                mismatches += outcome.mismatches;
            }
        }

        let mut rows = Vec::new();
        for (name, preset, recording) in PAIRS {
            let folder = self.campaign.join(recording);
            for fitted in campaign::open(&folder, &Pipeline::named(preset)?, SchemeArgument::Specified)? {
                rows.push((name, recording, Processed::new(fitted)?.range_errors()?));
            }
        }

        say!();
        say!(
            "bit-exact: {}, {values} values compared in Verilator at every stage",
            if mismatches == 0 { "yes" } else { "NO" }
        );
        say!("range error against the encoder of {}:", self.campaign.display());
        for (name, recording, RangeErrors { pixels, set_means, .. }) in rows {
            say!(
                "  {name:<12} {recording:<10} RMS {:5.1} mm over the target's mean, {:5.1} mm a pixel (noise included)",
                1e3 * set_means.rms,
                1e3 * pixels.rms
            );
        }
        Ok(agreement(mismatches == 0))
    }
}
