//! `vuris process`

use super::campaign::{self, Fitted};
use super::print::say;
use super::{SchemeArgument, progress};
use crate::model::{PipelineModel, PixelRecord, StreamEvent, beats_of_set};
use crate::problem::Result;
use crate::ranging::{RangeErrors, range_errors};
use crate::recording::Recording;
use crate::recording::arrays::{NamedArray, Numbers, may_be_replaced, write_arrays};
use crate::reference::{DifferenceStatistics, ReferenceImages, reference_images};
use crate::spec::Pipeline;
use crate::units::{turns_of_code, unambiguous_range_m};
use clap::Args;
use std::f64::consts::TAU;
use std::path::PathBuf;
use std::process::ExitCode;

/// Run the integer model over a recording, and write phase, amplitude, offset, distance and flags as .npy
#[derive(Debug, Args)]
pub(super) struct Process {
    /// Folder of the recording, or of a campaign: then all its recordings are processed
    recording: PathBuf,
    /// Specification: a preset (vuris, vuris-four-frame) or a TOML file
    #[arg(long, value_name = "FILE|PRESET")]
    spec: String,
    /// Folder to write to: a new or empty one, or one of an earlier run, which is replaced; of a campaign, a folder in it
    /// for each recording
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Scheme for the recording
    #[arg(long, value_enum, default_value_t)]
    scheme: SchemeArgument,
}

/// A recording's results.
pub(super) struct Processed {
    pub recording: Recording,
    pub pipeline: Pipeline,
    pub records: Vec<PixelRecord>,
    pub reference: ReferenceImages,
    pub notes: Vec<String>,
}

impl Processed {
    pub(super) fn new(fitted: Fitted) -> Result<Self> {
        let Fitted { recording, pipeline, notes } = fitted;
        let records = progress::during(format!("{}: running the model", recording.name), || {
            records(&pipeline, &recording)
        });
        let reference = reference_images(&pipeline, &recording.raw)?;
        Ok(Self { recording, pipeline, records, reference, notes })
    }

    /// Ranges in m by the integer model, `[set, row, column]`.
    pub(super) fn range_m(&self) -> Vec<f64> {
        let unit_m = self.pipeline.output.distance_unit_m;
        self.records.iter().map(|record| record.distance as f64 * unit_m).collect()
    }

    /// The integer model's ranges against the encoder.
    pub(super) fn range_errors(&self) -> Result<RangeErrors> {
        let valid: Vec<bool> = self.records.iter().map(|record| record.valid).collect();
        range_errors(&self.recording, &self.range_m(), &valid)
    }

    fn arrays(&self) -> Vec<NamedArray> {
        let derived = self.pipeline.derived();
        let geometry = self.recording.geometry();
        let shape = vec![self.recording.raw.sets(), geometry.height, geometry.width];
        let codes =
            |bits: u32, value: fn(&PixelRecord) -> i64| Numbers::codes(bits, self.records.iter().map(value));
        let flags = |valid: &[bool], saturated: &[bool]| {
            let bits = valid.iter().zip(saturated);
            Numbers::U8(bits.map(|(&valid, &saturated)| u8::from(valid) | u8::from(saturated) << 1).collect())
        };
        let reference = &self.reference;
        let rows = [
            ("phase", codes(derived.phase.bits, |r| r.phase)),
            ("amplitude", codes(derived.amplitude.bits, |r| r.amplitude)),
            ("offset", codes(derived.offset.bits, |r| r.offset)),
            ("distance", codes(derived.distance.bits, |r| r.distance)),
            ("flags", codes(2, |r| i64::from(r.valid) | i64::from(r.sums.saturated) << 1)),
            ("reference_phase_turns", Numbers::F64(reference.phase_turns.clone())),
            ("reference_amplitude_dn", Numbers::F64(reference.amplitude_dn.clone())),
            ("reference_offset_dn", Numbers::F64(reference.offset_dn.clone())),
            ("reference_range_m", Numbers::F64(reference.range_m.clone())),
            ("reference_flags", flags(&reference.valid, &reference.saturated)),
        ];
        rows.into_iter()
            .map(|(name, numbers)| NamedArray { name: name.to_owned(), shape: shape.clone(), numbers })
            .collect()
    }

    /// What the arrays' codes mean, and what they were made from.
    fn provenance(&self, spec: &str) -> toml::Table {
        let output = &self.pipeline.output;
        let mut table = toml::Table::new();
        let mut put = |key: &str, value: toml::Value| {
            table.insert(key.to_owned(), value);
        };
        put("recording", self.recording.name.clone().into());
        put("spec", spec.into());
        put("scheme", (&*self.pipeline.modulation.scheme.name).into());
        put("phase_turns_per_code", f64::from(output.phase_bits).exp2().recip().into());
        put("amplitude_dn_per_code", f64::from(output.amplitude_fraction_bits).exp2().recip().into());
        put("offset_dn_per_code", f64::from(output.offset_fraction_bits).exp2().recip().into());
        put("distance_m_per_code", output.distance_unit_m.into());
        put("flags", "bit 0: valid, bit 1: saturated".into());
        put(
            "phase_offset",
            "not added: add phase_offset_rad of sets.csv to a phase to get 4 pi f d / c".into(),
        );
        table
    }

    fn print(&self) -> Result<()> {
        say!(
            "{}: scheme {}, {} MHz",
            self.recording.name,
            self.pipeline.modulation.scheme.name,
            self.pipeline.modulation.frequency_hz / 1e6
        );
        for note in &self.notes {
            say!("  {note}");
        }
        self.print_differences()?;
        match self.range_errors() {
            Ok(errors) => say!(
                "  range against the encoder, each pixel's own constant removed: RMS {:.2} mm a pixel, {:.2} mm of the sets' means",
                1e3 * errors.pixels.rms,
                1e3 * errors.set_means.rms
            ),
            Err(why) => say!("  no range against the encoder: {why}"),
        }
        Ok(())
    }

    fn print_differences(&self) -> Result<()> {
        let (output, reference) = (&self.pipeline.output, &self.reference);
        let of_codes = |bits: u32| f64::from(bits).exp2().recip();
        let unambiguous_m = unambiguous_range_m(self.pipeline.modulation.frequency_hz);
        let values =
            |value: &dyn Fn(&PixelRecord) -> f64| self.records.iter().map(value).collect::<Vec<f64>>();
        let amplitude_dn = values(&|r| r.amplitude as f64 * of_codes(output.amplitude_fraction_bits));
        let offset_dn = values(&|r| r.offset as f64 * of_codes(output.offset_fraction_bits));
        let phase_turns = values(&|r| turns_of_code(r.phase, output.phase_bits).to_num());
        say!("  {:<22} {:>12} {:>12} {:>12}", "integer - float", "mean", "RMS", "largest");
        for (name, scale, integers, floats, period) in [
            ("phase, mrad", 1e3 * TAU, &phase_turns, &reference.phase_turns, Some(1.0)),
            ("amplitude, DN", 1.0, &amplitude_dn, &reference.amplitude_dn, None),
            ("offset, DN", 1.0, &offset_dn, &reference.offset_dn, None),
            ("distance, um", 1e6, &self.range_m(), &reference.range_m, Some(unambiguous_m)),
        ] {
            let valid = |values: &[f64]| -> Vec<f64> {
                values.iter().zip(&reference.valid).filter(|(_, valid)| **valid).map(|(v, _)| *v).collect()
            };
            if let Some(DifferenceStatistics { mean, rms, max_abs, .. }) =
                DifferenceStatistics::between(&valid(integers), &valid(floats), period)
            {
                say!("  {name:<22} {:>+12.5} {:>12.5} {:>12.5}", mean * scale, rms * scale, max_abs * scale);
            }
        }
        let count = |flag: fn(&PixelRecord) -> bool| self.records.iter().filter(|r| flag(r)).count();
        say!(
            "  {} pixels in {} sets; {} without a phase, {} saturated",
            self.records.len(),
            self.recording.raw.sets(),
            count(|r| !r.valid),
            count(|r| r.sums.saturated)
        );
        Ok(())
    }
}

/// The model's records of all sets of `recording`, `[set, row, column]`.
fn records(pipeline: &Pipeline, recording: &Recording) -> Vec<PixelRecord> {
    let mut model = PipelineModel::new(pipeline);
    let mut records = Vec::with_capacity(recording.raw.sets() * recording.geometry().pixels());
    for set in 0..recording.raw.sets() {
        for beat in beats_of_set(&recording.raw, set) {
            records.extend(model.advance(StreamEvent::Beat(beat)).into_iter().flatten());
        }
    }
    records.extend(model.advance(StreamEvent::Rest).into_iter().flatten());
    records
}

impl Process {
    pub(super) fn run(self) -> Result<ExitCode> {
        let base = Pipeline::named(&self.spec)?;
        let campaign = !self.recording.join("recording.toml").is_file();
        let mut all = Vec::new();
        for fitted in campaign::open(&self.recording, &base, self.scheme)? {
            let out = if campaign { self.out.join(&fitted.recording.name) } else { self.out.clone() };
            // Every place is looked at before the first result is written.
            may_be_replaced(&out)?;
            all.push((fitted, out));
        }
        for (fitted, out) in all {
            let processed = Processed::new(fitted)?;
            write_arrays(&out, &processed.arrays(), &processed.provenance(&self.spec))?;
            processed.print()?;
            say!("  written: {}", out.display());
        }
        Ok(ExitCode::SUCCESS)
    }
}
