//! `vuris algorithms`

use super::print::say;
use super::progress;
use crate::algorithms::{Algorithm, Request, design, named, table, usual_steps};
use crate::artifact::{Artifact, write};
use crate::problem::{Problem, Result};
use crate::report::{
    Bench, algorithm_explanation, algorithms_json, algorithms_picture, algorithms_table, curves_csv,
    design_table, designs_json,
};
use crate::spec::{Pipeline, Scheme, StepAngle};
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;
use std::process::ExitCode;

/// Phase algorithms: what the roots of their characteristic polynomials reject, how noise and disturbances move their phase,
/// and the design of new rows of weights
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true)]
pub(super) struct Algorithms {
    #[command(subcommand)]
    command: Option<Command>,
    /// Print the table for programs, as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    curves: Curves,
}

#[derive(Debug, Subcommand)]
enum Command {
    Show(Show),
    Design(Design),
}

/// Where the sensitivity curves go.
#[derive(Debug, Args)]
struct Curves {
    /// Write the sensitivity curves to this folder: algorithms.csv, algorithms.svg
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Modulation frequency, for velocities
    #[arg(long, value_name = "HZ", default_value_t = 30e6)]
    frequency_hz: f64,
    /// Time from one frame to the next, for velocities
    #[arg(long, value_name = "MS", default_value_t = 31.25)]
    frame_ms: f64,
}

/// One algorithm: polynomial, roots, verdict, sensitivities
#[derive(Debug, Args)]
struct Show {
    /// A row of the table, or a TOML file: a specification, or one with nothing but [modulation.scheme]
    name: String,
    /// Print it for programs, as JSON
    #[arg(long, conflicts_with = "toml")]
    json: bool,
    /// Print a specification with it instead, for `vuris generate`
    #[arg(long)]
    toml: bool,
    #[command(flatten)]
    curves: Curves,
}

/// Search rows of small integers that withstand what is asked for, ranked by noise, cost and frames
#[derive(Debug, Args)]
struct Design {
    /// Harmonics to reject
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    reject: Vec<usize>,
    /// What else must not make the phase swing
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_enum)]
    tolerate: Vec<Tolerate>,
    /// Frames at most
    #[arg(long, value_name = "N")]
    frames: usize,
    /// Phase steps to try, fractions of a turn [default: 1/3, 1/4, 1/6, 1/8, 1/9, 1/12]
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    step: Vec<String>,
    /// Bits at most by which a sum may be longer than a frame's word
    #[arg(long, value_name = "BITS", default_value_t = 8)]
    growth: u32,
    /// Rows to print
    #[arg(long, value_name = "N", default_value_t = 10)]
    show: usize,
    /// Print them for programs, as JSON
    #[arg(long, conflicts_with = "toml")]
    json: bool,
    /// Print a specification with the first instead, for `vuris generate`
    #[arg(long)]
    toml: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Tolerate {
    /// A linear step error, and motion at a constant velocity: to the first order
    Motion,
    /// The same to the second order
    Motion2,
    /// The harmonics are rejected under a linear step error, too
    Harmonics,
    /// Linear drifts of offset and amplitude
    Drift,
}

/// The algorithms whose curves are drawn where none is named: more would hide each other.
const DRAWN: [&str; 7] = ["four_frame", "wdft", "hariharan", "wdft-4", "n-plus-3-6", "carre", "novak"];

impl Algorithms {
    pub(super) fn run(self) -> Result<ExitCode> {
        match self.command {
            Some(Command::Show(show)) => return show.run(),
            Some(Command::Design(design)) => return design.run(),
            None => {}
        }
        let bench = self.curves.bench()?;
        let rows = table()?;
        if self.json {
            say!("{}", algorithms_json(&rows));
        } else {
            say!("{}", algorithms_table(&rows));
        }
        if let Some(folder) = &self.curves.out {
            let drawn: Vec<Algorithm> =
                rows.iter().filter(|row| DRAWN.contains(&&*row.name)).cloned().collect();
            let files = || files(&rows, &drawn, &bench, "algorithms");
            write(folder, &progress::during("simulating", files)?)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

impl Curves {
    fn bench(&self) -> Result<Bench> {
        let refuse =
            |option: &str, value: f64| Problem::at("vuris algorithms", format_args!("{option} {value}"));
        if !(1e4..=1e10).contains(&self.frequency_hz) {
            return Err(refuse("--frequency-hz", self.frequency_hz).expected("1e4 to 1e10 Hz"));
        }
        if !(1e-3..=1e4).contains(&self.frame_ms) {
            return Err(refuse("--frame-ms", self.frame_ms).expected("0.001 to 10000 ms"));
        }
        Ok(Bench { frequency_hz: self.frequency_hz, frame_s: self.frame_ms / 1e3 })
    }
}

/// The curves of `rows` as CSV and those of `drawn` as a picture, each with the mark by which a later run knows that it may
/// replace the file.
fn files(rows: &[Algorithm], drawn: &[Algorithm], bench: &Bench, name: &str) -> Result<Vec<Artifact>> {
    let mark = "Generated by `vuris algorithms`.";
    Ok(vec![
        Artifact::new(format!("{name}.csv"), format!("# {mark}\n{}", curves_csv(rows, bench)?)),
        Artifact::new(
            format!("{name}.svg"),
            format!("<!-- {mark} -->\n{}", algorithms_picture(drawn, bench)),
        ),
    ])
}

/// The row or the file called `name`.
fn algorithm(name: &str) -> Result<Algorithm> {
    if let Some(row) = named(name)? {
        return Ok(row);
    }
    let names: Vec<String> =
        table()?.into_iter().map(|row| row.name).filter(|row| !row.starts_with("dft-")).collect();
    let scheme = Scheme::of_file(name, &format!("{}, dft-3 to dft-64", names.join(", ")))?;
    Algorithm::of_scheme(&scheme).ok_or_else(|| {
        Problem::at(name, "step_turns whose parts of a turn are too many to count")
            .expected("angles with a common denominator up to 1048576")
            .remedy("choose angles with fewer different denominators")
    })
}

/// The preset's specification with another scheme, as a TOML file.
fn specification(scheme: &Scheme) -> Result<String> {
    let pipeline = Pipeline::named("vuris")?.adapted(&scheme.name, |specification| {
        specification.name = "vuris-row".to_owned();
        specification.modulation.scheme = scheme.clone();
        specification.modulation.order = None;
    })?;
    Ok(pipeline.to_toml())
}

impl Show {
    fn run(self) -> Result<ExitCode> {
        let bench = self.curves.bench()?;
        let row = algorithm(&self.name)?;
        if self.toml {
            let scheme = row.scheme.as_ref().ok_or_else(|| {
                Problem::at(&row.name, "is not linear in the frames: it has no weights")
                    .expected("an algorithm with weights")
                    .remedy("`vuris algorithms` lists them; novak is hariharan around its nominal step")
            })?;
            say!("{}", specification(scheme)?.trim_end());
        } else if self.json {
            say!("{}", algorithms_json(std::slice::from_ref(&row)));
        } else {
            say!("{}", algorithm_explanation(&row, &bench).trim_end());
        }
        if let Some(folder) = &self.curves.out {
            let rows = std::slice::from_ref(&row);
            let name = format!("algorithm-{}", row.name);
            write(folder, &progress::during("simulating", || files(rows, rows, &bench, &name))?)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

impl Design {
    fn run(self) -> Result<ExitCode> {
        let steps: Vec<StepAngle> = self
            .step
            .iter()
            .map(|text| {
                StepAngle::parse(text).ok_or_else(|| {
                    Problem::at("vuris algorithms design", format_args!("--step {text}"))
                        .expected("fractions of a turn such as 1/3")
                })
            })
            .collect::<Result<_>>()?;
        let tolerated = |what: Tolerate| self.tolerate.contains(&what);
        let request = Request {
            reject: self.reject.clone(),
            motion: match (tolerated(Tolerate::Motion), tolerated(Tolerate::Motion2)) {
                (_, true) => 2,
                (true, false) => 1,
                (false, false) => 0,
            },
            harmonics_in_motion: tolerated(Tolerate::Harmonics),
            drift: tolerated(Tolerate::Drift),
            frames: self.frames,
            growth_bits: self.growth,
            steps: if steps.is_empty() { usual_steps() } else { steps },
        };
        let designs = progress::during("searching", || design(&request))?;
        let shown = &designs[..designs.len().min(self.show.max(1))];
        if self.toml {
            say!("{}", specification(&designs[0].scheme)?.trim_end());
        } else if self.json {
            say!("{}", designs_json(shown));
        } else {
            say!("{}", design_table(shown));
            say!("{} of {} rows; --show N prints others", shown.len(), designs.len());
        }
        Ok(ExitCode::SUCCESS)
    }
}
