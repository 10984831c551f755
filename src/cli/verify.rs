//! `vuris verify`

use super::campaign::{self, Fitted};
use super::generate::shown_spec;
use super::{SchemeArgument, agreement, progress, scene_sets};
use crate::cosim::{Outcome, Simulator, Traffic, simulate, standard};
use crate::hdl::{Golden, Scenario, Segment, Source};
use crate::problem::{Problem, Result};
use crate::spec::Pipeline;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Build the generated Verilog in a real simulator and confirm that it agrees with the model, bit by bit, at every stage
#[derive(Debug, Args)]
pub(super) struct Verify {
    /// Specification: a preset (vuris, vuris-four-frame) or a TOML file
    #[arg(long, value_name = "FILE|PRESET")]
    spec: String,
    /// Simulator
    #[arg(long, value_enum, default_value_t)]
    simulator: SimulatorArgument,
    /// Drive it with the raw frames of a recording, or of all recordings of a campaign, instead of corners, random frames, a
    /// scene, broken streams and resets
    #[arg(long, value_name = "DIR")]
    recording: Option<PathBuf>,
    /// Scheme for the recording
    #[arg(long, value_enum, default_value_t, requires = "recording")]
    scheme: SchemeArgument,
    /// Use only the first sets of the recording
    #[arg(long, value_name = "N", requires = "recording", value_parser = clap::value_parser!(u32).range(1..))]
    sets: Option<u32>,
    /// Seed of random frames, pauses and stops
    #[arg(long, default_value_t = 1)]
    seed: u32,
    /// Percent of clocks without input
    #[arg(long, value_name = "PERCENT", default_value_t = 25, value_parser = clap::value_parser!(u32).range(0..=90))]
    pause: u32,
    /// Percent of clocks without output
    #[arg(long, value_name = "PERCENT", default_value_t = 25, value_parser = clap::value_parser!(u32).range(0..=90))]
    stop: u32,
    /// Keep Verilog, vectors, build and waveforms in this folder [default: a temporary one, kept only after a mismatch]
    #[arg(long, value_name = "DIR")]
    work: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum SimulatorArgument {
    /// Verilator
    #[default]
    Verilator,
    /// Icarus Verilog
    Icarus,
    /// Both
    All,
}

impl SimulatorArgument {
    fn simulators(self) -> &'static [Simulator] {
        match self {
            Self::Verilator => &[Simulator::Verilator],
            Self::Icarus => &[Simulator::Icarus],
            Self::All => &Simulator::ALL,
        }
    }
}

/// What is simulated: the pipeline, where it may have been adapted to a recording, and the scenario.
pub(super) struct Subject {
    pub pipeline: Pipeline,
    pub scenario: Scenario,
    /// What drives it, in words.
    pub stimulus: String,
}

impl Subject {
    /// The raw frames of the recording or campaign in `folder`, one subject for each pipeline that they need; prints how the
    /// specification was adapted to them.
    pub(super) fn of_recordings(
        base: &Pipeline,
        folder: &Path,
        scheme: SchemeArgument,
        sets: Option<u32>,
    ) -> Result<Vec<Self>> {
        let mut subjects: Vec<Self> = Vec::new();
        for Fitted { recording, pipeline, notes } in campaign::open(folder, base, scheme)? {
            for note in notes {
                println!("{}: {note}", recording.name);
            }
            let raw = match sets {
                Some(sets) => recording.raw.first_sets(sets as usize),
                None => recording.raw,
            };
            let stimulus = format!("recording {}, {} sets", recording.name, raw.sets());
            let segment = Segment::of_sets(&recording.name, &raw);
            match subjects.iter_mut().find(|subject| subject.pipeline == pipeline) {
                Some(subject) => {
                    subject.scenario.segments.push(segment);
                    subject.stimulus += &format!("; {stimulus}");
                }
                None => {
                    subjects.push(Self {
                        pipeline,
                        scenario: Scenario { segments: vec![segment] },
                        stimulus,
                    });
                }
            }
        }
        Ok(subjects)
    }

    /// One set of the simulated room.
    pub(super) fn scene(pipeline: Pipeline, noise_seed: u64) -> Result<Self> {
        let (raw, _) = scene_sets(&pipeline, 1, Some(noise_seed))?;
        let scenario = Scenario { segments: vec![Segment::of_sets("simulated scene", &raw)] };
        Ok(Self { pipeline, scenario, stimulus: "simulated scene".to_owned() })
    }

    /// Builds and runs it in `simulator`, prints what it showed, and keeps `work` where something differs.
    pub(super) fn verify(
        &self,
        spec: &str,
        simulator: Simulator,
        traffic: Traffic,
        work: Option<&Path>,
    ) -> Result<Outcome> {
        let source = Source { pipeline: &self.pipeline, spec: shown_spec(spec) };
        let golden = progress::during("running the model", || Golden::new(&self.pipeline, &self.scenario));
        let temporary = match work {
            Some(_) => None,
            None => Some(
                tempfile::Builder::new()
                    .prefix("vuris-verify-")
                    .tempdir()
                    .map_err(|error| Problem::io(&std::env::temp_dir(), "write", &error))?,
            ),
        };
        let folder = match (&temporary, work) {
            (Some(temporary), _) => temporary.path(),
            (None, Some(work)) => work,
            (None, None) => Path::new("."),
        };
        let outcome = progress::during(
            format!("{}: building and running {}", simulator.name(), self.stimulus),
            || simulate(&source, &golden, simulator, traffic, folder, &|_| {}),
        )?;
        self.print(simulator, &golden, &outcome);
        if outcome.mismatches > 0
            && let Some(temporary) = temporary
        {
            println!("  kept: {}", temporary.keep().display());
        }
        Ok(outcome)
    }

    fn print(&self, simulator: Simulator, golden: &Golden, outcome: &Outcome) {
        let verdict = if outcome.mismatches == 0 { "bit-exact" } else { "DIFFERS" };
        println!(
            "{} in {}: {verdict}, {}: {} values of {} result sets, {} sets discarded as they should be, {} clocks in {:.1} s",
            self.pipeline.name,
            simulator.name(),
            self.stimulus,
            outcome.values,
            golden.sets.len(),
            golden.discarded,
            outcome.clocks,
            outcome.simulation_s
        );
        for finding in &outcome.findings {
            println!("  {finding}");
        }
        if let Some(waveform) = &outcome.waveform {
            println!("  waveform: {}", waveform.display());
        }
    }
}

impl Verify {
    pub(super) fn run(self) -> Result<ExitCode> {
        let base = Pipeline::named(&self.spec)?;
        let subjects = match &self.recording {
            Some(folder) => Subject::of_recordings(&base, folder, self.scheme, self.sets)?,
            None => {
                let mut scenario = standard(&base, u64::from(self.seed));
                let (raw, _) = scene_sets(&base, 1, Some(u64::from(self.seed)))?;
                scenario.segments.push(Segment::of_sets("simulated scene", &raw));
                let stimulus = "corners, random frames, broken streams, resets, a scene".to_owned();
                vec![Subject { pipeline: base, scenario, stimulus }]
            }
        };
        let traffic = Traffic { seed: self.seed, pause_percent: self.pause, stop_percent: self.stop };
        let mut agrees = true;
        for (number, subject) in subjects.iter().enumerate() {
            // A folder of its own for each pipeline, where there are several.
            let work = self.work.as_deref().map(|work| match subjects.len() {
                1 => work.to_owned(),
                _ => work.join(format!("{}-{number}", subject.pipeline.modulation.scheme.name)),
            });
            for &simulator in self.simulator.simulators() {
                let outcome = subject.verify(&self.spec, simulator, traffic, work.as_deref())?;
                agrees &= outcome.mismatches == 0;
            }
        }
        Ok(agreement(agrees))
    }
}
