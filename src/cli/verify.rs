//! `vuris verify`

use super::campaign::{self, Fitted};
use super::generate::shown_spec;
use super::print::{counted, say};
use super::{SchemeArgument, agreement, progress, scene_sets};
use crate::cosim::{Outcome, Simulation, Simulator, Traffic, simulate_angle, standard};
use crate::hdl::{Golden, Scenario, Segment, Source, angle_stimulus};
use crate::problem::{Problem, Result};
use crate::spec::{AngleCore, Design, Pipeline};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Build the generated Verilog in a real simulator and confirm that it agrees with the model, bit by bit, at every stage
#[derive(Debug, Args)]
pub(super) struct Verify {
    /// Specification: a preset (vuris, vuris-fast, vuris-four-frame, angle-16, angle-16-folded, angle-16-iterative) or a TOML file
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
    /// Percent of clocks without input [default: 25; without a recording four mixtures of pauses and stops]
    #[arg(long, value_name = "PERCENT", value_parser = clap::value_parser!(u32).range(0..=90))]
    pause: Option<u32>,
    /// Percent of clocks without output [default: like --pause]
    #[arg(long, value_name = "PERCENT", value_parser = clap::value_parser!(u32).range(0..=90))]
    stop: Option<u32>,
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
                say!("{}: {note}", recording.name);
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

    /// Builds it for `simulator`, runs it with each of `traffics`, prints what it showed, and keeps the files where something
    /// differs.
    pub(super) fn verify(
        &self,
        spec: &str,
        simulator: Simulator,
        traffics: &[Traffic],
        work: Option<&Path>,
    ) -> Result<Vec<Outcome>> {
        let Some(folder) = work else {
            let temporary = tempfile::Builder::new()
                .prefix("vuris-verify-")
                .tempdir()
                .map_err(|error| Problem::io(&std::env::temp_dir(), "write", &error))?;
            let result = self.verify_in(spec, simulator, traffics, temporary.path());
            if !result.as_ref().is_ok_and(|outcomes| outcomes.iter().all(|outcome| outcome.mismatches == 0)) {
                say!("  kept: {}", temporary.keep().display());
            }
            return result;
        };
        self.verify_in(spec, simulator, traffics, folder)
    }

    fn verify_in(
        &self,
        spec: &str,
        simulator: Simulator,
        traffics: &[Traffic],
        folder: &Path,
    ) -> Result<Vec<Outcome>> {
        let spec = shown_spec(spec);
        let source = Source { pipeline: &self.pipeline, spec: &spec };
        let golden = progress::during("running the model", || Golden::new(&self.pipeline, &self.scenario));
        let simulation = progress::during(format!("{}: building", simulator.name()), || {
            Simulation::build(source, &golden, simulator, folder, &|_| {})
        })?;
        let mut outcomes = Vec::new();
        for &traffic in traffics {
            let Traffic { pause_percent, stop_percent, .. } = traffic;
            let what = format!("{}, {pause_percent} % pauses, {stop_percent} % stops", self.stimulus);
            let running = format!("{}: running {what}", simulator.name());
            let outcome = progress::during(running, || simulation.run(traffic))?;
            self.print(simulator, &golden, &what, &outcome)?;
            outcomes.push(outcome);
        }
        Ok(outcomes)
    }

    fn print(&self, simulator: Simulator, golden: &Golden, what: &str, outcome: &Outcome) -> Result<()> {
        let verdict = if outcome.mismatches == 0 { "bit-exact" } else { "DIFFERS" };
        say!(
            "{} in {}: {verdict}: {what}: {} values of {}, {} discarded as due, {} clocks in {:.1} s",
            self.pipeline.name,
            simulator.name(),
            outcome.values,
            counted(golden.sets.len(), "result set"),
            counted(golden.discarded as usize, "set"),
            outcome.clocks,
            outcome.simulation_s
        );
        for finding in &outcome.findings {
            say!("  {finding}");
        }
        if let Some(waveform) = &outcome.waveform {
            say!("  waveform: {}", waveform.display());
        }
        Ok(())
    }
}

impl Verify {
    pub(super) fn run(self) -> Result<ExitCode> {
        let base = match Design::named(&self.spec)? {
            Design::Pipeline(pipeline) => *pipeline,
            Design::Angle(core) => {
                if let Some(folder) = &self.recording {
                    return Err(Problem::in_file(folder, "is a recording, and an angle unit takes vectors")
                        .expected("a specification of a pipeline")
                        .remedy("leave --recording out"));
                }
                return self.verify_angle(&core);
            }
        };
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
        let single = self.recording.is_some() || self.pause.is_some() || self.stop.is_some();
        let mut agrees = true;
        for (number, subject) in subjects.iter().enumerate() {
            // A folder of its own for each pipeline, where there are several.
            let work = self.work.as_deref().map(|work| match subjects.len() {
                1 => work.to_owned(),
                _ => work.join(format!("{}-{number}", subject.pipeline.modulation.scheme.name)),
            });
            for &simulator in self.simulator.simulators() {
                let traffics =
                    if single { vec![self.traffic()] } else { profiles(subject, simulator, self.seed)? };
                let outcomes = subject.verify(&self.spec, simulator, &traffics, work.as_deref())?;
                agrees &= outcomes.iter().all(|outcome| outcome.mismatches == 0);
            }
        }
        Ok(agreement(agrees))
    }

    /// The one mixture that was asked for.
    fn traffic(&self) -> Traffic {
        let Traffic { seed, pause_percent, stop_percent } = Traffic { seed: self.seed, ..Traffic::default() };
        Traffic {
            seed,
            pause_percent: self.pause.unwrap_or(pause_percent),
            stop_percent: self.stop.unwrap_or(stop_percent),
        }
    }

    /// An angle unit by itself.
    fn verify_angle(&self, core: &AngleCore) -> Result<ExitCode> {
        let spec = shown_spec(&self.spec);
        let vectors = angle_stimulus(&core.unit, self.seed.into());
        let traffics = if self.pause.is_some() || self.stop.is_some() {
            vec![self.traffic()]
        } else {
            Traffic::profiles(self.seed).to_vec()
        };
        let mut agrees = true;
        for &simulator in self.simulator.simulators() {
            let temporary = tempfile::Builder::new()
                .prefix("vuris-verify-")
                .tempdir()
                .map_err(|error| Problem::io(&std::env::temp_dir(), "write", &error))?;
            let folder = self.work.as_deref().unwrap_or(temporary.path());
            let outcomes = progress::during(format!("{}: building and running", simulator.name()), || {
                simulate_angle(core, &spec, &vectors, simulator, &traffics, folder, &|_| {})
            })?;
            let mut differs = false;
            for (traffic, outcome) in traffics.iter().zip(&outcomes) {
                let verdict = if outcome.mismatches == 0 { "bit-exact" } else { "DIFFERS" };
                say!(
                    "{} in {}: {verdict}: weak vectors, corners, random vectors of every octave, {} % pauses, {} % stops: {}, {} clocks in {:.1} s",
                    core.name,
                    simulator.name(),
                    traffic.pause_percent,
                    traffic.stop_percent,
                    counted(outcome.values as usize, "vector"),
                    outcome.clocks,
                    outcome.simulation_s
                );
                differs |= outcome.mismatches > 0;
            }
            if differs && self.work.is_none() {
                say!("  kept: {}", temporary.keep().display());
            }
            agrees &= !differs;
        }
        Ok(agreement(agrees))
    }
}

/// Pixels from which Icarus, a hundred times slower than Verilator, runs only the first mixture of pauses and stops.
const SLOW_PIXELS: usize = 4096;

/// All mixtures of pauses and stops, or with a line that says so the first.
fn profiles(subject: &Subject, simulator: Simulator, seed: u32) -> Result<Vec<Traffic>> {
    let mut profiles = Traffic::profiles(seed).to_vec();
    let pixels = subject.pipeline.geometry().pixels();
    if simulator == Simulator::Icarus && pixels > SLOW_PIXELS {
        say!(
            "icarus: one of {} mixtures of pauses and stops, since {pixels} pixels take it minutes (verilator runs all; --pause and --stop choose another)",
            profiles.len()
        );
        profiles.truncate(1);
    }
    Ok(profiles)
}
