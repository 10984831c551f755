//! `vuris sweep`

mod areas;
mod journal;
mod output;
mod recommend;
mod specification;

use super::print::{counted, say};
use super::progress;
use crate::problem::{Problem, Result};
use crate::report::{front_table, octave_table, sweep_columns, sweep_csv, sweep_parquet, sweep_picture};
use crate::spec::{AngleUnit, Architecture, Atan, Design, Rounding, Throughput};
use crate::sweep::{
    Area, AreaModel, Configuration, ExactAngle, Figures, Grid, Plan, Point, Record, Shard, Tally, evaluate,
    throughput_named,
};
use clap::{Args, ValueEnum};
use indicatif::ProgressBar;
use journal::{Journal, Subject};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Measure the phase's error over all vectors of a word, or a stratified choice of them, for every combination of
/// word lengths, iterations and guard bits, against area
#[derive(Debug, Args)]
pub(super) struct Sweep {
    /// Specification (a preset or a TOML file) that gives every value which no option below gives
    #[arg(long, value_name = "FILE|PRESET", default_value = "vuris")]
    spec: String,
    /// Bits of both signed input words of a unit that gives the phase alone; without it the specification's own
    #[arg(long, value_name = "LIST")]
    word: Option<String>,
    /// The angle is that of (x, sqrt(METRIC) y); with --word only
    #[arg(long, value_name = "1|3", default_value_t = 1, requires = "word")]
    metric: i64,
    /// Bits of the phase
    #[arg(long, value_name = "LIST")]
    phase_bits: Option<String>,
    /// CORDIC iterations [default: with --word or --phase-bits one more than the phase's bits, otherwise the specification's]
    #[arg(long, value_name = "LIST")]
    iterations: Option<String>,
    /// Bits of the vector below the phase's resolution
    #[arg(long, value_name = "LIST")]
    vector_guard_bits: Option<String>,
    /// Bits of the angle below the phase's resolution
    #[arg(long, value_name = "LIST")]
    angle_guard_bits: Option<String>,
    /// With or without normaliser; what is generated has one
    #[arg(long, value_enum, default_value_t)]
    normaliser: Normaliser,
    /// What becomes of the bits below a cut; what is generated rounds to nearest
    #[arg(long, value_enum, default_value_t)]
    rounding: RoundingArgument,
    /// Clocks between two pixels, 1 to 64, or "iterative": one iteration a clock
    #[arg(long, value_name = "LIST")]
    cycles_per_pixel: Option<String>,
    /// Modulation frequency, for errors in mm [default: the specification's; 30e6 for an angle unit by itself]
    #[arg(long, value_name = "HZ")]
    frequency_hz: Option<f64>,
    /// Vectors drawn in each octave of the amplitude, where both words have more than 24 bits together
    #[arg(long, value_name = "N", default_value_t = 65_536, value_parser = clap::value_parser!(u64).range(1..=1 << 28))]
    samples: u64,
    /// Visit every vector of words of up to 32 bits together
    #[arg(long)]
    exhaustive: bool,
    /// Areas by synthesis of every configuration for an ECP5, each once, instead of the fitted model
    #[arg(long, conflicts_with_all = ["recommend", "shard"])]
    synthesise: bool,
    /// Folder for sweep.csv, sweep.parquet, sweep.svg and the journal from which a later run goes on
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Evaluate share i of n only, into a journal in --out
    #[arg(long, value_name = "I/N", requires = "out")]
    shard: Option<String>,
    /// Evaluate nothing: add up the journals of all shards in --out
    #[arg(long, requires = "out", conflicts_with = "shard")]
    merge: bool,
    /// Fit the area model to the synthesised points of a sweep.csv, and print its coefficients
    #[arg(long, value_name = "FILE", conflicts_with_all = ["out", "recommend"])]
    fit_area: Option<PathBuf>,
    #[command(flatten)]
    recommend: recommend::Recommend,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum Normaliser {
    #[default]
    On,
    Off,
    Both,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum RoundingArgument {
    #[default]
    Nearest,
    Truncate,
    Both,
}

/// How many vectors were evaluated in what time.
#[derive(Default)]
struct Effort {
    vectors: u64,
    time: Duration,
    /// Configurations that a journal had.
    known: usize,
}

impl Sweep {
    pub(super) fn run(self) -> Result<ExitCode> {
        if let Some(path) = &self.fit_area {
            return self.fit_area(path);
        }
        let design = Design::named(&self.spec)?;
        if self.recommend.is_asked_for() {
            return self.recommended(&design);
        }
        let frequency_hz = self.frequency_hz(&design)?;
        let candidates = self.grid(specification::unit_of(&design))?.configurations()?;
        if let Some(text) = &self.shard {
            return self.one_shard(&candidates, Shard::parse(text)?);
        }
        if let Some(folder) = &self.out {
            output::check(folder)?;
        }
        let (tallies, effort) =
            if self.merge { self.merged(&candidates)? } else { self.measured(&candidates, Shard::WHOLE)? };
        let areas = if self.synthesise {
            areas::synthesised(&candidates)?
        } else {
            candidates.iter().map(|(_, unit)| areas::fitted(unit)).collect()
        };
        let point =
            |(((configuration, _), (plan, tally)), area): ((&Candidate, &(Plan, Tally)), Area)| Point {
                configuration: *configuration,
                coverage: plan.coverage(),
                rows: Figures::rows(tally),
                area,
            };
        let points: Vec<Point> = candidates.iter().zip(&tallies).zip(areas).map(point).collect();
        self.report(&points, frequency_hz)?;
        if effort.vectors > 0 {
            let seconds = effort.time.as_secs_f64();
            let millions = effort.vectors as f64 / 1e6;
            say!("{} vectors in {seconds:.2} s, {:.1} million a second", effort.vectors, millions / seconds);
        }
        Ok(ExitCode::SUCCESS)
    }

    /// The modulation frequency that makes a range of a phase.
    fn frequency_hz(&self, design: &Design) -> Result<f64> {
        match self.frequency_hz {
            Some(frequency_hz) if !(1e4..=1e10).contains(&frequency_hz) => {
                Err(Problem::at("--frequency-hz", frequency_hz).expected("10000 to 1e10 Hz"))
            }
            Some(frequency_hz) => Ok(frequency_hz),
            None => Ok(specification::frequency_hz_of(design)),
        }
    }

    /// The grid that the options ask for; what they leave out is the specification's.
    fn grid(&self, unit: &AngleUnit) -> Result<Grid> {
        let numbers = |option: &str, text: &Option<String>, otherwise: u32| match text {
            Some(text) => Grid::numbers(option, text),
            None => Ok(vec![otherwise]),
        };
        if unit.atan != Atan::Cordic {
            return Err(Problem::at("sweep", "atan = \"poly\"")
                .expected("a CORDIC: the sweep varies its iterations and guard bits")
                .remedy("set atan = \"cordic\""));
        }
        let mut base = Configuration::of(unit);
        if self.word.is_some() {
            // Not a camera's sums: a unit by itself, which gives the phase alone.
            base.length_bits = 0;
        }
        let words = match &self.word {
            Some(text) => {
                Grid::numbers("--word", text)?.into_iter().map(|bits| (bits, bits, self.metric)).collect()
            }
            None => vec![(base.x_bits, base.y_bits, base.metric)],
        };
        Ok(Grid {
            base,
            words,
            phase_bits: numbers("--phase-bits", &self.phase_bits, base.phase_bits)?,
            iterations: match &self.iterations {
                Some(text) => Grid::numbers("--iterations", text)?,
                // The specification's own belong to its own phase.
                None if self.word.is_some() || self.phase_bits.is_some() => Vec::new(),
                None => vec![base.iterations],
            },
            vector_guard_bits: numbers(
                "--vector-guard-bits",
                &self.vector_guard_bits,
                base.vector_guard_bits,
            )?,
            angle_guard_bits: numbers("--angle-guard-bits", &self.angle_guard_bits, base.angle_guard_bits)?,
            throughputs: match &self.cycles_per_pixel {
                Some(text) => throughputs(text)?,
                None => vec![base.throughput],
            },
            normaliser: match self.normaliser {
                Normaliser::On => vec![true],
                Normaliser::Off => vec![false],
                Normaliser::Both => vec![true, false],
            },
            rounding: match self.rounding {
                RoundingArgument::Nearest => vec![Rounding::Nearest],
                RoundingArgument::Truncate => vec![Rounding::Truncate],
                RoundingArgument::Both => vec![Rounding::Nearest, Rounding::Truncate],
            },
        })
    }

    /// The vectors of each of `configurations`; neighbours with the same words share the work of choosing them.
    fn plans(&self, candidates: &[Candidate]) -> Result<Vec<Plan>> {
        let mut plans: Vec<Plan> = Vec::new();
        for (configuration, _) in candidates {
            let bits = configuration.x_bits + configuration.y_bits;
            if self.exhaustive && bits > 32 {
                return Err(Problem::at("--exhaustive", format_args!("words of {bits} bits together"))
                    .expected("at most 32")
                    .remedy("leave it out: weak vectors are all visited, strong ones drawn"));
            }
            let last = plans.last().filter(|plan| plan.serves(configuration)).cloned();
            plans.push(last.unwrap_or_else(|| Plan::new(configuration, self.samples, self.exhaustive)));
        }
        Ok(plans)
    }

    /// The sums of `shard` of all configurations: from the journal where it has them, evaluated and written down where not.
    fn measured(&self, candidates: &[Candidate], shard: Shard) -> Result<(Vec<(Plan, Tally)>, Effort)> {
        let mut journal = self.out.as_deref().map(|folder| Journal::open(folder, shard)).transpose()?;
        let plans = self.plans(candidates)?;
        let bar = progress::bar(plans.iter().map(|plan| plan.size(shard)).sum());
        let mut effort = Effort::default();
        let mut tallies = Vec::new();
        for ((configuration, unit), plan) in candidates.iter().zip(plans) {
            bar.set_message(configuration.to_string());
            let subject = subject(unit, configuration, &plan);
            let known = journal.as_ref().and_then(|journal| journal.find(&subject, shard).cloned());
            let tally = match known {
                Some(tally) => {
                    effort.known += 1;
                    bar.inc(plan.size(shard));
                    tally
                }
                None => {
                    let tally = timed(unit, configuration, &plan, shard, &bar, &mut effort);
                    if let Some(journal) = &mut journal {
                        journal.add(&subject, shard, &tally)?;
                    }
                    tally
                }
            };
            tallies.push((plan, tally));
        }
        bar.finish_and_clear();
        if effort.known > 0 {
            say!("{} taken from the journal of an earlier run", counted(effort.known, "configuration"));
        }
        Ok((tallies, effort))
    }

    fn one_shard(&self, candidates: &[Candidate], shard: Shard) -> Result<ExitCode> {
        self.measured(candidates, shard)?;
        let folder = self.out.as_deref().unwrap_or(Path::new("."));
        say!(
            "{}: shard {shard} of {} is done; when all are, the same command with --merge adds them up",
            journal::path_in(folder, shard).display(),
            counted(candidates.len(), "configuration")
        );
        Ok(ExitCode::SUCCESS)
    }

    /// The sums of all shards, from all journals in the folder.
    fn merged(&self, candidates: &[Candidate]) -> Result<(Vec<(Plan, Tally)>, Effort)> {
        let folder = self.out.as_deref().unwrap_or(Path::new("."));
        let mut records = Vec::new();
        for path in journal::paths_in(folder)? {
            records.extend(journal::read(&path)?.0);
        }
        let merged = |((configuration, unit), plan): (&Candidate, Plan)| {
            let subject = subject(unit, configuration, &plan);
            Ok((plan, journal::merged(folder, &records, &subject)?))
        };
        let tallies = candidates.iter().zip(self.plans(candidates)?).map(merged).collect::<Result<_>>()?;
        Ok((tallies, Effort::default()))
    }

    /// Tables, and the files where a folder is given.
    fn report(&self, points: &[Point], frequency_hz: f64) -> Result<()> {
        match points {
            [point] => say!("{}", octave_table(point, frequency_hz)),
            _ => {
                say!(
                    "{}; those that no other beats in area and largest error, at {} MHz:\n",
                    counted(points.len(), "configuration"),
                    frequency_hz / 1e6
                );
                say!("{}", front_table(points, frequency_hz));
            }
        }
        if let Some(folder) = &self.out {
            let columns = sweep_columns(points, frequency_hz);
            let subtitle = format!(
                "{}, phase in integers against exact arithmetic",
                counted(points.len(), "configuration")
            );
            let svg = sweep_picture(points, frequency_hz, &subtitle);
            let [csv_name, parquet_name, svg_name] = output::NAMES;
            output::write(
                folder,
                [
                    (csv_name, sweep_csv(&columns)?.into_bytes()),
                    (parquet_name, sweep_parquet(&columns)?),
                    (svg_name, svg.into_bytes()),
                ],
            )?;
            say!("written: {} in {}", output::NAMES.join(", "), folder.display());
        }
        Ok(())
    }

    /// Fits the area model to the synthesised rows of the CSV at `path`.
    fn fit_area(&self, path: &Path) -> Result<ExitCode> {
        let points = output::synthesised_points(path)?;
        if points.is_empty() {
            return Err(Problem::in_file(path, "has no synthesised area")
                .expected("rows with area_source \"synthesised\""));
        }
        let kind = |unit: &AngleUnit| match unit.architecture {
            Architecture::Unrolled => "unrolled",
            Architecture::Folded { .. } => "folded",
            Architecture::Iterative => "one iteration a clock",
            Architecture::Tables => "tables and multipliers",
        };
        for name in ["unrolled", "folded", "one iteration a clock"] {
            let points: Vec<_> = points.iter().filter(|(unit, _)| kind(unit) == name).cloned().collect();
            if points.is_empty() {
                continue;
            }
            let (model, worst) = AreaModel::fit(&points)?;
            say!("{name}: largest deviation {:.1} % over {}", 100.0 * worst, counted(points.len(), "point"));
            for (name, luts) in model.named() {
                say!("  {name:7} {luts:9.4} LUTs a bit");
            }
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// What is swept.
type Candidate = (Configuration, AngleUnit);

/// Reads a list such as `1,4,iterative`.
fn throughputs(text: &str) -> Result<Vec<Throughput>> {
    let named = |name: &str| {
        throughput_named(name).ok_or_else(|| {
            Problem::at("--cycles-per-pixel", format_args!("\"{text}\""))
                .expected("whole numbers and \"iterative\", such as 1,4,iterative")
        })
    };
    text.split(',').map(named).collect()
}

fn subject(unit: &AngleUnit, configuration: &Configuration, plan: &Plan) -> Subject {
    Subject {
        configuration: *configuration,
        coverage: plan.coverage(),
        fingerprint: Record::fingerprint_of(unit, configuration),
    }
}

fn timed(
    unit: &AngleUnit,
    configuration: &Configuration,
    plan: &Plan,
    shard: Shard,
    bar: &ProgressBar,
    effort: &mut Effort,
) -> Tally {
    let exact = ExactAngle::new(configuration.metric);
    let start = Instant::now();
    let tally = evaluate(unit, &exact, plan, shard, &|vectors| bar.inc(vectors));
    effort.time += start.elapsed();
    let (even, corners) = tally.overall();
    effort.vectors += even.vectors + corners.vectors;
    tally
}
